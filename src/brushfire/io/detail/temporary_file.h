// A file that is being written beside its target, and what is left of those that were never completed.
#pragma once

#include <string>

namespace brushfire::detail {

// The rule (docs/files.md): a file PATH is written as PATH.part- and six of 0-9 and a-v, in the same folder.
// Whoever writes it holds a lock on it (flock) for as long as the process lives. One that nobody holds was left by a
// process that was killed: who writes the same PATH next removes it. Where the file system has no locks, none is
// removed.
class TemporaryFile {
 public:
  TemporaryFile() = default;
  // Creates it, after what is left over beside the target has been cleared. Not open where that fails: errno says why.
  explicit TemporaryFile(const std::string& target);
  ~TemporaryFile();  // removes it unless it has been renamed
  TemporaryFile(TemporaryFile&& other) noexcept;
  TemporaryFile& operator=(TemporaryFile&& other) noexcept;

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  const std::string& path() const { return path_; }

  // Renames it to the target and closes it. False where either fails: errno says why.
  bool rename_to(const std::string& target);

 private:
  void discard() noexcept;

  std::string path_;
  int descriptor_ = -1;
};

// A lock that one process has: on a file that is made where there is none, until the object or the process ends.
class FileLock {
 public:
  explicit FileLock(const std::string& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  bool is_taken() const { return is_taken_; }  // by somebody else

 private:
  int descriptor_ = -1;
  bool is_taken_ = false;
};

// Where a chain of symbolic links ends, whether or not there is anything: what is written under a link's name is
// written there. The path itself where it is no link.
std::string followed(const std::string& path);

}  // namespace brushfire::detail
