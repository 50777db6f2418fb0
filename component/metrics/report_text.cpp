// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "metrics/certificate.hpp"
#include "metrics/report.hpp"

namespace delos {
namespace {

constexpr std::size_t kColumns = 80;
constexpr std::size_t kLines = 24;

// printf into a string, for columns that line up; cut at the width of the screen.
template <class... Values>
std::string line(const char* format, const Values&... values) {
  char buffer[2 * kColumns];
  const int n = std::snprintf(buffer, sizeof buffer, format, values...);
  return {buffer, std::min(static_cast<std::size_t>(std::max(n, 0)), kColumns)};
}

std::string grouped(std::int64_t n) {
  std::string digits = std::to_string(n);
  for (int i = static_cast<int>(digits.size()) - 3; i > 0; i -= 3) {
    digits.insert(static_cast<std::size_t>(i), " ");
  }
  return digits;
}

std::string length(double metres) {
  char buffer[32];
  const bool is_long = metres >= 1000.0;
  std::snprintf(buffer, sizeof buffer, "%.4g %s", is_long ? metres / 1000.0 : metres,
                is_long ? "km" : "m");
  return buffer;
}

// "12.345W 67.890N"
std::string place_text(const LonLat& where) {
  const double lon = where.lon_rad * kDegPerRad, lat = where.lat_rad * kDegPerRad;
  char buffer[48];
  std::snprintf(buffer, sizeof buffer, "%.3f%c %.3f%c", std::abs(lon), lon < 0.0 ? 'W' : 'E',
                std::abs(lat), lat < 0.0 ? 'S' : 'N');
  return buffer;
}

void add_sizes(const Report& report, std::vector<std::string>& lines) {
  const Quality& q = report.quality;
  const Vec3 radii_km = report.surface.scale_m() / 1000.0 * report.surface.radii();
  lines.push_back(report.surface.is_sphere()
                      ? line("surface     sphere of radius %.6g km", radii_km.x())
                      : line("surface     ellipsoid %.7g x %.7g x %.7g km", radii_km.x(),
                             radii_km.y(), radii_km.z()));
  std::string counts = "cells       " + grouped(q.n_vertices);
  if (report.n_cells_made > 0) counts += " of " + grouped(report.n_cells_made) + " made";
  if (report.expected_vertices > 0.0) {
    const std::int64_t n_made = report.n_cells_made > 0 ? report.n_cells_made : q.n_vertices;
    counts += " (" + line("%.1f", 100.0 * static_cast<double>(n_made) / report.expected_vertices) +
              " % of the expected count)";
  }
  lines.push_back(counts);
  std::string also = "also        " + grouped(q.n_edges + q.n_border_edges) + " edges, ";
  also += q.has_border() ? grouped(q.n_border_edges) + " of them at the border, " : "";
  lines.push_back(also + grouped(q.n_triangles) + " triangles");
  lines.push_back("spacing     wanted " +
                  (q.knows_spacing ? length(q.spacing_min_m) + " to " + length(q.spacing_max_m)
                                   : std::string("unknown")) +
                  "; edges " + length(q.edge_length_min_m) + " to " + length(q.edge_length_max_m));
  const std::string sum = q.has_border()
                              ? line("%.6g million km2", q.total_area_m2 * 1e-12)
                              : line("sums to the surface within %.1e", q.total_area_error);
  lines.push_back(line("area        %s; cells %.4g to %.4g km2", sum.c_str(),
                       q.cell_area_min_m2.value * 1e-6, q.cell_area_max_m2.value * 1e-6));
}

// "12.345W 67.890N 17" for a triangle, "12.345W 67.890N 17-39" for the edge of two cells.
std::string element_text(const Extreme& worst) {
  std::string out = text(place_text(worst.where), " ", worst.id + kReportIndexBase);
  if (worst.element == Element::edge) out += text("-", worst.other + kReportIndexBase);
  return out;
}

void add_quality(const Quality& q, std::vector<std::string>& lines) {
  lines.push_back(
      "quality          worst    mean   ideal  place; triangle or cells of edge, from 1");
  const auto row = [&](const char* name, const Extreme& worst, double mean, const char* ideal) {
    lines.push_back(line("  %-11s %8.4f %7.4f %7s  %s", name, worst.value, mean, ideal,
                         element_text(worst).c_str()));
  };
  const auto single = [&](const char* name, const Extreme& worst, const char* ideal) {
    lines.push_back(line("  %-11s %8.4f %7s %7s  %s", name, worst.value, "", ideal,
                         element_text(worst).c_str()));
  };
  row("area-length", q.area_length_min, q.area_length_mean, "1");
  single("angle min", q.angle_min_deg, "60");
  single("angle max", q.angle_max_deg, "60");
  row("radius-edge", q.radius_edge_max, q.radius_edge_mean, "0.577");
  if (q.knows_spacing) {
    row("edge/h min", q.relative_edge_min, q.relative_edge_mean, "1");
    row("edge/h max", q.relative_edge_max, q.relative_edge_mean, "1");
  }
  row("dual/edge", q.dual_ratio_min, q.dual_ratio_mean, "0.577");
  row("stagger", q.stagger_max, q.stagger_mean, "0");
  lines.push_back(line("  degree 5 / 6 / 7 / other: %.2f / %.2f / %.2f / %.4f %%",
                       100.0 * q.degree_5, 100.0 * q.degree_6, 100.0 * q.degree_7,
                       100.0 * q.degree_other));
}

void add_verdict(const Report& report, std::vector<std::string>& lines) {
  const Quality& q = report.quality;
  const bool is_sound = (q.euler == 2 || q.has_border()) && q.n_degenerate == 0;
  lines.push_back(is_sound ? line("structure   %s; %lld non-Delaunay sides",
                                  q.has_border() ? "with a border" : "closed and whole",
                                  static_cast<long long>(q.n_non_delaunay))
                           : line("structure   BROKEN: Euler %lld, %lld degenerate triangles",
                                  static_cast<long long>(q.euler),
                                  static_cast<long long>(q.n_degenerate)));
  const char* head = "certificate ";
  for (const std::string& verdict : certificate_text(certificate(q))) {
    lines.push_back(head + verdict);
    head = "            ";
  }
  if (report.missed.empty()) return;
  std::string missed = "required    but missed:";
  for (const std::string& sentence : report.missed) {
    missed += " " + sentence.substr(0, sentence.find(':'));
  }
  lines.push_back(missed.substr(0, kColumns));
}

double real(const ReportSection& section, const char* key) {
  for (const auto& [name, value] : section.values) {
    if (name != key) continue;
    if (const auto* const whole = std::get_if<std::int64_t>(&value)) {
      return static_cast<double>(*whole);
    }
    if (const auto* const plain = std::get_if<double>(&value)) return *plain;
  }
  return 0.0;
}

/// Of the section "domain": what is left of the cells, and the lines that hold.
void add_domain(const ReportSection& section, std::vector<std::string>& lines) {
  lines.push_back(line("domain      %s cells, %.4g million km2, %.0f of %.0f bodies",
                       grouped(static_cast<std::int64_t>(real(section, "n_cells"))).c_str(),
                       1e-12 * real(section, "area_m2"), real(section, "n_bodies_kept"),
                       real(section, "n_bodies")));
  if (real(section, "n_passages") + real(section, "n_blockages") == 0.0) return;
  lines.push_back(line("            %.0f of %.0f passages open, %.0f of %.0f blockages shut",
                       real(section, "n_passages_open"), real(section, "n_passages"),
                       real(section, "n_blockages_shut"), real(section, "n_blockages")));
}

/// Of the section "region".
void add_region(const ReportSection& section, std::vector<std::string>& lines) {
  const auto count = [&](const char* key) {
    return grouped(static_cast<std::int64_t>(real(section, key)));
  };
  lines.push_back("region      " + count("n_cells") + " cells: " + count("n_inside") + " inside, " +
                  count("n_relaxation") + " relaxed, " + count("n_specified") + " specified");
}

void add_coast(const ReportSection& section, std::vector<std::string>& lines) {
  if (real(section, "n_edges") == 0.0) return;
  lines.push_back(line(
      "coast       %.0f km, %.3f of its line, %.1f km off; %.0f tips; steps %.1f km",
      1e-3 * real(section, "length_m"), real(section, "length_over_line"),
      1e-3 * real(section, "offset_m"), real(section, "n_sea_tips") + real(section, "n_land_tips"),
      1e-3 * real(section, "step_m")));
}

/// Of the section "constraints"; bad triangles miss the certificate.
void add_constraints(const ReportSection& section, std::vector<std::string>& lines) {
  const auto count = [&](const char* key) {
    return grouped(static_cast<std::int64_t>(real(section, key)));
  };
  lines.push_back("lines       " + count("n_vertices") + " vertices, " + count("n_edges") +
                  " edges kept; " + count("n_missed") + " bad triangles there");
}

/// Of the section "layers", whichever kind it tells of.
void add_layers(const ReportSection& section, std::vector<std::string>& lines) {
  const double levels = real(section, "levels");
  const bool is_ocean = std::any_of(section.values.begin(), section.values.end(),
                                    [](const auto& entry) { return entry.first == "depth_m"; });
  if (is_ocean) {
    lines.push_back(
        line("layers      %.0f to %.0f m, %.1f a sea cell; %.4g km3, %+.2f %% of the data's",
             levels, real(section, "depth_m"), real(section, "mean_levels"),
             1e-9 * real(section, "volume_m3"), 100.0 * (real(section, "volume_ratio") - 1.0)));
  } else {
    lines.push_back(
        line("layers      %.0f to %.0f m over ground up to %.0f m, thinnest %.2f of flat", levels,
             real(section, "top_m"), real(section, "ground_max_m"), real(section, "thinnest")));
  }
}

/// One line, as many as it holds: "16 (kway): 4.2 % of edges cut, 1.02 of the mean; 64 ...".
void add_partitions(const std::vector<ReportPartition>& partitions,
                    std::vector<std::string>& lines) {
  std::string row;
  for (const ReportPartition& partition : partitions) {
    const auto n_parts = static_cast<long long>(partition.n_parts);
    const double percent = 100.0 * partition.cut_share;
    const std::string entry =
        row.empty() ? line("parts       %lld (%s): %.2g %% of edges cut, heaviest %.3f", n_parts,
                           partition.method.c_str(), percent, partition.heaviest)
                    : line("; %lld: %.2g %%, %.3f", n_parts, percent, partition.heaviest);
    if (row.size() + entry.size() > kColumns) break;
    row += entry;
  }
  if (!row.empty()) lines.push_back(row);
}

void add_times(const std::vector<PhaseTime>& phases, std::vector<std::string>& lines) {
  if (phases.empty()) return;
  double total_s = 0.0;
  for (const PhaseTime& phase : phases) total_s += phase.wall_s;
  std::string row = line("time        %.2f s:", total_s);
  for (const PhaseTime& phase : phases) {
    const std::string entry = line(" %s %.2f", phase.phase.c_str(), phase.wall_s);
    if (row.size() + entry.size() > kColumns) {
      lines.push_back(row);
      row = std::string(11, ' ');
    }
    row += entry;
  }
  lines.push_back(row);
}

}  // namespace

std::string report_text(const Report& report) {
  std::vector<std::string> lines;
  lines.push_back(report.title + " (delos " + report.version + ")");
  add_sizes(report, lines);
  add_quality(report.quality, lines);
  add_verdict(report, lines);
  for (const ReportSection& section : report.sections) {
    if (section.name == "constraints") add_constraints(section, lines);
    if (section.name == "domain") add_domain(section, lines);
    if (section.name == "region") add_region(section, lines);
    if (section.name == "coast") add_coast(section, lines);
    if (section.name == "layers") add_layers(section, lines);
  }
  add_partitions(report.partitions, lines);
  add_times(report.phases, lines);
  if (!report.digest.empty()) lines.push_back("digest      " + report.digest);
  if (lines.size() > kLines) lines.erase(lines.begin() + kLines - 1, lines.end() - 1);
  std::string out;
  for (const std::string& text : lines) out += text.substr(0, kColumns) + "\n";
  return out;
}

}  // namespace delos
