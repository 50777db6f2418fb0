// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/report.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/sample_meshes.hpp"

using namespace delos;

namespace {

Report sample_report() {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  Report report;
  report.title = "sample";
  report.version = "0.1.0";
  report.surface = Ellipsoid::wgs84();
  const SpacingField spacing = SpacingField::constant(report.surface, 1e6);
  report.quality = measure_quality(context, report.surface, spacing,
                                   samples::bisected_icosahedron(report.surface, 3));
  report.expected_vertices = 640.0;
  report.digest = std::string(64, 'a');
  for (int i = 0; i < 40; ++i) report.phases.push_back({"a phase of long name", 1.5, 2.5, 10});
  report.sections.push_back(
      {"refine", {{"n_inserted", std::int64_t{630}}, {"radius_edge", 1.05}, {"repair", true}}});
  report.inputs.push_back({"etopo.nc", "0123"});
  return report;
}

}  // namespace

TEST_CASE("the text report fits one screen whatever it holds") {
  const Report report = sample_report();
  std::istringstream text(report_text(report));
  int n_lines = 0;
  for (std::string line; std::getline(text, line); ++n_lines) CHECK(line.size() <= 80);
  CHECK(n_lines <= 24);
  CHECK(report_text(report).find(report.digest) != std::string::npos);
  CHECK(report_text(report).find("certificate well centred") != std::string::npos);
}

TEST_CASE("the JSON report reads back to the same numbers") {
  const Report report = sample_report();
  const auto json = nlohmann::json::parse(report_json(report));
  CHECK(json["counts"]["cells"] == 642);
  CHECK(json["quality"]["area_length_mean"].get<double>() == report.quality.area_length_mean);
  CHECK(json["certificate"]["well_centred"] == true);
  CHECK(json["refine"]["n_inserted"] == 630);
  CHECK(json["refine"]["repair"] == true);
  CHECK(json["inputs"][0]["sha256"] == "0123");
  CHECK(json["phases"].size() == 40);
  CHECK(json["phases"][0]["wall_s"] == 1.5);
  CHECK(json["phases"][0]["cpu_s"] == 2.5);
  CHECK(json["phases"][0]["items"] == 10);
}

TEST_CASE("worst elements are named by triangle or cells, from 1") {
  Report report = sample_report();
  const Quality& quality = report.quality;
  const auto json = nlohmann::json::parse(report_json(report));
  CHECK(json["index_base"] == 1);
  const auto& certificate = json["certificate"];
  CHECK(certificate["well_centred_fraction"] == 1.0);
  CHECK(certificate["n_obtuse"] == 0);
  CHECK(certificate["angle_max_deg"]["value"].get<double>() == quality.angle_max_deg.value);
  CHECK(certificate["angle_max_deg"]["triangle"] == quality.angle_max_deg.id + 1);
  CHECK(certificate["stagger_max"]["cells"][1] == quality.stagger_max.other + 1);
  CHECK(certificate["dual_ratio_min"]["cells"][0] == quality.dual_ratio_min.id + 1);
  CHECK(certificate["dual_ratio_min"]["lat_deg"].get<double>() ==
        doctest::Approx(quality.dual_ratio_min.where.lat_rad * kDegPerRad).epsilon(1e-14));
  CHECK(certificate["relative_edge_bound"] == 0.65);
  CHECK(json["quality"]["degree_min"]["cell"] == quality.degree_min.id + 1);
  CHECK(json["requirements_missed"].empty());
  CHECK(report_text(report).find(text(quality.stagger_max.id + 1, "-",
                                      quality.stagger_max.other + 1)) != std::string::npos);
}

TEST_CASE("a spacing that nobody knows leaves no number in the report") {
  Report report = sample_report();
  report.quality.knows_spacing = false;
  const auto json = nlohmann::json::parse(report_json(report));
  CHECK_FALSE(json["quality"].contains("relative_edge_min"));
  CHECK_FALSE(json["certificate"].contains("relative_edge_min"));
  CHECK_FALSE(json["certificate"].contains("spacing_kept"));
  CHECK(report_text(report).find("edge/h") == std::string::npos);
  CHECK(report_text(report).find("spacing not known") != std::string::npos);
}

TEST_CASE("what is required and missed stands in both reports") {
  Report report = sample_report();
  report.missed = {"angle_max: 80 deg instead of at most 70 deg.", "degree_max: 8."};
  const auto json = nlohmann::json::parse(report_json(report));
  CHECK(json["requirements_missed"][1] == "degree_max: 8.");
  CHECK(report_text(report).find("but missed: angle_max degree_max\n") != std::string::npos);
}

