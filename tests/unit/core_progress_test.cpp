// SPDX-License-Identifier: BSD-3-Clause
#include "core/progress.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <ctime>
#include <thread>

using namespace delos;

namespace {

void work_for(double cpu_s) {
  const std::clock_t end = std::clock() + static_cast<std::clock_t>(cpu_s * CLOCKS_PER_SEC);
  while (std::clock() < end) {
  }
}

}  // namespace

TEST_CASE("a phase that works costs processor time, one that waits only wall time") {
  Monitor monitor;
  {
    const Phase phase(monitor, "work", 3);
    work_for(0.02);
    monitor.advance(3);
  }
  {
    const Phase phase(monitor, "wait", 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  REQUIRE(monitor.phases().size() == 2);
  const PhaseTime &work = monitor.phases()[0], &wait = monitor.phases()[1];
  CHECK(work.phase == "work");
  CHECK(work.items == 3);
  CHECK(work.cpu_s >= 0.019);  // clock() counts microseconds, and may round up the start
  CHECK(wait.phase == "wait");
  CHECK(wait.wall_s >= 0.05);
  CHECK(wait.cpu_s < 0.025);
}

TEST_CASE("the processor time of a phase is that of all threads") {
  Monitor monitor;
  {
    const Phase phase(monitor, "work", 0);
    std::thread other([] { work_for(0.02); });
    other.join();
  }
  CHECK(monitor.phases().front().cpu_s >= 0.019);
}

TEST_CASE("progress names the phase from its first report to its last") {
  std::vector<Progress> heard;
  Monitor monitor([&](const Progress& progress) { heard.push_back(progress); }, {}, nullptr);
  {
    const Phase phase(monitor, "count", 10);
    monitor.advance(10);
  }
  REQUIRE(heard.size() >= 2);
  CHECK(heard.front().phase == "count");
  CHECK(heard.front().done == 0);
  CHECK(heard.back().phase == "count");
  CHECK(heard.back().done == 10);
  CHECK(heard.back().total == 10);
}
