// Lines of text as they come, for lists that people write: places, costs.
#pragma once

#include <brushfire/io/byte_stream.h>

#include <array>
#include <cstddef>
#include <string>

namespace brushfire::tool {

// A file or pipe line by line: one that never ends is found wrong, or interrupted, in its midst. "-" is standard input,
// and named pipes are read. Lines end in LF, CR LF or CR; a UTF-8 byte order mark in front is nothing. Throws
// Error(FileNotReadable).
class TextLines {
 public:
  explicit TextLines(const std::string& path) : stream_(path, ByteStream::NamedPipes::Read) {}

  // False at the end. Throws Error(InvalidArgument) where the line is longer than 65536 bytes, Error(FileMalformed) for
  // text in UTF-16.
  bool next(std::string& line);

  // "FILE:LINE: ", of the line that was read last.
  std::string here() const { return stream_.name() + ":" + std::to_string(number_) + ": "; }

 private:
  bool read(std::string& line);

  ByteStream stream_;
  std::array<char, 65536> block_{};
  std::size_t at_ = 0, size_ = 0;
  bool after_cr_ = false;  // an LF that comes now belongs to the line before
  int number_ = 0;
};

}  // namespace brushfire::tool
