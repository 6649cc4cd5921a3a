// Hand-built and random meshes.
#include "oracle/zoo.h"

#include <brushfire/mesh/shapes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

namespace brushfire::oracle {
namespace {

using Positions = std::vector<Vec3>;
using Faces = std::vector<Face>;

Index below(std::mt19937& random, Index n) { return static_cast<Index>(random() % n); }

Shape merged(Shape a, const Shape& b, Vec3 shift) {
  const auto offset = static_cast<Index>(a.positions.size());
  for (const Vec3& p : b.positions) a.positions.push_back(p + shift);
  for (const Face& t : b.faces) a.faces.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

Shape shuffled(Shape s, bool flip, bool rotate, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (Face& t : s.faces) {
    if (flip && random() % 2) std::swap(t[0], t[1]);
    if (rotate) std::rotate(t.begin(), t.begin() + below(random, 3), t.end());
  }
  return s;
}

Shape hilly(int cells, std::uint32_t seed, double height) {
  std::mt19937 random(seed);
  Shape s = shapes::plane(static_cast<Index>(cells), static_cast<Index>(cells));
  for (Vec3& p : s.positions) p.z = height * static_cast<double>(random() % 1000) / 1000;
  return s;
}

// A sheet with a slit along its middle row, closed at both ends: the slit's vertices are there twice, at one place.
Shape with_slit(int cells) {
  Shape s = shapes::plane(static_cast<Index>(cells), static_cast<Index>(cells));
  const auto row = static_cast<Index>(cells / 2);
  const auto columns = static_cast<Index>(cells + 1);
  std::map<Index, Index> copy;
  for (Index x = 1; x + 1 < columns; ++x) {
    copy[row * columns + x] = static_cast<Index>(s.positions.size());
    const Vec3 p = s.positions[row * columns + x];
    s.positions.push_back(p);
  }
  for (Face& t : s.faces) {
    const bool upper =
        t[0] > row * columns + columns - 1 || t[1] > row * columns + columns - 1 || t[2] > row * columns + columns - 1;
    for (Index& v : t) {
      if (upper && copy.count(v)) v = copy[v];
    }
  }
  return s;
}

// An edge of a sheet is split on one side only by a vertex on it, and the gap closed by a face of no area.
Shape with_flat_face() {
  return {{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, -1, 0}, {0, 2, 1}},
          {{0, 2, 3}, {2, 1, 3}, {0, 1, 2}, {1, 0, 4}, {0, 3, 5}}};
}

Shape with_collapsed_edge() {
  Shape s = hilly(4, 7, 0.5);
  s.positions[13] = s.positions[12];
  s.positions[7] = s.positions[6];
  return s;
}

Shape with_repeats() {
  Shape s = hilly(3, 3, 0.3);
  s.faces.push_back({0, 0, 1});
  s.faces.push_back({2, 9, 2});  // conducts between vertices that no other face joins
  s.faces.push_back({5, 5, 5});
  s.positions.push_back({3, 3, 3});
  s.faces.push_back({15, 16, 15});  // a hair
  s.positions.push_back({9, 9, 9});
  return s;
}

Shape with_duplicates() {
  Shape s = shuffled(hilly(4, 5, 0.6), true, true, 5);
  const std::size_t count = s.faces.size();
  for (std::size_t f = 0; f < count; f += 3) s.faces.push_back({s.faces[f][1], s.faces[f][0], s.faces[f][2]});
  for (std::size_t f = 0; f < count; f += 4) s.faces.push_back(s.faces[f]);
  return s;
}

// A book on each edge: three sheets through one line, and a fourth that meets them in one vertex.
Shape crossing_sheets() {
  Shape s = shapes::book(3, 3, 3);
  return merged(s, shapes::bow_tie(3, 5), {0.2, 0.1, 4});
}

Mesh collinear_soup() {
  Positions p;
  for (int k = 0; k < 5; ++k) p.push_back({static_cast<double>(k), 0, 0});
  p.push_back({2, 3, 0});
  p.push_back({2, -3, 0});
  const Faces t{{0, 2, 4}, {0, 1, 2}, {2, 3, 4}, {0, 4, 5}, {1, 3, 6}, {0, 1, 3}, {4, 2, 0}};
  return Mesh(p, t);
}

}  // namespace

Mesh random_soup(std::uint32_t seed, Index vertices, Index faces, int lattice) {
  std::mt19937 random(seed);
  const auto n = static_cast<std::uint32_t>(lattice);
  Positions p(vertices);
  for (Vec3& v : p) {
    v = {static_cast<double>(random() % n), static_cast<double>(random() % n), static_cast<double>(random() % n)};
  }
  Faces t(faces);
  for (Face& f : t) f = {below(random, vertices), below(random, vertices), below(random, vertices)};
  return Mesh(p, t);
}

Mesh random_intrinsic(std::uint32_t seed, Index vertices, Index faces) {
  std::mt19937 random(seed);
  std::map<std::pair<Index, Index>, double> length;
  Faces t(faces);
  std::vector<std::array<double, 3>> lengths(faces);
  for (Index f = 0; f < faces; ++f) {
    t[f] = {below(random, vertices), below(random, vertices), below(random, vertices)};
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[f][k], b = t[f][(k + 1) % 3];
      const double fresh = 1 + 0.9 * static_cast<double>(random() % 1024) / 1024;
      lengths[f][k] = a == b ? 0 : length.try_emplace(std::minmax(a, b), fresh).first->second;
    }
  }
  return Mesh::from_lengths(vertices, t, lengths);
}