TEST_CASE("partitions stand in both reports, on one line of the screen") {
  Report report = sample_report();
  report.partitions = {{16, "kway", 1552, 0.0513, 1.021, 0.98},
                       {64, "kway", 3116, 0.1031, 1.029, 0.97}};
  const auto json = nlohmann::json::parse(report_json(report));
  CHECK(json["partitions"][1]["parts"] == 64);
  CHECK(json["partitions"][1]["cut_edges"] == 3116);
  CHECK(json["partitions"][0]["method"] == "kway");
  CHECK(json["partitions"][0]["heaviest"].get<double>() == 1.021);
  CHECK(report_text(report).find("\nparts       16 (kway): 5.1 % of edges cut, heaviest 1.021; "
                                 "64: 10 %, 1.029\n") != std::string::npos);
  for (int n = 100; n < 140; ++n) report.partitions.push_back({n, "kway", 1, 0.5, 1.0, 1.0});
  std::istringstream lines(report_text(report));
  for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 80);
}

TEST_CASE("the domain and given lines are on the screen") {
  Report report = sample_report();
  report.sections.push_back({"constraints",
                             {{"n_vertices", std::int64_t{1234}},
                              {"n_edges", std::int64_t{1200}},
                              {"n_missed", std::int64_t{2}}}});
  report.sections.push_back({"domain",
                             {{"n_cells", std::int64_t{117194}},
                              {"area_m2", 3.6148e14},
                              {"n_bodies", std::int64_t{31}},
                              {"n_bodies_kept", std::int64_t{1}}}});
  CHECK(report_text(report).find(
            "\nlines       1 234 vertices, 1 200 edges kept; 2 bad "
            "triangles there\n"
            "domain      117 194 cells, 361.5 million km2, 1 of 31 bodies\n") != std::string::npos);
  CHECK(report_text(report).find("passages") == std::string::npos);
  report.sections.back().values.insert(report.sections.back().values.end(),
                                       {{"n_passages", std::int64_t{19}},
                                        {"n_passages_open", std::int64_t{18}},
                                        {"n_blockages", std::int64_t{21}},
                                        {"n_blockages_shut", std::int64_t{21}}});
  CHECK(
      report_text(report).find("\n            18 of 19 passages open, 21 of 21 blockages shut\n") !=
      std::string::npos);
  report.sections.push_back({"coast", {{"n_edges", std::int64_t{0}}}});
  CHECK(report_text(report).find("coast ") == std::string::npos);
  report.sections.back().values = {{"n_edges", std::int64_t{9014}},
                                   {"length_m", 3.11434e8},
                                   {"length_over_line", 1.2406},
                                   {"offset_m", 13278.5},
                                   {"step_m", 17297.0},
                                   {"n_sea_tips", std::int64_t{161}},
                                   {"n_land_tips", std::int64_t{256}}};
  CHECK(report_text(report).find("\ncoast       311434 km, 1.241 of its line, 13.3 km off; 417 "
                                 "tips; steps 17.3 km\n") != std::string::npos);
}

TEST_CASE("layers are a line of the screen") {
  Report report = sample_report();
  report.sections.push_back({"layers",
                             {{"kind", std::string("z_level")},
                              {"levels", std::int64_t{60}},
                              {"depth_m", 5500.0},
                              {"mean_levels", 41.34},
                              {"volume_m3", 1.3321e18},
                              {"volume_ratio", 0.9988}}});
  CHECK(report_text(report).find("\nlayers      60 to 5500 m, 41.3 a sea cell; 1.332e+09 km3, "
                                 "-0.12 % of the data's\n") != std::string::npos);
  report.sections.back() = {"layers",
                            {{"kind", std::string("terrain_following")},
                             {"levels", std::int64_t{55}},
                             {"top_m", 30000.0},
                             {"ground_max_m", 4780.4},
                             {"thinnest", 0.612}}};
  CHECK(report_text(report).find("\nlayers      55 to 30000 m over ground up to 4780 m, thinnest "
                                 "0.61 of flat\n") != std::string::npos);
}

TEST_CASE("a number that is not finite is refused by its name") {
  Report report = sample_report();
  report.quality.stagger_mean = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(report_json(report), doctest::Contains("stagger_mean"), Error);
}
