// Mutilations of meshes.
#include "corpus/mutations.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace brushfire::corpus {
namespace {

double size_of(const Shape& s) {
  double size = 0;
  for (const Vec3& p : s.positions) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return size > 0 ? size : 1;
}

Vec3 direction(Dice& dice) { return {dice.sign_and_unit(), dice.sign_and_unit(), dice.sign_and_unit()}; }

Index any_vertex(const Shape& s, Dice& dice) { return dice.below(s.positions.size()); }

double& axis(Vec3& p, std::uint32_t k) { return k == 0 ? p.x : k == 1 ? p.y : p.z; }

}  // namespace

void mix_scales(Shape& s, Dice& dice, double decades) {
  const Vec3 centre = dice.chance(0.5) ? s.positions[any_vertex(s, dice)] : Vec3{};
  for (Vec3& p : s.positions) p = dice.power(-decades, decades) * (p - centre);
}

void pull_clusters(Shape& s, Dice& dice) {
  for (int clusters = dice.between(1, 2); clusters > 0; --clusters) {
    const Index centre = any_vertex(s, dice);
    const double size = size_of(s) * dice.power(-14, -3);
    const double share = dice.chance(0.5) ? 1 : 0.5;
    std::vector<bool> pulled(s.positions.size(), false);
    for (const Face& t : s.faces) {
      if (std::find(t.begin(), t.end(), centre) == t.end()) continue;
      for (const Index v : t) {
        if (v == centre || pulled[v] || !dice.chance(share)) continue;
        pulled[v] = true;
        s.positions[v] = s.positions[centre] + size * direction(dice);
      }
    }
  }
}

void send_one_far(Shape& s, Dice& dice) {
  const double far = dice.power(6, 17);
  Vec3& p = s.positions[any_vertex(s, dice)];
  if (dice.chance(0.5)) {
    p = far * direction(dice);
  } else {
    axis(p, dice.below(3)) = far;
  }
}

void shear(Shape& s, Dice& dice) {
  const std::uint32_t to = dice.below(3), from = (to + 1 + dice.below(2)) % 3;
  const double by = dice.power(0, 9);
  for (Vec3& p : s.positions) axis(p, to) += by * axis(p, from);
}

void stretch(Shape& s, Dice& dice) {
  const std::uint32_t k = dice.below(3);
  const double by = dice.power(-12, 12);
  for (Vec3& p : s.positions) axis(p, k) *= by;
}

void snap_to_grid(Shape& s, Dice& dice) {
  const double step = size_of(s) / dice.between(2, 6);
  for (Vec3& p : s.positions) p = {std::round(p.x / step), std::round(p.y / step), std::round(p.z / step)};
}

void jitter(Shape& s, Dice& dice) {
  const double by = size_of(s) * dice.power(-16, -3);
  for (Vec3& p : s.positions) p = p + by * direction(dice);
}

void make_collinear(Shape& s, Dice& dice) {
  for (int count = dice.between(1, 3); count > 0; --count) {
    const Vec3 a = s.positions[any_vertex(s, dice)], b = s.positions[any_vertex(s, dice)];
    constexpr std::array kShares{0.0, 0.5, 0.25, 1.0, 2.0};  // exact on a grid
    s.positions[any_vertex(s, dice)] = a + kShares[dice.below(kShares.size())] * (b - a);
  }
}

void repeat_vertices(Shape& s, Dice& dice) {
  for (int count = dice.between(1, 4); count > 0; --count) {
    const Index a = any_vertex(s, dice), b = dice.chance(0.2) ? a : any_vertex(s, dice);
    Face t{a, b, a};
    std::rotate(t.begin(), t.begin() + dice.below(3), t.end());
    s.faces.insert(s.faces.begin() + dice.below(s.faces.size() + 1), t);
  }
  if (dice.chance(0.3)) s.positions.push_back(direction(dice));
}

void shuffle_faces(Shape& s, Dice& dice) {
  for (Face& t : s.faces) {
    if (dice.chance(0.5)) std::swap(t[0], t[1]);
    std::rotate(t.begin(), t.begin() + dice.below(3), t.end());
  }
}

void mutilate(Shape& s, Dice& dice) {
  switch (dice.below(10)) {
    case 0:
      return mix_scales(s, dice, dice.within(0, 12));
    case 1:
      return pull_clusters(s, dice);
    case 2:
      return send_one_far(s, dice);
    case 3:
      return shear(s, dice);
    case 4:
      return stretch(s, dice);
    case 5:
      return snap_to_grid(s, dice);
    case 6:
      return jitter(s, dice);
    case 7:
      return make_collinear(s, dice);
    case 8:
      return repeat_vertices(s, dice);
    default:
      return shuffle_faces(s, dice);
  }
}

}  // namespace brushfire::corpus
