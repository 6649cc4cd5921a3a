// What zlib, LZ4 and xz unpack, and what to say without them.
#include <brushfire/io/detail/inflate.h>

#include <brushfire/core/cancel.h>

#include <algorithm>
#include <limits>

#ifdef BRUSHFIRE_HAS_ZLIB
#include <zlib.h>
#endif
#ifdef BRUSHFIRE_HAS_LZ4
#include <lz4.h>
#endif
#ifdef BRUSHFIRE_HAS_LZMA
#include <lzma.h>
#endif

namespace brushfire::detail {

std::size_t inflate_budget(std::size_t size) {
  constexpr std::size_t kFree = std::size_t{64} << 20, kRatio = 100;
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
  return size > (kMost - kFree) / kRatio ? kMost : kFree + kRatio * size;
}

bool is_gzip(std::string_view bytes) { return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b'; }

std::string inflate_exactly(std::string_view compressed, char* target, std::size_t expected) {
  Inflater inflater(compressed);
  const std::size_t done = inflater.read(target, expected);
  if (!inflater.error().empty()) return inflater.error();
  if (done < expected) {
    return "inflates to " + std::to_string(done) + " bytes, but " + std::to_string(expected) + " are needed";
  }
  if (!inflater.ended()) {
    if (!inflater.error().empty()) return inflater.error();
    return "inflates to more than the " + std::to_string(expected) + " bytes that are needed";
  }
  return {};
}

#ifdef BRUSHFIRE_HAS_ZLIB

struct Inflater::Stream {
  z_stream z{};
  std::string_view rest;
  bool ok = false, ended = false, overflow = false;

  // What is behind the end and no gzip stream again is ignored, as gzip does.
  void next_member() {
    ended = !is_gzip(rest);
    if (!ended) ok = inflateReset(&z) == Z_OK;
  }
};

Inflater::Inflater(std::string_view compressed) : stream_(std::make_unique<Stream>()) {
  constexpr int kZlibOrGzip = 15 + 32;
  stream_->rest = compressed;
  stream_->ok = inflateInit2(&stream_->z, kZlibOrGzip) == Z_OK;
  if (!stream_->ok) error_ = "zlib cannot start";
}

Inflater::~Inflater() { inflateEnd(&stream_->z); }

std::size_t Inflater::read(char* target, std::size_t size) {
  constexpr std::size_t kChunk = std::size_t{1} << 30;  // zlib counts in 32 bits
  constexpr std::size_t kPiece = std::size_t{1} << 23;  // that comes out in some ten milliseconds
  Stream& s = *stream_;
  std::size_t done = 0;
  while (s.ok && !s.ended && done < size) {
    stop_if_cancelled();
    const std::size_t in = std::min(s.rest.size(), kChunk), out = std::min(size - done, kPiece);
    s.z.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(s.rest.data()));
    s.z.avail_in = static_cast<uInt>(in);
    s.z.next_out = reinterpret_cast<Bytef*>(target + done);
    s.z.avail_out = static_cast<uInt>(out);
    const int status = inflate(&s.z, Z_NO_FLUSH);
    s.rest.remove_prefix(in - s.z.avail_in);
    done += out - s.z.avail_out;
    if (status == Z_STREAM_END) {
      s.next_member();
    } else if (status == Z_BUF_ERROR || (status == Z_OK && s.rest.empty() && s.z.avail_out != 0)) {
      error_ = "compressed data ends early";
      s.ok = false;
    } else if (status != Z_OK) {
      error_ = std::string("compressed data is damaged") + (s.z.msg != nullptr ? std::string(": ") + s.z.msg : "");
      s.ok = false;
    }
  }
  return done;
}

bool Inflater::ended() {
  if (stream_->ok && !stream_->ended) {
    char beyond;
    stream_->overflow = read(&beyond, 1) != 0;
  }
  return stream_->ended && !stream_->overflow;
}

std::string deflate(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
           static_cast<uLong>(bytes.size()));
  out.resize(size);
  return out;
}

#else

struct Inflater::Stream {};
Inflater::Inflater(std::string_view) : error_("is compressed, but this program was built without zlib") {}
Inflater::~Inflater() = default;
std::size_t Inflater::read(char*, std::size_t) { return 0; }
bool Inflater::ended() { return true; }
std::string deflate(std::string_view) { return {}; }

#endif

#ifdef BRUSHFIRE_HAS_LZ4

std::string expand_lz4(std::string_view compressed, char* target, std::size_t expected) {
  constexpr std::size_t kMost = LZ4_MAX_INPUT_SIZE;  // it counts in int
  if (compressed.size() > kMost || expected > kMost) return "is larger than a block of LZ4 may be";
  const int done =
      LZ4_decompress_safe(compressed.data(), target, static_cast<int>(compressed.size()), static_cast<int>(expected));
  if (done < 0 || static_cast<std::size_t>(done) != expected) return "compressed data is damaged";
  return {};
}

#else

std::string expand_lz4(std::string_view, char*, std::size_t) {
  return "is compressed with LZ4, but this program was built without it";
}

#endif

#ifdef BRUSHFIRE_HAS_LZMA

std::string expand_xz(std::string_view compressed, char* target, std::size_t expected) {
  std::uint64_t memory = std::uint64_t{128} << 20;  // the largest preset asks for 65 MiB
  std::size_t in = 0, out = 0;
  const lzma_ret status =
      lzma_stream_buffer_decode(&memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(compressed.data()), &in,
                                compressed.size(), reinterpret_cast<std::uint8_t*>(target), &out, expected);
  if (status == LZMA_MEMLIMIT_ERROR) return "asks for too much memory to be unpacked";
  if (status != LZMA_OK || out != expected) return "compressed data is damaged";
  return {};
}

#else

std::string expand_xz(std::string_view, char*, std::size_t) {
  return "is compressed with LZMA, but this program was built without it";
}

#endif

}  // namespace brushfire::detail
