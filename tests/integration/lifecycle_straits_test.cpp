// SPDX-License-Identifier: BSD-3-Clause
// The straits and isthmuses that come with the configurations, on the bathymetry that delos
// carries.
#include <doctest/doctest.h>

#include <set>

#include "io/geojson.hpp"
#include "support/products.hpp"

using namespace delos;
using delos::testing::made;
using delos::testing::value_of;

namespace {

const std::string kStraits = DELOS_SOURCE_DIR "/config/straits.geojson";

}  // namespace

TEST_CASE("the straits file has lines with names of their own, each a passage or a blockage") {
  std::set<std::string> names;
  std::size_t n_lines = 0;
  for (const char* const tag : {"passage", "minor_passage", "blockage"}) {
    for (const LonLatLine& line : read_lines(kStraits, tag)) {
      CAPTURE(line.name);
      CHECK(names.insert(line.name).second);
      ++n_lines;
    }
  }
  CHECK(read_lines(kStraits).size() == n_lines);
  CHECK(read_lines(kStraits, "any_passage").size() ==
        read_lines(kStraits, "passage").size() + read_lines(kStraits, "minor_passage").size());
}

TEST_CASE("at 120 km every strait of the straits file is open and every isthmus shut") {
  const Product product = made(
      "sizing: {sources: [{type: constant, spacing: 120 km}]}\ndata_path: []\n"
      "domain: {passages: {file: straits.geojson, select: any_passage}, blockages: {file: "
      "straits.geojson, select: blockage}, remove: [bays, channels]}\n",
      2, DELOS_SOURCE_DIR "/config");
  const auto of = [&](const char* key) {
    return value_of<std::int64_t>(product.report, "domain", key);
  };
  const auto n_of = [](const char* tag) {
    return static_cast<std::int64_t>(read_lines(kStraits, tag).size());
  };
  CHECK(of("n_passages") == n_of("any_passage"));
  CHECK(of("n_blockages") == n_of("blockage"));
  CHECK(value_of<std::string>(product.report, "domain", "passages_not_open").empty());
  CHECK(value_of<std::string>(product.report, "domain", "blockages_not_shut").empty());
}
