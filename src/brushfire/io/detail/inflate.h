// zlib: compressed content out and in, where the library was built with it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace brushfire::detail {

// How much compressed content of a file of `size` bytes may inflate to, in total.
std::size_t inflate_budget(std::size_t size);

bool is_gzip(std::string_view bytes);

// A zlib or gzip stream that is inflated piece by piece. gzip files may be several streams in a row.
class Inflater {
 public:
  explicit Inflater(std::string_view compressed);
  ~Inflater();

  // Fills `target` as far as the stream reaches and returns how far; sets error() where the data is damaged.
  std::size_t read(char* target, std::size_t size);

  // True where nothing is left in the stream; otherwise something came out beyond what has been read.
  bool ended();
  const std::string& error() const { return error_; }

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
  std::string error_;
};

// Deflate cannot do better than 1032 to 1: a promise beyond that is refused before memory is taken for it.
constexpr bool can_inflate_to(std::size_t size, std::string_view compressed) {
  return size / 1032 <= compressed.size();
}

// Inflates a zlib or gzip stream into exactly `expected` bytes at `target`. Returns an empty string or what is wrong.
std::string inflate_exactly(std::string_view compressed, char* target, std::size_t expected);

// One block of LZ4, or one .xz stream, into exactly `expected` bytes at `target`. Return an empty string or what is
// wrong, which may be that the library was built without them.
std::string expand_lz4(std::string_view compressed, char* target, std::size_t expected);
std::string expand_xz(std::string_view compressed, char* target, std::size_t expected);

// A zlib stream of the bytes; empty where the library was built without zlib.
std::string deflate(std::string_view bytes);

}  // namespace brushfire::detail
