// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/remap_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "dual/build.hpp"
#include "io/atomic_file.hpp"
#include "io/netcdf.hpp"
#include "io/unpack.hpp"
#include "io/weight_file.hpp"
#include "lifecycle/grid_file.hpp"
#include "lifecycle/outputs.hpp"
#include "lifecycle/version.hpp"

namespace delos {
namespace {

using netcdf::Type;

// What missing becomes: the library's own default for doubles and floats.
constexpr double kFill = 9.9692099683868690e+36;

Grid cells_of(Context& context, const std::string& path) {
  GridFile file = read_grid_file(context, path);
  DELOS_CHECK(file.mesh || file.grid, ErrorKind::input, path,
              ": the file has triangles with a border, but not the cells around its points. Give "
              "a file of cells, as MPAS.");
  if (file.grid) return std::move(*file.grid);
  return build_grid(context, file.surface, file.latitude, *file.mesh);
}

/// Of the grid itself, which the new file has from its own.
bool is_of_grid(const std::string& name) {
  const std::set<std::string> own{"latCell", "lonCell",  "xCell",       "yCell",
                                  "zCell",   "areaCell", "meshDensity", "indexToCellID"};
  return own.count(name) > 0;
}

bool is_real(Type type) { return type == Type::float32 || type == Type::float64; }
bool is_number(Type type) {
  return is_real(type) || type == Type::int8 || type == Type::int16 || type == Type::int32;
}

/// One variable on its way.
struct Item {
  netcdf::Variable variable;
  std::ptrdiff_t cells = -1;  ///< which dimension; -1: copied as it is
  netcdf::VariableId id;
};

/// The variables of a file of fields, and those of the new one.
class Fields {
 public:
  Fields(const FieldRemap& task, const Grid& source) : task_(task), file_(task.fields) {
    check_cells(source.n_cells());
    for (const netcdf::Variable& variable : file_.variables()) find_carried(variable);
    DELOS_CHECK(!report_.carried.empty(), ErrorKind::input, task.fields, ": no variable of type ",
                "float or double has the dimension ", task.dimension,
                ", so there is nothing to carry.");
    for (const netcdf::Variable& variable : file_.variables()) find_copied(variable);
  }

  RemapReport write(Context& context, const remap::Transfer& transfer, const Grid& target,
                    const std::string& path) {
    netcdf::Writer out(path, netcdf::Format::cdf5);
    define(out, target);
    out.end_definitions();
    put_grid(out, target);
    const Phase phase(context.monitor, "write", static_cast<std::int64_t>(items_.size()));
    for (const Item& item : items_) {
      context.monitor.check_cancelled();
      item.cells < 0 ? copy(out, item) : carry(context, transfer, out, item);
      context.monitor.advance(1);
    }
    out.close();
    return report_;
  }

  std::uint64_t bytes(std::int64_t n_targets) const {
    double sum = 3.0 * sizeof(double) * static_cast<double>(n_targets);
    const auto n_cells = static_cast<double>(file_.dimension(task_.dimension).length);
    for (const Item& item : items_) {
      const double width = item.variable.type == Type::float64 ? sizeof(double) : sizeof(float);
      const double share = item.cells < 0 ? 1.0 : static_cast<double>(n_targets) / n_cells;
      sum += share * width * static_cast<double>(item.variable.n_values());
    }
    return static_cast<std::uint64_t>(sum);
  }

 private:
  void check_cells(std::int64_t n_cells) const {
    DELOS_CHECK(file_.has_dimension(task_.dimension), ErrorKind::input, task_.fields,
                ": no dimension ", task_.dimension,
                ". Name the one of the cells by --dimension NAME.");
    const std::size_t length = file_.dimension(task_.dimension).length;
    DELOS_CHECK(length == at(n_cells), ErrorKind::input, task_.fields, ": dimension ",
                task_.dimension, " has ", length, " cells, but ", task_.from, " has ", n_cells,
                ". Give the grid that the fields are on.");
  }

