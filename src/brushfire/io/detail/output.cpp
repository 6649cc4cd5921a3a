// Writing beside the target and renaming.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/output.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <random>
#include <system_error>

namespace brushfire::detail {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18;
constexpr std::size_t kLongestNumber = 32;  // "-1.2345678901234567e-308" has 24

std::string random_suffix() {
  std::random_device device;
  static constexpr char kLetters[] = "0123456789abcdefghijklmnopqrstuv";
  std::string suffix;
  for (std::uint32_t bits = device(), k = 0; k < 6; ++k, bits >>= 5) suffix += kLetters[bits & 31];
  return suffix;
}

}  // namespace

Output::Output(const std::string& path) : name_(path == "-" ? "standard output" : path), buffer_(kBufferSize) {
  if (path == "-") {
    is_stdout_ = true;
    file_ = stdout;
    return;
  }
  std::error_code error;
  fs::path target(path);
  if (fs::is_symlink(target, error)) {
    const fs::path resolved = fs::weakly_canonical(target, error);
    if (!error) target = resolved;
  }
  target_ = target.string();
  const fs::file_status status = fs::status(target, error);
  if (status.type() == fs::file_type::directory) fail("is a directory");
  const bool is_special = fs::exists(status) && status.type() != fs::file_type::regular;
  if (is_special) {
    file_ = std::fopen(target_.c_str(), "wb");
    if (file_ == nullptr) fail(std::strerror(errno));
    return;
  }
  for (int attempt = 0; attempt < 16 && file_ == nullptr; ++attempt) {
    temporary_ = target_ + ".part-" + random_suffix();
    file_ = std::fopen(temporary_.c_str(), "wbx");
    if (file_ == nullptr && errno != EEXIST) break;
  }
  if (file_ == nullptr) {
    const int cause = errno;
    temporary_.clear();
    fail(std::string("cannot be created: ") + std::strerror(cause));
  }
  std::setvbuf(file_, nullptr, _IONBF, 0);
  if (fs::exists(status)) fs::permissions(temporary_, status.permissions(), error);
}

Output::~Output() {
  if (file_ != nullptr && !is_stdout_) std::fclose(file_);
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void Output::fail(const std::string& cause) {
  throw Error(ErrorCode::FileNotWritable, printable(name_) + ": " + cause);
}

void Output::flush() {
  if (used_ != 0 && std::fwrite(buffer_.data(), 1, used_, file_) != used_) {
    fail(std::string("cannot be written: ") + std::strerror(errno));
  }
  used_ = 0;
}

void Output::bytes(const void* data, std::size_t size) {
  if (size == 0) return;
  if (size > buffer_.size() - used_) flush();
  if (size > buffer_.size()) {
    if (std::fwrite(data, 1, size, file_) != size) fail(std::string("cannot be written: ") + std::strerror(errno));
    return;
  }
  std::memcpy(buffer_.data() + used_, data, size);
  used_ += size;
}

void Output::write(std::string_view text) { bytes(text.data(), text.size()); }

void Output::number(double value) {
  char text[kLongestNumber];
  const auto result = std::to_chars(text, text + sizeof text, value);
  write({text, static_cast<std::size_t>(result.ptr - text)});
}

void Output::number(float value) {
  char text[kLongestNumber];
  const auto result = std::to_chars(text, text + sizeof text, value);
  write({text, static_cast<std::size_t>(result.ptr - text)});
}

void Output::number(std::int64_t value) {
  char text[kLongestNumber];
  const auto result = std::to_chars(text, text + sizeof text, value);
  write({text, static_cast<std::size_t>(result.ptr - text)});
}

void Output::numbers(std::initializer_list<double> values, char separator) {
  bool is_first = true;
  for (const double x : values) {
    if (!is_first) write(separator);
    number(x);
    is_first = false;
  }
}

void Output::commit() {
  flush();
  if (is_stdout_) {
    if (std::fflush(stdout) != 0) fail(std::string("cannot be written: ") + std::strerror(errno));
    return;
  }
  const int closed = std::fclose(file_);
  file_ = nullptr;
  if (closed != 0) fail(std::string("cannot be written: ") + std::strerror(errno));
  if (temporary_.empty()) return;
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail("cannot be renamed into place: " + error.message());
  temporary_.clear();
}

}  // namespace brushfire::detail
