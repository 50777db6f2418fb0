// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/settings_domain.hpp"

#include <algorithm>

#include "domain/tips.hpp"
#include "lifecycle/settings_reader.hpp"

namespace delos {
namespace {

FileRequest file_of(MapReader& keys) {
  FileRequest request;
  request.file = keys.string("file", nullptr, "land.geojson");
  request.where = keys.locate("file");
  return request;
}

LinesRequest read_lines_request(MapReader& domain, const char* key) {
  LinesRequest out;
  if (!domain.has(key)) return out;
  MapReader keys = domain.map(key, {"file", "select", "except"});
  out.file = file_of(keys);
  out.select = keys.string("select", "");
  out.except = keys.strings("except", {}, {});
  return out;
}

void read_bodies(MapReader& domain, domain::OceanOptions& out) {
  using domain::BodyRule;
  constexpr BodyRule kRules[] = {BodyRule::largest, BodyRule::all, BodyRule::named};
  const std::size_t rule = domain.choice("bodies", {"largest", "all", "named"}, "largest");
  out.bodies = kRules[rule];
  domain.each("at", [&](const ConfigNode& node, const std::string& path, ConfigNode& effective) {
    MapReader keys(node, path, effective, {"lon", "lat"});
    const auto degrees = [&](const char* key, double limit) {
      return keys.quantity(key, Dimension::angle, Bounds::between(-limit, limit)) * kRadPerDeg;
    };
    const double lon = degrees("lon", 360.0);
    out.body_points.push_back({lon, degrees("lat", 90.0)});
  });
  const bool is_named = out.bodies == BodyRule::named;
  if (is_named && out.body_points.empty()) {
    domain.fail("at", "bodies: named needs a point in each body, e.g. at: [{lon: 35 deg, ",
                "lat: 43 deg}].");
  }
  if (!is_named && !out.body_points.empty()) {
    domain.fail("at", "points go with bodies: named. Set that, or remove them.");
  }
}

}  // namespace

std::optional<DomainSettings> read_domain(MapReader& root) {
  if (!root.has("domain")) return std::nullopt;
  DomainSettings out;
  MapReader domain =
      root.map("domain", {"wet_fraction", "sea_level", "land", "passages", "blockages", "bodies",
                          "at", "remove", "fit_coast", "order", "parts"});
  constexpr double kLeastShare = 0.001;  // at 0 every cell is sea
  out.options.least_wet =
      domain.quantity("wet_fraction", Dimension::none, Bounds::between(kLeastShare, 1.0), "0.5");
  if (domain.has("land")) {
    if (domain.has("sea_level")) {
      domain.fail("sea_level", "belongs to the bathymetry, which `land` takes the place of. ",
                  "Remove one of the two.");
    }
    MapReader keys = domain.map("land", {"file", "feature"});
    out.land = file_of(keys);
    out.land_feature = keys.string("feature", "");
  } else {
    out.options.sea_level_m = domain.quantity("sea_level", Dimension::length, Bounds::any(), "0 m");
  }
  out.passages = read_lines_request(domain, "passages");
  out.blockages = read_lines_request(domain, "blockages");
  read_bodies(domain, out.options);
  const auto removed = domain.strings("remove", {"bays", "channels"}, {});
  const auto removes = [&](const char* what) {
    return std::find(removed.begin(), removed.end(), what) != removed.end();
  };
  out.options.prune = {removes("bays"), removes("channels")};
  out.fits_coast = domain.boolean("fit_coast", false);
  if (out.fits_coast) out.options.tip_margin = domain::kTipMargin;
  const CellOrderSettings order = read_cell_order(domain, "parts", domain::CellOrder::hilbert);
  out.options.order = order.kind;
  out.options.n_parts = order.n_parts;
  return out;
}

CellOrderSettings read_cell_order(MapReader& keys, const char* parts_key,
                                  domain::CellOrder standard) {
  using domain::CellOrder;
  constexpr CellOrder kCellOrders[] = {CellOrder::hilbert, CellOrder::metis, CellOrder::kept};
  constexpr std::int64_t kMaxParts = 1'000'000;
  CellOrderSettings out;
  out.kind = kCellOrders[keys.choice("order", {"hilbert", "metis", "kept"},
                                     standard == CellOrder::kept ? "kept" : "hilbert")];
  if (out.kind == CellOrder::metis) {
    if (!keys.has(parts_key)) {
      keys.fail(parts_key, "order: metis needs the number of parts, e.g. ", parts_key, ": 64.");
    }
    out.n_parts = keys.integer(parts_key, 2, kMaxParts);
  } else if (keys.has(parts_key)) {
    keys.fail(parts_key, "goes with order: metis. Set that, or remove it.");
  }
  return out;
}

}  // namespace delos
