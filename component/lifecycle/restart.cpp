// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/restart.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "io/restart.hpp"
#include "lifecycle/grid_file.hpp"
#include "lifecycle/settings_tree.hpp"
#include "lifecycle/version.hpp"

namespace delos {
namespace {

constexpr std::size_t kCorners = 3;
constexpr std::size_t kVertexNumbers = 4;  // x, y, z, spacing
static_assert(sizeof(Vertex) == kVertexNumbers * sizeof(double));
// Names in the file.
constexpr const char* kConfig = "config";
constexpr const char* kConfigDigest = "config_digest";
constexpr const char* kGeneration = "generation";
constexpr const char* kClock = "clock";
constexpr const char* kComponentClock = "component_clock";
constexpr const char* kVertices = "vertices";
constexpr const char* kTriangles = "triangles";
constexpr const char* kFixedOffsets = "fixed_offsets";
constexpr const char* kFixedEnds = "fixed_ends";
constexpr const char* kDomain = "domain_cells";
constexpr const char* kRings = "region_rings";
constexpr const char* kLayers = "layer_heights";
constexpr const char* kNotes = "report_notes";
constexpr const char* kSpacing = "spacing";
constexpr const char* kSpacingTable = "spacing_table";
constexpr const char* kPolicy = "remesh_policy";
constexpr const char* kTold = "remesh_told";
constexpr const char* kStatistics = "statistics_";
/// How many of the settings that differ a message names.
constexpr std::size_t kNamedSettings = 5;

std::string sha256(const std::string& content) {
  Digest digest;
  digest.add(content.data(), content.size());
  return digest.hex();
}

// ------------------------------------------------------------------ writing

/// A lat-lon table, or nothing.
struct SavedTable {
  LatLonField field;
  std::vector<std::int64_t> shape;
  SavedTable() = default;
  explicit SavedTable(LatLonField of_nodes)
      : field(std::move(of_nodes)), shape{field.n_lat_cells, field.n_lon} {}
};

/// The arrays that the grid does not have as they are written.
struct Content {
  std::vector<std::int32_t> triangles;
  std::vector<std::int64_t> clock, component_clock, generation;
  SavedTable spacing, table_m;
  std::string notes, config_digest;
};

Content content_of(const Restart& state) {
  const Product& product = *state.product;
  Content out;
  out.triangles.reserve(kCorners * product.mesh.triangles.size());
  for (const Triangle& tri : product.mesh.triangles) {
    out.triangles.insert(out.triangles.end(), tri.vertex.begin(), tri.vertex.end());
  }
  out.clock = integers_of(state.host.state());
  if (state.component) out.component_clock = integers_of(state.component->state());
  out.generation = {state.generation};
  // A table that is kept in metres gives the field that was made of it.
  const auto& table_m = product.spacing_table_m;
  if (table_m) out.table_m = SavedTable(*table_m);
  if (!table_m || product.spacing.is_constant()) out.spacing = SavedTable(product.spacing.scaled());
  out.notes = report_notes(product.report);
  out.config_digest = sha256(product.settings.text);
  return out;
}

void add_table(const SavedTable& table, const std::string& name, const std::string& unit,
               std::vector<RestartArray>& out) {
  if (table.shape.empty()) return;
  out.push_back({name + "_shape", "rows but one, and columns; 0 and 0 for a constant",
                 std::span<const std::int64_t>(table.shape)});
  out.push_back({name, "[rows, columns] the wanted spacing on a lat-lon table, in " + unit,
                 std::span<const double>(table.field.values)});
}

std::vector<RestartArray> arrays_of(const Restart& state, const Content& content) {
  const Product& product = *state.product;
  const Array<Vertex>& vertices = product.mesh.vertices;
  std::vector<RestartArray> out = {
      {kConfig, "effective configuration, YAML", std::string_view(product.settings.text)},
      {kConfigDigest, "SHA-256 of config", std::string_view(content.config_digest)},
      {kGeneration, "of the grid", std::span<const std::int64_t>(content.generation)},
      {kClock, "the host's clock and its alarms, integers of delos::ClockState",
       std::span<const std::int64_t>(content.clock)},
      {kVertices, "[n_vertices, 4] x, y, z and wanted spacing, in units of the largest radius",
       std::span<const double>(&vertices.front().x, kVertexNumbers * vertices.size())},
      {kTriangles, "[n_triangles, 3] corners, counter-clockwise, from 0",
       std::span<const std::int32_t>(content.triangles)},
      {kNotes, "sections and inputs of the report, JSON", std::string_view(content.notes)}};
  if (!content.component_clock.empty()) {
    out.push_back({kComponentClock, "the component's, as clock",
                   std::span<const std::int64_t>(content.component_clock)});
  }
  const FixedEdges& fixed = product.mesh.fixed;
  if (fixed.n_vertices() > 0) {
    out.push_back({kFixedOffsets,
                   "[n_fixed + 1] the first vertices stay; where the ends of each are",
                   std::span<const std::int32_t>(fixed.offsets)});
  }
  if (!fixed.ends.empty()) {
    out.push_back({kFixedEnds, "the other ends of the edges that stay, from 0",
                   std::span<const std::int32_t>(fixed.ends)});
  }
  if (product.domain) {
    out.push_back({kDomain, "[n_cells] the vertex, from 0, of each cell of the culled grid",
                   std::span<const std::int32_t>(product.domain->cells)});
  }
  if (product.settings.region) {
    out.push_back({kRings, "[n_cells] the ring of each cell of a regional grid, 0 inside",
                   std::span<const std::int32_t>(product.grid->cell_ring)});
  }
  if (product.layers) {
    out.push_back({kLayers, "[n_cells] depth of the bottom or height of the ground, in m",
                   saved_heights(*product.layers)});
  }
  add_table(content.spacing, kSpacing, "units of the largest radius", out);
  add_table(content.table_m, kSpacingTable, "m", out);
  return out;
}

/// What the statistics and the policy do not have as it is written.
struct RemeshContent {
  std::vector<Solution::Saved> saved;
  std::vector<std::int64_t> policy;
};

/// Armed; then the time of the last remesh, if there was one: calendar, seconds.
std::vector<std::int64_t> integers_of(const PolicyState& policy) {
  std::vector<std::int64_t> out{policy.is_armed ? 1 : 0};
  if (!policy.last_remesh) return out;
  const ExactSeconds& seconds = policy.last_remesh->since_year_zero();
  out.insert(out.end(), {static_cast<std::int64_t>(policy.last_remesh->calendar()), seconds.whole(),
                         seconds.numerator(), seconds.denominator()});
  return out;
}

void add_remesh(const Remesh& remesh, const RemeshContent& content,
                std::vector<RestartArray>& out) {
  out.push_back({kPolicy, "armed, and calendar and seconds of the last remesh",
                 std::span<const std::int64_t>(content.policy)});
  out.push_back(
      {kTold, "mismatch and decision of the last alarm", std::span<const double>(remesh.told)});
  for (const Solution::Saved& one : content.saved) {
    const std::string name = kStatistics + one.name;
    const auto add = [&](const char* part, const char* description,
                         std::span<const double> values) {
      if (!values.empty()) out.push_back({name + part, description, values});
    };
    out.push_back({name + "_counts", "integers of delos::StatisticsState",
                   std::span<const std::int64_t>(one.statistics.counts)});
    add("_times", "s, of delos::StatisticsState", one.statistics.times_s);
    add("_mean", "[fields, places] of the running window", one.statistics.mean);
    add("_spread", "[fields, places] of the running window, with its weight in s",
        one.statistics.spread);
    add("_complete_mean", "[fields, places] of the last complete window",
        one.statistics.complete_mean);
    add("_complete_spread", "[fields, places] of the last complete window",
        one.statistics.complete_spread);
    add("_lon", "degrees, of the host's grid", one.axes.lon_deg);
    add("_lat", "degrees, of the host's grid", one.axes.lat_deg);
  }
}

// ------------------------------------------------------------------ reading

using Leaves = std::map<std::string, std::string>;

void collect(const ConfigNode& node, const std::string& key, Leaves& out) {
  if (node.kind == ConfigNode::Kind::scalar) out[key] = node.scalar;
  std::size_t i = 0;
  for (const ConfigEntry& entry : node.entries) {
    const std::string name = entry.first.empty() ? std::to_string(i) : entry.first;
    collect(entry.second, key.empty() ? name : text(key, ".", name), out);
    ++i;
  }
}

Leaves leaves_of(const std::string& yaml) {
  Leaves out;
  collect(parse_config(yaml, "config"), "", out);
  return out;
}

/// "sizing.sources.0.spacing is 600 km there and 500 km here; ..."
std::string differences(const std::string& there, const std::string& here) {
  const Leaves mine = leaves_of(here);
  const Leaves theirs = leaves_of(there);
  std::vector<std::string> out;
  const auto shown = [](const Leaves& all, const std::string& key) {
    const auto found = all.find(key);
    return found == all.end() ? std::string("not set") : found->second;
  };
  Leaves all = theirs;
  all.insert(mine.begin(), mine.end());
  for (const auto& [key, unused] : all) {
    const std::string one = shown(theirs, key), other = shown(mine, key);
    if (one != other) out.push_back(text(key, " is ", one, " there and ", other, " here"));
  }
  std::string joined;
  for (std::size_t i = 0; i < out.size() && i < kNamedSettings; ++i) {
    joined += (i == 0 ? "" : "; ") + out[i];
  }
  if (out.size() > kNamedSettings) joined += text("; and ", out.size() - kNamedSettings, " more");
  return joined;
}

void check_config(const RestartFile& file, const Settings& settings) {
  const std::string theirs = file.text(kConfigDigest), mine = sha256(settings.text);
  if (theirs == mine) return;
  throw Error(
      ErrorKind::input,
      text("the restart file ", file.path(), " is of another configuration (SHA-256 ", theirs,
           ") than the component's (", mine, "): ", differences(file.text(kConfig), settings.text),
           ". Restore those settings, or start anew."));
}

FixedEdges read_fixed(const RestartFile& file) {
  FixedEdges out;
  if (!file.has(kFixedOffsets)) return out;
  out.offsets = file.ids(kFixedOffsets);
  if (file.has(kFixedEnds)) out.ends = file.ids(kFixedEnds);
  const auto is_id = [&](Index end) { return out.has_vertex(end) && end >= 0; };
  DELOS_CHECK(out.offsets.front() == 0 && std::is_sorted(out.offsets.begin(), out.offsets.end()) &&
                  at(out.offsets.back()) == out.ends.size() &&
                  std::all_of(out.ends.begin(), out.ends.end(), is_id),
              ErrorKind::input, "the restart file ", file.path(), " has ", kFixedOffsets, " and ",
              kFixedEnds, " that do not fit each other. Take another one.");
  return out;
}

Mesh read_mesh(const RestartFile& file) {
  const std::vector<double> numbers = file.doubles(kVertices);
  Array<Vertex> vertices(numbers.size() / kVertexNumbers);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double* from = numbers.data() + kVertexNumbers * i;
    vertices[i] = {from[0], from[1], from[2], from[3]};
  }
  const std::vector<std::int32_t> ids = file.ids(kTriangles);
  std::vector<std::array<Index, 3>> corners(ids.size() / kCorners);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = {ids[kCorners * i], ids[kCorners * i + 1], ids[kCorners * i + 2]};
  }
  Mesh mesh = mesh_from_triangles(std::move(vertices), corners);
  mesh.fixed = read_fixed(file);
  return mesh;
}

