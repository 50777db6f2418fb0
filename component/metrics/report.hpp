// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The report of one grid, for programs (JSON) and for people (one screen of text).
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/progress.hpp"
#include "metrics/quality.hpp"

namespace delos {

using ReportValue = std::variant<bool, std::int64_t, double, std::string>;

/// One named object of plain values in the report, e.g. "refine" or "config", in the order given.
struct ReportSection {
  std::string name;
  std::vector<std::pair<std::string, ReportValue>> values;
};

/// An input file and its checksum.
struct ReportInput {
  std::string path;
  std::string sha256;
};

/// The grid cut into parts, one for each process of a model.
struct ReportPartition {
  std::int64_t n_parts = 0;
  std::string method;
  std::int64_t n_cut_edges = 0;
  double cut_share = 0.0;  ///< of the edges
  double heaviest = 0.0;   ///< load of a part over the mean load
  double lightest = 0.0;
};

/// Ids in reports count as those in the files that go with them.
inline constexpr std::int64_t kReportIndexBase = 1;

struct Report {
  std::string title;    ///< e.g. the configuration's name
  std::string version;  ///< of delos
  Ellipsoid surface;
  Quality quality;
  double expected_vertices = 0.0;  ///< from the spacing field; 0 = unknown
  std::int64_t n_cells_made = 0;   ///< of which the grid is a part; 0: it is the whole
  int n_threads = 0;
  std::vector<PhaseTime> phases;
  std::string digest;  ///< of the grid
  std::vector<ReportSection> sections;
  std::vector<ReportInput> inputs;
  std::vector<ReportPartition> partitions;
  std::vector<std::string> missed;  ///< what was required and is not met: missed_requirements()
};

/// JSON, two spaces, keys in a fixed order, numbers that read back to the same double. Ids of the
/// worst elements count from 1 ("index_base"), as in the files; an edge is the pair of its cells.
/// All but "threads" and "phases" depends on the grid alone. Error(internal) naming the key when a
/// number is not finite.
std::string report_json(const Report& report);

/// What of a report can't be measured again from its grid, for restart files: the sections but
/// "dual", and the inputs. JSON.
std::string report_notes(const Report& report);
/// The way back: adds them to the report. Error(input) for another text.
void add_report_notes(const std::string& notes, Report& report);

/// At most 24 lines of at most 80 columns, each ended by a newline.
std::string report_text(const Report& report);

}  // namespace delos
