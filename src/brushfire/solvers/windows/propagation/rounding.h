// What rounding can do to a distance on a mesh, told from the mesh: see "Rounding" in docs/tolerance.md.
#pragma once

#include <brushfire/solvers/windows/algebra/real.h>

#include <algorithm>
#include <limits>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// How unlike the edges of a mesh are. Faces are laid over one another by frames whose directions come from edges: that
// of the shortest edge of a face is known to epsilon * ratio, and moves what lies at the far end of the longest one by
// that share of it.
class Unevenness {
 public:
  void add(double a, double b, double c, double double_area = 0) {
    const double longest = std::max({a, b, c}), shortest = std::min({a, b, c});
    ++faces_;
    edges_ += 0.5 * (a + b + c);
    area_ += 0.5 * double_area;
    longest_ = std::max(longest_, longest);
    lever_ = std::max(lever_, longest);
    if (!(shortest > 0)) {  // an edge without length has no direction; the other two are each other's
      if (longest > 0) shortest_ = std::min(shortest_, longest);  // and a way for light to their ends, perhaps the only
      return;
    }
    const double ratio = longest / shortest;
    ratio_ = std::max(ratio_, ratio);
    lever_ = std::max(lever_, ratio * longest);
    shortest_ = std::min(shortest_, shortest);
  }
  double longest() const { return longest_; }
  double shortest() const { return shortest_; }  // infinity: there is none
  double ratio() const { return ratio_; }        // largest, of longest and shortest edge of a face
  double lever() const { return lever_; }        // largest, of that times the longest edge
  // How many edges a straight line crosses for each unit of its length: half as many if they lie anyhow.
  double density() const { return area_ > 0 ? edges_ / area_ : std::numeric_limits<double>::infinity(); }
  double faces() const { return faces_; }

 private:
  double longest_ = 0, shortest_ = std::numeric_limits<double>::infinity(), ratio_ = 1, lever_ = 0;
  double faces_ = 0, edges_ = 0, area_ = 0;
};

// |computed value - distance| <= relative * length + absolute, apart from what tolerances and offsets add.
struct Rounding {
  double relative = 0, absolute = 0;
  double doubt = 0;  // absolute, as a share of the shortest edge: of the distance between neighbours
  // What every face that is crossed adds to `relative`, how many these are by length, and how many there are.
  double each_face = 0, density = 0, faces = 0;

  double of(double length) const {
    if (!(length > 0)) return 0;
    return (relative + each_face * std::min(density * length, faces)) * length + absolute;
  }
};

// How many epsilons of the lever a path may lose, and of the ratio for each unit of its length. The law is that of the
// frames; the factor covers what crossing many faces adds up to: the largest ever met is 10 (./run corpus looks for
// more).
inline constexpr double kFrames = 32;
// The rest: roots and sums along the way, and results that are given out as doubles.
inline constexpr double kAlong = kWide ? 4e-15 : 1e-12;
// Products of numbers beyond these leave the range of doubles: then nothing is promised.
inline constexpr double kLeast = 1e-140, kMost = 1e140;

// Turned from frame to frame a source comes a little nearer or goes away, each time alike where faces are: half an
// epsilon a face is the most that was met. A shortest path crosses a face once.
inline constexpr double kEachFace = kEpsilon;

inline Rounding rounding_of(const Unevenness& u) {
  if (!(u.longest() > 0)) return {};
  const bool in_range = u.shortest() > kLeast && u.longest() < kMost;
  // Wider numbers have the feet of apexes from positions, so that directions are known to epsilon whatever the ratio.
  const double lever = kWide ? u.longest() : u.lever();
  const double absolute = in_range ? kFrames * kEpsilon * lever : std::numeric_limits<double>::infinity();
  return {
      kAlong + kFrames * kEpsilon * u.ratio(), absolute, absolute / u.shortest(), kEachFace, u.density(), u.faces()};
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
