// SPDX-License-Identifier: BSD-3-Clause
// The BMI class: its 41 functions by type and by place, what they give, what they refuse.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <delos/bmi.hpp>
#include <delos/delos.hpp>
#include <functional>
#include <initializer_list>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace {

using delos::Bmi;
using delos::BmiInterface;
using Names = std::vector<std::string>;

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegPerRad = 180.0 / kPi;
constexpr int kFunctions = 41;
constexpr const char* kYaml =
    "sizing: {sources: [{type: constant, spacing: 600 km}]}\nrefine: {tile_vertices: 500}\n";

/// Place of a virtual function in its table, after the two destructors (Itanium C++ ABI on x86-64).
/// The type must be the one asked for.
template <class Function>
int place(Function BmiInterface::*function) {
  return static_cast<int>(std::bit_cast<std::array<std::ptrdiff_t, 2>>(function)[0] / 8) - 2;
}

/// Every function with BMI's exact type, in the order of bmi.hxx.
std::vector<int> places() {
  using B = BmiInterface;
  using std::string;
  return {place<void(string)>(&B::Initialize),
          place<void()>(&B::Update),
          place<void(double)>(&B::UpdateUntil),
          place<void()>(&B::Finalize),
          place<string()>(&B::GetComponentName),
          place<int()>(&B::GetInputItemCount),
          place<int()>(&B::GetOutputItemCount),
          place<Names()>(&B::GetInputVarNames),
          place<Names()>(&B::GetOutputVarNames),
          place<int(string)>(&B::GetVarGrid),
          place<string(string)>(&B::GetVarType),
          place<string(string)>(&B::GetVarUnits),
          place<int(string)>(&B::GetVarItemsize),
          place<int(string)>(&B::GetVarNbytes),
          place<string(string)>(&B::GetVarLocation),
          place<double()>(&B::GetCurrentTime),
          place<double()>(&B::GetStartTime),
          place<double()>(&B::GetEndTime),
          place<string()>(&B::GetTimeUnits),
          place<double()>(&B::GetTimeStep),
          place<void(string, void*)>(&B::GetValue),
          place<void*(string)>(&B::GetValuePtr),
          place<void(string, void*, int*, int)>(&B::GetValueAtIndices),
          place<void(string, void*)>(&B::SetValue),
          place<void(string, int*, int, void*)>(&B::SetValueAtIndices),
          place<int(int)>(&B::GetGridRank),
          place<int(int)>(&B::GetGridSize),
          place<string(int)>(&B::GetGridType),
          place<void(int, int*)>(&B::GetGridShape),
          place<void(int, double*)>(&B::GetGridSpacing),
          place<void(int, double*)>(&B::GetGridOrigin),
          place<void(int, double*)>(&B::GetGridX),
          place<void(int, double*)>(&B::GetGridY),
          place<void(int, double*)>(&B::GetGridZ),
          place<int(int)>(&B::GetGridNodeCount),
          place<int(int)>(&B::GetGridEdgeCount),
          place<int(int)>(&B::GetGridFaceCount),
          place<void(int, int*)>(&B::GetGridEdgeNodes),
          place<void(int, int*)>(&B::GetGridFaceEdges),
          place<void(int, int*)>(&B::GetGridFaceNodes),
          place<void(int, int*)>(&B::GetGridNodesPerFace)};
}

struct Fixture {
  Fixture() : path(folder.write("grid.yaml", kYaml)) { model.Initialize(path); }
  std::vector<double> values(const std::string& name) {
    std::vector<double> out(static_cast<std::size_t>(model.GetVarNbytes(name)) / sizeof(double));
    model.GetValue(name, out.data());
    return out;
  }
  int generation() {
    int out = -1;
    model.GetValue("grid__generation", &out);
    return out;
  }
  delos::testing::TemporaryFolder folder;
  std::string path;
  Bmi model;
};

