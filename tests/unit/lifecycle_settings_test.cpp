// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/settings.hpp"

#include <doctest/doctest.h>

#include "core/error.hpp"
#include "lifecycle/require.hpp"

using namespace delos;

namespace {

constexpr char kUniform[] = "sizing:\n  sources:\n    - {type: constant, spacing: 60 km}\n";

Settings read(const std::string& yaml) { return read_settings(parse_config(yaml, "a.yaml"), "."); }

/// The message of the Error(config) that the text gives.
std::string error_of(const std::string& yaml) {
  try {
    static_cast<void>(read(yaml));
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::config);
    return error.what();
  }
  return "no error";
}

bool has(const std::string& message, const std::string& part) {
  CAPTURE(message);
  CHECK(message.find(part) != std::string::npos);
  return message.find(part) != std::string::npos;
}

std::string with_source(const std::string& source) {
  return "sizing:\n  sources:\n    - " + source + "\n";
}

}  // namespace

TEST_CASE("a uniform grid needs nothing but its spacing") {
  const Settings settings = read(kUniform);
  CHECK(settings.shape == "sphere");
  CHECK(settings.surface.scale_m() == 6371220.0);
  CHECK(settings.generator == Generator::frontal);
  REQUIRE(settings.sizing.sources.size() == 1);
  CHECK(std::get<ConstantSource>(settings.sizing.sources[0].source.source).spacing_m == 60000.0);
  CHECK(settings.output.mpas);
  CHECK_FALSE(settings.sizing.needs_bathymetry);
  CHECK(settings.refine.size_ratio == RefineOptions{}.size_ratio);
  CHECK_FALSE(settings.require.bounds.well_centred);
}

TEST_CASE("an unknown key is refused with its line and the nearest valid key") {
  const std::string message = error_of("sizing:\n  sorces: []\n");
  has(message, "a.yaml:2 sizing.sorces: unknown key. Did you mean 'sources'?");
  has(error_of(with_source("{type: constant, spacng: 60 km}")), "Did you mean 'spacing'?");
  has(error_of(std::string(kUniform) + "threds: 2\n"), "a.yaml:4 threds: unknown key");
}

TEST_CASE("an unknown source or word is refused with those that exist") {
  has(error_of(with_source("{type: cost, spacing: 60 km}")), "Did you mean 'coast'?");
  has(error_of("surface: {shape: spere}\n"), "Did you mean 'sphere'?");
  has(error_of(std::string(kUniform) + "output: {formats: [mpaz]}\n"), "Did you mean 'mpas'?");
  has(error_of(std::string(kUniform) + "output: {partitions: [1]}\n"), "between 2 and");
  has(error_of(std::string(kUniform) + "output: {partitions: [2.5]}\n"), "whole numbers");
  has(error_of(std::string(kUniform) + "output: {partitions: [8, 16, 8]}\n"), "has 8 twice");
  has(error_of(std::string(kUniform) + "output: {partition_method: curve}\n"), "[16, 64]");
  has(error_of(std::string(kUniform) + "output: {partitions: [8], partition_method: metis}\n"),
      "Valid here: automatic, kway, curve");
}

TEST_CASE("a wrong type is refused") {
  has(error_of("sizing: 3\n"), "a.yaml:1 sizing: a map of keys is needed here");
  has(error_of("sizing: {sources: {type: constant}}\n"), "sizing.sources: a list is needed here");
  has(error_of(with_source("{type: constant, spacing: [60 km]}")), "a single value is needed");
  has(error_of(with_source("{type: constant, spacing: wide}")), "'wide' is not a length");
  has(error_of(std::string(kUniform) + "threads: many\n"), "'many' is not a whole number");
  has(error_of(std::string(kUniform) + "relax: {repair: perhaps}\n"), "neither true nor false");
  has(error_of("- a list\n"), "a configuration is a map");
}

TEST_CASE("a number without its unit, or with a wrong one, is refused") {
  has(error_of(with_source("{type: constant, spacing: 60}")),
      "a.yaml:3 sizing.sources.0.spacing: '60' has no unit");
  has(error_of(with_source("{type: constant, spacing: 60 s}")),
      "is a time, but a length is needed");
}

