// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where a grid came from and what is certified about it, and how that stands in a file.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "io/netcdf.hpp"

namespace delos {

struct InputFile {
  std::string path;
  std::string sha256;  ///< 64 hexadecimal digits
};

/// The worst element of one measure. Ids from 0 here, from 1 in the file.
struct FileExtreme {
  double value = 0.0;
  std::array<Index, 2> ids{kNone, kNone};  ///< the triangle and none, or the edge's two cells
  std::array<double, 2> lon_lat_deg{};     ///< in (-180, 180] and [-90, 90]
};

/// What metrics found, for the file's reader to rely on.
struct FileCertificate {
  double well_centred = 0.0;  ///< fraction of triangles whose circumcentre is inside
  std::int32_t n_obtuse = 0;  ///< the others
  FileExtreme angle_max_deg;  ///< a triangle; the others are edges
  FileExtreme dual_ratio_min;
  FileExtreme stagger_max;
  std::optional<FileExtreme> relative_edge_min;  ///< none: the wanted spacing is not known
};

struct Provenance {
  std::string version;            ///< of delos
  std::string config;             ///< the whole YAML text
  std::string digest;             ///< SHA-256 of the grid's arrays, hexadecimal; free of dates
  std::vector<InputFile> inputs;  ///< every file that the grid depends on
  std::string history;            ///< see history_line(); the only place where a date stands
  std::string parent_id;          ///< MPAS: of the file that this one was derived from, if any
  std::optional<FileCertificate> certificate;
};

/// The input with the SHA-256 of its bytes. Error(input) when it can't be read.
InputFile describe_input(const std::string& path);

/// Seconds since 1970 that SOURCE_DATE_EPOCH fixes (reproducible-builds.org), else `now_s`.
/// Error(config) when the variable is set and no whole number >= 0.
std::int64_t history_time(std::int64_t now_s);

/// "2026-01-31T12:00:00Z: <command>", for Provenance::history.
std::string history_line(std::int64_t time_s, const std::string& command);

/// Ten alphanumerics derived from the digest: the same grid gets the same id (MPAS `file_id`).
std::string file_id(const std::string& digest);

/// What the file calls the elements of a certificate, e.g. {"nVertices", "nCells"}: the dimensions
/// that its ids count along.
struct ElementNames {
  std::string triangle, cell;
};

/// Global attributes history, delos_version, delos_config, delos_digest, delos_inputs (a line
/// "<sha256>  <path>" per file, as sha256sum prints); empty ones are left out. The certificate:
/// delos_certificate says in words what the ids count along and from where (1); then
/// delos_well_centred, delos_n_obtuse and, for each of delos_angle_max_deg,
/// delos_relative_edge_min, delos_dual_ratio_min and delos_stagger_max, the value, <name>_triangle
/// (one id) or <name>_cells (two, of an edge) and <name>_lon_lat (degrees). Error(internal) when a
/// number is not finite.
void write_provenance(netcdf::Writer& file, const Provenance& provenance,
                      const ElementNames& elements);

/// The same, read back. Error(input) naming the attribute when a certificate is there in part, or
/// its numbers are not of the right count, finite, or ids from 1.
Provenance read_provenance(const netcdf::Reader& file);

}  // namespace delos
