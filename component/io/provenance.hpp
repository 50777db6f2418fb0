// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where a grid came from and what is certified about it, and how that stands in a file.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/netcdf.hpp"

namespace delos {

struct InputFile {
  std::string path;
  std::string sha256;  ///< 64 hexadecimal digits
};

/// What metrics found, for the file's reader to rely on.
struct FileCertificate {
  double well_centred = 0.0;       ///< fraction of triangles whose circumcentre is inside
  double min_relative_edge = 0.0;  ///< smallest edge length / wanted spacing
  double min_dual_ratio = 0.0;     ///< smallest dual / primal edge length
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

/// Global attributes history, delos_version, delos_config, delos_digest, delos_inputs (a line
/// "<sha256>  <path>" per file, as sha256sum prints) and delos_<certificate>. Empty ones are left
/// out.
void write_provenance(netcdf::Writer& file, const Provenance& provenance);

/// The same, read back.
Provenance read_provenance(const netcdf::Reader& file);

}  // namespace delos
