// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How names are shared between the library, which is built with hidden visibility, and its users.
//
// Everything public is declared in delos::api, and each header brings its names into delos, which
// is where users find them: delos::Grid, delos::Error. The library's own sources define
// DELOS_BUILDING_LIBRARY and see only delos::api, because the engine has private types of the
// same names.

#define DELOS_API __attribute__((visibility("default")))
