// Reading whole files, inflating them, and wording errors.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/inflate.h>
#include <brushfire/io/detail/input.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <new>
#include <system_error>
#include <vector>

namespace brushfire::detail {

namespace fs = std::filesystem;

namespace {

struct FileCloser {
  void operator()(std::FILE* f) const {
    if (f != nullptr && f != stdin) std::fclose(f);
  }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

[[noreturn]] void not_readable(const std::string& name, const std::string& cause) {
  throw Error(ErrorCode::FileNotReadable, printable(name) + ": " + cause);
}

struct Buffer {
  std::shared_ptr<char[]> data;
  std::size_t size = 0;
};

std::shared_ptr<char[]> allocate(std::size_t size, const std::string& name) {
  try {
    return std::shared_ptr<char[]>(new char[size]);  // not initialised: it is read into at once
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::TooLarge, printable(name) + ": " + std::to_string(size) + " bytes do not fit into memory");
  }
}

// Reads to the end; `expected` is a hint only, because a file may grow and a pipe has no size.
Buffer read_all(std::FILE* file, std::size_t expected, const std::string& name) {
  std::size_t capacity = expected + 1;  // one more, so that the end is seen without growing
  Buffer buffer{allocate(capacity, name), 0};
  while (true) {
    const std::size_t got = std::fread(buffer.data.get() + buffer.size, 1, capacity - buffer.size, file);
    buffer.size += got;
    if (got == 0) break;
    if (buffer.size == capacity) {
      const std::size_t larger = capacity < (std::size_t{1} << 16) ? std::size_t{1} << 16 : capacity + capacity / 2;
      std::shared_ptr<char[]> grown = allocate(larger, name);
      std::memcpy(grown.get(), buffer.data.get(), buffer.size);
      buffer.data = std::move(grown);
      capacity = larger;
    }
  }
  if (std::ferror(file) != 0) not_readable(name, std::string("cannot be read: ") + std::strerror(errno));
  return buffer;
}

// Paths of the process's own descriptors: the shell's <(command) is one, and someone writes to it.
bool is_descriptor_path(const std::string& path) {
  return path.rfind("/dev/fd/", 0) == 0 || path.rfind("/proc/self/fd/", 0) == 0 || path == "/dev/stdin";
}

void refuse_what_is_no_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  switch (status.type()) {
    case fs::file_type::not_found:
      not_readable(path, "no such file");
    case fs::file_type::directory:
      not_readable(path, "is a directory");
    case fs::file_type::fifo:
      if (!is_descriptor_path(path)) not_readable(path, "is a named pipe; feed it to standard input and name it -");
      break;
    case fs::file_type::character:
    case fs::file_type::block:
      not_readable(path, "is a device");
    case fs::file_type::socket:
      not_readable(path, "is a socket");
    case fs::file_type::none:
      not_readable(path, error.message());
    default:
      break;
  }
}

std::string escape(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (u >= 0x20 && u != 0x7f) {
      out += c;
      continue;
    }
    static constexpr char kHex[] = "0123456789abcdef";
    out += "\\x";
    out += kHex[u >> 4];
    out += kHex[u & 15];
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) { return escape(text); }

std::string quote(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string out = "'";
  for (const char c : text.substr(0, kLongest)) {
    // Foreign bytes are escaped too: the cut could fall into the middle of a character.
    if (static_cast<unsigned char>(c) < 0x80) {
      out += escape(std::string_view(&c, 1));
    } else {
      static constexpr char kHex[] = "0123456789abcdef";
      out += "\\x";
      out += kHex[static_cast<unsigned char>(c) >> 4];
      out += kHex[static_cast<unsigned char>(c) & 15];
    }
  }
  return out + (text.size() > kLongest ? "...'" : "'");
}

Input Input::from_file(const std::string& path) {
  Input input;
  Buffer buffer;
  if (path == "-") {
    input.name_ = "standard input";
    buffer = read_all(stdin, 0, input.name_);
  } else {
    input.name_ = path;
    refuse_what_is_no_file(path);
    File file(std::fopen(path.c_str(), "rb"));
    if (!file) not_readable(path, std::strerror(errno));
    std::setvbuf(file.get(), nullptr, _IONBF, 0);  // whole-file reads need no buffer between
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    buffer = read_all(file.get(), error ? 0 : static_cast<std::size_t>(size), path);
    input.folder_ = fs::path(path).parent_path().string();
    input.has_folder_ = true;
  }
  input.bytes_ = {buffer.data.get(), buffer.size};
  input.storage_ = std::move(buffer.data);
  input.inflate_gzip();
  return input;
}

Input Input::from_memory(std::string_view bytes, const std::string& name) {
  Input input;
  input.name_ = name;
  input.bytes_ = bytes;
  input.inflate_gzip();
  return input;
}

void Input::drop_byte_order_mark() {
  const std::string_view start = bytes_.substr(0, 2);
  if (start == "\xff\xfe" || start == "\xfe\xff") fail("is text in UTF-16, which is not read: save it as UTF-8");
  if (bytes_.substr(0, 3) == "\xef\xbb\xbf") bytes_.remove_prefix(3);
}

std::string Input::extension() const {
  const auto lower = [](std::string s) {
    std::transform(s.begin(), s.end(), s.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return s;
  };
  fs::path path(name_);
  if (lower(path.extension().string()) == ".gz") path = path.stem();
  const std::string dotted = lower(path.extension().string());
  return dotted.empty() ? dotted : dotted.substr(1);
}

Input Input::companion(const std::string& relative, std::size_t line) const {
  const fs::path path(relative);
  const bool outside = path.is_absolute() || path.has_root_name() ||
                       std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
  if (!has_folder_) fail_line(line, "refers to the file " + quote(relative) + ", which is out of reach from here");
  if (outside || relative.empty() || relative == "-") {
    fail_line(line, "refers to the file " + quote(relative) + ", which is not in its own folder or below");
  }
  return from_file((fs::path(folder_) / path).string());
}

void Input::fail_line(std::size_t line, const std::string& cause) const {
  throw Error(ErrorCode::FileMalformed, printable(name_) + ":" + std::to_string(line) + ": " + cause);
}

void Input::fail_byte(std::size_t byte, const std::string& cause) const {
  throw Error(ErrorCode::FileMalformed, printable(name_) + ": byte " + std::to_string(byte) + ": " + cause);
}

void Input::fail(const std::string& cause) const {
  throw Error(ErrorCode::FileMalformed, printable(name_) + ": " + cause);
}

void Input::inflate_gzip() {
  inflate_budget_ = detail::inflate_budget(bytes_.size());
  if (!is_gzip(bytes_)) return;
  const std::size_t limit = inflate_budget_;
  Inflater inflater(bytes_);
  std::vector<std::pair<std::shared_ptr<char[]>, std::size_t>> blocks;
  std::size_t total = 0;
  // Blocks that grow with what has come out, gathered at the end: memory follows the content, not a promise.
  while (true) {
    const std::size_t size = std::min(std::max(total, std::size_t{1} << 16), limit - total + 1);
    std::shared_ptr<char[]> block = allocate(size, name_);
    const std::size_t got = inflater.read(block.get(), size);
    total += got;
    blocks.emplace_back(std::move(block), got);
    if (!inflater.error().empty()) fail("gzip: " + inflater.error());
    if (total > limit) {
      fail("gzip: inflates to more than " + std::to_string(limit) + " bytes, over 100 times its size: refused");
    }
    if (got < size) break;
  }
  std::shared_ptr<char[]> all = allocate(total, name_);
  std::size_t at = 0;
  for (const auto& [block, size] : blocks) {
    std::memcpy(all.get() + at, block.get(), size);
    at += size;
  }
  bytes_ = {all.get(), total};
  storage_ = std::move(all);
}

}  // namespace brushfire::detail
