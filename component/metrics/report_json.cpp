// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <nlohmann/json.hpp>

#include "metrics/certificate.hpp"
#include "metrics/report.hpp"

namespace delos {
namespace {

using Json = nlohmann::ordered_json;

// A number for the report; `key` names it in the message when it can't be written.
Json number(const std::string& key, double value) {
  DELOS_CHECK(std::isfinite(value), ErrorKind::internal, "report key '", key, "' is ", value,
              ": a quality measure must be finite; keep the configuration and report a bug.");
  return value;
}

Json place(const std::string& key, const Extreme& extreme) {
  Json out;
  out["value"] = number(key, extreme.value);
  const std::int64_t id = extreme.id + kReportIndexBase;
  if (extreme.element == Element::edge) {
    out["cells"] = {id, extreme.other + kReportIndexBase};
  } else {
    out[extreme.element == Element::triangle ? "triangle" : "cell"] = id;
  }
  out["lon_deg"] = number(key, extreme.where.lon_rad * kDegPerRad);
  out["lat_deg"] = number(key, extreme.where.lat_rad * kDegPerRad);
  return out;
}

Json histogram(const Histogram& bins) {
  return {{"lower", bins.lower}, {"upper", bins.upper}, {"counts", bins.counts}};
}

// An object filled key by key, every number checked.
struct Object {
  Json json = Json::object();
  Object& add(const std::string& key, double value) {
    json[key] = number(key, value);
    return *this;
  }
  Object& add(const std::string& key, std::int64_t value) {
    json[key] = value;
    return *this;
  }
  Object& add(const std::string& key, const Extreme& value) {
    json[key] = place(key, value);
    return *this;
  }
};

Json counts_json(const Report& report) {
  const Quality& q = report.quality;
  Object out;
  out.add("cells", q.n_vertices).add("vertices", q.n_triangles + q.n_border_vertices);
  out.add("edges", q.n_edges + q.n_border_edges);
  if (q.has_border()) {
    out.add("border_vertices", q.n_border_vertices).add("border_edges", q.n_border_edges);
  }
  if (report.n_cells_made > 0) out.add("cells_made", report.n_cells_made);
  if (report.expected_vertices > 0.0) {
    const std::int64_t n_made = report.n_cells_made > 0 ? report.n_cells_made : q.n_vertices;
    out.add("cells_expected", report.expected_vertices);
    out.add("cells_over_expected", static_cast<double>(n_made) / report.expected_vertices);
  }
  out.add("euler", q.euler).add("non_delaunay_sides", q.n_non_delaunay);
  out.add("degenerate_triangles", q.n_degenerate);
  return out.json;
}

Json quality_json(const Quality& q) {
  Object out;
  out.add("area_length_min", q.area_length_min).add("area_length_p01", q.area_length_p01);
  out.add("area_length_mean", q.area_length_mean);
  out.add("angle_min_deg", q.angle_min_deg).add("angle_max_deg", q.angle_max_deg);
  out.add("angle_mad_deg", q.angle_mad_deg);
  out.add("radius_edge_max", q.radius_edge_max).add("radius_edge_mean", q.radius_edge_mean);
  if (q.knows_spacing) {
    out.add("relative_edge_mean", q.relative_edge_mean);
    out.add("relative_edge_std", q.relative_edge_std);
    out.add("relative_edge_min", q.relative_edge_min).add("relative_edge_max", q.relative_edge_max);
  }
  out.add("degree_5", q.degree_5).add("degree_6", q.degree_6).add("degree_7", q.degree_7);
  out.add("degree_other", q.degree_other).add("n_degree_5", q.n_degree_5);
  out.add("n_degree_6", q.n_degree_6).add("n_degree_7", q.n_degree_7);
  out.add("n_degree_other", q.n_degree_other);
  out.add("degree_min", q.degree_min).add("degree_max", q.degree_max);
  out.add("well_centred", q.well_centred).add("n_obtuse", q.n_obtuse);
  out.add("dual_ratio_min", q.dual_ratio_min).add("dual_ratio_mean", q.dual_ratio_mean);
  out.add("stagger_mean", q.stagger_mean).add("stagger_max", q.stagger_max);
  out.add("grading_max", q.grading_max);
  return out.json;
}

Json sizes_json(const Quality& q) {
  Object out;
  if (q.knows_spacing) {
    out.add("spacing_min_m", q.spacing_min_m).add("spacing_max_m", q.spacing_max_m);
  }
  out.add("edge_length_min_m", q.edge_length_min_m);
  out.add("edge_length_mean_m", q.edge_length_mean_m);
  out.add("edge_length_max_m", q.edge_length_max_m);
  out.add("cell_area_min_m2", q.cell_area_min_m2).add("cell_area_max_m2", q.cell_area_max_m2);
  out.add("total_area_m2", q.total_area_m2);
  if (!q.has_border()) out.add("total_area_error", q.total_area_error);
  return out.json;
}

Json certificate_json(const Certificate& c) {
  Json out;
  out["well_centred"] = c.is_well_centred();
  out["well_centred_fraction"] = number("well_centred_fraction", c.well_centred);
  out["n_obtuse"] = c.n_obtuse;
  out["angle_max_deg"] = place("angle_max_deg", c.angle_max_deg);
  if (c.relative_edge_min) {
    out["spacing_kept"] = c.keeps_spacing();
    out["relative_edge_bound"] = kRelativeEdgeBound;
    out["relative_edge_min"] = place("relative_edge_min", *c.relative_edge_min);
  }
  out["dual_ratio_min"] = place("dual_ratio_min", c.dual_ratio_min);
  out["stagger_max"] = place("stagger_max", c.stagger_max);
  return out;
}

Json section_json(const ReportSection& section) {
  Json out = Json::object();
  for (const auto& entry : section.values) {
    const std::string& key = entry.first;
    std::string name = section.name;
    name.append(".").append(key);
    if (const auto* real = std::get_if<double>(&entry.second)) {
      out[key] = number(name, *real);
    } else {
      std::visit([&](const auto& plain) { out[key] = plain; }, entry.second);
    }
  }
  return out;
}

Json partitions_json(const std::vector<ReportPartition>& partitions) {
  Json out = Json::array();
  for (const ReportPartition& partition : partitions) {
    Object entry;
    entry.add("parts", partition.n_parts);
    entry.json["method"] = partition.method;
    entry.add("cut_edges", partition.n_cut_edges).add("cut_share", partition.cut_share);
    entry.add("heaviest", partition.heaviest).add("lightest", partition.lightest);
    out.push_back(entry.json);
  }
  return out;
}

Json phases_json(const std::vector<PhaseTime>& phases) {
  Json out = Json::array();
  for (const PhaseTime& phase : phases) {
    out.push_back({{"phase", phase.phase},
                   {"wall_s", phase.wall_s},
                   {"cpu_s", phase.cpu_s},
                   {"items", phase.items}});
  }
  return out;
}
ReportValue plain_value(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  return json.get<std::string>();
}
}  // namespace

std::string report_json(const Report& report) {
  const Ellipsoid& surface = report.surface;
  const Vec3 radii_m = surface.scale_m() * surface.radii();
  Json out;
  out["title"] = report.title;
  out["delos_version"] = report.version;
  out["digest"] = report.digest;
  out["radii_m"] = {radii_m.x(), radii_m.y(), radii_m.z()};
  out["index_base"] = kReportIndexBase;
  out["counts"] = counts_json(report);
  out["sizes"] = sizes_json(report.quality);
  out["quality"] = quality_json(report.quality);
  out["certificate"] = certificate_json(certificate(report.quality));
  out["requirements_missed"] = report.missed;
  for (const ReportSection& section : report.sections) out[section.name] = section_json(section);
  if (!report.partitions.empty()) out["partitions"] = partitions_json(report.partitions);
  out["inputs"] = Json::array();
  for (const ReportInput& input : report.inputs) {
    out["inputs"].push_back({{"path", input.path}, {"sha256", input.sha256}});
  }
  out["histograms"] = {{"area_length", histogram(report.quality.area_length)},
                       {"angle_deg", histogram(report.quality.angle_deg)},
                       {"relative_edge", histogram(report.quality.relative_edge)},
                       {"degree", histogram(report.quality.degree)}};
  out["threads"] = report.n_threads;
  out["phases"] = phases_json(report.phases);
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_notes(const Report& report) {
  // Arrays of pairs: a name may come twice.
  Json sections = Json::array(), inputs = Json::array();
  for (const ReportSection& section : report.sections) {
    if (section.name == "dual") continue;
    Json values = Json::array();
    for (const auto& [key, value] : section.values) {
      std::visit([&, name = key](const auto& plain) { values.push_back({name, plain}); }, value);
    }
    sections.push_back({section.name, values});
  }
  for (const ReportInput& input : report.inputs) inputs.push_back({input.path, input.sha256});
  return Json{{"sections", sections}, {"inputs", inputs}}.dump(-1, ' ', false,
                                                               Json::error_handler_t::replace);
}

void add_report_notes(const std::string& notes, Report& report) {
  try {
    const Json all = Json::parse(notes);
    for (const Json& section : all.at("sections")) {
      ReportSection out{section.at(0), {}};
      for (const Json& value : section.at(1)) {
        out.values.emplace_back(value.at(0), plain_value(value.at(1)));
      }
      report.sections.push_back(std::move(out));
    }
    for (const Json& input : all.at("inputs")) {
      report.inputs.push_back({input.at(0), input.at(1)});
    }
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::input, text("the notes of a report can't be read: ", error.what()));
  }
}

}  // namespace delos
