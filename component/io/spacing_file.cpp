// SPDX-License-Identifier: BSD-3-Clause
#include "io/spacing_file.hpp"

#include "io/atomic_file.hpp"

namespace delos {

void write_spacing(const std::string& path, const LatLonField& spacing_m,
                   const Provenance& provenance, netcdf::Format format) {
  AtomicFile target(path, spacing_m.values.size() * sizeof(double));
  target.fill([&](const std::string& temporary) {
    netcdf::Writer file(temporary, format);
    const netcdf::DimensionId lat = file.define_dimension("lat", at(spacing_m.n_rows()));
    const netcdf::DimensionId lon = file.define_dimension("lon", at(spacing_m.n_lon));
    const netcdf::VariableId spacing =
        file.define_variable("spacing", netcdf::Type::float64, {lat, lon});
    file.attribute(spacing, "long_name", "wanted edge length of the triangulation");
    file.attribute(spacing, "units", "m");
    file.compress(spacing, 1);
    const netcdf::VariableId lat_id = file.define_variable("lat", netcdf::Type::float64, {lat});
    file.attribute(lat_id, "standard_name", "latitude");
    file.attribute(lat_id, "units", "degrees_north");
    const netcdf::VariableId lon_id = file.define_variable("lon", netcdf::Type::float64, {lon});
    file.attribute(lon_id, "standard_name", "longitude");
    file.attribute(lon_id, "units", "degrees_east");
    file.attribute(netcdf::kGlobal, "Conventions", "CF-1.8");
    Provenance notes = provenance;
    notes.certificate.reset();  // of a grid, which this file does not hold
    write_provenance(file, notes, {});
    file.end_definitions();
    std::vector<double> degrees;
    degrees.reserve(static_cast<std::size_t>(spacing_m.n_rows()));
    for (Index row = 0; row < spacing_m.n_rows(); ++row) {
      degrees.push_back(180.0 * row / spacing_m.n_lat_cells - 90.0);
    }
    file.put(lat_id, std::span<const double>(degrees));
    degrees.clear();
    for (Index column = 0; column < spacing_m.n_lon; ++column) {
      degrees.push_back(360.0 * column / spacing_m.n_lon - 180.0);
    }
    file.put(lon_id, std::span<const double>(degrees));
    file.put(spacing, std::span<const double>(spacing_m.values));
    file.close();
  });
  target.commit();
}

}  // namespace delos