/// action() must throw what a framework can catch, with a text that holds the parts.
void refused(const std::function<void()>& action, std::initializer_list<const char*> parts) {
  std::string message;
  try {
    action();
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  CAPTURE(message);
  REQUIRE_MESSAGE(!message.empty(), "no std::runtime_error was thrown");
  for (const char* const part : parts) CHECK(message.find(part) != std::string::npos);
}

/// A framework's own abstract class, with functions that BMI does not know.
class Foreign : public BmiInterface {
 public:
  virtual int extension() { return 7; }
};

}  // namespace

TEST_CASE("the 41 functions of BMI have their types and their places in the virtual table") {
  const auto found = places();
  REQUIRE(found.size() == kFunctions);
#if defined(__x86_64__)
  for (int i = 0; i < kFunctions; ++i) CHECK(found[static_cast<std::size_t>(i)] == i);
#endif
}

TEST_CASE_FIXTURE(Fixture, "BMI gives the arrays of the C++ grid") {
  const delos::Grid grid = delos::generate(delos::Config::from_file(path));
  const auto n_cells = static_cast<std::size_t>(grid.n_cells());
  REQUIRE(model.GetGridType(0) == "unstructured");
  CHECK(model.GetGridRank(0) == 2);
  CHECK(model.GetGridSize(0) == grid.n_vertices());
  CHECK(model.GetGridNodeCount(0) == grid.n_vertices());
  CHECK(model.GetGridEdgeCount(0) == grid.n_edges());
  CHECK(model.GetGridFaceCount(0) == grid.n_cells());

  const auto n_nodes = static_cast<std::size_t>(grid.n_vertices());
  std::vector<double> x(n_nodes), y(n_nodes);
  model.GetGridX(0, x.data());
  model.GetGridY(0, y.data());
  for (std::size_t i = 0; i < n_nodes; ++i) {
    REQUIRE(x[i] == doctest::Approx(grid.vertex_lon_lat()[2 * i] * kDegPerRad).epsilon(1e-14));
    REQUIRE(y[i] == doctest::Approx(grid.vertex_lon_lat()[2 * i + 1] * kDegPerRad).epsilon(1e-14));
  }
  const auto n_sides = 2 * static_cast<std::size_t>(grid.n_edges());
  std::vector<int> table(n_sides);
  const auto same = [&](std::span<const std::int32_t> wanted) {
    return std::equal(table.begin(), table.end(), wanted.begin(), wanted.end());
  };
  model.GetGridEdgeNodes(0, table.data());
  CHECK(same(grid.vertices_on_edge()));
  model.GetGridFaceEdges(0, table.data());
  CHECK(same(grid.edges_on_cell()));
  model.GetGridFaceNodes(0, table.data());
  CHECK(same(grid.vertices_on_cell()));
  std::vector<int> counts(n_cells);
  model.GetGridNodesPerFace(0, counts.data());
  for (std::size_t i = 0; i < n_cells; ++i) {
    REQUIRE(counts[i] == grid.cell_offsets()[i + 1] - grid.cell_offsets()[i]);
  }

  const auto area_m2 = values("cell_area");
  const auto spacing_m = values("cell_spacing");
  CHECK(std::equal(area_m2.begin(), area_m2.end(), grid.cell_area_m2().begin(),
                   grid.cell_area_m2().end()));
  CHECK(std::equal(spacing_m.begin(), spacing_m.end(), grid.cell_spacing_m().begin(),
                   grid.cell_spacing_m().end()));
  CHECK(static_cast<const double*>(model.GetValuePtr("cell_area"))[5] == grid.cell_area_m2()[5]);
}

TEST_CASE_FIXTURE(Fixture, "the j-th edge of a BMI face joins its nodes j - 1 and j") {
  const auto n_faces = static_cast<std::size_t>(model.GetGridFaceCount(0));
  const auto n_sides = 2 * static_cast<std::size_t>(model.GetGridEdgeCount(0));
  std::vector<int> edge_nodes(n_sides), edges(n_sides), nodes(n_sides), counts(n_faces);
  model.GetGridEdgeNodes(0, edge_nodes.data());
  model.GetGridFaceEdges(0, edges.data());
  model.GetGridFaceNodes(0, nodes.data());
  model.GetGridNodesPerFace(0, counts.data());
  std::size_t first = 0;
  for (const int count : counts) {
    const auto n = static_cast<std::size_t>(count);
    for (std::size_t j = 0; j < n; ++j) {
      const auto edge = 2 * static_cast<std::size_t>(edges[first + j]);
      const std::array ends = {nodes[first + (j + n - 1) % n], nodes[first + j]};
      const bool joined = (edge_nodes[edge] == ends[0] && edge_nodes[edge + 1] == ends[1]) ||
                          (edge_nodes[edge] == ends[1] && edge_nodes[edge + 1] == ends[0]);
      REQUIRE(joined);
    }
    first += n;
  }
  CHECK(first == n_sides);
}

