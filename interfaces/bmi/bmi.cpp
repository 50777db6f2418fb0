// SPDX-License-Identifier: BSD-3-Clause
#include "delos/bmi.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <delos/delos.hpp>
#include <limits>
#include <map>
#include <optional>
#include <span>

namespace delos::api {
namespace {

constexpr int kCells = 0;   // BMI's id of the grid
constexpr int kScalar = 1;  // and of the one value
constexpr double kDay_s = 86400.0;
constexpr double kDegPerRad = 57.295779513082320877;
constexpr std::int64_t kNanos = 1000000000;  // BMI's doubles are rounded to nanoseconds
// Seconds; 30 million years, so that a double still has nanoseconds to tell apart from noise.
constexpr double kLongest_s = 1e15;
constexpr const char* kGeneration = "grid__generation";
constexpr const char* kEngineGeneration = "grid_generation";  // the component's name for it

[[noreturn]] void fail(ErrorKind kind, const std::string& message) {
  throw Error(kind, "BMI: " + message);
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out.empty() ? "none" : out;
}

void need(const void* pointer, const char* what) {
  if (pointer == nullptr) {
    fail(ErrorKind::input, std::string(what) + " is a null pointer: pass an array");
  }
}

/// BMI counts in int.
int as_int(std::int64_t number, const std::string& what) {
  if (number > std::numeric_limits<int>::max()) {
    fail(ErrorKind::resource, what + " is " + std::to_string(number) +
                                  ", more than BMI's int holds: use delos::Component");
  }
  return static_cast<int>(number);
}

TimeInterval interval(double seconds) {
  const double whole = std::floor(seconds);
  return TimeInterval::of_seconds(static_cast<std::int64_t>(whole)) +
         TimeInterval::of_seconds(0, std::llround((seconds - whole) * 1e9), kNanos);
}

void copy_ints(std::span<const std::int32_t> from, int* to) {
  static_assert(sizeof(int) == sizeof(std::int32_t));
  need(to, "the table");
  std::copy(from.begin(), from.end(), to);
}

}  // namespace

struct BmiBackend::Impl {
  std::optional<Component> component;
  std::map<std::string, std::vector<double>> inputs;  // of this generation, those set
  std::int64_t earlier = 0;                           // generations before the last Initialize
  std::int64_t inputs_of = 0;                         // the component's generation of the inputs
  int generation = 0;                                 // what GetValuePtr points to
  double time_s = 0.0;

  Component& live() {
    if (!component) fail(ErrorKind::state, "no grid yet: call Initialize(config_file) first");
    return *component;
  }

  std::vector<std::string> names(const State& state) {
    std::vector<std::string> out = state.names();
    std::replace(out.begin(), out.end(), std::string(kEngineGeneration), std::string(kGeneration));
    return out;
  }

  bool is_input(const std::string& name) {
    const auto inputs_known = live().import_state().names();
    return std::find(inputs_known.begin(), inputs_known.end(), name) != inputs_known.end();
  }

  Field field(const std::string& name) {
    if (is_input(name)) return live().import_state().field(name);
    const auto outputs = live().export_state().names();
    const std::string own = name == kGeneration ? kEngineGeneration : name;
    if (name == kEngineGeneration ||
        std::find(outputs.begin(), outputs.end(), own) == outputs.end()) {
      fail(ErrorKind::state, "no variable '" + name + "'; inputs are " +
                                 listed(names(live().import_state())) + "; outputs are " +
                                 listed(names(live().export_state())));
    }
    return live().export_state().field(own);
  }

  /// What Initialize and Update leave behind.
  void follow_generation() {
    if (inputs_of != live().generation()) inputs.clear();
    inputs_of = live().generation();
    generation = as_int(earlier + inputs_of, kGeneration);
  }

  /// The input's values, bound to the component when they are first asked for.
  std::vector<double>& values_to_set(const std::string& name) {
    Field target = field(name);
    if (!is_input(name)) {
      fail(ErrorKind::state, "'" + name + "' is an output and can't be set; inputs are " +
                                 listed(names(live().import_state())));
    }
    auto& values = inputs[name];
    if (values.empty()) {
      values.assign(static_cast<std::size_t>(target.n_points() * target.n_components()),
                    std::numeric_limits<double>::quiet_NaN());
      target.bind(values);
    }
    return values;
  }

  std::span<const std::byte> bytes(const std::string& name) {
    const Field source = field(name);
    if (name == kGeneration) return std::as_bytes(std::span<const int>(&generation, 1));
    if (is_input(name) && inputs.count(name) == 0) {
      fail(ErrorKind::state, "input '" + name + "' has no values yet: call SetValue first");
    }
    return std::as_bytes(source.data());
  }