  void find_carried(const netcdf::Variable& variable) {
    std::ptrdiff_t cells = -1;
    for (std::size_t d = 0; d < variable.rank(); ++d) {
      if (variable.dimensions[d].name == task_.dimension) cells = static_cast<std::ptrdiff_t>(d);
    }
    if (cells < 0 || is_of_grid(variable.name)) return;
    if (!is_real(variable.type)) {
      report_.left_out.push_back(
          text(variable.name, " (", to_string(variable.type), ": means of codes say nothing)"));
      return;
    }
    items_.push_back({variable, cells, {}});
    report_.carried.push_back(variable.name);
    for (const netcdf::Dimension& dimension : variable.dimensions) used_.insert(dimension.name);
  }

  void find_copied(const netcdf::Variable& variable) {
    const auto& dimensions = variable.dimensions;
    const bool fits = std::all_of(dimensions.begin(), dimensions.end(), [&](const auto& dimension) {
      return dimension.name != task_.dimension && used_.count(dimension.name) > 0;
    });
    if (!fits || !is_number(variable.type)) return;
    items_.push_back({variable, -1, {}});
    report_.copied.push_back(variable.name);
  }

  void define(netcdf::Writer& out, const Grid& target) {
    std::map<std::string, netcdf::DimensionId> ids;
    const auto id_of = [&](const netcdf::Dimension& dimension) {
      const auto found = ids.find(dimension.name);
      if (found != ids.end()) return found->second;
      const bool is_cells = dimension.name == task_.dimension;
      const std::size_t length = is_cells ? at(target.n_cells()) : dimension.length;
      return ids[dimension.name] = out.define_dimension(
                 dimension.name, keeps_growing(dimension) ? netcdf::kUnlimited : length);
    };
    const netcdf::DimensionId cells = id_of(file_.dimension(task_.dimension));
    define_grid(out, cells);
    for (Item& item : items_) {
      std::vector<netcdf::DimensionId> dimensions;
      for (const auto& dimension : item.variable.dimensions) dimensions.push_back(id_of(dimension));
      item.id = out.define_variable(item.variable.name, item.variable.type, dimensions);
      if (item.cells >= 0) out.attribute(item.id, "_FillValue", kFill);
      copy_attributes(out, item);
    }
    out.attribute(netcdf::kGlobal, "delos_version", library_version());
    std::string history = history_now(task_.command);
    const auto before = file_.text_attribute("", "history");
    if (before && !before->empty()) history += "\n" + *before;
    out.attribute(netcdf::kGlobal, "history", history);
  }

  /// CDF-5 has one dimension that grows, the first of its variables.
  bool keeps_growing(const netcdf::Dimension& dimension) const {
    if (!dimension.unlimited || dimension.name == task_.dimension) return false;
    return std::all_of(items_.begin(), items_.end(), [&](const Item& item) {
      const auto& dimensions = item.variable.dimensions;
      for (std::size_t d = 0; d < dimensions.size(); ++d) {
        const bool is_other = dimensions[d].unlimited && dimensions[d].name != dimension.name;
        if (is_other || (d > 0 && dimensions[d].name == dimension.name)) return false;
      }
      return true;
    });
  }

  void define_grid(netcdf::Writer& out, netcdf::DimensionId cells) {
    lat_ = out.define_variable("latCell", Type::float64, {cells});
    out.attribute(lat_, "units", "rad");
    lon_ = out.define_variable("lonCell", Type::float64, {cells});
    out.attribute(lon_, "units", "rad");
    area_ = out.define_variable("areaCell", Type::float64, {cells});
    out.attribute(area_, "units", "m2");
  }