Mesh needle_grid(std::uint32_t seed, int cells, double altitude) {
  std::mt19937 random(seed);
  Shape s = shapes::plane(static_cast<Index>(cells), static_cast<Index>(cells));
  double y = 0;
  const auto columns = static_cast<std::size_t>(cells) + 1;
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    Vec3& p = s.positions[v];
    if (v % columns == 0 && v > 0) y += (v / columns) % 2 ? altitude : 1.0 / cells;
    p.x += (static_cast<double>(random() % 1000) / 1000 - 0.5) * 0.5 / cells;
    p.y = y;
    p.z = 0.1 * static_cast<double>((v / columns / 2 * 7) % 5);
  }
  return s.mesh();
}

Mesh flat_torus(Index columns, Index rows, double width, double height) {
  const double dx = width / columns, dy = height / rows, diagonal = std::hypot(dx, dy);
  Faces t;
  std::vector<std::array<double, 3>> lengths;
  for (Index y = 0; y < rows; ++y) {
    for (Index x = 0; x < columns; ++x) {
      const Index a = y * columns + x, b = y * columns + (x + 1) % columns,
                  c = (y + 1) % rows * columns + (x + 1) % columns, d = (y + 1) % rows * columns + x;
      t.push_back({a, b, c});
      lengths.push_back({dx, dy, diagonal});
      t.push_back({a, c, d});
      lengths.push_back({diagonal, dx, dy});
    }
  }
  return Mesh::from_lengths(columns * rows, t, lengths);
}

Mesh fan(Index count, bool closed, double height, int waves) {
  Positions p{{0, 0, 0}};
  Faces t;
  const Index rim = closed ? count : count + 1;
  for (Index k = 0; k < rim; ++k) {
    const double angle = (closed ? 2 : 1.5) * kPi * k / count;
    p.push_back({std::cos(angle), std::sin(angle), height * std::cos(waves * angle)});
  }
  for (Index k = 0; k < count; ++k) t.push_back({0, 1 + k, 1 + (k + 1) % rim});
  return Mesh(p, t);
}

Mesh bipyramid(Index count, double height, double depth) {
  Positions p{{0, 0, height}, {0, 0, -depth}};
  Faces t;
  for (Index k = 0; k < count; ++k) {
    const double angle = 2 * kPi * k / count;
    p.push_back({std::cos(angle), std::sin(angle), 0});
  }
  for (Index k = 0; k < count; ++k) {
    const Index a = 2 + k, b = 2 + (k + 1) % count;
    t.push_back({0, a, b});
    t.push_back({1, b, a});
  }
  return Mesh(p, t);
}

Mesh strip(Index count, double step) {
  Positions p;
  Faces t;
  for (Index k = 0; k < count + 2; ++k) p.push_back({step * k, k % 2 ? 1.0 : 0.0, 0});
  for (Index k = 0; k < count; ++k) t.push_back(k % 2 ? Face{k + 1, k, k + 2} : Face{k, k + 1, k + 2});
  return Mesh(p, t);
}

std::vector<Specimen> awkward_meshes() {
  std::vector<Specimen> all;
  const auto add = [&](std::string name, Mesh mesh) { all.push_back({std::move(name), std::move(mesh)}); };
  const Shape tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  add("one triangle", Mesh(Positions{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, Faces{{0, 1, 2}}));
  add("tetrahedron", tetrahedron.mesh());
  add("pillow: one triangle twice", Mesh(Positions{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, Faces{{0, 1, 2}, {2, 1, 0}}));
  add("one flat triangle twice", Mesh(Positions{{0, 0, 0}, {3, 0, 0}, {1, 0, 0}}, Faces{{0, 1, 2}, {2, 1, 0}}));
  add("flat face in a sheet", with_flat_face().mesh());
  add("collinear soup", collinear_soup());
  add("flipped faces", shuffled(hilly(5, 1, 0.4), true, true, 1).mesh());
  add("duplicate faces", with_duplicates().mesh());
  add("repeated indices", with_repeats().mesh());
  add("edges of length zero", with_collapsed_edge().mesh());
  add("slit", with_slit(8).mesh());
  add("book of 5 pages", shapes::book(5, 4, 6).mesh());
  add("book of 3 pages, flipped", shuffled(shapes::book(3, 5, 5), true, true, 3).mesh());
  add("bow-tie of 4 discs", shapes::bow_tie(4, 7).mesh());
  add("crossing sheets", crossing_sheets().mesh());
  add("two components", merged(tetrahedron, hilly(3, 2, 1), {9, 0, 0}).mesh());
  add("spiky sheet", hilly(8, 11, 1.5).mesh());
  add("cube", shapes::cube(4).mesh());
  add("plane", shapes::plane(9, 7).mesh());
  add("saddle", shapes::saddle(6).mesh());
  add("flat torus", flat_torus(6, 5, 3, 2));
  add("closed fan", fan(12, true, 0.4, 3));
  add("open fan", fan(9, false));
  add("strip", strip(40, 0.3));
  add("needles of 1e-3", needle_grid(4, 6, 1e-3));
  add("needles of 1e-8", needle_grid(5, 6, 1e-8));
  return all;
}

}  // namespace brushfire::oracle
