// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Surfaces and spacings that the tests of refinement and relaxation share: kind and hostile ones,
// a few thousand vertices each.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/hash.hpp"
#include "core/progress.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/spacing.hpp"

namespace delos {

struct SampleSpacing {
  std::string name;
  Ellipsoid surface;
  SpacingField spacing;
  bool is_smooth;  ///< gradient well below 1: all guarantees of quality hold
};

/// Threads and monitor of one run.
struct TestRun {
  explicit TestRun(int threads) : exec(threads) {}
  parallel::Executor exec;
  Monitor monitor;
  Context context{exec, monitor};
};

/// digest_of(context, sample) for 1 thread and for 2, 5 and 8: must be equal for every sample.
template <class DigestOf>
void check_same_bits_for_any_threads(const std::vector<SampleSpacing>& samples,
                                     const DigestOf& digest_of) {
  for (const SampleSpacing& sample : samples) {
    CAPTURE(sample.name);
    TestRun one(1);
    const std::string bits = digest_of(one.context, sample);
    for (const int threads : {2, 5, 8}) {
      CAPTURE(threads);
      TestRun run(threads);
      CHECK(digest_of(run.context, sample) == bits);
    }
  }
}

/// A table of 1 degree from spacing_m(lon_deg, lat_deg, column, row).
template <class Function>
SpacingField sample_table(const Ellipsoid& surface, const Function& spacing_m) {
  LatLonField field{180, 360, {}};
  for (Index j = 0; j < field.n_rows(); ++j) {
    for (Index i = 0; i < field.n_lon; ++i) {
      field.values.push_back(
          spacing_m(field.lon_rad(i) * kDegPerRad, field.lat_rad(j) * kDegPerRad, i, j));
    }
  }
  return SpacingField::table(surface, LatitudeKind::geodetic, field);
}

inline std::vector<SampleSpacing> sample_spacings() {
  const Ellipsoid earth = Ellipsoid::sphere(6371220.0), wgs84 = Ellipsoid::wgs84();
  const Ellipsoid triaxial(Vec3(1.2, 1.0, 0.8) * 6371220.0, Vec3(1e6, -2e6, 3e6));
  const Ellipsoid flat(Vec3(1.0, 0.7, 0.4) * 6371220.0, Vec3(0, 0, 0));
  const auto patch = [](double lon, double lat, Index, Index) {
    const double d2 = (lon + 40.0) * (lon + 40.0) + (lat - 35.0) * (lat - 35.0);
    return 1e3 * (600.0 - 480.0 * std::exp(-d2 / 800.0));
  };
  const auto pole = [](double, double lat, Index, Index) {
    return 1e3 * (60.0 + 6.0 * (90.0 - lat));
  };
  const auto step = [](double lon, double, Index, Index) { return lon < 0.0 ? 200e3 : 800e3; };
  const auto noise = [](double, double, Index i, Index j) {
    return 1e3 * (250.0 + 350.0 * uniform01(7, static_cast<std::uint64_t>(j * 360 + i)));
  };
  return {{"uniform 240 km sphere", earth, SpacingField::constant(earth, 240e3), true},
          {"uniform 300 km WGS84", wgs84, SpacingField::constant(wgs84, 300e3), true},
          {"uniform 300 km triaxial", triaxial, SpacingField::constant(triaxial, 300e3), true},
          {"uniform 250 km, 1 : 0.7 : 0.4", flat, SpacingField::constant(flat, 250e3), true},
          {"patch 600 to 120 km", earth, sample_table(earth, patch), true},
          {"finest at the pole", earth, sample_table(earth, pole), true},
          {"uniform 3000 km", earth, SpacingField::constant(earth, 3000e3), false},
          {"step 200 to 800 km", earth, sample_table(earth, step), false},
          {"noise at the scale of the table", earth, sample_table(earth, noise), false}};
}

}  // namespace delos
