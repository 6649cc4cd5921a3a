// Cells of VTK files, legacy and XML, as faces.
#pragma once

#include <brushfire/io/detail/mesh_parts.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <string>

namespace brushfire::detail {

class VtkCells {
 public:
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

  void leave_out(std::uint64_t cells = 1) { left_out_ += cells; }

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
    if (left_out_ != 0)
      parts.remarks.push_back(counted(left_out_, "cell that is no face", "cells that are no faces") + " left out");
    if (curved_ != 0) {
      parts.remarks.push_back(counted(curved_, "curved face", "curved faces") + " read as flat, by the corners");
    }
  }

 private:
  void add_cell(const Input& input, double type, std::span<const double> corners, std::size_t place, MeshParts& parts) {
    constexpr int kStrip = 6, kPolygon = 7, kPixel = 8, kTriangle = 5, kQuad = 9, kQuadraticTriangle = 22,
                  kQuadraticQuad = 23;
    const int t = type >= 0 && type < 256 ? static_cast<int>(type) : 0;
    const std::size_t n = t == kTriangle || t == kQuadraticTriangle          ? 3
                          : t == kQuad || t == kPixel || t == kQuadraticQuad ? 4
                                                                             : corners.size();
    if (n > corners.size()) {
      fail(input, place, parts,
           "a cell of type " + std::to_string(t) + " has " + std::to_string(corners.size()) + " corners");
    }
    if (t == kStrip) {
      add_strip(input, corners, place, parts);
    } else if (t == kPixel) {
      const double turned[]{corners[0], corners[1], corners[3], corners[2]};
      add_polygon(input, turned, place, parts);
    } else if (t == kTriangle || t == kPolygon || t == kQuad || t == kQuadraticTriangle || t == kQuadraticQuad) {
      if (t == kQuadraticTriangle || t == kQuadraticQuad) ++curved_;
      add_polygon(input, corners.first(n), place, parts);
    } else {
      ++left_out_;
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
  std::uint64_t left_out_ = 0, curved_ = 0;
};

}  // namespace brushfire::detail