TEST_CASE_FIXTURE(Fixture, "BMI variables say their grid, type, size, unit and place") {
  CHECK(model.GetComponentName() == "delos");
  CHECK(model.GetInputItemCount() == static_cast<int>(model.GetInputVarNames().size()));
  CHECK(model.GetOutputItemCount() == static_cast<int>(model.GetOutputVarNames().size()));
  Names all = model.GetOutputVarNames();
  CHECK(std::count(all.begin(), all.end(), "grid__generation") == 1);
  for (const std::string& name : model.GetInputVarNames()) all.push_back(name);
  for (const std::string& name : all) {
    CAPTURE(name);
    const bool is_scalar = name == "grid__generation";
    CHECK(model.GetVarGrid(name) == (is_scalar ? 1 : 0));
    CHECK(model.GetVarType(name) == (is_scalar ? "int" : "double"));
    CHECK(model.GetVarItemsize(name) == (is_scalar ? 4 : 8));
    CHECK(model.GetVarNbytes(name) == (is_scalar ? 4 : 8 * model.GetGridFaceCount(0)));
    CHECK(model.GetVarLocation(name) == (is_scalar ? "node" : "face"));
  }
  CHECK(model.GetVarUnits("cell_area") == "m2");
  CHECK(model.GetVarUnits("grid__generation") == "1");
  CHECK(model.GetVarUnits("eddy_kinetic_energy") == "m2 s-2");
  CHECK(model.GetGridRank(1) == 0);
  CHECK(model.GetGridSize(1) == 1);
  CHECK(model.GetGridType(1) == "scalar");
  CHECK(generation() == 1);
  CHECK(*static_cast<int*>(model.GetValuePtr("grid__generation")) == 1);
}

TEST_CASE_FIXTURE(Fixture, "UDUNITS reads the units of all BMI variables") {
  if (std::system("command -v udunits2 >/dev/null") != 0) {
    MESSAGE("skipped: no udunits2 (Debian: udunits-bin)");
    return;
  }
  const auto reads = [](const std::string& unit) {
    const std::string command = "udunits2 -H '" + unit + "' -W '" + unit + "' >/dev/null 2>&1";
    return std::system(command.c_str()) == 0;
  };
  CHECK_FALSE(reads("no_unit"));
  CHECK(reads(model.GetTimeUnits()));
  for (const Names& names : {model.GetInputVarNames(), model.GetOutputVarNames()}) {
    for (const std::string& name : names) {
      CAPTURE(name);
      CHECK(reads(model.GetVarUnits(name)));
    }
  }
}

TEST_CASE_FIXTURE(Fixture, "BMI time is seconds from zero, by days or by what the host asks") {
  CHECK(model.GetTimeUnits() == "s");
  CHECK(model.GetStartTime() == 0.0);
  CHECK(model.GetCurrentTime() == 0.0);
  CHECK(model.GetTimeStep() == 86400.0);
  CHECK(model.GetEndTime() == std::numeric_limits<double>::max());
  model.Update();
  CHECK(model.GetCurrentTime() == 86400.0);
  model.UpdateUntil(86400.0);
  model.UpdateUntil(90000.1);
  CHECK(model.GetCurrentTime() == 90000.1);
  model.Update();
  CHECK(model.GetCurrentTime() == 176400.1);
  refused([&] { model.UpdateUntil(1.0); }, {"UpdateUntil(1.0", "later"});
  refused([&] { model.UpdateUntil(std::nan("")); }, {"UpdateUntil", "later"});
  CHECK(model.GetCurrentTime() == 176400.1);
}

