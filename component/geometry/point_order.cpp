// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/point_order.hpp"
