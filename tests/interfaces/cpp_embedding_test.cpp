// SPDX-License-Identifier: BSD-3-Clause
// What a component leaves alone in its host's process, and how many of them live there.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>
#ifdef __x86_64__
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cfenv>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <delos/delos.hpp>
#include <filesystem>
#include <functional>
#include <locale>
#include <string>
#include <thread>
#include <utility>
#include <vector>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "component_support.hpp"
#include "support/temporary_folder.hpp"

using namespace hosts;

namespace {

/// By the distance to an island's coast, so that files and tables have their part.
delos::Config coastal(const delos::testing::TemporaryFolder& folder) {
  const std::string land = folder.write(
      "land.geojson",
      R"({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":
          [[[-30, -40], [40, -35], [60, 20], [10, 50], [-30, -40]]]}})");
  return delos::Config::from_text(
      "sizing:\n"
      "  sources: [{type: coast, file: " +
      land +
      ", spacing: 500 km, rate: 0.2, max: 1500 km}]\n"
      "  smooth: 5 deg\n"
      "  gradient_limit: 0.3\n"
      "  resolution: 4 deg\n"
      "refine: {tile_vertices: 500}\n"
      "relax: {polish_rounds: 4}\n");
}

/// What goes to a file descriptor while it lives.
class Capture {
 public:
  explicit Capture(int descriptor)
      : descriptor_(descriptor), saved_(dup(descriptor)), file_(std::tmpfile()) {
    std::fflush(nullptr);
    dup2(fileno(file_), descriptor_);
  }
  ~Capture() {
    restore();
    std::fclose(file_);
  }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
  long n_bytes() {
    restore();
    return static_cast<long>(lseek(fileno(file_), 0, SEEK_END));
  }

 private:
  void restore() {
    if (saved_ < 0) return;
    std::fflush(nullptr);
    dup2(saved_, descriptor_);
    close(saved_);
    saved_ = -1;
  }
  int descriptor_;
  int saved_;
  std::FILE* file_;
};

/// What the process does on each signal.
std::vector<std::pair<void (*)(int), int>> actions() {
  std::vector<std::pair<void (*)(int), int>> out;
  for (int number = 1; number < NSIG; ++number) {
    struct sigaction action {};
    sigaction(number, nullptr, &action);
    out.emplace_back(action.sa_handler, action.sa_flags);
  }
  return out;
}

std::vector<int> blocked_signals() {
  sigset_t mask;
  pthread_sigmask(SIG_SETMASK, nullptr, &mask);
  std::vector<int> out;
  for (int number = 1; number < NSIG; ++number) {
    if (sigismember(&mask, number) == 1) out.push_back(number);
  }
  return out;
}

void read(const delos::Config& config, const std::string& path) {
  delos::Component component(config, {.threads = 1});
  component.initialize(delos::InitializePhase::advertise);
  auto clock = daily();
  component.read_restart(path, clock);
}

/// What is said of files that libraries below might print about: damaged ones, and none.
std::vector<std::string> failures(const delos::testing::TemporaryFolder& folder) {
  const auto config = uniform("1500 km");
  const auto clock = daily();
  delos::Component component(config, {.threads = 1});
  component.initialize();
  const std::string whole = folder.file("whole.nc");
  component.write_restart(whole, clock);
  std::filesystem::copy_file(whole, folder.file("short.nc"));
  std::filesystem::resize_file(folder.file("short.nc"), std::filesystem::file_size(whole) / 2);
  const std::vector<std::function<void()>> calls = {
      [&] { component.write_restart(folder.file("no such folder/a.nc"), clock); },
      [&] { read(config, folder.file("short.nc")); },
      [&] { read(config, folder.write("text.nc", "no restart file")); },
      // As netCDF-4 files begin.
      [&] { read(config, folder.write("hdf.nc", "\x89HDF\r\n\x1a\n and no more")); },
      [&] { read(config, folder.file("nowhere.nc")); },
      [&] { static_cast<void>(delos::Config::from_text("sizing: [")); }};
  std::vector<std::string> out;
  for (const auto& call : calls) {
    out.emplace_back("none");
    try {
      call();
    } catch (const delos::Error& error) {
      out.back() = error.what();
    }
  }
  return out;
}

/// Rounding, traps and what becomes of subnormal numbers, as the calling thread has them.
unsigned floating_point_mode() {
#ifdef __x86_64__
  return _mm_getcsr() & ~static_cast<unsigned>(_MM_EXCEPT_MASK);
#else
  return static_cast<unsigned>(std::fegetround());
#endif
}

/// A host's own floating point, until it goes.
class HostFloatingPoint {
 public:
  HostFloatingPoint() { std::fegetenv(&before_); }
  ~HostFloatingPoint() { std::fesetenv(&before_); }
  HostFloatingPoint(const HostFloatingPoint&) = delete;
  HostFloatingPoint& operator=(const HostFloatingPoint&) = delete;
  static void round_up() { std::fesetround(FE_UPWARD); }
  /// As gfortran's -ffpe-trap=invalid,zero,overflow.
  static void trap() {
#ifdef __GLIBC__
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
#endif
  }
  /// As programs linked with -Ofast.
  static void flush_to_zero() {
#ifdef __x86_64__
    _mm_setcsr(_mm_getcsr() | _MM_FLUSH_ZERO_ON | kDenormalsAreZero);
#endif
  }

 private:
#ifdef __x86_64__
  static constexpr unsigned kDenormalsAreZero = 0x40;
#endif
  std::fenv_t before_{};
};

}  // namespace