  Grid cells(int grid, const char* what) {
    live();
    if (grid == kScalar) {
      fail(ErrorKind::state, std::string("grid 1 is a scalar and has no ") + what + ": ask grid 0");
    }
    if (grid != kCells) {
      fail(ErrorKind::state,
           "no grid " + std::to_string(grid) + ": 0 is the cells', 1 the scalar's");
    }
    return live().grid();
  }
};

BmiBackend::BmiBackend() : impl_(std::make_unique<Impl>()) {}
BmiBackend::~BmiBackend() = default;

void BmiBackend::initialize(const std::string& config_file) {
  if (impl_->component) {
    fail(ErrorKind::state, "Initialize was called twice: call Finalize in between");
  }
  if (config_file.empty()) {
    fail(ErrorKind::config, "Initialize needs the path of a delos configuration (YAML)");
  }
  Component component(Config::from_file(config_file));
  component.initialize();
  impl_->component.emplace(std::move(component));
  impl_->time_s = 0.0;
  impl_->follow_generation();
}

void BmiBackend::update() { update_until(impl_->time_s + kDay_s); }

void BmiBackend::update_until(double time_s) {
  Component& component = impl_->live();
  if (!std::isfinite(time_s) || time_s < impl_->time_s || time_s > kLongest_s) {
    fail(ErrorKind::state, "UpdateUntil(" + std::to_string(time_s) + " s) from " +
                               std::to_string(impl_->time_s) +
                               " s: give a later time, up to 1e15 s");
  }
  // Where nobody says a date, model time starts at this one.
  const Time start = Time::parse("2000-01-01");
  const Time from = component.current_time().value_or(start);
  const TimeInterval step = start + interval(time_s) - from;
  if (step == TimeInterval()) return;
  for (const auto& [name, values] : impl_->inputs) component.import_state().field(name).stamp(from);
  component.run(component.import_state(), component.export_state(),
                Clock({.start = from, .step = step}));
  impl_->time_s = time_s;
  impl_->follow_generation();
}

void BmiBackend::finalize() {
  if (!impl_->component) return;
  impl_->earlier += impl_->component->generation();
  impl_->component->finalize();
  impl_->component.reset();
  impl_->inputs.clear();
  impl_->inputs_of = 0;
}

std::vector<std::string> BmiBackend::input_names() const {
  return impl_->names(impl_->live().import_state());
}

std::vector<std::string> BmiBackend::output_names() const {
  return impl_->names(impl_->live().export_state());
}

int BmiBackend::var_grid(const std::string& name) const {
  return impl_->field(name).location() == Location::grid ? kScalar : kCells;
}

std::string BmiBackend::var_type(const std::string& name) const {
  impl_->field(name);
  return name == kGeneration ? "int" : "double";
}

std::string BmiBackend::var_units(const std::string& name) const {
  return impl_->field(name).units();
}

int BmiBackend::var_itemsize(const std::string& name) const {
  impl_->field(name);
  return name == kGeneration ? sizeof(int) : sizeof(double);
}

int BmiBackend::var_nbytes(const std::string& name) const {
  const Field field = impl_->field(name);
  return as_int(field.n_points() * field.n_components() * var_itemsize(name),
                "the size in bytes of " + name);
}

std::string BmiBackend::var_location(const std::string& name) const {
  switch (impl_->field(name).location()) {
    case Location::edge:
      return "edge";
    case Location::vertex:
    case Location::grid:
      return "node";
    default:
      return "face";
  }
}

double BmiBackend::current_time_s() const { return impl_->time_s; }
double BmiBackend::start_time_s() const { return 0.0; }
double BmiBackend::end_time_s() const { return std::numeric_limits<double>::max(); }
double BmiBackend::time_step_s() const { return kDay_s; }

void BmiBackend::get(const std::string& name, void* dest) const {
  const auto bytes = impl_->bytes(name);
  need(dest, "dest");
  std::memcpy(dest, bytes.data(), bytes.size());
}

namespace {

/// copy(i, place) for the i-th index, all of them checked before the first.
template <class Copy>
void for_indices(std::span<const int> indices, std::size_t n_items, Copy&& copy) {
  for (const int index : indices) {
    if (index < 0 || static_cast<std::size_t>(index) >= n_items) {
      fail(ErrorKind::input,
           "index " + std::to_string(index) + ": give 0 to " + std::to_string(n_items - 1));
    }
  }
  for (std::size_t i = 0; i < indices.size(); ++i) copy(i, static_cast<std::size_t>(indices[i]));
}

std::span<const int> indices_of(const int* indices, int count) {
  if (count < 0) fail(ErrorKind::input, "count is " + std::to_string(count) + ": give 0 or more");
  if (count > 0) need(indices, "inds");
  return {indices, static_cast<std::size_t>(count)};
}

}  // namespace

void BmiBackend::get_at(const std::string& name, void* dest, const int* indices, int count) const {
  const auto bytes = impl_->bytes(name);
  const auto item = static_cast<std::size_t>(var_itemsize(name));
  if (count > 0) need(dest, "dest");
  for_indices(indices_of(indices, count), bytes.size() / item, [&](std::size_t i, std::size_t at) {
    std::memcpy(static_cast<std::byte*>(dest) + i * item, bytes.data() + at * item, item);
  });
}

void* BmiBackend::pointer(const std::string& name) {
  if (impl_->is_input(name)) return impl_->values_to_set(name).data();
  // BMI has no pointer to constant values.
  return const_cast<std::byte*>(impl_->bytes(name).data());
}

void BmiBackend::set(const std::string& name, const void* source) {
  impl_->field(name);
  need(source, "src");
  auto& values = impl_->values_to_set(name);
  std::memcpy(values.data(), source, values.size() * sizeof(double));
}

void BmiBackend::set_at(const std::string& name, const int* indices, int count,
                        const void* source) {
  const auto which = indices_of(indices, count);
  auto& values = impl_->values_to_set(name);
  if (count > 0) need(source, "src");
  for_indices(which, values.size(), [&](std::size_t i, std::size_t at) {
    std::memcpy(&values[at], static_cast<const std::byte*>(source) + i * sizeof(double),
                sizeof(double));
  });
}

int BmiBackend::grid_rank(int grid) const {
  if (grid == kScalar) return 0;
  impl_->cells(grid, "rank");
  return 2;
}

int BmiBackend::grid_size(int grid) const { return grid == kScalar ? 1 : node_count(grid); }

std::string BmiBackend::grid_type(int grid) const {
  if (grid == kScalar) return "scalar";
  impl_->cells(grid, "type");
  return "unstructured";
}

void BmiBackend::refuse_structured(int grid, const char* what) const {
  impl_->cells(grid, what);
  fail(ErrorKind::state, std::string("grid 0 is unstructured and has no ") + what +
                             ": ask GetGridX, GetGridY and GetGridFaceNodes");
}

void BmiBackend::grid_x(int grid, double* x) const {
  const Grid cells = impl_->cells(grid, "x");
  need(x, "x");
  const auto lon_lat = cells.vertex_lon_lat();
  for (std::size_t i = 0; i < lon_lat.size() / 2; ++i) x[i] = lon_lat[2 * i] * kDegPerRad;
}

void BmiBackend::grid_y(int grid, double* y) const {
  const Grid cells = impl_->cells(grid, "y");
  need(y, "y");
  const auto lon_lat = cells.vertex_lon_lat();
  for (std::size_t i = 0; i < lon_lat.size() / 2; ++i) y[i] = lon_lat[2 * i + 1] * kDegPerRad;
}

void BmiBackend::refuse_z(int grid) const {
  impl_->cells(grid, "z");
  fail(ErrorKind::state,
       "grid 0 has rank 2 and no z: its nodes lie on the surface; ask GetGridX "
       "(longitude) and GetGridY (latitude)");
}

int BmiBackend::node_count(int grid) const {
  return as_int(impl_->cells(grid, "nodes").n_vertices(), "the number of nodes");
}

int BmiBackend::edge_count(int grid) const {
  return as_int(impl_->cells(grid, "edges").n_edges(), "the number of edges");
}

int BmiBackend::face_count(int grid) const {
  return as_int(impl_->cells(grid, "faces").n_cells(), "the number of faces");
}

void BmiBackend::edge_nodes(int grid, int* nodes) const {
  copy_ints(impl_->cells(grid, "edges").vertices_on_edge(), nodes);
}

void BmiBackend::face_edges(int grid, int* edges) const {
  copy_ints(impl_->cells(grid, "faces").edges_on_cell(), edges);
}

void BmiBackend::face_nodes(int grid, int* nodes) const {
  copy_ints(impl_->cells(grid, "faces").vertices_on_cell(), nodes);
}

void BmiBackend::nodes_per_face(int grid, int* counts) const {
  const Grid cells = impl_->cells(grid, "faces");
  need(counts, "nodes_per_face");
  const auto offsets = cells.cell_offsets();
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
    counts[i] = static_cast<int>(offsets[i + 1] - offsets[i]);
  }
}

}  // namespace delos::api
