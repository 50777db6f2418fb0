// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/settings_region.hpp"

#include <cmath>

#include "lifecycle/settings_reader.hpp"
#include "lifecycle/settings_sizing.hpp"

namespace delos {
namespace {

RegionDisc read_region_disc(MapReader keys, double radius_m) {
  const std::vector<double> centre =
      keys.quantities("centre", Dimension::angle, Bounds::between(-360.0, 360.0), {2, 2});
  if (std::abs(centre[1]) > 90.0) {
    keys.fail("centre", "is [longitude, latitude]; ", centre[1], " deg is no latitude.");
  }
  const double radius_rad = read_arc(keys, "radius", radius_m);
  if (!(radius_rad > 0.0 && radius_rad < kPi)) {
    keys.fail("radius", "is ", radius_rad * kDegPerRad, " deg: must be above 0 and below 180 deg.");
  }
  return {{centre[0] * kRadPerDeg, centre[1] * kRadPerDeg}, radius_rad};
}

/// Longitude and latitude in turn; longitudes go the short way from point to point.
std::shared_ptr<const PolygonSet> read_region_points(MapReader& keys) {
  constexpr std::size_t kFewest = 6, kMost = 200'000;
  const std::vector<double> degrees =
      keys.quantities("points", Dimension::angle, Bounds::between(-720.0, 720.0), {kFewest, kMost});
  if (degrees.size() % 2 != 0) {
    keys.fail("points", "has ", degrees.size(), " numbers; it is longitude, latitude in turn.");
  }
  PolygonRing ring;
  for (std::size_t i = 0; i < degrees.size(); i += 2) {
    const double lon = degrees[i], lat = degrees[i + 1];
    if (std::abs(lat) > 90.0) {
      keys.fail("points", lat, " deg is no latitude; give longitude, latitude in turn.");
    }
    constexpr double kTurn = 360.0;
    const double before = i == 0 ? lon : ring.lon_deg.back();
    ring.lon_deg.push_back(lon - kTurn * std::round((lon - before) / kTurn));
    ring.lat_deg.push_back(lat);
  }
  auto out = std::make_shared<PolygonSet>();
  out->source = keys.locate("points");
  out->rings.push_back(std::move(ring));
  return out;
}

}  // namespace

std::optional<RegionSettings> read_region(MapReader& root, double radius_m) {
  if (!root.has("region")) return std::nullopt;
  RegionSettings out;
  MapReader keys = root.map("region", {"disc", "points", "polygons", "relaxation_rings",
                                       "specified_rings", "growth", "align"});
  if (keys.has("disc") + keys.has("points") + keys.has("polygons") != 1) {
    keys.fail("disc",
              "a region is one of disc: {centre: [10 deg, 50 deg], radius: 1000 km}, points: ",
              "[0 deg, 40 deg, ...] or polygons: {file: region.geojson}.");
  }
  if (keys.has("disc")) {
    out.shape = read_region_disc(keys.map("disc", {"centre", "radius"}), radius_m);
  } else if (keys.has("points")) {
    out.shape = read_region_points(keys);
  } else {
    MapReader polygons = keys.map("polygons", {"file", "feature"});
    out.polygons.file = polygons.string("file", nullptr, "region.geojson");
    out.polygons.where = polygons.locate("file");
    out.feature = polygons.string("feature", "");
  }
  constexpr std::int64_t kMostRings = 100;
  out.rings.relaxation = static_cast<int>(keys.integer("relaxation_rings", 0, kMostRings, "5"));
  out.rings.specified = static_cast<int>(keys.integer("specified_rings", 0, kMostRings, "2"));
  // Above it triangles outside are too rough to be relaxed; below, they cost more than a region.
  constexpr double kLeastGrowth = 0.01, kMostGrowth = 1.0;
  out.growth =
      keys.quantity("growth", Dimension::none, Bounds::between(kLeastGrowth, kMostGrowth), "0.12");
  out.align = keys.boolean("align", out.align);
  return out;
}

}  // namespace delos
