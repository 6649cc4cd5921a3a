// Writing beside the target and renaming.
#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/decimal.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/output.h>
#include <brushfire/io/detail/posix.h>
#include <brushfire/io/detail/waiting.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <utility>

namespace brushfire::detail {

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18;
constexpr std::size_t kLongestNumber = 32;
constexpr std::size_t kAtOnce = PIPE_BUF;  // what a pipe that can be written to takes without blocking

}  // namespace

Output::Output(const Destination& destination)
    : name_(destination.name == "-" ? "standard output" : destination.name),
      memory_(destination.memory),
      buffer_(kBufferSize) {
  stop_if_cancelled();
  if (memory_ == nullptr) open(destination.name);
}

void Output::open(const std::string& path) {
  struct posix::stat status{};
  if (path == "-") {
    if (std::fflush(stdout) != 0) fail(std::string("cannot be written: ") + std::strerror(errno));
    descriptor_ = STDOUT_FILENO;
    is_stdout_ = true;
    waits_ = posix::fstat(descriptor_, &status) == 0 && !S_ISREG(status.st_mode);
    return;
  }
  if (path.find('\0') != std::string::npos) fail("a name with a zero byte in it is no file's");
  const bool exists = posix::stat(path.c_str(), &status) == 0;
  if (!exists && errno == ELOOP) fail(std::strerror(errno));
  if (exists && S_ISDIR(status.st_mode)) fail("is a directory");
  target_ = exists && !S_ISREG(status.st_mode) ? path : followed(path);
  if (exists && !S_ISREG(status.st_mode)) {
    open_pipe_or_device();
    return;
  }
  temporary_ = TemporaryFile(target_);
  if (!temporary_.is_open()) fail(std::string("cannot be created: ") + std::strerror(errno));
  descriptor_ = temporary_.descriptor();
  // Permission to write lets the file be replaced; what it lets others do stays as it was.
  if (exists) static_cast<void>(!posix::fchmod(descriptor_, status.st_mode & 07777));
}

// A pipe has no reader at first, and is not waited for in a call that nothing ends.
void Output::open_pipe_or_device() {
  waits_ = true;
  while ((descriptor_ = posix::open(target_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC)) < 0) {
    if (errno != ENXIO && errno != EINTR) fail(std::strerror(errno));
    wait_a_little();
  }
}

Output::~Output() {
  if (descriptor_ >= 0 && !is_stdout_ && !temporary_.is_open()) posix::close(descriptor_);
}

void Output::fail(const std::string& cause) {
  throw Error(ErrorCode::FileNotWritable, printable(name_) + ": " + cause);
}

void Output::send(const char* data, std::size_t size) {
  if (memory_ != nullptr) {
    stop_if_cancelled();
    memory_->insert(memory_->end(), data, data + size);
    return;
  }
  while (size != 0) {
    stop_if_cancelled();
    if (waits_) wait_until_writable(descriptor_);
    const posix::ssize_t sent = posix::write(descriptor_, data, std::min(size, waits_ ? kAtOnce : kLongestCall));
    if (sent < 0 && errno != EINTR && errno != EAGAIN) fail(std::string("cannot be written: ") + std::strerror(errno));
    if (sent <= 0) continue;
    data += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

void Output::flush() { send(buffer_.data(), std::exchange(used_, 0)); }

void Output::bytes(const void* data, std::size_t size) {
  if (size == 0) return;
  if (size > buffer_.size() - used_) flush();
  if (size > buffer_.size()) return send(static_cast<const char*>(data), size);
  std::memcpy(buffer_.data() + used_, data, size);
  used_ += size;
}

void Output::write(std::string_view bytes) { this->bytes(bytes.data(), bytes.size()); }

void Output::number(double value) {
  char text[kLongestDecimal];
  write({text, static_cast<std::size_t>(write_shortest(text, value) - text)});
}

void Output::number(float value) {
  char text[kLongestDecimal];
  write({text, static_cast<std::size_t>(write_shortest(text, value) - text)});
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
  if (is_stdout_ || memory_ != nullptr) return;
  if (temporary_.is_open()) {
    descriptor_ = -1;
    if (!temporary_.rename_to(target_)) fail(std::string("cannot be renamed into place: ") + std::strerror(errno));
  } else if (posix::close(std::exchange(descriptor_, -1)) != 0) {
    fail(std::string("cannot be written: ") + std::strerror(errno));
  }
}

}  // namespace brushfire::detail
