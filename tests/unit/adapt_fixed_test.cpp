// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/fixed.hpp"

#include <doctest/doctest.h>

#include "core/types.hpp"

using namespace delos;

namespace {

LonLat place(double lon_deg, double lat_deg) {
  return {lon_deg * kRadPerDeg, lat_deg * kRadPerDeg};
}

std::vector<char> in(const FixedRegion& region, const std::vector<LonLat>& places) {
  parallel::Executor exec(2);
  return in_fixed_regions(exec, std::span(&region, 1), places);
}

}  // namespace

TEST_CASE("a fixed disc holds what is near on the sphere, over pole and date line") {
  CHECK(in(FixedDisc{179.0, 0.0, 3.0 * kRadPerDeg},
           {place(181.0, 0.0), place(-179.0, 2.0), place(176.5, 0.0), place(175.0, 0.0),
            place(0.0, 0.0)}) == std::vector<char>{1, 1, 1, 0, 0});
  CHECK(in(FixedDisc{0.0, 89.0, 2.5 * kRadPerDeg},
           {place(180.0, 89.0), place(90.0, 88.0), place(180.0, 88.0)}) ==
        std::vector<char>{1, 1, 0});
}

TEST_CASE("a fixed box may cross the date line or go round") {
  const std::vector<LonLat> places{place(170.0, 0.0), place(190.0, 0.0), place(0.0, 0.0),
                                   place(180.0, 20.0)};
  for (const FixedBox& box :
       {FixedBox{160.0, -160.0, -10.0, 10.0}, FixedBox{160.0, 200.0, -10.0, 10.0},
        FixedBox{-200.0, -160.0, -10.0, 10.0}}) {
    CHECK(in(box, places) == std::vector<char>{1, 1, 0, 0});
  }
  CHECK(in(FixedBox{-180.0, 180.0, -10.0, 30.0}, places) == std::vector<char>{1, 1, 1, 1});
}

TEST_CASE("without regions nothing is fixed") {
  parallel::Executor exec(1);
  const std::vector<LonLat> places(3, place(0.0, 0.0));
  CHECK(in_fixed_regions(exec, {}, places).empty());
}
