// Input: the bytes of a file, and how to say what is wrong with them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace brushfire::detail {

// Bytes of a file or of memory, inflated where they were gzip. Cheap to copy; the bytes are shared.
class Input {
 public:
  // Reads a whole file; "-" is standard input. Only regular files and pipes without a name are read: a named pipe could
  // block for ever, a device never end.
  static Input from_file(const std::string& path);

  // Views `bytes`, which must outlive the Input (gzip content is inflated into storage of its own).
  static Input from_memory(std::string_view bytes, const std::string& name);

  std::string_view bytes() const noexcept { return bytes_; }
  std::size_t size() const noexcept { return bytes_.size(); }
  const std::string& name() const noexcept { return name_; }  // as given by the caller
  std::string extension() const;                              // lower case, without dot and without a final .gz
  std::size_t inflate_budget() const noexcept { return inflate_budget_; }

  // Drops a UTF-8 byte order mark in front, and refuses text in UTF-16 by name. For content that is not binary.
  void drop_byte_order_mark();

  // A file that this one refers to; `line` is where. Refused unless it lies in the same folder or below.
  Input companion(const std::string& relative, std::size_t line) const;

  // Throw Error(FileMalformed): "NAME:LINE: cause", "NAME: byte N: cause", "NAME: cause".
  [[noreturn]] void fail_line(std::size_t line, const std::string& cause) const;
  [[noreturn]] void fail_byte(std::size_t byte, const std::string& cause) const;
  [[noreturn]] void fail(const std::string& cause) const;

 private:
  void inflate_gzip();

  std::string name_;
  std::string folder_;  // of a file; empty for memory and standard input
  bool has_folder_ = false;
  std::shared_ptr<const char[]> storage_;
  std::string_view bytes_;
  std::size_t inflate_budget_ = 0;
};

// Text for an error message: at most 40 characters, quoted, control characters and foreign bytes as \xNN.
std::string quote(std::string_view text);

// The same without quotes or limit: for names.
std::string printable(std::string_view text);

}  // namespace brushfire::detail
