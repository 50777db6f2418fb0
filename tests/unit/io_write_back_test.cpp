// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_back.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <linux/magic.h>
#include <sys/mman.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace {

constexpr std::int64_t kBlockBytes = std::int64_t{64} << 10;
constexpr std::int64_t kBlocks = 128;

/// Writes block k at place order(k), each full of its own letter, beside a WriteBack.
template <class Order>
void write_blocks(const std::string& path, Order&& order) {
  std::ofstream file(path, std::ios::binary);
  delos::WriteBack write_back(4 * kBlockBytes);
  write_back.watch(path);
  for (std::int64_t k = 0; k < kBlocks; ++k) {
    const std::int64_t place = order(k);
    file.seekp(place * kBlockBytes);
    file << std::string(kBlockBytes, static_cast<char>('a' + place % 26)) << std::flush;
    CHECK(write_back.advance(place * kBlockBytes, kBlockBytes) == 0);
  }
}

/// Share of the file that is in the page cache.
double share_in_memory(const std::string& path) {
  const int handle = ::open(path.c_str(), O_RDONLY);
  const auto n_bytes = static_cast<std::size_t>(kBlocks * kBlockBytes);
  void* map = ::mmap(nullptr, n_bytes, PROT_READ, MAP_SHARED, handle, 0);
  ::close(handle);
  REQUIRE(map != MAP_FAILED);
  const auto page_bytes = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  std::vector<unsigned char> pages((n_bytes + page_bytes - 1) / page_bytes);
  const int status = ::mincore(map, n_bytes, pages.data());
  ::munmap(map, n_bytes);
  REQUIRE(status == 0);
  const auto n = std::count_if(pages.begin(), pages.end(), [](auto page) { return page % 2 == 1; });
  return static_cast<double>(n) / static_cast<double>(pages.size());
}

}  // namespace

TEST_CASE("a file that goes to the disk while it is made has every byte, in any order") {
  const delos::testing::TemporaryFolder folder;
  for (const std::int64_t step : {1, 37}) {  // in order; here and there
    CAPTURE(step);
    const std::string path = folder.file("long");
    write_blocks(path, [=](std::int64_t k) { return k * step % kBlocks; });
    std::ifstream file(path, std::ios::binary);
    std::string block(kBlockBytes, ' ');
    for (std::int64_t k = 0; k < kBlocks; ++k) {
      REQUIRE(file.read(block.data(), kBlockBytes));
      CHECK(block == std::string(kBlockBytes, static_cast<char>('a' + k % 26)));
    }
  }
}

TEST_CASE("a file that goes to the disk while it is made leaves the memory") {
  const delos::testing::TemporaryFolder folder;
  struct statfs system {};
  REQUIRE(::statfs(folder.file("").c_str(), &system) == 0);
  if (system.f_type == TMPFS_MAGIC) return;  // memory is where its files are
  const std::string path = folder.file("long");
  write_blocks(path, [](std::int64_t k) { return k; });
  CHECK(share_in_memory(path) < 0.5);
}

TEST_CASE("a file that can't be watched costs nothing") {
  const delos::testing::TemporaryFolder folder;
  delos::WriteBack write_back(1);
  CHECK(write_back.advance(0, 1) == 0);
  write_back.watch(folder.file("none"));
  CHECK(write_back.advance(0, 1) == 0);
}
