// SPDX-License-Identifier: BSD-3-Clause
// What a framework loads at run time: dlopen libdelos_bmi, then these two names (those that
// NextGen's "create_function" and "destroy_function" have by default).
#include <string>
#include <vector>

// CSDMS's header, where this build was shown one, makes the models its own; it needs the two above.
#if __has_include(<bmi.hxx>)
#include <bmi.hxx>
#endif

#include "delos/bmi.hpp"

namespace {
#if __has_include(<bmi.hxx>)
using Interface = bmi::Bmi;
#else
using Interface = delos::api::BmiInterface;
#endif
}  // namespace

/// A model that is not initialized, or null without memory for one.
extern "C" DELOS_API Interface* bmi_model_create() {
  try {
    return new delos::api::BmiModel<Interface>();
  } catch (...) {
    return nullptr;
  }
}

/// Of what bmi_model_create gave; null does nothing.
extern "C" DELOS_API void bmi_model_destroy(Interface* model) { delete model; }
