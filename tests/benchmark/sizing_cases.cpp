// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/sizing_cases.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "core/elementary.hpp"
#include "core/hash.hpp"
#include "io/embedded_bathymetry.hpp"
#include "io/netcdf.hpp"
#include "io/rasters.hpp"
#include "sizing/nodes.hpp"
#include "sizing/sources.hpp"
#include "support/temporary_folder.hpp"

namespace delos::benchmark {
namespace {

constexpr double kResolution = kRadPerDeg / 12.0;
constexpr double kRadius = 6371220.0;
constexpr std::size_t kVertices = std::size_t{1} << 22;
/// Vertices a call of evaluate, as a loop of relax asks for.
constexpr std::int64_t kVertexGrain = 1024;

/// What all kernels start from.
struct Inputs {
  LatLonField wavy_m;              ///< spacing, 30 to 240 km
  LatLonField rough_m;             ///< spacing from the slope of the sea floor, 10 to 120 km, noisy
  std::shared_ptr<Raster> fine_m;  ///< elevation at 5 minutes, cell-centred
  std::shared_ptr<Raster> rossby_m;                    ///< radius at 1/4 degree, missing on land
  std::shared_ptr<Raster> energy;                      ///< the same nodes, m2/s2
  std::shared_ptr<RasterStack> temperature, salinity;  ///< 1 degree, 33 levels
  std::vector<Vertex> vertices;                        ///< a spiral, neighbours near each other
  LatLonField elevation_m;                             ///< fine_m on the table
};

/// What a kernel writes; its digest says whether the bits are the same.
struct Outputs {
  LatLonField field;
  std::vector<Vertex> vertices;
  Raster raster;
  double number = 0.0;
};

struct Kernel {
  const char* name;
  std::function<std::int64_t(parallel::Executor&, Outputs&)> run;  ///< returns the nodes
  const LatLonField* field = nullptr;                              ///< what `field` holds before
  const std::vector<Vertex>* vertices = nullptr;                   ///< the same of `vertices`
};

LatLonField wavy_table() {
  LatLonField field = make_table(kResolution);
  for (Index row = 0; row < field.n_rows(); ++row) {
    const double lat = field.lat_rad(row);
    for (Index i = 0; i < field.n_lon; ++i) {
      const double lon = field.lon_rad(i);
      const double wave = elementary::sin(7.0 * lon + 3.0 * elementary::sin(5.0 * lat)) *
                              elementary::cos(11.0 * lat) +
                          0.5 * elementary::sin(23.0 * lon) * elementary::cos(19.0 * lat);
      field.values[field.at(row, i)] = std::clamp(135e3 + 105e3 * wave, 30e3, 240e3);
    }
  }
  return field;
}

Raster empty_raster(std::size_t n_lat) {
  Raster raster;
  raster.source = "benchmark";
  raster.periodic = true;
  const double step = 180.0 / static_cast<double>(n_lat);
  for (std::size_t j = 0; j < n_lat; ++j) {
    raster.lat_deg.push_back((static_cast<double>(j) + 0.5) * step - 90.0);
  }
  for (std::size_t i = 0; i < 2 * n_lat; ++i) {
    raster.lon_deg.push_back((static_cast<double>(i) + 0.5) * step - 180.0);
  }
  raster.values.resize(2 * n_lat * n_lat);
  return raster;
}

/// Nodes of a table as the nearest of a raster: enough for made up data.
double value_near(const LatLonField& field, double lat_deg, double lon_deg) {
  const auto row = static_cast<Index>((lat_deg + 90.0) / 180.0 * field.n_lat_cells + 0.5);
  const auto column = static_cast<Index>((lon_deg + 180.0) / 360.0 * field.n_lon + 0.5);
  return field.values[field.at(row, column % field.n_lon)];
}

/// Smooth noise in [-1, 1]: random values at the nodes of squares, bilinear between them.
double noise(std::uint64_t seed, double x, double y, std::uint64_t period) {
  const double x0 = std::floor(x), y0 = std::floor(y), s = x - x0, t = y - y0;
  const auto at = [&](std::uint64_t i, std::uint64_t j) {
    return 2.0 * uniform01(seed, i % period, j) - 1.0;
  };
  const auto i = static_cast<std::uint64_t>(x0), j = static_cast<std::uint64_t>(y0);
  const double low = at(i, j) + s * (at(i + 1, j) - at(i, j));
  const double high = at(i, j + 1) + s * (at(i + 1, j + 1) - at(i, j + 1));
  return low + t * (high - low);
}

/// The embedded elevation at 5 minutes with noise of 300 m at 1 degree, half at half, and so on.
std::shared_ptr<Raster> fine_elevation(parallel::Executor& exec) {
  LatLonField table = make_table(kResolution);
  sample(exec, embedded_bathymetry(), table);
  auto raster = std::make_shared<Raster>(empty_raster(2160));
  for (std::size_t j = 0; j < raster->n_lat(); ++j) {
    for (std::size_t i = 0; i < raster->n_lon(); ++i) {
      double value = value_near(table, raster->lat_deg[j], raster->lon_deg[i]);
      double amplitude = 300.0;
      for (std::uint64_t size = 12; size >= 2; size /= 2, amplitude *= 0.5) {
        value += amplitude * noise(size, static_cast<double>(i) / static_cast<double>(size),
                                   static_cast<double>(j) / static_cast<double>(size), 4320 / size);
      }
      raster->values[j * raster->n_lon() + i] = std::floor(value + 0.5);
    }
  }
  return raster;
}

/// A field of the sea alone, from a law of latitude and longitude.
template <class Law>
std::shared_ptr<Raster> sea_raster(const LatLonField& elevation_m, std::size_t n_lat, Law law) {
  auto raster = std::make_shared<Raster>(empty_raster(n_lat));
  for (std::size_t j = 0; j < raster->n_lat(); ++j) {
    for (std::size_t i = 0; i < raster->n_lon(); ++i) {
      const double lat = raster->lat_deg[j], lon = raster->lon_deg[i];
      const double elevation = value_near(elevation_m, lat, lon);
      raster->values[j * raster->n_lon() + i] =
          elevation < 0.0 ? law(lat, lon, -elevation) : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return raster;
}

/// Water that is warm and fresh above, cold and salt below, down to the sea floor.
template <class Law>
std::shared_ptr<RasterStack> climatology(const LatLonField& elevation_m, Law law) {
  auto stack = std::make_shared<RasterStack>();
  for (int level = 0; level < 33; ++level) {
    const double depth_m = 5.0 * level * (level + 1);
    stack->depth_m.push_back(depth_m);
    stack->levels.push_back(*sea_raster(elevation_m, 180, [&](double lat, double, double floor_m) {
      return depth_m < floor_m ? law(lat, depth_m) : std::numeric_limits<double>::quiet_NaN();
    }));
  }
  return stack;
}

std::vector<Vertex> spiral() {
  std::vector<Vertex> vertices(kVertices);
  const double turns = std::sqrt(static_cast<double>(kVertices));
  for (std::size_t k = 0; k < kVertices; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(kVertices);
    const double z = 2.0 * share - 1.0, r = std::sqrt(1.0 - z * z);
    const double whole = turns * share;
    const elementary::SinCos angle = elementary::sincos(2.0 * kPi * (whole - std::floor(whole)));
    vertices[k] = {r * angle.cos, r * angle.sin, z, 0.0};
  }
  return vertices;
}

Inputs make_inputs(parallel::Executor& exec) {
  Inputs in;
  in.wavy_m = wavy_table();
  in.fine_m = fine_elevation(exec);
  in.elevation_m = make_table(kResolution);
  sample(exec, *in.fine_m, in.elevation_m);
  in.rough_m = in.elevation_m;
  fill_slope(exec, Ellipsoid::sphere(kRadius), LatitudeKind::geodetic, SlopeSource{}, in.rough_m);
  clamp(exec, {10e3, 120e3}, in.rough_m);
  in.rossby_m = sea_raster(in.elevation_m, 720, [](double lat, double, double depth_m) {
    return std::min(30e3, 8e3 * std::sqrt(depth_m / 4000.0) / (0.02 + std::abs(lat) / 90.0));
  });
  in.energy = sea_raster(in.elevation_m, 720, [](double lat, double lon, double) {
    return 0.1 + 0.1 * elementary::sin(0.3 * lat) * elementary::cos(0.4 * lon);
  });
  in.temperature = climatology(in.elevation_m, [](double lat, double depth_m) {
    return 2.0 + 25.0 * (1.0 - std::abs(lat) / 90.0) / (1.0 + depth_m / 400.0);
  });
  in.salinity =
      climatology(in.elevation_m, [](double, double depth_m) { return 34.0 + depth_m / 5000.0; });
  in.vertices = spiral();
  return in;
}

/// Wavy islands of half a degree to 8 degrees, 1000 sides each.
std::shared_ptr<PolygonSet> islands() {
  auto set = std::make_shared<PolygonSet>();
  set->source = "benchmark";
  for (Index k = 0; k < 300; ++k) {
    const auto id = static_cast<std::uint64_t>(k);
    const double lon = 360.0 * uniform01(1, id) - 180.0, lat = 150.0 * uniform01(2, id) - 75.0;
    const double size = uniform01(3, id), radius = 0.5 + 7.5 * size * size * size;
    PolygonRing ring;
    ring.polygon = k;
    for (int side = 0; side < 1000; ++side) {
      const double angle = 2.0 * kPi * side / 1000.0;
      const double r = radius * (1.0 + 0.2 * elementary::sin(9.0 * angle));
      ring.lon_deg.push_back(lon + r * elementary::cos(angle));
      ring.lat_deg.push_back(lat + r * elementary::sin(angle));
    }
    set->rings.push_back(ring);
  }
  return set;
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::int64_t size_of(const LatLonField& field) {
  return static_cast<std::int64_t>(field.values.size());
}

using Run = std::function<std::int64_t(parallel::Executor&, Outputs&)>;

/// A kernel that writes the table.
Run on_field(std::function<void(parallel::Executor&, LatLonField&)> body) {
  return [body = std::move(body)](parallel::Executor& exec, Outputs& out) {
    body(exec, out.field);
    return size_of(out.field);
  };
}

Run limiter(const Ellipsoid& surface) {
  return on_field([surface](parallel::Executor& exec, LatLonField& field) {
    Monitor monitor;
    Context context{exec, monitor};
    limit_gradient(context, surface, LatitudeKind::geodetic, 0.15, field);
  });
}

Run recipe(const SpacingRecipe& wanted) {
  return [wanted](parallel::Executor& exec, Outputs& out) {
    Monitor monitor;
    Context context{exec, monitor};
    out.field = build_spacing_table(context, Ellipsoid::sphere(kRadius), wanted);
    return size_of(out.field);
  };
}

/// Slope, coast, Rossby and eddies together on the 5' table, limited, for a million cells.
SpacingRecipe full_recipe(const Inputs& in) {
  SpacingRecipe wanted;
  wanted.resolution_rad = kResolution;
  wanted.elevation_m = in.fine_m;
  SlopeSource slope;
  slope.smooth_rad = 0.25 * kRadPerDeg;
  RossbySource rossby;
  rossby.radius_m = in.rossby_m;
  EddySource eddies;
  eddies.field = in.energy;
  wanted.sources = {
      {"slope", slope}, {"coast", CoastSource{}}, {"rossby", rossby}, {"eddies", eddies}};
  wanted.clamp = ClampOptions{10e3, 120e3};
  wanted.gradient_limit = 0.15;
  wanted.cells = 1000000;
  return wanted;
}

/// Mixes numbers, for as many nodes as a kernel has: what the machine's threads are worth when
/// nothing is shared. A kernel can't gain more from them.
std::int64_t spin(parallel::Executor& exec, Outputs& out) {
  constexpr std::int64_t kGrain = std::int64_t{1} << 16, kNumbers = kGrain << 11;
  out.number = parallel::sum(exec, kNumbers, kGrain, [](std::int64_t i) {
    return uniform01(1, static_cast<std::uint64_t>(i));
  });
  return kNumbers;
}

/// Lookups and the integral.
std::vector<Kernel> field_kernels(const Inputs& in) {
  const Ellipsoid sphere = Ellipsoid::sphere(kRadius);
  const SpacingField spacing = SpacingField::table(sphere, LatitudeKind::geodetic, in.wavy_m);
  return {
      {"spin", spin},
      {"field",
       [&in, sphere](parallel::Executor& exec, Outputs& out) {
         const SpacingField made =
             SpacingField::table(exec, sphere, LatitudeKind::geodetic, in.wavy_m);
         out.number = made.at(0.6, 0.48, 0.64);
         return size_of(in.wavy_m);
       }},
      {"to_table",
       [spacing](parallel::Executor&, Outputs& out) {
         out.field = spacing.to_table();
         return size_of(out.field);
       }},
      {"evaluate",
       [spacing, &in](parallel::Executor& exec, Outputs& out) {
         const auto n = static_cast<std::int64_t>(kVertices);
         parallel::for_range(exec, n, kVertexGrain, [&](std::int64_t begin, std::int64_t end) {
           spacing.evaluate(std::span(out.vertices)
                                .subspan(static_cast<std::size_t>(begin),
                                         static_cast<std::size_t>(end - begin)));
         });
         return n;
       },
       nullptr, &in.vertices},
      {"integral",
       [spacing, sphere](parallel::Executor& exec, Outputs& out) {
         out.number = expected_vertices(exec, sphere, spacing);
         return std::int64_t{2160} * 4320;
       }},
  };
}

/// Sources from formulas and from what files hold.
std::vector<Kernel> source_kernels(const Inputs& in) {
  const Ellipsoid sphere = Ellipsoid::sphere(kRadius);
  const RegionEdge edge{15e3, 150e3, 0.25, Transition::gaussian};
  RossbySource rossby;
  rossby.radius_m = in.rossby_m;
  EddySource eddies;
  eddies.field = in.energy;
  eddies.smooth_rad = kRadPerDeg;
  CoastSource coast;
  CoastSource far_coast;
  far_coast.max_m = far_coast.spacing_m + far_coast.rate * 2.1e6;
  SlopeSource slope;
  slope.smooth_rad = 0.25 * kRadPerDeg;
  using Exec = parallel::Executor;
  return {
      {"disc", on_field([edge](Exec& exec, LatLonField& field) {
         fill_disc(exec, {-40.0, 35.0, 0.1, edge}, field);
       }),
       &in.wavy_m},
      {"box", on_field([edge](Exec& exec, LatLonField& field) {
         fill_box(exec, {-60.0, 10.0, 20.0, 60.0, edge}, field);
       }),
       &in.wavy_m},
      {"polygon", on_field([land = islands()](Exec& exec, LatLonField& field) {
         fill_polygon(exec, {land, {15e3, 150e3, 0.05, Transition::smooth}}, field);
       }),
       &in.wavy_m},
      {"profile", on_field([](Exec& exec, LatLonField& field) {
         fill_latitude_profile(exec, {{-90.0, 0.0, 90.0}, {60e3, 30e3, 60e3}, true}, field);
       }),
       &in.wavy_m},
      {"sample",
       on_field([&in](Exec& exec, LatLonField& field) { sample(exec, *in.fine_m, field); }),
       &in.wavy_m},
      {"sample_coarse",
       on_field([&in](Exec& exec, LatLonField& field) { sample(exec, *in.rossby_m, field); }),
       &in.wavy_m},
      {"rossby",
       on_field([rossby](Exec& exec, LatLonField& field) { fill_rossby(exec, rossby, field); }),
       &in.wavy_m},
      {"rossby_radius",
       [&in](Exec& exec, Outputs& out) {
         out.raster = rossby_radius(exec, *in.temperature, *in.salinity);
         return static_cast<std::int64_t>(out.raster.values.size());
       }},
      {"eddies",
       on_field([eddies](Exec& exec, LatLonField& field) { fill_eddies(exec, eddies, field); }),
       &in.wavy_m},
      {"coast", on_field([coast, sphere, &in](Exec& exec, LatLonField& field) {
         fill_coast(exec, sphere, coast, in.fine_m.get(), field);
       }),
       &in.wavy_m},
      {"coast_far", on_field([far_coast, sphere, &in](Exec& exec, LatLonField& field) {
         fill_coast(exec, sphere, far_coast, in.fine_m.get(), field);
       }),
       &in.wavy_m},
      {"slope", on_field([slope, sphere](Exec& exec, LatLonField& field) {
         fill_slope(exec, sphere, LatitudeKind::geodetic, slope, field);
       }),
       &in.elevation_m},
      {"tidal",
       on_field([](Exec& exec, LatLonField& field) { fill_tidal(exec, TidalSource{}, field); }),
       &in.elevation_m},
  };
}

/// What follows the sources, and everything together.
std::vector<Kernel> table_kernels(const Inputs& in) {
  using Exec = parallel::Executor;
  return {
      {"smooth",
       on_field([](Exec& exec, LatLonField& field) { smooth(exec, 0.5 * kRadPerDeg, field); }),
       &in.wavy_m},
      {"combine", on_field([&in](Exec& exec, LatLonField& field) {
         combine_into(exec, {CombineRule::min, {}}, 1, in.elevation_m, field);
         clamp(exec, {30e3, 120e3}, field);
         set_land(exec, in.elevation_m, 60e3, field);
       }),
       &in.wavy_m},
      {"limit", limiter(Ellipsoid::sphere(kRadius)), &in.wavy_m},
      {"limit_rough", limiter(Ellipsoid::sphere(kRadius)), &in.rough_m},
      {"limit_triaxial", limiter(Ellipsoid(Vec3(7645464.0, 6371220.0, 5096976.0), Vec3(0, 0, 0))),
       &in.wavy_m},
      {"recipe", recipe(full_recipe(in))},
  };
}

/// The fine elevation as a file: floats in the classic layout, or packed and compressed.
std::string write_elevation(const testing::TemporaryFolder& folder, const Raster& raster,
                            bool is_packed) {
  const std::string path = folder.file(is_packed ? "packed.nc" : "plain.nc");
  netcdf::Writer file(path, is_packed ? netcdf::Format::netcdf4 : netcdf::Format::cdf5);
  const auto lat = file.define_dimension("lat", raster.n_lat());
  const auto lon = file.define_dimension("lon", raster.n_lon());
  const auto lat_values = file.define_variable("lat", netcdf::Type::float64, {lat});
  const auto lon_values = file.define_variable("lon", netcdf::Type::float64, {lon});
  const auto values = file.define_variable(
      "z", is_packed ? netcdf::Type::int16 : netcdf::Type::float32, {lat, lon});
  file.attribute(lat_values, "units", "degrees_north");
  file.attribute(lon_values, "units", "degrees_east");
  if (is_packed) file.compress(values, 1);
  file.end_definitions();
  file.put(lat_values, std::span<const double>(raster.lat_deg));
  file.put(lon_values, std::span<const double>(raster.lon_deg));
  file.put(values, std::span<const double>(raster.values));
  file.close();
  return path;
}

/// Reading from files written beforehand, from the system's cache.
std::vector<Kernel> file_kernels(const Inputs& in, const testing::TemporaryFolder& folder) {
  const auto read = [](const std::string& path) -> Run {
    return [path](parallel::Executor& exec, Outputs& out) {
      out.raster = read_raster(exec, path, {});
      return static_cast<std::int64_t>(out.raster.values.size());
    };
  };
  return {{"read", read(write_elevation(folder, *in.fine_m, false))},
          {"read_packed", read(write_elevation(folder, *in.fine_m, true))}};
}

std::string digest_of(const Outputs& out) {
  Digest digest;
  digest.add(std::span<const double>(out.field.values));
  digest.add(std::span<const Vertex>(out.vertices));
  digest.add(std::span<const double>(out.raster.values));
  digest.add(&out.number, sizeof(out.number));
  return digest.hex();
}

void time_kernel(const Kernel& kernel, std::span<const int> threads, int rounds,
                 std::vector<SizingTiming>& timings) {
  const std::size_t first = timings.size();
  for (const int n : threads) timings.push_back({kernel.name, n, 1e30, 0, ""});
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t t = 0; t < threads.size(); ++t) {
      SizingTiming& timing = timings[first + t];
      parallel::Executor exec(timing.threads);
      Outputs out;
      if (kernel.field != nullptr) out.field = *kernel.field;
      if (kernel.vertices != nullptr) out.vertices = *kernel.vertices;
      const double s = seconds_of([&] { timing.nodes = kernel.run(exec, out); });
      timing.seconds = std::min(timing.seconds, s);
      if (round == 0) timing.digest = digest_of(out);
    }
  }
}

}  // namespace

std::vector<SizingTiming> time_sizing(std::span<const int> threads, int rounds,
                                      std::span<const std::string> names) {
  parallel::Executor exec;
  const Inputs in = make_inputs(exec);
  std::vector<SizingTiming> timings;
  const testing::TemporaryFolder folder;
  for (const auto& kernels :
       {field_kernels(in), source_kernels(in), table_kernels(in), file_kernels(in, folder)}) {
    for (const Kernel& kernel : kernels) {
      const bool is_wanted =
          names.empty() || std::find(names.begin(), names.end(), kernel.name) != names.end();
      if (is_wanted) time_kernel(kernel, threads, rounds, timings);
    }
  }
  return timings;
}

}  // namespace delos::benchmark
