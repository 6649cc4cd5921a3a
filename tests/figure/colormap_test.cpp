// Colour maps: lightness rises, labels differ.
#include <brushfire/core/error.h>
#include <brushfire/figure/colormap.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace brushfire {
namespace {

double linear(float channel) {
  const double c = static_cast<double>(channel);
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// Relative luminance of an sRGB colour.
double luminance(Color c) { return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b); }

TEST(Colormap, LuminanceRisesFromEndToEndSoThatBlackAndWhitePrintsStillShowIt) {
  for (const Colormap map : {Colormap::Viridis, Colormap::Magma, Colormap::Cividis}) {
    double last = luminance(color_of(map, 0));
    for (int i = 1; i <= 64; ++i) {
      const double now = luminance(color_of(map, i / 64.0));
      EXPECT_GT(now, last) << "at " << i << "/64 of map " << static_cast<int>(map);
      last = now;
    }
  }
}

TEST(Colormap, SharesOutsideTheMapTakeItsEnds) {
  EXPECT_EQ(color_of(Colormap::Magma, -3), color_of(Colormap::Magma, 0));
  EXPECT_EQ(color_of(Colormap::Magma, 7), color_of(Colormap::Magma, 1));
}

TEST(Colormap, FirstHundredLabelsHaveColoursThatDiffer) {
  for (Index a = 0; a < 100; ++a) {
    for (Index b = 0; b < a; ++b) EXPECT_FALSE(label_color(a) == label_color(b)) << a << " and " << b;
  }
}

TEST(Colormap, UnknownNameIsAnErrorThatListsTheMaps) {
  try {
    colormap_named("jet");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::InvalidArgument);
    EXPECT_NE(std::string(e.what()).find("viridis, magma, cividis"), std::string::npos);
  }
}

}  // namespace
}  // namespace brushfire