TEST_CASE("values out of range are refused with the bound") {
  has(error_of(with_source("{type: constant, spacing: 0 km}")), "0 km: must be > 0 m");
  has(error_of(with_source("{type: constant, spacing: -5 km}")), "-5 km: must be > 0 m");
  has(error_of("surface: {radius: 0 km}\n"), "surface.radius: 0 km: must be > 0 m");
  has(error_of("surface: {shape: ellipsoid, radii: [1 km, -1 km, 1 km]}\n"),
      "surface.radii: -1 km: must be > 0 m");
  has(error_of("surface: {shape: ellipsoid, radii: [1 km, 1 km]}\n"), "has 2 values; 3 are needed");
  has(error_of("surface: {shape: ellipsoid, radii: [100 km, 1 km, 1 km]}\n"), "more than 10 times");
  has(error_of("sizing: {sources: [{type: constant, spacing: 60 km}], gradient_limit: 0}\n"),
      "sizing.gradient_limit: 0: must be > 0");
  has(error_of("sizing: {sources: [{type: constant, spacing: 60 km}],"
               " clamp: {min: 60 km, max: 30 km}}\n"),
      "30 km is below `min`");
  has(error_of(std::string(kUniform) + "refine: {radius_edge: 0.5}\n"), "must be between 1 and 10");
}

TEST_CASE("a missing key says what to give") {
  has(error_of("surface: {shape: sphere}\n"), "at least one source of spacing is needed");
  has(error_of(with_source("{type: constant}")), "sizing.sources.0.spacing: missing");
  has(error_of(with_source("{spacing: 60 km}")), "a source is a map with a `type`");
  has(error_of(with_source("{type: raster}")), "sizing.sources.0.file: missing");
}

TEST_CASE("options that contradict each other are refused") {
  has(error_of("surface: {radii: [1 km, 1 km, 1 km]}\n"), "does not go with shape: sphere");
  has(error_of("generator: icosahedral\n" + std::string(kUniform)), "is not used by generator");
  has(error_of("generator: icosahedral\n"), "give either subdivisions");
  has(error_of("generator: icosahedral\nsubdivisions: 4\nrelax: {spring_rounds: 3}\n"),
      "relax.spring_rounds: unknown key");
  has(error_of(std::string(kUniform) + "spacing: 60 km\n"), "belongs to the generators");
  has(error_of(with_source("{type: rossby}")), "give either radius_file");
}

TEST_CASE("broken YAML and a key given twice are refused with their line") {
  has(error_of("sizing: [1, 2\nthreads: 3\n"), "this is not YAML");
  has(error_of("threads: 1\nthreads: 2\n"), "a.yaml:2 threads: this key is given twice");
}

TEST_CASE("a second document and aliases of aliases are refused") {
  has(error_of(std::string(kUniform) + "---\nthreads: 4\n"), "a.yaml: holds 2 YAML documents");
  CHECK(read("---\n" + std::string(kUniform) + "...\n").sizing.sources.size() == 1);
  std::string laughs = "a: &a [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (const char c : {'b', 'c', 'd', 'e', 'f', 'g', 'h'}) {
    const std::string before(1, static_cast<char>(c - 1)), name(1, c);
    laughs += name + ": &" + name + " [";
    for (int i = 0; i < 10; ++i) laughs += (i == 0 ? "*" : ", *") + before;
    laughs += "]\n";
  }
  has(error_of(laughs), "Are there aliases of aliases?");
}

TEST_CASE("an error is one line of bounded length and names the file") {
  has(error_of(""), "a.yaml:1 sizing.sources: at least one source");
  has(error_of(std::string(kUniform) + "generator: \"a\\e[1m\\nb\"\n"), "'a?[1m b' is not known");
  CHECK(error_of(std::string(kUniform) + "generator: " + std::string(99999, 'x') + "\n").size() <
        3000);
  has(error_of(std::string("\0\0", 2)), "this is not YAML");
}

