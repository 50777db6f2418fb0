// SPDX-License-Identifier: BSD-3-Clause
#include "core/parallel.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>

#include "core/error.hpp"
#include "core/hash.hpp"

using namespace delos;

TEST_CASE("a number of threads far beyond the machine's is cut, not started") {
  parallel::Executor all(0), none(-1), few(8), many(1'000'000);
  CHECK(none.n_threads() == all.n_threads());
  CHECK(few.n_threads() == 8);
  CHECK(many.n_threads() >= 64);
  CHECK(many.n_threads() <= std::max(64, 4 * all.n_threads()));
  std::atomic<int> n_done = 0;
  many.run_blocks(1000, [&](std::int64_t) { ++n_done; });
  CHECK(n_done == 1000);
}

TEST_CASE("counts become positions, for any length, grain and number of threads") {
  constexpr std::int64_t kUnset = -77;  // the last value is not read
  for (const int threads : {1, 4}) {
    parallel::Executor exec(threads);
    for (const std::int64_t n : {0, 1, 7, 8, 9, 1000}) {
      for (const std::int64_t grain : {1, 8, 4096}) {
        const auto count = [](std::int64_t i) {
          return static_cast<std::int64_t>(hash64(3, static_cast<std::uint64_t>(i)) % 10);
        };
        std::vector<std::int64_t> positions, wanted = {0};
        for (std::int64_t i = 0; i < n; ++i) {
          positions.push_back(count(i));
          wanted.push_back(wanted.back() + count(i));
        }
        positions.push_back(kUnset);
        parallel::scan_counts(exec, grain, positions);
        CHECK(positions == wanted);
        CHECK(parallel::exclusive_scan(exec, n, grain, count) == wanted);
      }
    }
  }
}

TEST_CASE("the smallest of all threads' values remains, none counting as the largest") {
  parallel::Executor exec(4);
  constexpr std::int64_t kValues = 100000;
  std::vector<Index> slots(3, kNone);
  parallel::for_index(exec, kValues, 64, [&](std::int64_t i) {
    const auto value = static_cast<Index>(hash64(5, static_cast<std::uint64_t>(i)) >> 40);
    parallel::lower_to(slots[static_cast<std::size_t>(i % 2)], value);
  });
  std::vector<Index> wanted(3, kNone);
  for (std::int64_t i = 0; i < kValues; ++i) {
    const auto value = static_cast<Index>(hash64(5, static_cast<std::uint64_t>(i)) >> 40);
    Index& slot = wanted[static_cast<std::size_t>(i % 2)];
    if (slot == kNone || value < slot) slot = value;
  }
  CHECK(slots == wanted);
}

TEST_CASE("a pipeline takes in ascending order what is made in any") {
  constexpr std::int64_t kItems = 500;
  for (const int threads : {1, 2, 5}) {
    CAPTURE(threads);
    parallel::Executor exec(threads);
    for (const bool backwards : {false, true}) {
      std::vector<std::int64_t> order(kItems);
      for (std::int64_t i = 0; i < kItems; ++i) {
        order[static_cast<std::size_t>(i)] = backwards ? kItems - 1 - i : i;
      }
      std::vector<std::uint64_t> made(kItems, 0), taken;
      exec.run_pipeline(
          order,
          [&](std::int64_t i) {
            made[static_cast<std::size_t>(i)] = hash64(7, static_cast<std::uint64_t>(i));
          },
          [&](std::int64_t i) { taken.push_back(made[static_cast<std::size_t>(i)]); });
      CHECK(taken.size() == made.size());
      CHECK(taken == made);
      CHECK(std::find(taken.begin(), taken.end(), 0) == taken.end());
    }
    exec.run_pipeline(
        {}, [](std::int64_t) { FAIL("made"); }, [](std::int64_t) { FAIL("taken"); });
  }
}

TEST_CASE("an exception in a pipeline reaches its caller") {
  const std::vector<std::int64_t> order = {0, 1, 2, 3, 4, 5, 6, 7};
  for (const int threads : {1, 4}) {
    parallel::Executor exec(threads);
    const auto fail_at = [](std::int64_t which) {
      return [=](std::int64_t i) {
        if (i == which) throw Error(ErrorKind::input, "no");
      };
    };
    CHECK_THROWS_AS(exec.run_pipeline(order, fail_at(3), fail_at(-1)), Error);
    CHECK_THROWS_AS(exec.run_pipeline(order, fail_at(-1), fail_at(5)), Error);
  }
}
