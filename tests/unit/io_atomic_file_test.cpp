// SPDX-License-Identifier: BSD-3-Clause
#include "io/atomic_file.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "support/expect_error.hpp"
#include "support/file_size_limit.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;
using delos::AtomicFile;
using delos::Error;
using delos::ErrorKind;
using delos::OutputSet;
using delos::testing::expect_error;
using delos::testing::FileSizeLimit;
using delos::testing::TemporaryFolder;

namespace {

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_plainly(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

std::size_t n_entries(const TemporaryFolder& folder) {
  const fs::directory_iterator entries(folder.file(""));
  return static_cast<std::size_t>(std::distance(fs::begin(entries), fs::end(entries)));
}

}  // namespace

TEST_CASE("a committed file has its content and no temporary stays") {
  const TemporaryFolder folder;
  delos::write_text_atomically(folder.file("a.txt"), "one\ntwo\n");
  CHECK(content_of(folder.file("a.txt")) == "one\ntwo\n");
  CHECK(n_entries(folder) == 1);
}

TEST_CASE("a file that is not committed leaves the old one as it was") {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "old");
  {
    const AtomicFile file(path);
    write_plainly(file.temporary(), "new");
    CHECK(content_of(path) == "old");
    CHECK(n_entries(folder) == 2);
  }
  CHECK(content_of(path) == "old");
  CHECK(n_entries(folder) == 1);
}

TEST_CASE("two writers of one target never share a temporary") {
  const TemporaryFolder folder;
  AtomicFile first(folder.file("a.txt")), second(folder.file("a.txt"));
  CHECK(first.temporary() != second.temporary());
  write_plainly(first.temporary(), "first");
  write_plainly(second.temporary(), "second");
  second.commit();
  first.commit();
  CHECK(content_of(folder.file("a.txt")) == "first");
  CHECK(n_entries(folder) == 1);
}

TEST_CASE("a symbolic link stays one and its target is replaced") {
  const TemporaryFolder folder;
  folder.write("real.txt", "old");
  fs::create_symlink("real.txt", folder.file("link.txt"));
  delos::write_text_atomically(folder.file("link.txt"), "new");
  CHECK(fs::is_symlink(folder.file("link.txt")));
  CHECK(content_of(folder.file("real.txt")) == "new");
}

TEST_CASE("targets that can't be written are refused with the reason") {
  const TemporaryFolder folder;
  const auto refuse = [&](const std::string& path, std::initializer_list<std::string> parts) {
    expect_error(ErrorKind::output, parts, [&] { delos::write_text_atomically(path, "x"); });
  };
  const std::string missing = folder.file("nowhere/a.txt");
  refuse(missing, {missing, "there is no folder"});
  folder.write("plain", "");
  refuse(folder.file("plain/a.txt"), {"is not a folder"});
  fs::create_directory(folder.file("sub"));
  refuse(folder.file("sub"), {"it is a folder"});
  refuse(folder.file("sub/"), {"names a folder"});
  refuse("/dev/null", {"/dev/null", "not a regular file"});
  CHECK(n_entries(folder) == 2);
}

TEST_CASE("a folder without write permission is refused with what to do") {
  if (::geteuid() == 0) {
    MESSAGE("skipped: root may write everywhere");
    return;
  }
  const TemporaryFolder folder;
  ::chmod(folder.file("").c_str(), 0500);
  expect_error(ErrorKind::output, {"a.txt", "Permission denied", "Check the permissions"},
               [&] { delos::write_text_atomically(folder.file("a.txt"), "x"); });
  ::chmod(folder.file("").c_str(), 0700);
}

TEST_CASE("more bytes than the disk has are refused before anything is written") {
  const TemporaryFolder folder;
  constexpr std::uint64_t kHuge = std::uint64_t{1} << 60;
  expect_error(ErrorKind::output, {"MB left", "needs about", "Free some space"},
               [&] { const AtomicFile file(folder.file("a.nc"), kHuge); });
  CHECK(n_entries(folder) == 0);
}

TEST_CASE("a write that fails half way leaves nothing behind") {
  const TemporaryFolder folder;
  const FileSizeLimit limit(1000);
  expect_error(ErrorKind::output, {"a.txt", "Free some space"}, [&] {
    delos::write_text_atomically(folder.file("a.txt"), std::string(100000, 'x'));
  });
  CHECK(n_entries(folder) == 0);
}

TEST_CASE("a set of outputs appears together") {
  const TemporaryFolder folder;
  OutputSet set;
  for (const char* name : {"a", "b", "c"}) {
    set.add(folder.file(name), 1, [&](const std::string& path) { write_plainly(path, name); });
    CHECK_FALSE(fs::exists(folder.file(name)));
  }
  set.commit();
  CHECK(content_of(folder.file("a")) == "a");
  CHECK(content_of(folder.file("c")) == "c");
  CHECK(n_entries(folder) == 3);
}

TEST_CASE(
    "nothing of a set appears when one of its writers fails, and the message has the target") {
  const TemporaryFolder folder;
  const std::string path = folder.write("a", "old");
  const auto attempt = [&] {
    OutputSet set;
    set.add(path, 1, [](const std::string& temporary) { write_plainly(temporary, "new"); });
    set.add(folder.file("b"), 1, [](const std::string& temporary) {
      throw Error(ErrorKind::output, "can't write " + temporary + ": told so.");
    });
    set.commit();
  };
  expect_error(ErrorKind::output, {"can't write " + folder.file("b") + ": told so."}, attempt);
  CHECK(content_of(path) == "old");
  CHECK(n_entries(folder) == 1);
}

TEST_CASE("a set whose last rename fails takes the others back") {
  const TemporaryFolder folder;
  const std::string old_one = folder.write("a", "old");
  OutputSet set;
  for (const char* name : {"a", "b", "c"}) {
    set.add(folder.file(name), 1, [&](const std::string& path) { write_plainly(path, name); });
  }
  fs::create_directory(folder.file("c"));
  expect_error(ErrorKind::output, {folder.file("c")}, [&] { set.commit(); });
  CHECK(content_of(old_one) == "old");
  CHECK_FALSE(fs::exists(folder.file("b")));
}
