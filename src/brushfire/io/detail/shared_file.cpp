// Positional reads and writes, and locks of open file descriptions.
#include <brushfire/io/detail/shared_file.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/posix.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

namespace brushfire::detail {
namespace {

// 0, EAGAIN or EACCES where somebody else has it, or why there are no locks.
int set_lock(int descriptor, std::uint64_t offset, bool locked) {
#ifdef F_OFD_SETLK
  struct flock range{};
  range.l_type = static_cast<short>(locked ? F_WRLCK : F_UNLCK);
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(offset);
  range.l_len = 1;
  return fcntl(descriptor, F_OFD_SETLK, &range) == 0 ? 0 : errno;
#elif defined(_WIN32)
  return posix::set_lock(descriptor, offset, locked);
#else
  static_cast<void>(descriptor), static_cast<void>(offset), static_cast<void>(locked);
  return ENOSYS;
#endif
}

bool is_taken(int error) { return error == EAGAIN || error == EACCES; }

}  // namespace

SharedFile::SharedFile(const std::string& path, Missing missing) : path_(path) {
  descriptor_ = posix::open(path.c_str(), O_RDWR | O_CLOEXEC | (missing == Missing::Created ? O_CREAT : 0), 0666);
  if (descriptor_ < 0) fail(errno);
  // The last byte that a lock can be on is nobody's.
  const int error = set_lock(descriptor_, posix::kLastLock, true);
  can_lock_ = error == 0 || is_taken(error);
  if (error == 0) set_lock(descriptor_, posix::kLastLock, false);
}

SharedFile::SharedFile(SharedFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), can_lock_(other.can_lock_) {}

SharedFile::~SharedFile() {
  if (descriptor_ >= 0) posix::close(descriptor_);
}

void SharedFile::fail(int error) const { throw Error(ErrorCode::FileNotWritable, path_ + ": " + std::strerror(error)); }

std::uint64_t SharedFile::size() const {
  struct posix::stat status{};
  if (posix::fstat(descriptor_, &status) != 0) fail(errno);
  return static_cast<std::uint64_t>(status.st_size);
}

void SharedFile::resize(std::uint64_t size) const {
  if (posix::ftruncate(descriptor_, static_cast<posix::off_t>(size)) != 0) fail(errno);
}

bool SharedFile::read(std::uint64_t offset, std::span<char> bytes) const {
  for (std::size_t done = 0; done < bytes.size();) {
    const posix::ssize_t n =
        posix::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<posix::off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(errno);
    if (n == 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

void SharedFile::write(std::uint64_t offset, std::span<const char> bytes) const {
  for (std::size_t done = 0; done < bytes.size();) {
    const posix::ssize_t n =
        posix::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<posix::off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(n < 0 ? errno : ENOSPC);
    done += static_cast<std::size_t>(n);
  }
}

bool SharedFile::try_lock(std::uint64_t offset) const {
  return !can_lock_ || !is_taken(set_lock(descriptor_, offset, true));
}

void SharedFile::lock(std::uint64_t offset) const {
  constexpr std::chrono::milliseconds kPause{5};
  while (!try_lock(offset)) {
    stop_if_cancelled();
    std::this_thread::sleep_for(kPause);
  }
}

void SharedFile::unlock(std::uint64_t offset) const { set_lock(descriptor_, offset, false); }

bool SharedFile::is_at(const std::string& path) const {
  struct posix::stat open{}, named{};
  return posix::fstat(descriptor_, &open) == 0 && posix::stat(path.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

}  // namespace brushfire::detail