std::optional<LatLonField> read_table(const RestartFile& file, const std::string& name) {
  if (!file.has(name)) return std::nullopt;
  const std::vector<std::int64_t> shape = file.integers(name + "_shape");
  DELOS_CHECK(shape.size() == 2, ErrorKind::input, "the restart file ", file.path(), " has ",
              shape.size(), " numbers as the shape of ", name, ": must be 2.");
  const std::vector<double> values = file.doubles(name);
  return LatLonField{
      static_cast<Index>(shape[0]), static_cast<Index>(shape[1]), {values.begin(), values.end()}};
}

Clock read_clock(const RestartFile& file, const char* name) {
  return Clock::restored(clock_state_of(file.integers(name)));
}

PolicyState policy_of(const RestartFile& file) {
  const std::vector<std::int64_t> integers = file.integers(kPolicy);
  constexpr std::size_t kWithTime = 5;
  DELOS_CHECK(integers.size() == 1 || integers.size() == kWithTime, ErrorKind::input,
              "the restart file ", file.path(), " has ", integers.size(), " integers as ", kPolicy,
              ": must be 1 or ", kWithTime, ".");
  PolicyState out;
  out.is_armed = integers[0] != 0;
  if (integers.size() == 1) return out;
  DELOS_CHECK(integers[1] >= 0 && integers[1] <= static_cast<std::int64_t>(Calendar::day360),
              ErrorKind::input, "the restart file ", file.path(), " has the calendar ", integers[1],
              " in ", kPolicy, ".");
  out.last_remesh =
      Time(static_cast<Calendar>(integers[1]), ExactSeconds(integers[2], integers[3], integers[4]));
  return out;
}

