// The bytes of a file, a pipe or the standard input as they come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace brushfire {

// Waiting for a pipe listens to the thread's CancelScope (see core/cancel.h).
class ByteStream {
 public:
  enum class NamedPipes { Refused, Read };

  // "-" is standard input. Throws Error(FileNotReadable) for what is not there, a directory, a device or a socket, and
  // for a named pipe where these are refused; pipes by descriptor (the shell's <(command)) are always read.
  explicit ByteStream(const std::string& path, NamedPipes pipes = NamedPipes::Refused);
  ~ByteStream();
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  // Waits for bytes and takes up to `most` of them; 0 at the end. Throws Error(FileNotReadable) and Error(Cancelled).
  std::size_t read(char* to, std::size_t most);

  // The name that errors use.
  const std::string& name() const noexcept { return name_; }
  // False for pipes, and where the size is not known beforehand.
  bool is_file() const noexcept { return is_file_; }
  std::uint64_t file_size() const noexcept { return size_; }  // a hint: files may grow

 private:
  std::string name_;
  int descriptor_ = -1;
  bool is_own_ = false;  // not the process's standard input
  bool is_file_ = false;
  std::uint64_t size_ = 0;
};

}  // namespace brushfire
