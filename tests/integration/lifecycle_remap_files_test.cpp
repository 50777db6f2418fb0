// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/remap_files.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <numeric>

#include "io/mpas.hpp"
#include "io/netcdf.hpp"
#include "io/weight_file.hpp"
#include "support/expect_error.hpp"
#include "support/sample_fields.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::testing::expect_error;
using netcdf::Type;

namespace {

constexpr std::size_t kTimes = 2, kLevels = 3;
constexpr double kGap = -99.0;

/// Two grids in files, and fields on the first: temperature [time, cells, levels] is 10 + 100 time
/// + 1000 level, with gaps in the east of level 2; height [cells] is the third coordinate.
struct Sample {
  delos::testing::TemporaryFolder folder;
  Grid a, b;
  FieldRemap task;

  Sample() {
    const Ellipsoid surface = Ellipsoid::sphere(6371220.0);
    a = samples::grid_of(surface, samples::shaken(surface, 3, 0.1, 1));
    b = samples::grid_of(surface, samples::shaken(surface, 4, 0.1, 2));
    write_mpas(folder.file("a.nc"), a, {});
    write_mpas(folder.file("b.nc"), b, {});
    write_fields();
    task.from = folder.file("a.nc");
    task.to = folder.file("b.nc");
    task.fields = folder.file("fields.nc");
    task.out = folder.file("out.nc");
    task.command = "remap";
  }

  void write_fields() const {
    netcdf::Writer file(folder.file("fields.nc"), netcdf::Format::cdf5);
    const auto time = file.define_dimension("time", netcdf::kUnlimited);
    const auto cells = file.define_dimension("nCells", at(a.n_cells()));
    const auto levels = file.define_dimension("nLevels", kLevels);
    const auto days = file.define_variable("days", Type::float64, {time});
    const auto depth = file.define_variable("depth", Type::float32, {levels});
    const auto temperature =
        file.define_variable("temperature", Type::float32, {time, cells, levels});
    const auto height = file.define_variable("height", Type::float64, {cells});
    const auto code = file.define_variable("code", Type::int32, {cells});
    file.attribute(temperature, "units", "K");
    file.attribute(temperature, "_FillValue", kGap);
    file.attribute(netcdf::kGlobal, "history", "made by hand");
    file.end_definitions();
    const std::vector<double> of_days{1.0, 2.0}, of_levels{5.0, 50.0, 500.0};
    file.put_block(days, std::array<std::size_t, 1>{0}, std::array<std::size_t, 1>{kTimes},
                   std::span<const double>(of_days));
    file.put(depth, std::span<const double>(of_levels));
    for (std::size_t t = 0; t < kTimes; ++t) {
      std::vector<double> slab;
      for (const Vec3& place : a.cell_position) {
        for (std::size_t k = 0; k < kLevels; ++k) {
          slab.push_back(k == 2 && place.x() > 0.0 ? kGap : value(t, k));
        }
      }
      file.put_block(temperature, std::array<std::size_t, 3>{t, 0, 0},
                     std::array<std::size_t, 3>{1, at(a.n_cells()), kLevels},
                     std::span<const double>(slab));
    }
    std::vector<double> z;
    for (const Vec3& place : a.cell_position) z.push_back(place.z());
    file.put(height, std::span<const double>(z));
    file.put(code, std::span<const std::int32_t>(std::vector<std::int32_t>(z.size(), 1)));
    file.close();
  }

  static double value(std::size_t time, std::size_t level) {
    return 10.0 + 100.0 * static_cast<double>(time) + 1000.0 * static_cast<double>(level);
  }

  RemapReport run(int threads = 1) const {
    parallel::Executor exec(threads);
    Monitor monitor;
    Context context{exec, monitor};
    return remap_files(context, task);
  }
};

}  // namespace

