// Colour tables: viridis, magma, cividis at 33 equidistant places, linear in between (within 2/255 of the originals,
// 6/255 for cividis).
//
// Based on: Smith, van der Walt, "A better default colormap", 2015 (viridis, magma; CC0); Nunez, Anderton, Renslow,
// "Optimizing colormaps with consideration for color vision deficiency", 2018 (cividis).
#include <brushfire/figure/colormap.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace brushfire {
namespace {

constexpr std::size_t kNodes = 33;
using Table = std::array<std::array<int, 3>, kNodes>;

constexpr Table kViridis{
    {{68, 1, 84},    {71, 13, 96},   {72, 24, 106},  {72, 35, 116},  {71, 45, 123},  {69, 55, 129},  {66, 64, 134},
     {62, 73, 137},  {59, 82, 139},  {55, 91, 141},  {51, 99, 141},  {47, 107, 142}, {44, 114, 142}, {41, 122, 142},
     {38, 130, 142}, {35, 137, 142}, {33, 145, 140}, {31, 151, 139}, {31, 159, 136}, {33, 166, 133}, {39, 173, 129},
     {49, 181, 123}, {61, 188, 116}, {76, 194, 108}, {92, 200, 99},  {110, 206, 88}, {129, 211, 77}, {149, 216, 64},
     {170, 220, 50}, {192, 223, 37}, {213, 226, 26}, {234, 229, 26}, {253, 231, 37}}};
constexpr Table kMagma{{{0, 0, 4},       {3, 3, 18},      {10, 8, 34},     {19, 13, 52},    {29, 17, 71},
                        {41, 17, 90},    {54, 16, 107},   {68, 15, 118},   {81, 18, 124},   {93, 23, 127},
                        {106, 28, 129},  {118, 33, 129},  {131, 38, 129},  {144, 42, 129},  {156, 46, 127},
                        {170, 51, 125},  {183, 55, 121},  {194, 59, 117},  {207, 64, 112},  {219, 71, 106},
                        {229, 80, 100},  {238, 91, 94},   {244, 105, 92},  {249, 120, 93},  {251, 135, 97},
                        {253, 150, 104}, {254, 165, 113}, {254, 180, 123}, {254, 194, 135}, {254, 209, 148},
                        {253, 224, 161}, {252, 238, 176}, {252, 253, 191}}};
constexpr Table kCividis{{{0, 34, 78},     {0, 40, 91},     {0, 46, 106},    {5, 51, 113},    {26, 56, 111},
                          {39, 62, 110},   {50, 67, 109},   {59, 73, 108},   {67, 78, 108},   {75, 84, 108},
                          {83, 90, 109},   {90, 95, 110},   {97, 101, 111},  {104, 106, 113}, {111, 112, 115},
                          {118, 118, 118}, {125, 124, 120}, {131, 129, 121}, {139, 135, 120}, {146, 141, 120},
                          {154, 147, 118}, {162, 153, 117}, {170, 160, 115}, {179, 166, 112}, {187, 173, 109},
                          {195, 179, 105}, {204, 186, 100}, {212, 193, 95},  {221, 200, 88},  {230, 208, 81},
                          {239, 215, 72},  {248, 223, 60},  {254, 232, 56}}};

const Table& table_of(Colormap map) {
  switch (map) {
    case Colormap::Magma:
      return kMagma;
    case Colormap::Cividis:
      return kCividis;
    case Colormap::Viridis:
      break;
  }
  return kViridis;
}

// One full-saturation hue wheel, softened towards grey: hue in turns.
Color hue(double turns) {
  const auto channel = [turns](double shift) {
    const double x = turns + shift - std::floor(turns + shift);
    return static_cast<float>(std::clamp(std::abs(6 * x - 3) - 1, 0.0, 1.0));
  };
  return mix({channel(0), channel(2.0 / 3), channel(1.0 / 3)}, {0.55F, 0.55F, 0.55F}, 0.35F);
}

}  // namespace

Colormap colormap_named(std::string_view name) {
  if (name == "viridis") return Colormap::Viridis;
  if (name == "magma") return Colormap::Magma;
  if (name == "cividis") return Colormap::Cividis;
  throw Error(ErrorCode::InvalidArgument,
              "unknown colormap '" + std::string(name) + "': it is one of viridis, magma, cividis");
}

Color color_of(Colormap map, double share) {
  const Table& table = table_of(map);
  const double x = std::clamp(share, 0.0, 1.0) * (kNodes - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(x), kNodes - 2);
  const float t = static_cast<float>(x - static_cast<double>(i));
  const auto node = [&table](std::size_t k) {
    return Color{static_cast<float>(table[k][0]) / 255.0F, static_cast<float>(table[k][1]) / 255.0F,
                 static_cast<float>(table[k][2]) / 255.0F};
  };
  return mix(node(i), node(i + 1), t);
}

Color label_color(Index index) {
  constexpr std::array<Color, 8> kDistinct{{{0.90F, 0.62F, 0.00F},
                                            {0.34F, 0.71F, 0.91F},
                                            {0.00F, 0.62F, 0.45F},
                                            {0.94F, 0.89F, 0.26F},
                                            {0.00F, 0.45F, 0.70F},
                                            {0.84F, 0.37F, 0.00F},
                                            {0.80F, 0.47F, 0.65F},
                                            {0.60F, 0.60F, 0.60F}}};
  if (index < kDistinct.size()) return kDistinct[index];
  constexpr double kGoldenTurn = 0.61803398874989485;  // consecutive labels get hues far apart
  return hue(static_cast<double>(index) * kGoldenTurn);
}

}  // namespace brushfire
