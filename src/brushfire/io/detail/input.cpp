// Reading whole files, inflating them, and wording errors.
#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/memory.h>
#include <brushfire/core/error.h>
#include <brushfire/io/byte_stream.h>
#include <brushfire/io/detail/inflate.h>
#include <brushfire/io/detail/input.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <new>
#include <system_error>
#include <vector>

namespace brushfire::detail {

namespace fs = std::filesystem;

namespace {

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

// What comes from a pipe may have no end: more than this share of the memory that was there is not taken for it.
constexpr std::uint64_t kStreamShare = 4;

// Reads to the end; a file may grow, and a pipe has no size.
Buffer read_all(ByteStream& stream) {
  const std::uint64_t most = available_memory() / kStreamShare;
  std::size_t capacity = static_cast<std::size_t>(stream.file_size()) + 1;  // the end is seen without growing
  Buffer buffer{allocate(capacity, stream.name()), 0};
  while (const std::size_t got = stream.read(buffer.data.get() + buffer.size, capacity - buffer.size)) {
    buffer.size += got;
    if (buffer.size < capacity) continue;
    if (!stream.is_file() && buffer.size > most) {
      throw Error(ErrorCode::TooLarge, printable(stream.name()) + ": " + bytes_as_text(buffer.size) +
                                           " have come and no end: more than " + bytes_as_text(most) +
                                           ", a quarter of the memory that is available, is not read from a pipe");
    }
    const std::size_t larger = capacity < (std::size_t{1} << 16) ? std::size_t{1} << 16 : capacity + capacity / 2;
    std::shared_ptr<char[]> grown = allocate(larger, stream.name());
    std::memcpy(grown.get(), buffer.data.get(), buffer.size);
    buffer.data = std::move(grown);
    capacity = larger;
  }
  return buffer;
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
  ByteStream stream(path);
  input.name_ = stream.name();
  if (path != "-") {
    input.folder_ = fs::path(path).parent_path().string();
    input.has_folder_ = true;
  }
  Buffer buffer = read_all(stream);
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
  const bool outside = path.is_absolute() || path.has_root_name() || relative.find('\0') != std::string::npos ||
                       std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
  if (!has_folder_) fail_line(line, "refers to the file " + quote(relative) + ", which is out of reach from here");
  if (outside || relative.empty() || relative == "-") {
    fail_line(line, "refers to the file " + quote(relative) + ", which is not in its own folder or below");
  }
  // Links are followed before the file is opened, and only within the folder.
  std::error_code error;
  const fs::path folder = fs::canonical(folder_.empty() ? "." : folder_, error);
  const fs::path file = fs::canonical(fs::path(folder_) / path, error);
  if (error) return from_file((fs::path(folder_) / path).string());  // which says what is wrong
  if (std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first != folder.end()) {
    fail_line(line, "refers to the file " + quote(relative) + ", a symbolic link that leads out of its folder");
  }
  Input input = from_file(file.string());
  input.name_ = (fs::path(folder_) / path).string();
  return input;
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
    stop_if_cancelled();
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