Remesh read_remesh(const RestartFile& file, const RemeshSettings& settings, const Grid& grid) {
  Remesh out(settings);
  out.policy = policy_of(file);
  const std::vector<double> told = file.doubles(kTold);
  std::copy_n(told.begin(), std::min(told.size(), out.told.size()), out.told.begin());
  const auto doubles = [&](const std::string& name) {
    return file.has(name) ? file.doubles(name) : std::vector<double>{};
  };
  for (const std::string& field : out.solution.names()) {
    const std::string name = kStatistics + field;
    if (!file.has(name + "_counts")) continue;
    const std::vector<double> mean = doubles(name + "_mean"), spread = doubles(name + "_spread");
    const std::vector<double> complete_mean = doubles(name + "_complete_mean");
    const std::vector<double> complete_spread = doubles(name + "_complete_spread");
    out.solution.restore({field,
                          {doubles(name + "_lon"), doubles(name + "_lat")},
                          {file.integers(name + "_counts"), doubles(name + "_times"), mean, spread,
                           complete_mean, complete_spread}},
                         grid);
  }
  return out;
}

SavedProduct read_saved(parallel::Executor& exec, const RestartFile& file,
                        const Settings& settings) {
  std::optional<LatLonField> table_m = read_table(file, kSpacingTable);
  const std::optional<LatLonField> scaled = read_table(file, kSpacing);
  DELOS_CHECK(table_m || scaled, ErrorKind::input, "the restart file ", file.path(),
              " has neither ", kSpacing, " nor ", kSpacingTable, ". Take another one.");
  SpacingField spacing =
      scaled ? SpacingField::of_scaled(exec, settings.surface, settings.latitude, *scaled)
             : SpacingField::table(exec, settings.surface, settings.latitude, *table_m);
  DELOS_CHECK(settings.constraints.empty() || file.has(kFixedOffsets), ErrorKind::input,
              "the restart file ", file.path(), " does not hold the lines of `constraints` (",
              kFixedOffsets, "): an older delos wrote it. Start anew.");
  std::vector<Index> cells;
  if (settings.domain || settings.region) cells = file.ids(kDomain);
  std::vector<std::int32_t> rings;
  if (settings.region) rings = file.ids(kRings);
  std::vector<double> heights;
  if (settings.layers) heights = file.doubles(kLayers);
  return {read_mesh(file),  std::move(spacing), std::move(table_m), file.text(kNotes),
          std::move(cells), std::move(rings),   std::move(heights)};
}

}  // namespace