TEST_CASE("fields of a file arrive on another grid: times, levels, gaps, coordinates, history") {
  Sample sample;
  const RemapReport report = sample.run();
  CHECK(report.carried == std::vector<std::string>{"temperature", "height"});
  CHECK(report.copied == std::vector<std::string>{"days", "depth"});
  REQUIRE(report.left_out.size() == 1);
  CHECK(report.left_out[0].find("code (int32") == 0);

  const netcdf::Reader file(sample.task.out);
  const netcdf::Variable& temperature = file.variable("temperature");
  CHECK(temperature.type == Type::float32);
  CHECK(temperature.dimensions[0].unlimited);
  CHECK(file.read_double("days") == std::vector<double>{1.0, 2.0});
  CHECK(file.read_double("depth") == std::vector<double>{5.0, 50.0, 500.0});
  CHECK(file.text_attribute("temperature", "units") == "K");
  CHECK(file.text_attribute("", "history")->find("made by hand") != std::string::npos);
  const double fill = file.number_attribute("temperature", "_FillValue")->front();

  const std::vector<double> values = file.read_double("temperature");
  const auto n_cells = at(sample.b.n_cells());
  std::size_t n_gaps = 0;
  for (std::size_t t = 0; t < kTimes; ++t) {
    for (std::size_t i = 0; i < n_cells; ++i) {
      for (std::size_t k = 0; k < kLevels; ++k) {
        const double value = values[(t * n_cells + i) * kLevels + k];
        if (k == 2 && value == fill) {
          ++n_gaps;
          CHECK(sample.b.cell_position[i].x() > -0.15);
        } else {
          CHECK(value == Sample::value(t, k));
        }
      }
    }
  }
  CHECK(n_gaps > kTimes * n_cells * 2 / 5);
  CHECK(n_gaps < kTimes * n_cells * 3 / 5);
}

TEST_CASE("a file's field keeps its mass, and its weights do what the transfer does") {
  Sample sample;
  sample.task.weights = sample.folder.file("weights.nc");
  sample.task.options.limiter = remap::Limiter::none;
  sample.run(2);
  const netcdf::Reader file(sample.task.out);
  const std::vector<double> height = file.read_double("height"),
                            areas = file.read_double("areaCell");
  std::vector<double> old;
  for (const Vec3& place : sample.a.cell_position) old.push_back(place.z() + 0.0);
  const double mass = samples::mass(old, sample.a.cell_area_m2);
  const double size = std::accumulate(areas.begin(), areas.end(), 0.0);
  CHECK(std::abs(samples::mass(height, sample.b.cell_area_m2) - mass) < 1e-14 * size);
  const WeightFile weights = read_weights(sample.task.weights);
  CHECK(weights.method == "Second-order Conservative");
  std::vector<double> by_weights(height.size(), 0.0);
  for (std::size_t k = 0; k < weights.value.size(); ++k) {
    by_weights[at(weights.row[k])] += weights.value[k] * old[at(weights.column[k])];
  }
  for (std::size_t i = 0; i < height.size(); ++i) {
    CHECK(by_weights[i] == doctest::Approx(height[i]).epsilon(1e-12));
  }
}

TEST_CASE("files of fields that can't be carried are refused, and nothing is left behind") {
  Sample sample;
  const auto expect = [&](ErrorKind kind, const std::string& words) {
    expect_error(kind, {words}, [&] { sample.run(); });
    CHECK_FALSE(std::filesystem::exists(sample.folder.file("out.nc")));
  };
  sample.task.options.limiter = remap::Limiter::assured_sum;
  expect(ErrorKind::input, "missing values can't be given an assured sum");
  sample.task.options.limiter = remap::Limiter::gradient;
  sample.task.dimension = "nPoints";
  expect(ErrorKind::input, "no dimension nPoints");
  sample.task.dimension = "nLevels";
  expect(ErrorKind::input, "dimension nLevels has 3 cells");
  sample.task.dimension = "nCells";
  sample.task.weights = sample.folder.file("no_such_folder/weights.nc");
  expect(ErrorKind::output, "no_such_folder");
  sample.task.fields.clear();
  expect(ErrorKind::config, "the name of the new file");
}
