// Opening, waiting and reading, by POSIX calls.
#include <brushfire/io/byte_stream.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/posix.h>
#include <brushfire/io/detail/waiting.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace brushfire {

namespace posix = detail::posix;

namespace {

[[noreturn]] void not_readable(const std::string& name, const std::string& cause) {
  throw Error(ErrorCode::FileNotReadable, detail::printable(name) + ": " + cause);
}

// Paths of the process's own descriptors: the shell's <(command) is one, and someone writes to it.
bool is_descriptor_path(const std::string& path) {
  return path.starts_with("/dev/fd/") || path.starts_with("/proc/self/fd/") || path == "/dev/stdin";
}

// Before it is opened: opening alone may do something to a device.
void refuse_what_is_no_file(const std::string& path, bool reads_named_pipes) {
  if (path.find('\0') != std::string::npos) not_readable(path, "a name with a zero byte in it is no file's");
  struct posix::stat status{};
  if (posix::stat(path.c_str(), &status) != 0)
    not_readable(path, errno == ENOENT ? "no such file" : std::strerror(errno));
  if (S_ISDIR(status.st_mode)) not_readable(path, "is a directory");
  if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) not_readable(path, "is a device");
  if (S_ISSOCK(status.st_mode)) not_readable(path, "is a socket");
  if (S_ISFIFO(status.st_mode) && !reads_named_pipes && !is_descriptor_path(path)) {
    not_readable(path, "is a named pipe; feed it to standard input and name it -");
  }
}

}  // namespace

ByteStream::ByteStream(const std::string& path, NamedPipes pipes) : name_(path == "-" ? "standard input" : path) {
  if (path == "-") {
    descriptor_ = STDIN_FILENO;
  } else {
    refuse_what_is_no_file(path, pipes == NamedPipes::Read);
    // Not blocking: a pipe is opened before there is a writer, who is then waited for in read().
    descriptor_ = posix::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor_ < 0) not_readable(path, std::strerror(errno));
    is_own_ = true;
  }
  struct posix::stat status{};
  is_file_ = posix::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  if (is_file_) size_ = static_cast<std::uint64_t>(status.st_size);
}

ByteStream::~ByteStream() {
  if (is_own_) posix::close(descriptor_);
}

std::size_t ByteStream::read(char* to, std::size_t most) {
  while (true) {
    stop_if_cancelled();
    if (!is_file_) detail::wait_until_readable(descriptor_);
    const posix::ssize_t got = posix::read(descriptor_, to, std::min(most, detail::kLongestCall));
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR && errno != EAGAIN) not_readable(name_, std::string("cannot be read: ") + std::strerror(errno));
  }
}

}  // namespace brushfire
