// Blending, PNG by stb_image_write (compressed by zlib where there is one), WebP by libwebp.
#include <brushfire/figure/image.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

#ifdef BRUSHFIRE_HAS_ZLIB
#include <zlib.h>

namespace {
// stb's own compressor is slower and leaves files a fifth larger. Piece by piece, and nothing where the thread is
// told to stop: the frames between are those of C, which no exception may pass.
unsigned char* compress_for_stb(unsigned char* data, int size, int* out_size, int quality) {
  z_stream z{};
  constexpr int kBestUsefulLevel = 6;
  if (deflateInit(&z, std::min(quality, kBestUsefulLevel)) != Z_OK) return nullptr;
  const uLong bound = deflateBound(&z, static_cast<uLong>(size));
  auto* out = static_cast<unsigned char*>(std::malloc(bound));  // NOLINT(cppcoreguidelines-no-malloc): stb frees it
  const brushfire::CancelToken* const cancel = brushfire::current_cancel_token();
  constexpr int kPiece = 1 << 20;  // some ten milliseconds
  z.next_in = data;
  z.next_out = out;
  z.avail_out = static_cast<uInt>(bound);
  int status = out != nullptr ? Z_OK : Z_MEM_ERROR;
  for (int left = size; status == Z_OK;) {
    if (cancel != nullptr && cancel->cancelled()) break;
    const int piece = std::min(left, kPiece);
    left -= piece;
    z.avail_in = static_cast<uInt>(piece);
    status = deflate(&z, left == 0 ? Z_FINISH : Z_NO_FLUSH);
  }
  *out_size = static_cast<int>(z.total_out);
  deflateEnd(&z);
  if (status == Z_STREAM_END) return out;
  std::free(out);  // NOLINT(cppcoreguidelines-no-malloc)
  return nullptr;
}
}  // namespace
#define STBIW_ZLIB_COMPRESS compress_for_stb
#endif
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

#ifdef BRUSHFIRE_HAS_WEBP
#include <webp/encode.h>
#include <webp/mux.h>

namespace {
// libwebp asks several times a frame.
int goes_on(int, const WebPPicture*) {
  const brushfire::CancelToken* const cancel = brushfire::current_cancel_token();
  return cancel == nullptr || !cancel->cancelled() ? 1 : 0;
}
}  // namespace
#endif

namespace brushfire {

void blend_over(std::uint8_t* pixel, Color color, float alpha) {
  const float below = static_cast<float>(pixel[3]) / 255.0F * (1 - alpha);
  const float total = alpha + below;
  if (!(total > 0)) return;
  const std::array<float, 3> over{color.r, color.g, color.b};
  for (std::size_t k = 0; k < 3; ++k) {
    const float value = (alpha * over[k] + below * static_cast<float>(pixel[k]) / 255.0F) / total;
    pixel[k] = static_cast<std::uint8_t>(std::clamp(255.0F * value + 0.5F, 0.0F, 255.0F));
  }
  pixel[3] = static_cast<std::uint8_t>(255.0F * total + 0.5F);
}

std::vector<std::uint8_t> encode_png(const Image& image) {
  std::vector<std::uint8_t> bytes;
  const auto append = [](void* to, void* data, int size) {
    auto* out = static_cast<std::vector<std::uint8_t>*>(to);
    const auto* from = static_cast<const std::uint8_t*>(data);
    out->insert(out->end(), from, from + size);
  };
  constexpr int kChannels = 4;
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, kChannels, image.rgba.data(),
                             kChannels * image.width) == 0) {
    stop_if_cancelled();
    throw Error(ErrorCode::InvalidArgument, "an image of " + std::to_string(image.width) + " x " +
                                                std::to_string(image.height) + " pixels cannot be written as PNG");
  }
  return bytes;
}

std::vector<std::uint8_t> encode_webp(std::span<const Image> frames, int milliseconds) {
  if (frames.empty()) throw Error(ErrorCode::InvalidArgument, "an animation needs at least one frame");
  for (const Image& f : frames) {
    if (f.width != frames[0].width || f.height != frames[0].height) {
      throw Error(ErrorCode::InvalidArgument, "the frames of an animation must have one size");
    }
  }
#ifdef BRUSHFIRE_HAS_WEBP
  WebPAnimEncoderOptions animation;
  WebPConfig config;
  if (WebPAnimEncoderOptionsInit(&animation) == 0 || WebPConfigInit(&config) == 0) {
    throw Error(ErrorCode::InvalidArgument, "the WebP library is of another version than its headers");
  }
  // Without loss: a frame says only what has changed, and what a lossy one leaves of those before shows as ghosts.
  config.lossless = 1;
  config.near_lossless = 60;  // of 100: colours are rounded where nobody sees it
  config.quality = 75;        // how long smaller files are looked for
  config.method = 4;
  const std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)> encoder(
      WebPAnimEncoderNew(frames[0].width, frames[0].height, &animation), &WebPAnimEncoderDelete);
  int time = 0;
  bool good = encoder != nullptr;
  for (const Image& f : frames) {
    stop_if_cancelled();
    WebPPicture picture;
    good = good && WebPPictureInit(&picture) != 0;
    if (!good) break;
    picture.width = f.width;
    picture.height = f.height;
    picture.use_argb = 1;
    picture.progress_hook = goes_on;
    good = WebPPictureImportRGBA(&picture, f.rgba.data(), 4 * f.width) != 0 &&
           WebPAnimEncoderAdd(encoder.get(), &picture, time, &config) != 0;
    WebPPictureFree(&picture);
    time += milliseconds;
  }
  WebPData data;
  WebPDataInit(&data);
  good = good && WebPAnimEncoderAdd(encoder.get(), nullptr, time, nullptr) != 0 &&
         WebPAnimEncoderAssemble(encoder.get(), &data) != 0;
  std::vector<std::uint8_t> bytes(data.bytes, data.bytes + data.size);
  WebPDataClear(&data);
  if (!good) stop_if_cancelled();
  if (!good) throw Error(ErrorCode::InvalidArgument, "the frames could not be encoded as WebP");
  return bytes;
#else
  (void)milliseconds;
  throw Error(ErrorCode::InvalidArgument, "this build has no WebP: write numbered PNG files instead");
#endif
}

}  // namespace brushfire
