// POSIX calls by Windows' own. Nothing on other systems, which have them.
#include <brushfire/io/detail/posix.h>

#if defined(_WIN32)

#define NOMINMAX
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <io.h>

#include <algorithm>
#include <cerrno>
#include <string>

namespace brushfire::detail::posix {
namespace {

// Locks lie beyond the bytes of any file: where Windows locks, nobody else reads.
constexpr std::uint64_t kBeyond = std::uint64_t{1} << 62;
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;

HANDLE handle_of(int descriptor) { return reinterpret_cast<HANDLE>(_get_osfhandle(descriptor)); }

int as_errno(DWORD error) {
  switch (error) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
    case ERROR_BAD_NETPATH:
      return ENOENT;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
      return EEXIST;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
      return EACCES;
    case ERROR_LOCK_VIOLATION:
    case ERROR_IO_PENDING:
      return EWOULDBLOCK;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL:
      return ENOSPC;
    case ERROR_INVALID_HANDLE:
      return EBADF;
    case ERROR_BROKEN_PIPE:
    case ERROR_NO_DATA:
      return EPIPE;
    case ERROR_NOT_ENOUGH_MEMORY:
      return ENOMEM;
    default:
      return EIO;
  }
}

int done(bool well) {
  if (!well) errno = as_errno(GetLastError());
  return well ? 0 : -1;
}

std::wstring wide(const char* name) {
  std::wstring text(static_cast<std::size_t>(MultiByteToWideChar(CP_UTF8, 0, name, -1, nullptr, 0)), L'\0');
  MultiByteToWideChar(CP_UTF8, 0, name, -1, text.data(), static_cast<int>(text.size()));
  return text;
}

// A file that is open may be renamed and removed.
HANDLE opened(const char* path, DWORD access, DWORD how, DWORD attributes) {
  constexpr DWORD kShared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  return CreateFileW(wide(path).c_str(), access, kShared, nullptr, how, attributes, nullptr);
}

int status_of(HANDLE handle, struct stat* status) {
  *status = {};
  const DWORD type = GetFileType(handle);
  if (type != FILE_TYPE_DISK) {
    status->st_mode = type == FILE_TYPE_PIPE ? _S_IFIFO : S_IFCHR;
    return 0;
  }
  BY_HANDLE_FILE_INFORMATION told{};
  if (!GetFileInformationByHandle(handle, &told)) return done(false);
  const bool is_folder = (told.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  status->st_mode = is_folder ? S_IFDIR : S_IFREG;
  status->st_size = static_cast<off_t>(std::uint64_t{told.nFileSizeHigh} << 32 | told.nFileSizeLow);
  status->st_ino = std::uint64_t{told.nFileIndexHigh} << 32 | told.nFileIndexLow;
  status->st_dev = told.dwVolumeSerialNumber;
  return 0;
}

OVERLAPPED at(std::uint64_t offset) {
  OVERLAPPED place{};
  place.Offset = static_cast<DWORD>(offset);
  place.OffsetHigh = static_cast<DWORD>(offset >> 32);
  return place;
}

ssize_t read_at(int descriptor, void* to, std::size_t most, OVERLAPPED* place) {
  DWORD got = 0;
  if (ReadFile(handle_of(descriptor), to, static_cast<DWORD>(std::min(most, kMostAtOnce)), &got, place)) return got;
  const DWORD error = GetLastError();
  return error == ERROR_HANDLE_EOF || error == ERROR_BROKEN_PIPE ? 0 : done(false);
}

ssize_t write_at(int descriptor, const void* from, std::size_t bytes, OVERLAPPED* place) {
  DWORD sent = 0;
  const bool well =
      WriteFile(handle_of(descriptor), from, static_cast<DWORD>(std::min(bytes, kMostAtOnce)), &sent, place) != 0;
  return well ? static_cast<ssize_t>(sent) : done(false);
}

}  // namespace

int open(const char* path, int flags, int /*mode*/) {
  const int kind = flags & (O_RDONLY | O_WRONLY | O_RDWR);
  const DWORD access = (kind == O_WRONLY ? 0 : GENERIC_READ) | (kind == O_RDONLY ? 0 : GENERIC_WRITE);
  const DWORD how = (flags & O_EXCL) != 0 ? CREATE_NEW : (flags & O_CREAT) != 0 ? OPEN_ALWAYS : OPEN_EXISTING;
  const HANDLE handle = opened(path, access, how, FILE_ATTRIBUTE_NORMAL);
  if (handle == INVALID_HANDLE_VALUE) return done(false);
  const int descriptor = _open_osfhandle(reinterpret_cast<std::intptr_t>(handle), kind | _O_BINARY | _O_NOINHERIT);
  if (descriptor < 0) CloseHandle(handle);
  return descriptor;
}

int close(int descriptor) { return _close(descriptor); }
int dup(int descriptor) { return _dup(descriptor); }
int fchmod(int /*descriptor*/, int /*mode*/) { return 0; }

int fstat(int descriptor, struct stat* status) { return status_of(handle_of(descriptor), status); }

int stat(const char* path, struct stat* status) {
  const HANDLE handle = opened(path, 0, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS);
  if (handle == INVALID_HANDLE_VALUE) return done(false);
  const int result = status_of(handle, status);
  CloseHandle(handle);
  return result;
}

int lstat(const char* path, struct stat* status) {
  const HANDLE handle = opened(path, 0, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS | FILE_FLAG_OPEN_REPARSE_POINT);
  if (handle == INVALID_HANDLE_VALUE) return done(false);
  const int result = status_of(handle, status);
  CloseHandle(handle);
  return result;
}

int ftruncate(int descriptor, off_t size) {
  FILE_END_OF_FILE_INFO end{};
  end.EndOfFile.QuadPart = size;
  return done(SetFileInformationByHandle(handle_of(descriptor), FileEndOfFileInfo, &end, sizeof end) != 0);
}

int unlink(const char* path) { return done(DeleteFileW(wide(path).c_str()) != 0); }

int rename(const char* from, const char* to) {
  return done(MoveFileExW(wide(from).c_str(), wide(to).c_str(), MOVEFILE_REPLACE_EXISTING) != 0);
}

ssize_t read(int descriptor, void* to, std::size_t most) { return read_at(descriptor, to, most, nullptr); }

ssize_t write(int descriptor, const void* from, std::size_t bytes) {
  return write_at(descriptor, from, bytes, nullptr);
}

ssize_t pread(int descriptor, void* to, std::size_t most, off_t offset) {
  OVERLAPPED place = at(static_cast<std::uint64_t>(offset));
  return read_at(descriptor, to, most, &place);
}

ssize_t pwrite(int descriptor, const void* from, std::size_t bytes, off_t offset) {
  OVERLAPPED place = at(static_cast<std::uint64_t>(offset));
  return write_at(descriptor, from, bytes, &place);
}

int poll(pollfd* waited, unsigned long count, int milliseconds) {
  if (count == 0) Sleep(static_cast<DWORD>(milliseconds));
  for (unsigned long i = 0; i < count; ++i) waited[i].revents = waited[i].events;
  return static_cast<int>(count);
}

int set_lock(int descriptor, std::uint64_t offset, bool locked) {
  OVERLAPPED place = at(kBeyond + offset);
  const HANDLE handle = handle_of(descriptor);
  const BOOL well = locked ? LockFileEx(handle, LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &place)
                           : UnlockFileEx(handle, 0, 1, 0, &place);
  return well ? 0 : as_errno(GetLastError());
}

int flock(int descriptor, int /*operation*/) {
  constexpr std::uint64_t kOfAll = (std::uint64_t{1} << 61) - 1;
  const int error = set_lock(descriptor, kOfAll, true);
  if (error != 0) errno = error;
  return error == 0 ? 0 : -1;
}

}  // namespace brushfire::detail::posix

#endif
