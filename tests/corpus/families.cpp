// The families that the oracle can follow.
#include "corpus/families.h"

#include "corpus/mutations.h"
#include "oracle/deviation.h"
#include "oracle/zoo.h"

#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace brushfire::corpus {
namespace {

Shape shape_of(const Mesh& mesh) {
  return {{mesh.positions().begin(), mesh.positions().end()}, {mesh.faces().begin(), mesh.faces().end()}};
}

Draft draft(const Shape& s) { return {s.mesh(), {}}; }

// ---- bases

Shape soup(Dice& dice, int most_faces = 25) {
  const Index vertices = static_cast<Index>(dice.between(4, 12));
  Shape s;
  for (Index v = 0; v < vertices; ++v) {
    s.positions.push_back({dice.sign_and_unit(), dice.sign_and_unit(), dice.sign_and_unit()});
  }
  for (int f = dice.between(3, most_faces); f > 0; --f) {
    s.faces.push_back({dice.below(vertices), dice.below(vertices), dice.below(vertices)});
  }
  return s;
}

Shape hilly(Dice& dice, int most_cells = 5) {
  const auto columns = static_cast<Index>(dice.between(1, most_cells)), rows = static_cast<Index>(dice.between(1, 3));
  Shape s = shapes::plane(columns, rows);
  const double height = dice.chance(0.3) ? 0 : dice.power(-2, 0.3);
  for (Vec3& p : s.positions) p.z = height * dice.unit();
  return s;
}

// A convex or starry polyhedron of 8 or 20 faces.
Shape solid(Dice& dice) {
  Shape s = dice.chance(0.5) ? shapes::icosphere(0) : shapes::latlong_sphere(2, 4);
  for (Vec3& p : s.positions) p = dice.within(0.3, 1.5) * p;
  return s;
}

Shape sheets_in_space(Dice& dice) {
  switch (dice.below(3)) {
    case 0:
      return shapes::book(static_cast<Index>(dice.between(3, 5)), static_cast<Index>(dice.between(1, 3)), 2);
    case 1:
      return shapes::bow_tie(static_cast<Index>(dice.between(2, 3)), static_cast<Index>(dice.between(3, 6)));
    default:
      return shapes::cube(1);
  }
}

Index any_vertex(const Shape& s, Dice& dice) { return dice.below(s.positions.size()); }

Shape any_base(Dice& dice) {
  switch (dice.below(4)) {
    case 0:
      return soup(dice);
    case 1:
      return solid(dice);
    case 2:
      return sheets_in_space(dice);
    default:
      return hilly(dice);
  }
}

// ---- families

// By a power of two, so that nothing is rounded but what has no number.
Draft extremes(Dice& dice) {
  Shape s = any_base(dice);
  const double scale = std::ldexp(1, dice.chance(0.5) ? dice.between(900, 988) : -dice.between(900, 1060));
  for (Vec3& p : s.positions) p = scale * p;
  return draft(s);
}

Draft general_soup(Dice& dice) { return draft(soup(dice, 30)); }

Draft lattice_soup(Dice& dice) {
  Shape s = soup(dice, 30);
  const int steps = dice.between(1, 5);
  for (Vec3& p : s.positions) p = {std::round(steps * p.x), std::round(steps * p.y), std::round(steps * p.z)};
  return draft(s);
}

// Vertices of integer coordinates, joined to sheets with their diagonals this way or that.
Draft integer_grid(Dice& dice) {
  Shape s = shapes::plane(static_cast<Index>(dice.between(2, 5)), static_cast<Index>(dice.between(1, 4)), 1, 1);
  const double columns = std::round(1 / s.positions[1].x);
  double rows = 1;
  for (const Vec3& p : s.positions) rows = p.y > 0 ? std::max(rows, std::round(1 / p.y)) : rows;
  const int height = dice.between(0, 2);
  for (Vec3& p : s.positions) {
    p = {std::round(p.x * columns), std::round(p.y * rows), static_cast<double>(dice.between(0, height))};
  }
  for (std::size_t f = 0; f + 1 < s.faces.size(); f += 2) {  // (a, b, c), (a, c, d)
    const Face t = s.faces[f], u = s.faces[f + 1];
    if (dice.chance(0.5)) s.faces[f] = {t[0], t[1], u[2]}, s.faces[f + 1] = {t[1], t[2], u[2]};
  }
  return draft(s);
}

Draft mixed_scale(Dice& dice) {
  Shape s = any_base(dice);
  mix_scales(s, dice, dice.within(0, 12));
  return draft(s);
}

Draft tiny_clusters(Dice& dice) {
  Shape s = any_base(dice);
  pull_clusters(s, dice);
  return draft(s);
}

Draft power_law(Dice& dice) {
  Shape s = any_base(dice);
  const double decades = dice.within(1, 12);
  const auto coordinate = [&] { return (dice.chance(0.5) ? -1 : 1) * dice.power(-decades, decades); };
  const bool flat = dice.chance(0.3);
  for (Vec3& p : s.positions) p = {coordinate(), coordinate(), flat ? 0 : coordinate()};
  return draft(s);
}

Draft far_point(Dice& dice) {
  Shape s = any_base(dice);
  if (dice.chance(0.3)) mix_scales(s, dice, 5);
  send_one_far(s, dice);
  return draft(s);
}

Draft needles(Dice& dice) {
  const double altitude = dice.chance(0.1) ? 0 : dice.power(-16, -1);
  return {oracle::needle_grid(dice.below(1u << 30), dice.between(2, 6), altitude), {}};
}

Draft bipyramids(Dice& dice) {
  const double height = dice.power(-6, 6), depth = dice.chance(0.6) ? height : dice.power(-6, 6);
  Shape s = shape_of(oracle::bipyramid(static_cast<Index>(dice.between(3, 48)), height, depth));
  if (dice.chance(0.6)) jitter(s, dice);
  return draft(s);
}

Draft thin_strip(Dice& dice) {
  Shape s = shape_of(oracle::strip(static_cast<Index>(dice.between(2, 60)), dice.power(-9, 4)));
  const double ripple = dice.chance(0.5) ? 0 : dice.power(-6, 0);
  for (Vec3& p : s.positions) p.z = ripple * dice.unit();
  if (dice.chance(0.3)) jitter(s, dice);
  return draft(s);
}

Draft fans(Dice& dice) {
  Shape s = shape_of(
      oracle::fan(static_cast<Index>(dice.between(3, 60)), dice.chance(0.5), dice.power(-3, 1), dice.between(0, 6)));
  const double decades = dice.chance(0.5) ? 0 : dice.within(0, 9);
  for (Vec3& p : s.positions) p = dice.power(-decades, decades) * p;
  return draft(s);
}

// Every face two or three times, either way round. The copies come last.
Draft doubled(Dice& dice) {
  Shape s = dice.chance(0.3) ? shapes::cylinder(2, static_cast<Index>(dice.between(3, 8)), 1, dice.power(-1, 1))
                             : any_base(dice);
  if (s.faces.size() > 33) s.faces.resize(33);
  if (dice.chance(0.3)) mutilate(s, dice);
  const Mesh plain = s.mesh();
  const std::size_t count = s.faces.size();
  for (int copies = dice.between(1, 2); copies > 0; --copies) {
    for (std::size_t f = 0; f < count; ++f) {
      Face t = s.faces[f];
      if (dice.chance(0.5)) std::swap(t[0], t[1]);
      std::rotate(t.begin(), t.begin() + dice.below(3), t.end());
      s.faces.push_back(t);
    }
  }
  return {s.mesh(), plain};
}

// Sheets at one place with vertices of their own, joined along some of their edges: isometric, not the same.
Draft coincident_sheets(Dice& dice) {
  Shape s = hilly(dice, 3);
  const auto count = static_cast<Index>(s.positions.size());
  const std::size_t faces = s.faces.size();
  const double shared = dice.within(0.1, 0.9);
  for (int copies = dice.between(1, 2); copies > 0; --copies) {
    std::vector<Index> copy(count);
    for (Index v = 0; v < count; ++v) {
      copy[v] = v;
      if (dice.chance(shared)) continue;
      copy[v] = static_cast<Index>(s.positions.size());
      const Vec3 p = s.positions[v];
      s.positions.push_back(p);
    }
    for (std::size_t f = 0; f < faces; ++f) {
      const Face t = s.faces[f];
      s.faces.push_back({copy[t[0]], copy[t[1]], copy[t[2]]});
    }
  }
  return draft(s);
}

Draft sheared(Dice& dice) {
  Shape s = any_base(dice);
  shear(s, dice);
  if (dice.chance(0.3)) shear(s, dice);
  return draft(s);
}

Draft stretched(Dice& dice) {
  Shape s = any_base(dice);
  stretch(s, dice);
  return draft(s);
}

Draft collinear(Dice& dice) {
  Shape s = any_base(dice);
  if (dice.chance(0.5)) snap_to_grid(s, dice);
  for (int turns = dice.between(1, 3); turns > 0; --turns) make_collinear(s, dice);
  return draft(s);
}

Draft repeated(Dice& dice) {
  Shape s = any_base(dice);
  if (dice.chance(0.4)) snap_to_grid(s, dice);
  repeat_vertices(s, dice);
  shuffle_faces(s, dice);
  return draft(s);
}

Draft components(Dice& dice) {
  Shape s;
  for (int parts = dice.between(2, 6); parts > 0; --parts) {
    const Shape part = hilly(dice, 2);
    const auto offset = static_cast<Index>(s.positions.size());
    const double scale = dice.power(-6, 6);
    for (const Vec3& p : part.positions) s.positions.push_back(scale * p);
    for (const Face& t : part.faces) s.faces.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return draft(s);
}

Draft from_lengths(Dice& dice) {
  return {oracle::random_intrinsic(dice.below(1u << 30), static_cast<Index>(dice.between(4, 16)),
                                   static_cast<Index>(dice.between(4, 40))),
          {}};
}

Draft mutilated(Dice& dice) {
  Shape s = any_base(dice);
  for (int count = dice.between(1, 3); count > 0; --count) mutilate(s, dice);
  return draft(s);
}

// Specimens of the zoo, mutilated.
Draft zoo(Dice& dice) {
  static const std::vector<oracle::Specimen> all = [] {
    std::vector<oracle::Specimen> small;
    for (oracle::Specimen& s : oracle::awkward_meshes()) {
      if (s.mesh.face_count() <= 100 && s.mesh.has_positions()) small.push_back(std::move(s));
    }
    return small;
  }();
  Shape s = shape_of(all[dice.below(all.size())].mesh);
  for (int count = dice.between(0, 2); count > 0; --count) mutilate(s, dice);
  return draft(s);
}

}  // namespace

std::span<const Family> small_families() {
  static const std::vector<Family> all{
      {"soup", "random triangles in general position", general_soup},
      {"lattice", "random triangles on few integer points", lattice_soup},
      {"integer-grid", "sheets of integer coordinates, any diagonals", integer_grid},
      {"mixed-scale", "lengths from 1e-12 to 1e12 in one mesh", mixed_scale},
      {"tiny-clusters", "faces of 1e-14 .. 1e-3 beside ordinary ones", tiny_clusters},
      {"power-law", "coordinates of any size, each for itself", power_law},
      {"extremes", "sizes at both ends of the range of doubles", extremes},
      {"far-point", "one vertex at 1e6 .. 1e17", far_point},
      {"needles", "rows of altitude 1e-16 .. 0.1, and 0", needles},
      {"thin-strips", "bands of 60 triangles, 1e-9 .. 1e4 long", thin_strip},
      {"fans", "60 triangles around a vertex, saddles, spokes of any length", fans},
      {"bipyramids", "two tips over one rim, of any heights, rims torn", bipyramids},
      {"doubled", "every face two or three times", doubled},
      {"sheets", "sheets at one place, joined here and there", coincident_sheets},
      {"sheared", "sheared by up to 1e9", sheared},
      {"stretched", "one axis scaled by 1e-12 .. 1e12", stretched},
      {"collinear", "vertices on lines through others, and on others", collinear},
      {"repeated", "faces with a vertex twice", repeated},
      {"components", "several components of any scale", components},
      {"lengths", "no coordinates: lengths at random", from_lengths},
      {"mutilated", "up to three of these in one mesh", mutilated},
      {"zoo", "hand-built awkward meshes, mutilated", zoo},
  };
  return all;
}

Family family_of_ratio(int decades) {
  return {
      "ratio-1e" + std::to_string(decades), "the largest length is this many times the shortest",
      [decades](Dice& dice) {
        Shape s = any_base(dice);
        const double least = std::pow(10.0, -decades);
        const Index small = any_vertex(s, dice);
        for (Index v = 0; v < s.positions.size(); ++v) {
          const double scale = v == small || dice.chance(0.3) ? least : dice.chance(0.5) ? 1 : dice.power(-decades, 0);
          s.positions[v] = scale * s.positions[v];
        }
        return draft(s);
      },
      Starts::Ordinary};
}

Family with_curves(const Family& family) { return {"curves-" + family.name, family.what, family.make, Starts::Curves}; }

}  // namespace brushfire::corpus
