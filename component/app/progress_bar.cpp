// SPDX-License-Identifier: BSD-3-Clause
#include "app/progress_bar.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace delos::app {
namespace {

constexpr int kDefaultColumns = 80;
constexpr int kBarCells = 24;

int terminal_columns() {
  winsize size{};
  const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? size.ws_col : kDefaultColumns;
}

/// "1.2 M", "640", "35 k"
std::string short_count(double value) {
  char out[32];
  if (value >= 1e6) {
    std::snprintf(out, sizeof(out), "%.1f M", value / 1e6);
  } else if (value >= 1e4) {
    std::snprintf(out, sizeof(out), "%.0f k", value / 1e3);
  } else {
    std::snprintf(out, sizeof(out), "%.0f", value);
  }
  return out;
}

std::string short_time(double seconds) {
  const auto total = static_cast<long long>(std::llround(seconds));
  if (total < 120) return text(total, " s");
  if (total < 7200) return text(total / 60, " min ", total % 60, " s");
  return text(total / 3600, " h ", total / 60 % 60, " min");
}

std::string bar(double fraction) {
  const int filled = static_cast<int>(fraction * kBarCells);
  return "[" + std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(kBarCells - filled), '-') + "]";
}

}  // namespace

std::string progress_line(const Progress& progress, int columns) {
  std::string line = progress.phase;
  line.resize(std::max<std::size_t>(line.size(), 8), ' ');
  const auto done = static_cast<double>(progress.done);
  const double rate = progress.elapsed_s > 0.0 ? done / progress.elapsed_s : 0.0;
  if (progress.total > 0) {
    const double fraction = std::min(1.0, done / static_cast<double>(progress.total));
    char percent[16];
    std::snprintf(percent, sizeof(percent), " %3.0f %%", 100.0 * fraction);
    line += " " + bar(fraction) + percent;
    if (rate > 0.0) line += "  " + short_count(rate) + "/s";
    if (rate > 0.0 && fraction < 1.0) {
      line += "  ETA " + short_time((static_cast<double>(progress.total) - done) / rate);
    }
  } else {
    if (progress.done > 0) line += " " + short_count(done);
    line += "  " + short_time(progress.elapsed_s);
  }
  return line.substr(0, static_cast<std::size_t>(std::max(columns - 1, 1)));
}

ProgressBar::ProgressBar(bool quiet) : quiet_(quiet), is_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::show(const Progress& progress) {
  if (quiet_) return;
  if (is_terminal_) {
    std::fprintf(stderr, "\r\033[K%s", progress_line(progress, terminal_columns()).c_str());
    std::fflush(stderr);
    is_drawn_ = true;
  } else if (progress.phase != phase_) {
    std::fprintf(stderr, "%s\n", progress.phase.c_str());
  }
  phase_ = progress.phase;
}

void ProgressBar::log(LogLevel level, const std::string& message) {
  const bool is_warning = level == LogLevel::warning || level == LogLevel::error;
  if (level == LogLevel::debug || (quiet_ && !is_warning)) return;
  clear();
  std::fprintf(stderr, "delos: %s%s\n", is_warning ? "warning: " : "", message.c_str());
}

void ProgressBar::clear() {
  if (!is_drawn_) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
  is_drawn_ = false;
}

}  // namespace delos::app
