// Cells of VTK files, legacy and XML, as faces.
#pragma once

#include <brushfire/io/detail/mesh_parts.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace brushfire::detail {

class VtkCells {
 public:
  static constexpr std::uint8_t kVertices = 2, kPolyline = 4;

  void add_polygon(const Input& input, std::span<const double> corners, std::size_t place, MeshParts& parts) {
    take(input, corners, place, parts);
    parts.faces.add(corners_, place);
  }

  // Every other triangle of a strip is turned round; triangles that repeat a vertex only steer it.
  void add_strip(const Input& input, std::span<const double> corners, std::size_t place, MeshParts& parts) {
    take(input, corners, place, parts);
    for (std::size_t k = 2; k < corners_.size(); ++k) {
      const Index a = corners_[k - 2], b = corners_[k - 1], c = corners_[k];
      if (a == b || b == c || c == a) continue;
      parts.faces.add_triangle(k % 2 != 0 ? b : a, k % 2 != 0 ? a : b, c, place);
    }
  }

  // Cells of this type of VTK's that are no faces.
  void leave_out(std::uint8_t type, std::size_t cells = 1) { left_out_[type] += cells; }

  // Cells of an unstructured grid by their type; what is no face is left out.
  void add_grid(const Input& input, std::span<const double> offset, std::span<const double> connectivity,
                std::span<const double> types, std::size_t place, MeshParts& parts) {
    if (!offset.empty() && types.size() + 1 != offset.size()) {
      fail(input, place, parts,
           std::to_string(offset.size() - 1) + " cells, but " + std::to_string(types.size()) + " types");
    }
    for (std::size_t c = 0; c < types.size() && !offset.empty(); ++c) {
      const auto begin = static_cast<std::size_t>(offset[c]), end = static_cast<std::size_t>(offset[c + 1]);
      add_cell(input, types[c], connectivity.subspan(begin, end - begin), place, parts);
    }
  }

  void remark(MeshParts& parts) const {
    std::size_t total = 0;
    std::string names;
    for (const auto& [type, cells] : left_out_) {
      if (cells == 0) continue;
      total += cells;
      names += (names.empty() ? "" : ", ") + name_of(type) + ": " + std::to_string(cells);
    }
    if (total != 0) {
      parts.remarks.push_back(counted(total, "cell that is no face", "cells that are no faces") + " left out (" +
                              names + ")");
    }
    if (curved_ != 0) {
      parts.remarks.push_back(counted(curved_, "curved face", "curved faces") + " read as flat, by the corners");
    }
  }

 private:
  static constexpr int kStrip = 6, kPolygon = 7, kPixel = 8;

  static std::string name_of(std::uint8_t type) {
    static constexpr std::pair<std::uint8_t, const char*> kNames[]{{1, "vertex"},
                                                                   {2, "vertices"},
                                                                   {3, "line"},
                                                                   {4, "polyline"},
                                                                   {10, "tetrahedron"},
                                                                   {11, "voxel"},
                                                                   {12, "hexahedron"},
                                                                   {13, "wedge"},
                                                                   {14, "pyramid"},
                                                                   {21, "curved line"},
                                                                   {24, "curved tetrahedron"},
                                                                   {25, "curved hexahedron"},
                                                                   {42, "polyhedron"}};
    for (const auto& [number, name] : kNames) {
      if (number == type) return name;
    }
    return "type " + std::to_string(type);
  }

  struct Shape {
    std::size_t corners = 0;  // 0: no face of a fixed number of corners
    bool is_curved = false;
  };
  // The corners of a curved face stand before its other points.
  static Shape shape_of(int type) {
    constexpr int kFlat[]{5, 9}, kCurvedTriangles[]{22, 34, 69, 76}, kCurvedQuads[]{23, 28, 30, 70, 77};
    const auto is_in = [&](const auto& types) {
      return std::find(std::begin(types), std::end(types), type) != std::end(types);
    };
    if (is_in(kFlat)) return {type == 5 ? std::size_t{3} : std::size_t{4}, false};
    if (is_in(kCurvedTriangles)) return {3, true};
    return is_in(kCurvedQuads) ? Shape{4, true} : Shape{};
  }

  void add_cell(const Input& input, double type, std::span<const double> corners, std::size_t place, MeshParts& parts) {
    const int t = type >= 0 && type < 256 ? static_cast<int>(type) : 0;
    const Shape shape = shape_of(t);
    if (corners.size() < (t == kPixel ? 4 : shape.corners)) {
      fail(input, place, parts,
           "a cell of type " + std::to_string(t) + " has " + std::to_string(corners.size()) + " corners");
    }
    if (t == kStrip) {
      add_strip(input, corners, place, parts);
    } else if (t == kPixel) {
      const double turned[]{corners[0], corners[1], corners[3], corners[2]};
      add_polygon(input, turned, place, parts);
    } else if (t == kPolygon || shape.corners != 0) {
      curved_ += shape.is_curved;
      add_polygon(input, t == kPolygon ? corners : corners.first(shape.corners), place, parts);
    } else {
      leave_out(static_cast<std::uint8_t>(t));
    }
  }

  void take(const Input& input, std::span<const double> corners, std::size_t place, const MeshParts& parts) {
    corners_.clear();
    for (const double v : corners) {
      if (!(v >= 0) || v != std::floor(v) || v >= static_cast<double>(kNoIndex)) {
        fail(input, place, parts, "a cell names point " + std::to_string(v));
      }
      corners_.push_back(static_cast<Index>(v));
    }
  }

  [[noreturn]] static void fail(const Input& input, std::size_t place, const MeshParts& parts,
                                const std::string& cause) {
    if (parts.places_are_lines) input.fail_line(place, cause);
    input.fail_byte(place, cause);
  }

  std::vector<Index> corners_;
  std::map<std::uint8_t, std::size_t> left_out_;  // cells by type
  std::size_t curved_ = 0;
};

}  // namespace brushfire::detail
