// SPDX-License-Identifier: BSD-3-Clause
#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "core/error.hpp"

namespace delos {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& doing, const fs::path& path, int reason,
                       const std::string& advice) {
  throw Error(ErrorKind::output,
              text("can't ", doing, " ", path.string(), ": ", std::strerror(reason), ". ", advice));
}

std::string advice_for(int reason, const fs::path& folder) {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "Free some space, or choose another output folder.";
    case EROFS:
    case EACCES:
    case EPERM:
      return "Check the permissions of " + folder.string() + ", or choose another output folder.";
    default:
      return "Choose another output folder.";
  }
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

void check_target(const fs::path& target) {
  const fs::path folder = folder_of(target);
  std::error_code ignored;
  DELOS_CHECK(target.has_filename(), ErrorKind::output, "can't write '", target.string(),
              "': it names a folder. Give the name of a file.");
  DELOS_CHECK(fs::exists(folder, ignored), ErrorKind::output, "can't write ", target.string(),
              ": there is no folder ", folder.string(), ". Make it, or choose another one.");
  DELOS_CHECK(fs::is_directory(folder, ignored), ErrorKind::output, "can't write ", target.string(),
              ": ", folder.string(), " is not a folder. Choose another one.");
  const fs::file_status status = fs::status(target, ignored);
  DELOS_CHECK(!fs::is_directory(status), ErrorKind::output, "can't write ", target.string(),
              ": it is a folder. Choose another name.");
  DELOS_CHECK(!fs::exists(status) || fs::is_regular_file(status), ErrorKind::output, "can't write ",
              target.string(), ": it is not a regular file. Choose another name.");
}

// Makes an empty file that did not exist; two processes or threads never get the same one.
fs::path reserve_temporary(const fs::path& target) {
  const fs::path folder = folder_of(target);
  for (int attempt = 0;; ++attempt) {
    fs::path candidate =
        folder / text(".", target.filename().string(), ".", ::getpid(), "-", attempt, ".part");
    const int handle = ::open(candidate.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (handle >= 0) {
      ::close(handle);
      return candidate;
    }
    if (errno != EEXIST) fail("write", target, errno, advice_for(errno, folder));
  }
}

// Makes a rename durable; not every file system can do it for folders, so it is best effort.
void flush_folder(const fs::path& folder) {
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return;
  static_cast<void>(::fsync(handle));
  ::close(handle);
}

// A second name for the old target, by which it can come back; empty when there is none.
fs::path keep_old(const AtomicFile& file) {
  const fs::path old = file.temporary() + ".old";
  return ::link(file.target().c_str(), old.c_str()) == 0 ? old : fs::path();
}

}  // namespace

void check_free_space(const fs::path& folder, std::uint64_t needed_bytes) {
  std::error_code failed;
  const fs::space_info space = fs::space(folder.empty() ? fs::path(".") : folder, failed);
  DELOS_CHECK(!failed, ErrorKind::output, "can't write to the folder '", folder.string(),
              "': ", failed.message(), ". Make it, or choose another one.");
  constexpr double kMegabyte = 1e6;
  DELOS_CHECK(space.available >= needed_bytes, ErrorKind::output, "the folder '", folder.string(),
              "' has ", static_cast<double>(space.available) / kMegabyte,
              " MB left, but the output needs about ",
              static_cast<double>(needed_bytes) / kMegabyte,
              " MB. Free some space, or choose another output folder.");
}

AtomicFile::AtomicFile(const fs::path& target, std::uint64_t estimated_bytes) : target_(target) {
  std::error_code ignored;
  if (fs::is_symlink(target, ignored)) target_ = fs::weakly_canonical(target, ignored);
  check_target(target_);
  check_free_space(folder_of(target_), estimated_bytes);
  temporary_ = reserve_temporary(target_);
  pending_ = true;
}

AtomicFile::~AtomicFile() {
  if (pending_) ::unlink(temporary_.c_str());
}

void AtomicFile::fill(const std::function<void(const std::string&)>& write) {
  try {
    write(temporary());
  } catch (const Error& error) {
    std::string message = error.what();
    const std::string name = temporary();
    for (std::size_t at = 0; (at = message.find(name, at)) != std::string::npos;) {
      message.replace(at, name.size(), target_.string());
      at += target_.string().size();
    }
    throw Error(error.kind(), message);
  }
}

void AtomicFile::flush() {
  const int handle = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  if (handle < 0) fail("write", target_, errno, advice_for(errno, folder_of(target_)));
  const int status = ::fsync(handle);
  const int reason = errno;
  ::close(handle);
  if (status != 0) fail("write", target_, reason, advice_for(reason, folder_of(target_)));
}

void AtomicFile::rename_to_target() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    fail("write", target_, errno, advice_for(errno, folder_of(target_)));
  }
  pending_ = false;
}

void AtomicFile::commit() {
  flush();
  rename_to_target();
  flush_folder(folder_of(target_));
}

void OutputSet::add(const fs::path& target, std::uint64_t estimated_bytes,
                    const std::function<void(const std::string&)>& write) {
  files_.emplace_back(target, estimated_bytes);
  files_.back().fill(write);
}

void OutputSet::commit() {
  for (AtomicFile& file : files_) file.flush();
  std::vector<std::pair<fs::path, fs::path>> done;  // target, its old content
  const auto remove_old = [&] {
    for (const auto& [target, old] : done) {
      if (!old.empty()) ::unlink(old.c_str());
    }
  };
  try {
    for (AtomicFile& file : files_) {
      done.emplace_back(file.target(), keep_old(file));
      file.rename_to_target();
    }
  } catch (const Error&) {
    if (!done.back().second.empty()) ::unlink(done.back().second.c_str());
    done.pop_back();  // the one that failed still has its old content
    for (const auto& [target, old] : done) {
      static_cast<void>(old.empty() ? ::unlink(target.c_str())
                                    : ::rename(old.c_str(), target.c_str()));
    }
    throw;
  }
  remove_old();
  for (const AtomicFile& file : files_) flush_folder(folder_of(file.target()));
  files_.clear();
}

void write_text_atomically(const fs::path& path, const std::string& content) {
  AtomicFile file(path, content.size());
  std::ofstream stream(file.temporary(), std::ios::binary | std::ios::trunc);
  errno = 0;
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (!stream) {
    const int reason = errno != 0 ? errno : EIO;
    fail("write", path, reason, advice_for(reason, folder_of(path)));
  }
  file.commit();
}

}  // namespace delos