TEST_CASE("numbers that overflow and names that are no file names are refused where they stand") {
  has(error_of(with_source("{type: constant, spacing: 1e308 km}")),
      "a.yaml:3 sizing.sources.0.spacing: '1e308 km' is too large");
  has(error_of("surface: {centre: [1e300 km, 0 km, 0 km]}\n"),
      "a.yaml:1 surface.centre: lies more");
  has(error_of(std::string(kUniform) + "refine: {size_ratio: 1}\n"),
      "a.yaml:4 refine.size_ratio: 1");
  has(error_of(std::string(kUniform) + "output: {name: \"a\\nb\"}\n"), "is no file name");
  has(error_of(std::string(kUniform) + "output: {name: " + std::string(300, 'n') + "}\n"),
      "has 300 bytes");
  std::string parts = "2";
  for (int i = 3; i < 70; ++i) parts += ", " + std::to_string(i);
  has(error_of(std::string(kUniform) + "output: {partitions: [" + parts + "]}\n"),
      "has 68 values; at most 64 are needed");
  has(error_of("sizing: {sources: [{type: constant, spacing: 60 km}], combine: mean}\n"),
      "{blend: [0.5, 0.5]}");
  has(error_of(std::string(kUniform) + "remesh: {sources: []}\n"), "Give it, e.g. interval: P1M.");
}

TEST_CASE("overrides replace, add and append, and name themselves in errors") {
  ConfigNode root = parse_config(kUniform, "a.yaml");
  override_config(root, "sizing.sources.0.spacing", "120 km");
  override_config(root, "sizing.sources.1", "{type: constant, spacing: 90 km}");
  override_config(root, "sizing.clamp.min", "30 km");
  const Settings settings = read_settings(root, ".");
  REQUIRE(settings.sizing.sources.size() == 2);
  CHECK(std::get<ConstantSource>(settings.sizing.sources[0].source.source).spacing_m == 120000.0);
  CHECK(settings.sizing.recipe.clamp->min_m == 30000.0);

  CHECK_THROWS_WITH_AS(override_config(root, "sizing.sources.7.spacing", "1 km"),
                       doctest::Contains("is no index of this list of 2"), Error);
  override_config(root, "sizing.sources.0.spacing", "12");
  CHECK_THROWS_WITH_AS(static_cast<void>(read_settings(root, ".")),
                       doctest::Contains("override sizing.sources.0.spacing: '12' has no unit"),
                       Error);
}

TEST_CASE("the effective text holds the defaults and reads back to the same text") {
  const Settings settings = read(std::string(kUniform) + "threads: 3\noutput: {directory: d}\n");
  CHECK(settings.text.find("radius_edge: 1.05") != std::string::npos);
  CHECK(settings.text.find("6371.22 km") != std::string::npos);
  CHECK(read(settings.text).text == settings.text);
  // The grid depends neither on the threads nor on the folder.
  CHECK(read(kUniform).text == settings.text);
}

TEST_CASE("every requirement can be asked for, in its unit") {
  for (const RequirementRule& rule : requirement_rules()) {
    CAPTURE(rule.key);
    const double middle = 0.5 * (rule.lowest + rule.highest);
    const Settings settings =
        read(text(kUniform, "require: {", rule.key, ": ", middle, std::string(rule.unit), "}\n"));
    REQUIRE(settings.require.bounds.*rule.wanted);
    CHECK(*(settings.require.bounds.*rule.wanted) == doctest::Approx(middle));
    CHECK(settings.text.find(rule.key) != std::string::npos);
    CHECK(read(settings.text).text == settings.text);
  }
  const Requirements bounds =
      read(std::string(kUniform) + "require: {well_centred: true, degree_6_min: 0.9}\n")
          .require.bounds;
  CHECK(bounds.well_centred);
  CHECK(bounds.degree_6_min == 0.9);
  CHECK_FALSE(bounds.angle_max_deg);
  CHECK(read(std::string(kUniform) + "require: {angle_max: 1.5 rad}\n")
            .require.bounds.angle_max_deg.value() == doctest::Approx(85.943669));
}

