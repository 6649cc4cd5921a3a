// Output: a file that appears under its name complete or not at all, or bytes in memory.
#pragma once

#include <brushfire/io/detail/binary.h>
#include <brushfire/io/detail/temporary_file.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::detail {

// Where output goes: to the file `name`, or into `memory` where there is any; `name` then stands in messages only.
struct Destination {
  std::string name;
  std::vector<std::uint8_t>* memory = nullptr;
};

// Collects bytes in a buffer and writes them to a temporary beside the target, which commit() renames; without commit()
// the temporary goes away. "-" is standard output; devices and pipes are written to directly, links are followed.
// Everything that fails is Error(FileNotWritable). Listens to the thread's CancelScope, also while a pipe is waited
// for.
class Output {
 public:
  explicit Output(const Destination& destination);
  explicit Output(const std::string& path) : Output(Destination{path}) {}
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output();

  void write(std::string_view bytes);
  void write(char c) { write(std::string_view(&c, 1)); }
  void number(double value);  // the shortest text that reads back as the same double; inf, -inf, nan
  void number(float value);   // the same for float
  void number(std::int64_t value);
  void number(std::uint32_t value) { number(static_cast<std::int64_t>(value)); }
  void number(std::int32_t value) { number(static_cast<std::int64_t>(value)); }
  void numbers(std::initializer_list<double> values, char separator);

  // Values as bytes in the given order.
  template <class T>
  void values(std::span<const T> values, std::endian order) {
    if (order == std::endian::native) return bytes(values.data(), values.size() * sizeof(T));
    for (const T& v : values) value(v, order);
  }
  template <class T>
  void value(T v, std::endian order) {
    char raw[sizeof(T)];
    store(v, raw, order);
    bytes(raw, sizeof(T));
  }

  void commit();

 private:
  void bytes(const void* data, std::size_t size);
  void flush();
  void send(const char* data, std::size_t size);
  void open(const std::string& path);
  void open_pipe_or_device();
  [[noreturn]] void fail(const std::string& cause);

  std::string name_, target_;
  std::vector<std::uint8_t>* memory_ = nullptr;
  TemporaryFile temporary_;  // where the target is a file
  int descriptor_ = -1;
  bool is_stdout_ = false;
  bool waits_ = false;  // for who reads a pipe
  std::vector<char> buffer_;
  std::size_t used_ = 0;
};

}  // namespace brushfire::detail