TEST_CASE("two components on two threads make the grids that they make alone") {
  const auto coarse = uniform("900 km");
  const auto fine = uniform("500 km");
  const std::array<std::string, 2> alone = {life(coarse, 1), life(fine, 1)};
  CHECK(alone[0] != alone[1]);
  for (const int threads : {1, 2, 5}) {
    CAPTURE(threads);
    std::array<std::string, 2> together;
    std::thread first([&] { together[0] = life(coarse, threads); });
    std::thread second([&] { together[1] = life(fine, threads); });
    first.join();
    second.join();
    CHECK(together == alone);
  }
}

TEST_CASE("threads that write and read files at once get what one thread gets") {
  const delos::testing::TemporaryFolder folder;
  const auto bare = uniform("2000 km");
  constexpr int kThreads = 4;
  std::array<std::string, kThreads> found;
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      const std::string name = "part" + std::to_string(i);
      for (int round = 0; round < 5; ++round) {
        const delos::Grid grid = delos::generate(bare, {.threads = 1});
        grid.write_ugrid_cells(folder.file(name + ".nc"));
        delos::Clock clock({.start = delos::Time::parse("2000-01-01"),
                            .stop = delos::Time::parse("2000-01-03"),
                            .step = delos::TimeInterval::of_days(1)});
        delos::Component component(bare, {.threads = 1});
        component.initialize();
        component.write_restart(folder.file(name + ".restart"), clock);
        delos::Component second(bare, {.threads = 1});
        second.initialize(delos::InitializePhase::advertise);
        second.read_restart(folder.file(name + ".restart"), clock);
        found[static_cast<std::size_t>(i)] = second.grid().digest();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  const std::string alone = delos::generate(bare, {.threads = 1}).digest();
  for (const std::string& digest : found) CHECK(digest == alone);
}

TEST_CASE("components in the host's own oneTBB and OpenMP loops make the same grids") {
  const auto config = uniform("900 km");
  const std::string alone = life(config, 1);
  constexpr int kHosts = 4;
  std::array<std::string, kHosts> digests;
  tbb::task_arena arena(2);
  arena.execute([&] {
    tbb::parallel_for(0, kHosts,
                      [&](int i) { digests[static_cast<std::size_t>(i)] = life(config, i % 3); });
  });
  for (const std::string& digest : digests) CHECK(digest == alone);
#ifdef _OPENMP
  digests.fill("");
#pragma omp parallel for num_threads(3)
  for (int i = 0; i < kHosts; ++i) digests[static_cast<std::size_t>(i)] = life(config, i % 3);
  for (const std::string& digest : digests) CHECK(digest == alone);
#else
  MESSAGE("built without OpenMP: its part is left out");
#endif
}

TEST_CASE("a component's life leaves output, locale and signals alone") {
  const delos::testing::TemporaryFolder folder;
  const std::string locale = std::setlocale(LC_ALL, nullptr);
  const std::string cpp_locale = std::locale().name();
  const auto before = actions();
  const auto blocked = blocked_signals();
  Capture out(STDOUT_FILENO);
  Capture err(STDERR_FILENO);
  const std::string digest = life(uniform("900 km"), 2);
  const std::vector<std::string> refusals = failures(folder);
  const long n_out = out.n_bytes();
  const long n_err = err.n_bytes();
  CHECK(n_out == 0);
  CHECK(n_err == 0);
  CHECK(std::count(refusals.begin(), refusals.end(), "none") == 0);
  CHECK(std::setlocale(LC_ALL, nullptr) == locale);
  CHECK(std::locale().name() == cpp_locale);
  CHECK((actions() == before));
  CHECK(blocked_signals() == blocked);
  CHECK(digest == life(uniform("900 km"), 2));
}

TEST_CASE("the host's floating point stays as it is, and the grid does not depend on it") {
  const delos::testing::TemporaryFolder folder;
  const auto config = coastal(folder);
  const std::string alone = life(config, 1);
  constexpr std::array kModes = {&HostFloatingPoint::round_up, &HostFloatingPoint::trap,
                                 &HostFloatingPoint::flush_to_zero};
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    CAPTURE(i);
    std::string digest, nested;
    unsigned before = 0, after = 0;
    int flags = 0;
    {
      const HostFloatingPoint own;
      kModes[i]();
      std::feclearexcept(FE_ALL_EXCEPT);
      before = floating_point_mode();
      digest = life(config, 2);
      after = floating_point_mode();
      flags = std::fetestexcept(FE_ALL_EXCEPT);
      // The host's tasks carry its mode to all threads that work on them.
      tbb::task_arena arena(2);
      arena.execute([&] { tbb::parallel_for(0, 1, [&](int) { nested = life(config, 2); }); });
    }
    CHECK(after == before);
    CHECK(flags == 0);
    CHECK(digest == alone);
    CHECK(nested == alone);
  }
}

TEST_CASE("a thousand components that are never realized come and go") {
  const auto config = uniform("900 km");
  for (int i = 0; i < 1000; ++i) {
    delos::Component component(config);
    component.initialize(delos::InitializePhase::advertise);
    if (i % 2 == 0) component.finalize();
    CHECK(component.generation() == 0);
  }
}

TEST_CASE("what starting costs: initialize of a 60 km grid") {
  auto config = delos::Config::from_text("sizing: {sources: [{type: constant, spacing: 60 km}]}");
  delos::Component component(config);
  const std::clock_t begin = std::clock();
  component.initialize();
  const double used_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  MESSAGE("initialize: ", component.grid().n_cells(), " cells in ", used_s, " s of all threads");
  CHECK(component.grid().certificate().well_centred);
  CHECK(component.grid().weights_on_edge().size() > 0);
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__)
  // Of processors, so that a machine with other work does not matter: less than 1.5 s on one core.
  CHECK(used_s < 1.5);
#endif
}