TEST_CASE("a requirement that is unknown, unmeetable or without its unit is refused") {
  const auto error = [](const std::string& block) {
    return error_of(std::string(kUniform) + "require:\n  " + block + "\n");
  };
  has(error("relativ_edge_min: 0.65"),
      "a.yaml:5 require.relativ_edge_min: unknown key. Did you mean 'relative_edge_min'?");
  has(error("min_dual_ratio: 0.1"), "require.min_dual_ratio: unknown key.");
  has(error("relative_edge_min: 1.1"), "1.1: must be between 0 and 1");
  has(error("relative_edge_min: -0.1"), "-0.1: must be between 0 and 1");
  has(error("dual_ratio_min: 0.9"), "0.9: must be between 0 and 0.577");
  has(error("angle_max: 59 deg"), "59 deg: must be between 60 and 180 deg");
  has(error("angle_max: 85"), "a.yaml:5 require.angle_max: '85' has no unit");
  has(error("angle_min: 20 km"), "is a length, but an angle is needed");
  has(error("stagger_max: 0.1 deg"), "is an angle, but a number without unit is needed");
  has(error("degree_max: 5"), "must be between 6 and 100");
  has(error("area_length_min: nan"), "'nan' is not a number");
  has(error("well_centred: perhaps"), "neither true nor false");
  has(error("well_centred: {}"), "a single value is needed");
  has(error_of(std::string(kUniform) + "require: true\n"),
      "a.yaml:4 require: a map of keys is needed here");
}

TEST_CASE("the requirements can be read alone") {
  const ConfigNode root = parse_config("anything: [1]\nrequire: {angle_max: 85 deg}\n", "b.yaml");
  CHECK(read_require(root).bounds.angle_max_deg == 85.0);
  CHECK_FALSE(read_require(ConfigNode{}).bounds.angle_max_deg);
  CHECK_THROWS_WITH_AS(
      static_cast<void>(read_require(parse_config("require: {angle_mix: 85 deg}\n", "b.yaml"))),
      doctest::Contains("b.yaml:1 require.angle_mix: unknown key"), Error);
}

TEST_CASE("baselines take subdivisions or a spacing") {
  CHECK(read("generator: icosahedral\nsubdivisions: 16\n").subdivisions == 16);
  CHECK(read("generator: icosahedral\nsubdivisions: 16\n").relax.centroidal_rounds == 0);
  CHECK(read("generator: icosahedral\nsubdivisions: 16\nrelax: {centroidal_rounds: 100}\n")
            .relax.centroidal_rounds == 100);
  // 240 km on the Earth: 10 240 cells.
  CHECK(read("generator: icosahedral\nspacing: 240 km\n").subdivisions == 32);
  CHECK(read("generator: cubed_sphere\nspacing: 240 km\n").subdivisions == 41);
}

TEST_CASE("every type of source is understood") {
  const Settings settings = read(R"(
sizing:
  sources:
    - {type: latitude_profile, latitude: [-90 deg, 90 deg], spacing: [30 km, 60 km]}
    - {type: raster, file: h.nc, variable: h, units: km, missing: 60 km}
    - {type: disc, centre: [-40 deg, 35 deg], radius: 100 km, spacing: 15 km, outside: 150 km}
    - {type: box, west: 170 deg, east: -170 deg, south: -5 deg, north: 5 deg, spacing: 15 km, outside: 60 km}
    - {type: polygon, file: r.geojson, feature: Baltic, spacing: 15 km, outside: 60 km, width: 3 deg}
    - {type: slope, cells: 20, smooth: 30 km}
    - {type: tidal, period: 12.42 h, cells: 100}
    - {type: coast, spacing: 15 km, file: land.geojson}
    - {type: rossby, climatology: levitus_climatology.cdf, cells: 0.5, optional: true}
    - {type: eke, file: e.nc, form: threshold, threshold: 0.02 m2/s2, spacing_below: 60 km, spacing_above: 15 km}
    - {type: ssh_variability, file: s.nc}
  combine: {blend: [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1]}
  land: {spacing: 240 km}
)");
  const auto& sources = settings.sizing.sources;
  REQUIRE(sources.size() == 11);
  CHECK(settings.sizing.needs_bathymetry);
  CHECK(settings.sizing.bathymetry.field.file == "auto");
  CHECK(std::get<RasterSource>(sources[1].source.source).missing_m == 60000.0);
  CHECK(sources[1].field.raster.file_units == "km");
  CHECK(std::get<DiscSource>(sources[2].source.source).radius_rad ==
        doctest::Approx(100.0 / 6371.22));
  CHECK(sources[4].polygon_name == "Baltic");
  CHECK(std::get<TidalSource>(sources[6].source.source).period_s == doctest::Approx(44712.0));
  CHECK(std::get<RossbySource>(sources[8].source.source).factor == 2.0);
  CHECK(sources[8].optional);
  const auto& eke = std::get<EddySource>(sources[9].source.source);
  CHECK(std::get<EddyThreshold>(eke.form).amplitude == doctest::Approx(0.2));
  CHECK(std::get<EddySource>(sources[10].source.source).quantity == EddyQuantity::height_variance);
}