void write_restart(const std::string& path, const Restart& state, const Remesh* remesh) {
  const Content content = content_of(state);
  std::vector<RestartArray> arrays = arrays_of(state, content);
  RemeshContent of_remesh;
  if (remesh != nullptr) {
    of_remesh = {remesh->solution.saved(), integers_of(remesh->policy)};
    add_remesh(*remesh, of_remesh, arrays);
  }
  write_restart_arrays(path, library_version(), arrays);
}

Restart read_restart(Context& context, const Settings& settings, const std::string& path) {
  std::optional<Phase> phase(std::in_place, context.monitor, "read", 0);
  const RestartFile file(path, library_version());
  check_config(file, settings);
  const std::vector<std::int64_t> generation = file.integers(kGeneration);
  Clock host = read_clock(file, kClock);
  std::optional<Clock> component;
  if (file.has(kComponentClock)) component = read_clock(file, kComponentClock);
  SavedProduct saved = read_saved(context.exec, file, settings);
  phase.reset();
  auto product = std::make_shared<const Product>(resume(context, settings, std::move(saved)));
  std::optional<Remesh> remesh;
  if (settings.remesh) remesh = read_remesh(file, *settings.remesh, *product->grid);
  return {std::move(product), generation.front(), std::move(host), std::move(component),
          std::move(remesh)};
}

}  // namespace delos