  void put_grid(netcdf::Writer& out, const Grid& target) {
    std::vector<double> values(at(target.n_cells()));
    const auto put = [&](netcdf::VariableId id, auto&& value_of) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = value_of(i);
      out.put(id, std::span<const double>(values));
    };
    put(lat_, [&](std::size_t i) { return target.cell_lon_lat[i].lat_rad; });
    put(lon_, [&](std::size_t i) { return target.cell_lon_lat[i].lon_rad; });
    put(area_, [&](std::size_t i) { return target.cell_area_m2[i]; });
  }

  void copy_attributes(netcdf::Writer& out, const Item& item) {
    // Carried values are written unpacked, with a fill value of ours.
    const std::set<std::string> packing{"_FillValue", "missing_value", "scale_factor", "add_offset",
                                        "valid_min",  "valid_max",     "valid_range",  "_Unsigned"};
    const std::string& name = item.variable.name;
    for (const std::string& attribute : file_.attribute_names(name)) {
      if (item.cells >= 0 && packing.count(attribute) > 0) continue;
      if (const auto words = file_.text_attribute(name, attribute)) {
        out.attribute(item.id, attribute, *words);
      } else if (const auto numbers = file_.number_attribute(name, attribute)) {
        out.attribute(item.id, attribute, std::span<const double>(*numbers));
      }
    }
  }

  void copy(netcdf::Writer& out, const Item& item) {
    std::vector<std::size_t> start(item.variable.rank(), 0), count;
    for (const auto& dimension : item.variable.dimensions) count.push_back(dimension.length);
    std::vector<double> values(item.variable.n_values());
    if (values.empty()) return;
    file_.read(item.variable.name, start, count, std::span<double>(values));
    out.put_block(item.id, start, count, std::span<const double>(values));
  }

  /// Slab by slab of the leading dimensions: the cells and what is inside them at a time.
  void carry(Context& context, const remap::Transfer& transfer, netcdf::Writer& out,
             const Item& item) {
    const auto& dimensions = item.variable.dimensions;
    const auto cells = at(item.cells);
    std::size_t n_slabs = 1, n_levels = 1;
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
      if (d < cells) n_slabs *= dimensions[d].length;
      if (d > cells) n_levels *= dimensions[d].length;
    }
    std::vector<std::size_t> start(dimensions.size(), 0), count(dimensions.size(), 1);
    for (std::size_t d = cells; d < dimensions.size(); ++d) count[d] = dimensions[d].length;
    const auto n_targets = at(transfer.overlaps().n_targets);
    std::vector<double> from(count[cells] * n_levels), to(n_targets * n_levels);
    const Unpacking unpacking = read_unpacking(file_, item.variable);
    for (std::size_t slab = 0; slab < n_slabs && n_levels > 0; ++slab) {
      context.monitor.check_cancelled();
      count[cells] = dimensions[cells].length;
      file_.read(item.variable.name, start, count, std::span<double>(from));
      const bool is_whole = unpack(context.exec, unpacking, from) == from.size();
      carry_slab(context, transfer, is_whole, from, to);
      count[cells] = n_targets;
      out.put_block(item.id, start, count, std::span<const double>(to));
      for (std::size_t d = cells; d-- > 0 && ++start[d] == dimensions[d].length;) start[d] = 0;
    }
  }

  void carry_slab(Context& context, const remap::Transfer& transfer, bool is_whole,
                  std::span<const double> from, std::span<double> to) {
    remap::TransferOptions options = task_.options;
    options.n_levels =
        static_cast<std::int64_t>(from.size()) / std::max<std::int64_t>(1, n_sources(transfer));
    if (is_whole) {
      transfer.apply(context.exec, from, to, options);
      for (double& value : to) value = std::isnan(value) ? kFill : value;
      return;
    }
    const std::size_t n_levels = at(options.n_levels);
    options.n_levels = 1;
    std::vector<double> level(from.size() / n_levels), moved(to.size() / n_levels);
    for (std::size_t k = 0; k < n_levels; ++k) {
      for (std::size_t j = 0; j < level.size(); ++j) level[j] = from[j * n_levels + k];
      transfer.apply_valid(context.exec, level, moved, options);
      for (std::size_t i = 0; i < moved.size(); ++i) {
        to[i * n_levels + k] = std::isnan(moved[i]) ? kFill : moved[i];
      }
    }
  }

