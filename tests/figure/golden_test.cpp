// Golden images: pictures that were looked at once, compared with a tolerance that a one-pixel shift of a line breaks.
//
// BRUSHFIRE_UPDATE_GOLDENS=1 in the environment writes the pictures anew instead; look at them before committing.
#include <brushfire/figure/render.h>
#include <brushfire/mesh/shapes.h>

#include "figure/png.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

namespace brushfire {
namespace {

// Mean absolute difference per channel. Other compilers move single samples across an edge: some hundredths. A shift of
// all isolines by one pixel makes more than one (ShiftOfTheIsolines... below measures it).
constexpr double kTolerance = 0.25;

double mean_difference(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) return 255;
  double sum = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(a.rgba[i] - b.rgba[i]);
  return sum / static_cast<double>(a.rgba.size());
}

void expect_golden(const std::string& name, const Image& image) {
  const std::string file = std::string(BRUSHFIRE_GOLDEN_DIR) + "/" + name + ".png";
  if (std::getenv("BRUSHFIRE_UPDATE_GOLDENS") != nullptr) {
    const std::vector<std::uint8_t> bytes = encode_png(image);
    std::ofstream out(file, std::ios::binary);
    for (const std::uint8_t b : bytes) out.put(static_cast<char>(b));
    return;
  }
  const Image golden = test::decode_png(test::read_bytes(file));
  EXPECT_LT(mean_difference(golden, image), kTolerance) << name;
}

// A torus coloured by its longitude and latitude, so that lines run every way.
Panel torus(double shift = 0) {
  Panel panel;
  panel.mesh = shapes::torus(64, 32).mesh();
  for (const Vec3& p : panel.mesh.positions()) panel.scalar.push_back(p.x + 0.7 * p.y + 0.5 * p.z + shift);
  for (int i = -12; i <= 12; ++i) panel.isolines.push_back(0.15 * i);
  panel.dots = {{1.4, 0, 0}};
  Polyline ring;
  ring.closed = true;
  for (int i = 0; i < 64; ++i) ring.points.push_back({std::cos(i * kPi / 32), std::sin(i * kPi / 32), 0.4});
  panel.paths = {ring};
  return panel;
}

RenderOptions options() {
  RenderOptions o;
  o.width = 240;
  o.height = 160;
  o.camera.up = Axis::Z;
  o.camera.elevation = 40;
  o.scales[0].low = -1.8;
  o.scales[0].high = 1.8;
  o.colour_bar = false;
  return o;
}

Image render_one(const Panel& panel, const RenderOptions& o) { return render(std::span(&panel, 1), o); }

TEST(Golden, TorusWithIsolinesPathAndSource) { expect_golden("torus", render_one(torus(), options())); }

TEST(Golden, TorusInBandsWithPerspectiveAndWireframe) {
  RenderOptions o = options();
  o.fill = Fill::Bands;
  o.camera.perspective = true;
  o.wireframe = true;
  o.scales[0].colormap = Colormap::Cividis;
  expect_golden("torus-bands", render_one(torus(), o));
}

TEST(Golden, TitleAndColourBar) {
  RenderOptions o = options();
  o.colour_bar = true;
  o.scales[0].unit = "distance, µm";
  Panel panel = torus();
  panel.title = "Torus: ½ of 2π";
  expect_golden("torus-lettered", render_one(panel, o));
}

TEST(Golden, ShiftOfTheIsolinesByOnePixelExceedsTheTolerance) {
  // The torus is 2.8 wide over some 225 pixels, so a shift by 1/80 in x is one pixel; colours barely change by it.
  const double one_pixel = 2.8 / 225;
  EXPECT_GT(mean_difference(render_one(torus(), options()), render_one(torus(one_pixel), options())), 3 * kTolerance);
}

}  // namespace
}  // namespace brushfire
