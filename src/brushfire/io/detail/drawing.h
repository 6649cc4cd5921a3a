// Curves with their positions, as every writer of curves gets them; and the writers that draw them in real size.
#pragma once

#include <brushfire/io/detail/output.h>
#include <brushfire/io/write_lines.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace brushfire::detail {

struct Drawing {
  const Mesh& mesh;
  std::span<const SurfacePath> lines;
  const std::string& value_name;
  const LinesOptions& options;
  std::vector<std::vector<Vec3>> positions;  // [lines][points]

  std::size_t point_count() const {
    std::size_t n = 0;
    for (const SurfacePath& l : lines) n += l.points.size();
    return n;
  }
  double value(std::size_t line) const { return options.values.empty() ? lines[line].length : options.values[line]; }
};

void write_svg(Output& out, const Drawing& d);
void write_dxf(Output& out, const Drawing& d);

// How an SVG can be looked at: Error(InvalidArgument) that lists the names of the views for another one.
void check_view(const std::string& name);

}  // namespace brushfire::detail
