// SPDX-License-Identifier: BSD-3-Clause
// Fixed cases, one JSON line for each and each number of threads on standard output, after a line
// on the machine. README.md says what the keys mean.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "benchmark/cases.hpp"
#include "benchmark/child.hpp"
#include "benchmark/measure.hpp"
#include "benchmark/remap_cases.hpp"
#include "benchmark/remesh_cases.hpp"
#include "benchmark/sizing_cases.hpp"
#include "io/data_files.hpp"
#include "support/temporary_folder.hpp"

namespace delos::benchmark {
namespace {

constexpr char kUsage[] =
    "usage: delos_benchmark [OPTION...] [CASE...]\n"
    "  CASE             all but the large ones when none is named\n"
    "  --threads N,...  numbers of threads, each a line (default: 1 and all cores)\n"
    "  --repeat N       runs of each; the least of each time is told (default 1)\n"
    "  --large          the large cases too\n"
    "  --label TEXT     stands in the line on the machine, e.g. the commit\n"
    "  --sizing         the kernels of the sizing layer instead; CASE names some of them\n"
    "  --remesh         local remeshes beside fresh meshes instead; CASE names some of them\n"
    "  --remap          weights between two grids instead; CASE names some of them\n"
    "  --list           names of the cases, nothing is run\n";

struct Arguments {
  std::vector<std::string> names;
  std::vector<int> threads;
  int repeats = 1;
  bool with_large = false;
  bool only_sizing = false;
  bool only_remesh = false;
  bool only_remap = false;
  bool only_lists = false;
  std::string label;
};

int positive(const std::string& option, const std::string& word) {
  char* end = nullptr;
  const long value = std::strtol(word.c_str(), &end, 10);
  if (word.empty() || *end != '\0' || value < 1 || value > 1024) {
    throw std::invalid_argument(option + " " + word + ": must be whole numbers in 1..1024\n" +
                                kUsage);
  }
  return static_cast<int>(value);
}

std::vector<int> thread_counts(const std::string& list) {
  std::vector<int> counts;
  std::size_t begin = 0;
  while (begin <= list.size()) {
    const std::size_t comma = std::min(list.find(',', begin), list.size());
    counts.push_back(positive("--threads", list.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  return counts;
}

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto value = [&] {
      if (i + 1 == words.size()) throw std::invalid_argument(words[i] + ": value?\n" + kUsage);
      return words[++i];
    };
    if (words[i] == "--threads") {
      arguments.threads = thread_counts(value());
    } else if (words[i] == "--repeat") {
      arguments.repeats = positive("--repeat", value());
    } else if (words[i] == "--label") {
      arguments.label = value();
    } else if (words[i] == "--large") {
      arguments.with_large = true;
    } else if (words[i] == "--sizing") {
      arguments.only_sizing = true;
    } else if (words[i] == "--remesh") {
      arguments.only_remesh = true;
    } else if (words[i] == "--remap") {
      arguments.only_remap = true;
    } else if (words[i] == "--list") {
      arguments.only_lists = true;
    } else if (words[i].rfind("--", 0) == 0) {
      throw std::invalid_argument(words[i] + ": unknown option\n" + kUsage);
    } else {
      arguments.names.push_back(words[i]);
    }
  }
  if (arguments.threads.empty()) {
    arguments.threads.push_back(1);
    const auto n_cores = static_cast<int>(std::thread::hardware_concurrency());
    if (n_cores > 1) arguments.threads.push_back(n_cores);
  }
  return arguments;
}

std::vector<Case> chosen(const Arguments& arguments) {
  std::vector<Case> out;
  std::vector<std::string> unknown = arguments.names;
  for (Case& one : all_cases()) {
    const bool is_named = std::erase(unknown, one.name) > 0;
    const bool is_default = arguments.names.empty() && !one.is_large;
    if (is_named || is_default || (arguments.with_large && one.is_large)) {
      out.push_back(std::move(one));
    }
  }
  if (!unknown.empty()) throw std::invalid_argument(unknown[0] + ": no such case\n" + kUsage);
  return out;
}

bool has_data(const Case& one) {
  const std::vector<std::string> folders = {kDefaultDataFolder};
  if (one.data_file.empty() || has_data_file(one.data_file, ".", folders)) return true;
  std::fprintf(stderr, "%s is left out: %s of Debian's ferret-datasets is missing\n",
               one.name.c_str(), one.data_file.c_str());
  return false;
}

/// One case on one number of threads.
struct Entry {
  const Case* one = nullptr;
  int threads = 1;
  Json line = {};  ///< null until the first run
  bool has_failed = false;
};

std::vector<Entry> entries_of(const std::vector<Case>& cases, const std::vector<int>& threads) {
  std::vector<Entry> entries;
  for (const Case& one : cases) {
    if (!has_data(one)) continue;
    for (const int n : threads) entries.push_back({&one, n});
  }
  return entries;
}

/// Another run, in a process of its own, so that memory is that of one run.
void measure_again(Entry& entry) {
  try {
    const testing::TemporaryFolder folder;
    const Json next = Json::parse(
        run_in_child([&] { return measure(*entry.one, entry.threads, folder.file(".")).dump(); }));
    if (entry.line.is_null()) {
      entry.line = next;
    } else {
      join(next, entry.line);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s on %d threads: %s\n", entry.one->name.c_str(), entry.threads,
                 error.what());
    entry.has_failed = true;
  }
}

void print(const Json& line) {
  std::printf("%s\n", line.dump().c_str());
  std::fflush(stdout);
}

/// Prints what was measured; false when a run failed or a grid depends on the threads.
bool print_lines(std::vector<Entry>& entries) {
  bool is_good = true;
  const Entry* before = nullptr;
  for (Entry& entry : entries) {
    is_good = is_good && !entry.has_failed;
    if (entry.has_failed) continue;
    add_rates(entry.line);
    print(entry.line);
    if (before != nullptr && before->one == entry.one &&
        before->line.at("digest") != entry.line.at("digest")) {
      std::fprintf(stderr, "%s: the grids of %d and %d threads differ\n", entry.one->name.c_str(),
                   before->threads, entry.threads);
      is_good = false;
    }
    before = &entry;
  }
  return is_good;
}

void print_names() {
  for (const Case& one : all_cases()) {
    std::printf("%s%s\n", one.name.c_str(), one.is_large ? " (large)" : "");
  }
}

/// Kernels of the sizing layer; false when the bits of one depend on the threads.
bool run_sizing(const Arguments& arguments) {
  bool is_good = true;
  std::string name, digest;
  const auto timings = time_sizing(arguments.threads, arguments.repeats, arguments.names);
  if (timings.empty()) throw std::invalid_argument("no such kernel");
  for (const SizingTiming& timing : timings) {
    print({{"sizing", timing.name},
           {"threads", timing.threads},
           {"seconds", timing.seconds},
           {"nodes_per_s", static_cast<double>(timing.nodes) / timing.seconds},
           {"digest", timing.digest}});
    is_good = is_good && (timing.name != name || timing.digest == digest);
    name = timing.name;
    digest = timing.digest;
  }
  return is_good;
}

/// Local remeshes; false when the bits of one depend on the threads.
bool run_remesh(const Arguments& arguments) {
  bool is_good = true;
  std::string name, digest;
  const auto timings = time_remesh(arguments.threads, arguments.repeats, arguments.names);
  if (timings.empty()) throw std::invalid_argument("no such remesh");
  for (const RemeshTiming& timing : timings) {
    Json line = {{"remesh", timing.name},
                 {"threads", timing.threads},
                 {"before", timing.n_before},
                 {"after", timing.n_after},
                 {"removed", timing.n_removed},
                 {"inserted", timing.n_inserted},
                 {"fresh_s", timing.fresh_s},
                 {"remesh_s", timing.remesh_s},
                 {"share", timing.remesh_s / timing.fresh_s},
                 {"digest", timing.digest}};
    for (const PhaseTime& phase : timing.phases) {
      Json& total = line[phase.phase + "_s"];
      total = (total.is_null() ? 0.0 : total.get<double>()) + phase.wall_s;
    }
    print(line);
    is_good = is_good && (timing.name != name || timing.digest == digest);
    name = timing.name;
    digest = timing.digest;
  }
  return is_good;
}

/// Weights between grids; false when the bits of one depend on the threads. Rates are of the
/// program's processor seconds on one thread, of wall time on more, as in add_rates().
bool run_remap(const Arguments& arguments) {
  bool is_good = true;
  std::string name, digest;
  const auto timings = time_remap(arguments.threads, arguments.repeats, arguments.names);
  if (timings.empty()) throw std::invalid_argument("no such remap");
  for (const RemapTiming& timing : timings) {
    Json line = {{"remap", timing.name},          {"threads", timing.threads},
                 {"sources", timing.n_sources},   {"targets", timing.n_targets},
                 {"overlaps", timing.n_overlaps}, {"digest", timing.digest}};
    const auto n = static_cast<double>(timing.n_overlaps);
    for (const RemapTiming::PhaseSeconds& phase : timing.phases) {
      const double seconds = timing.threads == 1 ? phase.user_s : phase.wall_s;
      line[phase.phase + "_s"] = seconds;
    }
    const auto sum = [&](std::initializer_list<const char*> phases) {
      double seconds = 0.0;
      for (const std::string phase : phases) seconds += line.at(phase + "_s").get<double>();
      return seconds;
    };
    line["first_overlaps_per_s"] = n / sum({"intersect", "first"});
    line["second_overlaps_per_s"] = n / sum({"intersect", "gradients", "second"});
    print(line);
    is_good = is_good && (timing.name != name || timing.digest == digest);
    name = timing.name;
    digest = timing.digest;
  }
  return is_good;
}

int run_all(const Arguments& arguments) {
  if (arguments.only_sizing) return run_sizing(arguments) ? 0 : 1;
  if (arguments.only_remesh) return run_remesh(arguments) ? 0 : 1;
  if (arguments.only_remap) return run_remap(arguments) ? 0 : 1;
  const std::vector<Case> cases = chosen(arguments);
  if (arguments.only_lists) {
    print_names();
    return 0;
  }
  Json head = machine();
  head["label"] = arguments.label;
  print({{"machine", head}});
  std::vector<Entry> entries = entries_of(cases, arguments.threads);
  // Everything once, then everything again: a machine that is slow for a minute then spoils one
  // repeat of each, not all repeats of one.
  for (int repeat = 0; repeat < arguments.repeats; ++repeat) {
    for (Entry& entry : entries) {
      if (!entry.has_failed) measure_again(entry);
    }
  }
  return print_lines(entries) ? 0 : 1;
}

}  // namespace
}  // namespace delos::benchmark

int main(int argc, char** argv) {
  try {
    return delos::benchmark::run_all(delos::benchmark::parse({argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