TEST_CASE("the section remesh is read with its defaults, and left out there is none") {
  CHECK_FALSE(read(kUniform).remesh);
  const std::string section =
      "remesh: {interval: P1M, sources: [{type: eke}], statistics: {window: exponential, "
      "length: 30 d}}\n";
  const Settings settings = read(std::string(kUniform) + section);
  REQUIRE(settings.remesh);
  const RemeshSettings& remesh = *settings.remesh;
  CHECK(remesh.interval == TimeInterval::of_months(1));
  CHECK(remesh.policy.tau == 1.2);
  CHECK(remesh.policy.threshold == 0.1);
  CHECK(remesh.policy.hysteresis == 0.5);
  CHECK_FALSE(remesh.policy.minimum_interval);
  CHECK(remesh.statistics.window == Window::exponential);
  CHECK(remesh.statistics.length_s == 30.0 * 86400.0);
  REQUIRE(remesh.sources.size() == 1);
  CHECK(remesh.sources[0].field == SolutionField::velocity);
  CHECK(std::get<EddySource>(remesh.sources[0].law).fill_amplitude == 0.03);
  CHECK(remesh.with_static);
  CHECK(remesh.cells == 0);
  CHECK(remesh.fixed.empty());
  CHECK(settings.text.find("hysteresis: 0.5") != std::string::npos);
  CHECK(read(settings.text).text == settings.text);
}

TEST_CASE("every source and region of a remesh is read") {
  const Settings settings = read(std::string(kUniform) + R"(
remesh:
  interval: P10D
  minimum_interval: P1M
  sources:
    - {type: eke, from: normal_velocity, form: threshold, threshold: 0.02 m2/s2, spacing_below: 60 km, spacing_above: 15 km}
    - {type: eke, from: energy, smooth: 1 deg, upstream: {time: 20 d}}
    - {type: ssh_variability, quiet: [0.02 m, 60 km], energetic: [0.3 m, 10 km], upstream: {length: 500 km}}
    - {type: vorticity_gradient, quiet: [1e-12, 60 km], energetic: [1e-10, 10 km], clamp: 1e-9}
    - {type: indicator, form: threshold, threshold: 0.5, spacing_below: 60 km, spacing_above: 15 km}
    - {type: wanted_spacing, missing: 80 km}
  with_static: false
  tau: 1.3
  threshold: 0.2
  hysteresis: 0.25
  cells: 5000
  fixed:
    - {type: disc, centre: [10 deg, 50 deg], radius: 500 km}
    - {type: box, west: 170 deg, east: -170 deg, south: -10 deg, north: 10 deg}
    - {type: polygon, file: regions.geojson, feature: Baltic}
)");
  const RemeshSettings& remesh = *settings.remesh;
  constexpr SolutionField kFields[] = {
      SolutionField::normal_velocity,    SolutionField::energy,    SolutionField::height,
      SolutionField::vorticity_gradient, SolutionField::indicator, SolutionField::spacing};
  REQUIRE(remesh.sources.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) CHECK(remesh.sources[i].field == kFields[i]);
  CHECK(std::get<EddyThreshold>(std::get<EddySource>(remesh.sources[0].law).form).amplitude ==
        doctest::Approx(0.2));
  CHECK(std::get<EddySource>(remesh.sources[1].law).smooth_rad == doctest::Approx(kRadPerDeg));
  CHECK(std::get<EddySource>(remesh.sources[2].law).quantity == EddyQuantity::height_variance);
  CHECK(std::get<EddySource>(remesh.sources[3].law).max_energy == 1e-9);
  CHECK(std::get<EddySource>(remesh.sources[3].law).quantity == EddyQuantity::amplitude);
  CHECK_FALSE(remesh.sources[0].upstream);
  CHECK(remesh.sources[1].upstream->time_s == 20.0 * 86400.0);
  CHECK(remesh.sources[2].upstream->length_m == 500e3);
  CHECK(std::get<WantedSpacing>(remesh.sources[5].law).missing_m == 80e3);
  CHECK_FALSE(remesh.with_static);
  CHECK(remesh.policy.minimum_interval == TimeInterval::of_months(1));
  CHECK(remesh.policy.tau == 1.3);
  CHECK(remesh.cells == 5000);
  REQUIRE(remesh.fixed.size() == 2);
  CHECK(std::get<FixedDisc>(remesh.fixed[0]).radius_rad == doctest::Approx(500.0 / 6371.22));
  CHECK(std::get<FixedBox>(remesh.fixed[1]).east_deg == -170.0);
  REQUIRE(remesh.fixed_files.size() == 1);
  CHECK(remesh.fixed_files[0].file == "regions.geojson");
  CHECK(remesh.fixed_files[0].feature == "Baltic");
  CHECK(remesh.fixed_files[0].where.find("remesh.fixed.2.file") != std::string::npos);
}

