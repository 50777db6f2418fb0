// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The files of one run, all or none.
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "io/provenance.hpp"
#include "lifecycle/domain.hpp"
#include "lifecycle/file_kind.hpp"
#include "lifecycle/inputs.hpp"
#include "lifecycle/layers.hpp"
#include "lifecycle/settings.hpp"
#include "metrics/certificate.hpp"
#include "sizing/spacing.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// What the files say about the grid beside its arrays.
struct FileNotes {
  std::string digest;
  std::vector<InputRecord> inputs;
  std::string command;  ///< for the `history` attribute
  Certificate certificate;
  std::string report_text, report_json;
};

struct OutputContent {
  const Settings& settings;
  const Mesh& mesh;
  const Grid* grid;                    ///< may be null when the settings need no dual
  const DomainIds* domain;             ///< null: the grid covers the surface
  const LatLonField* spacing_table_m;  ///< may be null
  const SpacingField& spacing;         ///< what the grid was asked to follow
  FileNotes notes;
  /// Writes a picture ("globe", "map", "histograms") to a path; null: no pictures.
  std::function<void(const std::string& picture, const std::string& path)> draw;
  std::span<const GridPartition> partitions = {};
  const Layers* layers = nullptr;  ///< of the grid's cells
};

/// Phase "write". Every file that settings.output names, into `directory` (made when it is not
/// there), with all folders and files left as they were when anything fails. The paths. A report
/// of write_rejected_report() from an earlier run of this name goes. As write_grid_file for the
/// requirements.
std::vector<std::string> write_outputs(Context& context, const OutputContent& content,
                                       const std::string& directory);

/// One file. MPAS knows spheres only: a grid of an ellipsoid is carried to the sphere of equal area
/// (geometry/conformal) first, and the file says so. What is carried gets a certificate of its own;
/// Error(quality) when it misses what the settings require, unless `require.keep` is on.
void write_grid_file(Context& context, const OutputContent& content, FileKind kind,
                     const std::string& path);

/// A certificate as files hold it.
FileCertificate file_certificate(const Certificate& certificate);

/// A line of `history` with the time of now, see history_time().
std::string history_now(const std::string& command);

/// The report alone, of a grid that is not written because it misses a requirement, as
/// <name>.rejected.report.json and .txt. Path of the latter.
std::string write_rejected_report(const OutputSettings& output, const FileNotes& notes,
                                  const std::string& directory);

}  // namespace delos