  static std::int64_t n_sources(const remap::Transfer& transfer) {
    return transfer.overlaps().n_sources;
  }

  const FieldRemap& task_;
  netcdf::Reader file_;
  std::vector<Item> items_;
  std::set<std::string> used_;
  RemapReport report_;
  netcdf::VariableId lat_, lon_, area_;
};

void write_weight_file(Context& context, const FieldRemap& task, const remap::Transfer& transfer,
                       const std::array<const Grid*, 2>& grids, const std::string& path) {
  const remap::Normalization normalization = task.options.normalization;
  const remap::Weights weights = transfer.weights(context.exec, task.options.order, normalization);
  const remap::Overlaps& overlaps = transfer.overlaps();
  WeightFile file;
  file.source = weight_file_grid(*grids[0]);
  file.target = weight_file_grid(*grids[1]);
  std::vector<double> used_m2(file.source.fraction.size(), 0.0);
  for (std::int64_t k = 0; k < overlaps.size(); ++k) {
    used_m2[at(overlaps.source[at(k)])] += overlaps.area_m2[at(k)];
  }
  for (std::size_t j = 0; j < used_m2.size() && overlaps.is_open; ++j) {
    const double part = used_m2[j] / overlaps.source_area_m2[j];
    file.source.fraction[j] = part >= remap::kWhole ? 1.0 : part;
  }
  for (std::int64_t i = 0; i < overlaps.n_targets; ++i) {
    file.target.fraction[at(i)] = overlaps.covered_fraction(i);
  }
  file.is_of_covered = normalization == remap::Normalization::covered && overlaps.is_open;
  file.column = weights.column;
  file.value = weights.value;
  file.row.resize(weights.column.size());
  for (std::int64_t row = 0; row < weights.n_rows(); ++row) {
    std::fill(file.row.begin() + weights.offsets[at(row)],
              file.row.begin() + weights.offsets[at(row) + 1], static_cast<Index>(row));
  }
  file.method = task.options.order == remap::Order::first ? "First-order Conservative"
                                                          : "Second-order Conservative";
  Provenance provenance;
  provenance.version = library_version();
  provenance.history = history_now(task.command);
  write_weights(path, file, provenance);
}

}  // namespace

RemapReport remap_files(Context& context, const FieldRemap& task) {
  DELOS_CHECK(task.fields.empty() == task.out.empty(), ErrorKind::config,
              "a file of fields needs the name of the new file beside it.");
  DELOS_CHECK(!task.fields.empty() || !task.weights.empty(), ErrorKind::config,
              "nothing to do: give FIELDS.nc and OUT.nc, --weights FILE, or both.");
  const Grid source = cells_of(context, task.from), target = cells_of(context, task.to);
  std::optional<Fields> fields;
  if (!task.fields.empty()) fields.emplace(task, source);
  const auto transfer = [&] {
    const Phase phase(context.monitor, "transfer", target.n_cells());
    return remap::Transfer(context, remap::Tiling::cells(context.exec, source),
                           remap::Tiling::cells(context.exec, target), task.options.order);
  }();
  OutputSet outputs;
  RemapReport report;
  if (fields) {
    outputs.add(task.out, fields->bytes(target.n_cells()), [&](const std::string& path) {
      report = fields->write(context, transfer, target, path);
    });
  }
  if (!task.weights.empty()) {
    outputs.add(task.weights, 0, [&](const std::string& path) {
      write_weight_file(context, task, transfer, {&source, &target}, path);
    });
  }
  outputs.commit();
  report.n_unmapped = transfer.overlaps().n_unmapped;
  return report;
}

}  // namespace delos
