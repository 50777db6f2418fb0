// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a person sees of a running computation, on stderr.
#include <string>

#include "core/progress.hpp"

namespace delos::app {

/// "refine   [######----]  62 %  1.2 M/s  ETA 3 s": no wider than `columns`. Without a known total,
/// the items done instead of a bar.
std::string progress_line(const Progress& progress, int columns);

/// A bar that is redrawn in place on a terminal; elsewhere one line as each phase begins; nothing
/// when quiet. Log messages go in between, warnings always.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  void log(LogLevel level, const std::string& message);
  /// Takes the bar off the screen.
  void clear();

 private:
  bool quiet_;
  bool is_terminal_;
  bool is_drawn_ = false;
  std::string phase_;
};

}  // namespace delos::app
