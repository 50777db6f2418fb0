// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/fixed.hpp"

#include <doctest/doctest.h>

#include "core/types.hpp"
#include "sizing/analytic.hpp"

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

TEST_CASE("fixed polygons hold what their rings do, over date line and pole, with holes") {
  auto set = std::make_shared<PolygonSet>();
  set->source = "test";
  // A square over the date line with a square hole; a cap round the south pole.
  set->rings = {{{170.0, 190.0, 190.0, 170.0}, {-10.0, -10.0, 10.0, 10.0}, 0},
                {{178.0, 182.0, 182.0, 178.0}, {-2.0, -2.0, 2.0, 2.0}, 0},
                {{-180.0, -90.0, 0.0, 90.0, 170.0}, {-70.0, -70.0, -70.0, -70.0, -70.0}, 1}};
  const std::vector<LonLat> places{place(172.0, 0.0), place(-172.0, 5.0),  place(188.0, -9.0),
                                   place(180.0, 0.0), place(-179.0, 1.0),  place(165.0, 0.0),
                                   place(0.0, -80.0), place(120.0, -90.0), place(175.0, -71.0),
                                   place(0.0, -69.0), place(180.0, 11.0)};
  const std::vector<char> expected{1, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0};
  CHECK(in(FixedPolygons{set}, places) == expected);
  // The same as on the nodes of a table.
  const LatLonField table = make_table(2.5 * kRadPerDeg);
  std::vector<LonLat> nodes;
  for (Index j = 0; j < table.n_rows(); ++j) {
    for (Index i = 0; i < table.n_lon; ++i) nodes.push_back({table.lon_rad(i), table.lat_rad(j)});
  }
  parallel::Executor exec(2);
  const std::vector<char> of_table = inside_polygons(exec, *set, table);
  const std::vector<char> of_places = inside_polygons(exec, *set, nodes);
  std::size_t n_other = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) n_other += of_table[i] != of_places[i] ? 1 : 0;
  // Nodes on a side may go either way by rounding.
  CHECK(n_other < 40);
}

TEST_CASE("without regions nothing is fixed") {
  parallel::Executor exec(1);
  const std::vector<LonLat> places(3, place(0.0, 0.0));
  CHECK(in_fixed_regions(exec, {}, places).empty());
}
