// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Output files that appear whole or not at all: written under a temporary name in the folder of
// the target, moved there in one step once they are safely on disk.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <string>

namespace delos {

/// Throws Error(output), with the bytes needed and available, when the file system of `folder`
/// has not `needed_bytes` left, or when the folder does not exist.
void check_free_space(const std::filesystem::path& folder, std::uint64_t needed_bytes);

/// One output. Write to temporary(), close, then commit(); without commit() the temporary is
/// removed and the target stays as it was. The temporary is a hidden file beside the target, which
/// nobody else uses. A target that is a symbolic link is followed.
class AtomicFile {
 public:
  /// Error(output) when the folder is missing, not writable or has not `estimated_bytes` left, or
  /// when the target exists and is no regular file.
  explicit AtomicFile(const std::filesystem::path& target, std::uint64_t estimated_bytes = 0);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::string temporary() const { return temporary_.string(); }
  const std::filesystem::path& target() const { return target_; }

  /// Calls write(temporary()); messages of the errors that it throws name the target instead.
  void fill(const std::function<void(const std::string&)>& write);
  /// Forces the temporary to the disk; Error(output) when that fails (disk full).
  void flush();
  /// flush(), then rename: readers see the old file or the new one, never a part.
  void commit();

 private:
  friend class OutputSet;
  void rename_to_target();

  std::filesystem::path target_, temporary_;
  bool pending_ = false;  // the temporary exists and is ours to remove
};

/// Several outputs that belong together: commit() flushes all before it renames any, so that none
/// appears when one fails. If a rename fails all the same, the earlier ones are taken back.
class OutputSet {
 public:
  /// Calls write(path) at once with the path to write to, which may be handed to any writer of
  /// this layer.
  void add(const std::filesystem::path& target, std::uint64_t estimated_bytes,
           const std::function<void(const std::string&)>& write);
  /// All or none; then the set is empty again.
  void commit();
  std::size_t size() const { return files_.size(); }

 private:
  std::list<AtomicFile> files_;
};

/// The whole file at once, through an AtomicFile.
void write_text_atomically(const std::filesystem::path& path, const std::string& content);

}  // namespace delos
