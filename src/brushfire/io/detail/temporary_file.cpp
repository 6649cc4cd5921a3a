// Names, locks, and the list of what would have to be removed if the process ended now.
#include <brushfire/io/detail/temporary_file.h>

#include <brushfire/io/detail/posix.h>
#include <brushfire/io/unfinished.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <random>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace brushfire {

namespace detail {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".part-";
constexpr std::string_view kLetters = "0123456789abcdefghijklmnopqrstuv";
constexpr std::size_t kSuffix = 6;

std::string random_suffix() {
  std::random_device device;
  std::string suffix;
  for (std::uint32_t bits = device(), k = 0; k < kSuffix; ++k, bits >>= 5) suffix += kLetters[bits & 31];
  return suffix;
}

// True where nobody else holds the file, and this process does now.
bool lock(int descriptor) {
#ifdef LOCK_EX
  return posix::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
#else
  static_cast<void>(descriptor);
  return false;
#endif
}

// Whether the name still means the file that is open: it may have been removed, and another one have been made.
bool is_at(int descriptor, const std::string& path) {
  struct posix::stat open{}, named{};
  return posix::fstat(descriptor, &open) == 0 && posix::lstat(path.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

bool is_temporary_of(std::string_view name, std::string_view target) {
  if (name.size() != target.size() + kMark.size() + kSuffix || !name.starts_with(target)) return false;
  name.remove_prefix(target.size());
  if (!name.starts_with(kMark)) return false;
  name.remove_prefix(kMark.size());
  return name.find_first_not_of(kLetters) == std::string_view::npos;
}

void remove_if_nobody_holds(const std::string& path) {
  const int descriptor = posix::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct posix::stat status{};
  const bool is_file = posix::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  if (is_file && lock(descriptor) && is_at(descriptor, path)) posix::unlink(path.c_str());
  posix::close(descriptor);
}

void clear_left_over(const std::string& target) {
  const fs::path path(target);
  const std::string name = path.filename().string();
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (is_temporary_of(entry->path().filename().string(), name)) remove_if_nobody_holds(entry->path().string());
  }
}

// What this process is writing. Never destroyed: a thread may be writing when the process ends.
struct Unfinished {
  std::mutex mutex;
  std::set<std::string> paths;
};
Unfinished& unfinished() {
  static auto* const all = new Unfinished;
  return *all;
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& target) {
  clear_left_over(target);
  constexpr int kAttempts = 16;
  for (int attempt = 0; attempt < kAttempts && descriptor_ < 0; ++attempt) {
    const std::string path = target + std::string(kMark) + random_suffix();
    const std::lock_guard guard(unfinished().mutex);
    descriptor_ = posix::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) return;
    // Between the two calls it was nobody's, and may have been cleared away: then there is another name to try.
    if (!lock(descriptor_) && errno == EWOULDBLOCK) {
      posix::close(std::exchange(descriptor_, -1));
      continue;
    }
    if (!is_at(descriptor_, path)) {
      posix::close(std::exchange(descriptor_, -1));
      continue;
    }
    path_ = path;
    unfinished().paths.insert(path_);
  }
}

TemporaryFile::~TemporaryFile() { discard(); }

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : path_(std::exchange(other.path_, {})), descriptor_(std::exchange(other.descriptor_, -1)) {}

TemporaryFile& TemporaryFile::operator=(TemporaryFile&& other) noexcept {
  discard();
  path_ = std::exchange(other.path_, {});
  descriptor_ = std::exchange(other.descriptor_, -1);
  return *this;
}

void TemporaryFile::discard() noexcept {
  if (!path_.empty()) {
    const std::lock_guard guard(unfinished().mutex);
    posix::unlink(path_.c_str());
    unfinished().paths.erase(path_);
    path_.clear();
  }
  if (descriptor_ >= 0) posix::close(std::exchange(descriptor_, -1));
}

bool TemporaryFile::rename_to(const std::string& target) {
  // Some file systems tell of a full disk only when a descriptor is closed. The file itself stays open, and locked.
  const int copy = posix::dup(descriptor_);
  if (copy < 0 || posix::close(copy) != 0) return false;
  {
    const std::lock_guard guard(unfinished().mutex);
    if (posix::rename(path_.c_str(), target.c_str()) != 0) return false;
    unfinished().paths.erase(path_);
  }
  path_.clear();
  posix::close(std::exchange(descriptor_, -1));
  return true;
}

// Where the file cannot be made or the file system has no locks, nobody is kept out.
FileLock::FileLock(const std::string& path)
    : descriptor_(posix::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  is_taken_ = descriptor_ >= 0 && !lock(descriptor_) && errno == EWOULDBLOCK;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) posix::close(descriptor_);
}

std::string followed(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the system
  fs::path at(path);
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(at, error); ++i) {
    const fs::path link = fs::read_symlink(at, error);
    if (error) break;
    at = at.parent_path() / link;  // an absolute one takes the place of all
  }
  return at.string();
}

}  // namespace detail

void remove_unfinished_files() noexcept {
  detail::Unfinished& all = detail::unfinished();
  all.mutex.lock();  // for good: whoever is about to begin or complete a file waits until the process ends
  for (const std::string& path : all.paths) detail::posix::unlink(path.c_str());
}

}  // namespace brushfire
