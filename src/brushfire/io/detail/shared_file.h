// A file that several processes read and write at the same time, byte by byte under locks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace brushfire::detail {

// Locks are on single bytes and belong to the object (open file descriptions' locks, fcntl): they go with it, or with
// the process, however that ends. Two objects exclude each other also within a process. Where the file system has no
// locks nobody is kept out: can_lock() says so.
class SharedFile {
 public:
  enum class Missing : std::uint8_t { Created, Refused };

  // Opens it for reading and writing. Throws Error(FileNotWritable).
  SharedFile(const std::string& path, Missing missing);
  SharedFile(SharedFile&& other) noexcept;
  SharedFile& operator=(SharedFile&&) = delete;
  ~SharedFile();

  std::uint64_t size() const;
  // Bytes that are new read 0. Throws Error(FileNotWritable).
  void resize(std::uint64_t size) const;
  // All of `bytes` from there on; false where the file is shorter.
  bool read(std::uint64_t offset, std::span<char> bytes) const;
  // Throws Error(FileNotWritable), on a full disk for example.
  void write(std::uint64_t offset, std::span<const char> bytes) const;

  // Never waits. True where this object has the byte now.
  bool try_lock(std::uint64_t offset) const;
  // Waits for it, and listens to the thread's CancelScope.
  void lock(std::uint64_t offset) const;
  void unlock(std::uint64_t offset) const;
  bool can_lock() const { return can_lock_; }

  // Whether the path still means this file.
  bool is_at(const std::string& path) const;

 private:
  [[noreturn]] void fail(int error) const;

  std::string path_;
  int descriptor_ = -1;
  bool can_lock_ = true;
};

}  // namespace brushfire::detail
