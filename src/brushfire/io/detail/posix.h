// The POSIX calls that files are read and written by. Where the system has others, Windows, these have the same names
// and mean the same: a file that is open may be renamed, removed and replaced, bytes are never taken for text, names
// are UTF-8, and a lock keeps nobody from reading.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>

#if !defined(_WIN32)

#include <limits.h>
#include <poll.h>
#include <unistd.h>

#if defined(__has_include) && __has_include(<sys/file.h>)
#include <sys/file.h>
#endif

#include <cstdint>
#include <cstdio>

namespace brushfire::detail::posix {

inline constexpr std::uint64_t kLastLock = (std::uint64_t{1} << (8 * sizeof(::off_t) - 1)) - 2;
using ::close, ::dup, ::fchmod, ::fstat, ::ftruncate, ::lstat, ::off_t, ::open, ::poll, ::pollfd, ::pread, ::pwrite,
    ::read, ::ssize_t, ::stat, ::unlink, ::write, std::rename;
#ifdef LOCK_EX
using ::flock;
#endif

}  // namespace brushfire::detail::posix

#else

#include <cstddef>
#include <cstdint>

#define O_CLOEXEC 0
#define O_NOFOLLOW 0
#define O_NONBLOCK 0
#define LOCK_EX 2
#define LOCK_NB 4
#define PIPE_BUF 4096
#define POLLIN 1
#define POLLOUT 4
#define STDIN_FILENO 0
#define STDOUT_FILENO 1
#ifndef S_ISREG
#define S_ISREG(mode) (((mode) & S_IFMT) == S_IFREG)
#define S_ISDIR(mode) (((mode) & S_IFMT) == S_IFDIR)
#define S_ISCHR(mode) (((mode) & S_IFMT) == S_IFCHR)
#endif
#ifndef S_ISFIFO
#define S_ISFIFO(mode) (((mode) & S_IFMT) == _S_IFIFO)
#endif
#ifndef S_ISBLK
#define S_ISBLK(mode) false
#endif
#ifndef S_ISSOCK
#define S_ISSOCK(mode) false
#endif

namespace brushfire::detail::posix {

using off_t = std::int64_t;
using ssize_t = std::ptrdiff_t;
inline constexpr std::uint64_t kLastLock = (std::uint64_t{1} << 61) - 3;

struct stat {
  int st_mode;
  off_t st_size;
  std::uint64_t st_ino, st_dev;
};

struct pollfd {
  int fd;
  short events, revents;
};

int open(const char* path, int flags, int mode = 0);
int close(int descriptor);
int dup(int descriptor);
int fchmod(int descriptor, int mode);
int fstat(int descriptor, struct stat* status);
int stat(const char* path, struct stat* status);
int lstat(const char* path, struct stat* status);
int ftruncate(int descriptor, off_t size);
int unlink(const char* path);
int rename(const char* from, const char* to);
ssize_t read(int descriptor, void* to, std::size_t most);
ssize_t write(int descriptor, const void* from, std::size_t bytes);
ssize_t pread(int descriptor, void* to, std::size_t most, off_t offset);
ssize_t pwrite(int descriptor, const void* from, std::size_t bytes, off_t offset);
// Waits for the time that is told where there is no descriptor, and else for none: the call that follows does.
int poll(pollfd* waited, unsigned long count, int milliseconds);
// Of the whole file, exclusive, and never waiting.
int flock(int descriptor, int operation);
// Of one byte, which may lie anywhere: 0, or why not.
int set_lock(int descriptor, std::uint64_t offset, bool locked);

}  // namespace brushfire::detail::posix

#endif
