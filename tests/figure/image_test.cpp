// Images: blending, PNG and WebP round trips.
#include <brushfire/core/error.h>
#include <brushfire/figure/image.h>

#include "figure/png.h"

#include <gtest/gtest.h>

#include <cstring>

namespace brushfire {
namespace {

Image checkered(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::uint8_t* p = image.pixel(x, y);
      p[0] = static_cast<std::uint8_t>(7 * x);
      p[1] = static_cast<std::uint8_t>(11 * y);
      p[2] = static_cast<std::uint8_t>((x ^ y) & 1 ? 255 : 0);
      p[3] = static_cast<std::uint8_t>(255 - x);
    }
  }
  return image;
}

TEST(Image, PngKeepsEveryByte) {
  const Image image = checkered(37, 23);
  const Image back = test::decode_png(encode_png(image));
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 23);
  EXPECT_EQ(back.rgba, image.rgba);
}

TEST(Image, OpaqueColourOverAnythingIsTheColour) {
  std::uint8_t pixel[4] = {10, 200, 30, 90};
  blend_over(pixel, {1, 0.5F, 0}, 1);
  EXPECT_EQ(pixel[0], 255);
  EXPECT_EQ(pixel[1], 128);
  EXPECT_EQ(pixel[2], 0);
  EXPECT_EQ(pixel[3], 255);
}

TEST(Image, HalfACoverOnNothingKeepsItsColourAndHalfTheOpacity) {
  std::uint8_t pixel[4] = {0, 0, 0, 0};
  blend_over(pixel, {1, 0, 0.2F}, 0.5F);
  EXPECT_EQ(pixel[0], 255);
  EXPECT_EQ(pixel[2], 51);
  EXPECT_EQ(pixel[3], 128);
}

TEST(Image, AnimationNeedsFramesOfOneSize) {
  EXPECT_THROW(encode_webp({}, 40), Error);
  const std::vector<Image> frames{Image(8, 8), Image(8, 9)};
  EXPECT_THROW(encode_webp(frames, 40), Error);
}

#ifdef BRUSHFIRE_HAS_WEBP
TEST(Image, AnimationIsAWebPFileWithItsFrames) {
  std::vector<Image> frames{checkered(16, 16), Image(16, 16), checkered(16, 16)};
  const std::vector<std::uint8_t> bytes = encode_webp(frames, 40);
  ASSERT_GT(bytes.size(), 30u);
  EXPECT_EQ(std::memcmp(bytes.data(), "RIFF", 4), 0);
  EXPECT_EQ(std::memcmp(bytes.data() + 8, "WEBP", 4), 0);
  int frame_chunks = 0;
  for (std::size_t i = 0; i + 4 <= bytes.size(); ++i) frame_chunks += std::memcmp(bytes.data() + i, "ANMF", 4) == 0;
  EXPECT_EQ(frame_chunks, 3);
}
#endif

}  // namespace
}  // namespace brushfire
