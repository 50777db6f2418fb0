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
  report.quality =
      measure_quality(context, report.surface, samples::bisected_icosahedron(report.surface, 3));
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

TEST_CASE("a number that is not finite is refused by its name") {
  Report report = sample_report();
  report.quality.stagger_mean = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(report_json(report), doctest::Contains("stagger_mean"), Error);
}