TEST_CASE("mistakes in the section remesh are named") {
  const auto error = [](const std::string& block) {
    return error_of(std::string(kUniform) + "remesh: {" + block + "}\n");
  };
  const std::string sources = ", sources: [{type: eke}]";
  has(error("sources: [{type: eke}]"), "remesh.interval");
  has(error("interval: P1M"), "remesh.sources: at least one source is needed");
  has(error("interval: monthly" + sources), "remesh.interval: ");
  has(error("interval: -P1M" + sources), "does not lead forward");
  has(error("interval: P1M, tau: 1" + sources), "remesh.tau: 1: must be between 1.05 and 10");
  has(error("interval: P1M, treshold: 0.1" + sources), "Did you mean 'threshold'?");
  has(error("interval: P1M, threshold: 2" + sources), "must be between 0 and 1");
  has(error("interval: P1M, sources: [{type: ek}]"), "'ek' is no source of a remesh. Did you mean");
  has(error("interval: P1M, sources: [{type: eke, file: e.nc}]"), "unknown key");
  has(error("interval: P1M, sources: [{type: indicator}]"), "quiet: give [amplitude, spacing]");
  has(error("interval: P1M, statistics: {window: fixed}" + sources), "remesh.statistics.length");
  has(error("interval: P1M, statistics: {length: 3 d}" + sources), "Remove it");
  has(error("interval: P1M, fixed: [{type: disk}]" + sources), "remesh.fixed.0.type");
  has(error("interval: P1M, fixed: [{type: polygon}]" + sources), "remesh.fixed.0.file");
  has(error("interval: P1M, sources: [{type: eke, upstream: {}}]"),
      "either a length or a time is needed");
  has(error("interval: P1M, sources: [{type: eke, upstream: {length: 5 km, time: 3 d}}]"),
      "either a length or a time is needed");
  has(error("interval: P1M, sources: [{type: eke, upstream: {length: -5 km}}]"), "upstream.length");
  has(error("interval: P1M, sources: [{type: wanted_spacing, quiet: [1, 2 km]}]"), "unknown key");
  has(error_of("generator: icosahedral\nsubdivisions: 4\nremesh: {interval: P1M}\n"),
      "remesh: is not used by generator: icosahedral");
}

TEST_CASE("constraints are files and shapes written out") {
  const Settings settings =
      read(std::string(kUniform) +
           "constraints:\n  files: coast.geojson\n  shapes:\n"
           "    - {type: line, name: s, points: [0 deg, 1 deg, 2 deg, 3 deg]}\n");
  REQUIRE(settings.constraints.files.size() == 1);
  CHECK(settings.constraints.files[0].file == "coast.geojson");
  REQUIRE(settings.constraints.shapes.size() == 1);
  CHECK(settings.constraints.shapes[0].lon_lat_deg[1] == std::array<double, 2>{2.0, 3.0});
}

TEST_CASE("constraints that make no sense are refused") {
  const auto shape = [](const std::string& keys) {
    return std::string(kUniform) + "constraints: {shapes: [{" + keys + "}]}\n";
  };
  has(error_of(std::string(kUniform) + "constraints: {}\n"), "name GeoJSON files");
  has(error_of(shape("type: line, points: [0 deg, 1 deg, 2 deg, 3 deg, 4 deg]")), "has 5 numbers");
  has(error_of(shape("type: points, points: [0 deg, 91 deg]")), "91 deg is no latitude");
  has(error_of(shape("type: curve, points: [0 deg, 0 deg]")), "type");
}
