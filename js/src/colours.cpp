// The colour maps of pictures.
#include "reply.h"

#include <brushfire/figure/colormap.h>

#include <string_view>

namespace brushfire::js {

// [red, green, blue, alpha] of 256 equal steps from the low end to the high one.
BRUSHFIRE_EXPORT(colormap_table)
Reply* colormap_table(const char* name, std::size_t size) {
  return answer([&](Reply& reply) {
    const Colormap map = colormap_named(std::string_view(name, size));
    std::vector<std::uint8_t> table;
    constexpr int kSteps = 256;
    for (int k = 0; k < kSteps; ++k) {
      const Color c = color_of(map, k / (kSteps - 1.0));
      for (const float channel : {c.r, c.g, c.b, 1.0F})
        table.push_back(static_cast<std::uint8_t>(255 * channel + 0.5F));
    }
    reply.add(std::move(table));
  });
}

}  // namespace brushfire::js