TEST_CASE_FIXTURE(Fixture, "BMI inputs are set whole, at indices and through a pointer") {
  const std::string name = "eddy_kinetic_energy";
  const auto n = static_cast<std::size_t>(model.GetGridFaceCount(0));
  refused([&] { values(name); }, {name.c_str(), "SetValue"});
  std::vector<double> ones(n, 1.0);
  model.SetValue(name, ones.data());
  ones.assign(n, 0.0);  // SetValue has copied them
  std::array<int, 3> where = {0, 7, static_cast<int>(n) - 1};
  std::array<double, 3> what = {2.0, 3.0, 4.0};
  model.SetValueAtIndices(name, where.data(), 3, what.data());
  static_cast<double*>(model.GetValuePtr(name))[1] = 5.0;
  auto wanted = std::vector<double>(n, 1.0);
  wanted[0] = 2.0, wanted[7] = 3.0, wanted[n - 1] = 4.0, wanted[1] = 5.0;
  CHECK(values(name) == wanted);
  std::array<double, 3> got = {};
  model.GetValueAtIndices(name, got.data(), where.data(), 3);
  CHECK(got == what);
  model.Update();
  CHECK(values(name) == wanted);

  const std::string other = "surface_eastward_sea_water_velocity";
  model.SetValueAtIndices(other, where.data(), 1, what.data());
  const auto sparse = values(other);
  CHECK(sparse[0] == 2.0);
  CHECK(std::isnan(sparse[1]));
}

TEST_CASE_FIXTURE(Fixture, "a wrong BMI call says what to do and changes nothing") {
  double number = 0.0;
  int index = model.GetGridFaceCount(0);
  refused([&] { Bmi().Update(); }, {"Initialize"});
  refused([&] { Bmi().GetVarUnits("cell_area"); }, {"Initialize"});
  refused([&] { Bmi().Initialize(""); }, {"configuration"});
  refused([&] { Bmi().Initialize("/no/such/file.yaml"); }, {"/no/such/file.yaml"});
  refused([&] { model.Initialize(path); }, {"Finalize"});
  refused([&] { model.GetVarGrid("cell_volume"); }, {"cell_volume", "cell_area", "eddy_kinetic"});
  refused([&] { model.GetVarGrid("grid_generation"); }, {"grid__generation"});
  refused([&] { model.SetValue("cell_area", &number); }, {"cell_area", "output", "eddy_kinetic"});
  refused([&] { model.SetValue("eddy_kinetic_energy", nullptr); }, {"src"});
  refused([&] { model.GetValue("cell_area", nullptr); }, {"dest"});
  refused([&] { model.GetValueAtIndices("cell_area", &number, &index, 1); },
          {std::to_string(index).c_str(), std::to_string(index - 1).c_str()});
  refused([&] { model.GetValueAtIndices("cell_area", &number, &index, -1); }, {"count"});
  refused([&] { model.GetGridShape(0, &index); }, {"shape", "GetGridX"});
  refused([&] { model.GetGridSpacing(0, &number); }, {"spacing"});
  refused([&] { model.GetGridOrigin(0, &number); }, {"origin"});
  refused([&] { model.GetGridZ(0, &number); }, {"rank 2", "GetGridX"});
  refused([&] { model.GetGridFaceCount(1); }, {"scalar", "grid 0"});
  refused([&] { model.GetGridType(2); }, {"no grid 2"});
  CHECK(generation() == 1);
  model.Update();
}

TEST_CASE_FIXTURE(Fixture, "a BMI model starts again after Finalize, with the next generation") {
  const auto first = values("cell_area");
  model.Update();
  model.Finalize();
  model.Finalize();
  refused([&] { model.GetValuePtr("cell_area"); }, {"Initialize"});
  model.Initialize(path);
  CHECK(values("cell_area") == first);
  CHECK(model.GetCurrentTime() == 0.0);
  CHECK(generation() == 2);
}

TEST_CASE("a BMI model derives from the framework's own class") {
  delos::BmiModel<Foreign> model;
  Foreign& seen = model;
  CHECK(seen.extension() == 7);
  CHECK(seen.GetComponentName() == "delos");
}
