// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/report.hpp"
