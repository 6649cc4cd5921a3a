// Complexes that grow face by face over random edges, with coordinates of the family.
#include "oracle/wild.h"

#include <brushfire/mesh/shapes.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace brushfire::oracle {
namespace {

using Random = std::mt19937;

Index below(Random& random, Index n) { return static_cast<Index>(random() % n); }
double uniform(Random& random) { return (static_cast<double>(random()) + 0.5) / 4294967296.0; }
double between(Random& random, double low, double high) { return low + (high - low) * uniform(random); }
double sign(Random& random) { return random() % 2 ? 1 : -1; }
Vec3 in_cube(Random& random) { return {between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)}; }
double power_of_ten(Random& random, double low, double high) { return std::pow(10.0, between(random, low, high)); }

// What each family draws its vertices from; fixed for one complex.
std::function<Vec3()> places(Wild family, Random& random) {
  switch (family) {
    case Wild::Scales:
      return [&] { return power_of_ten(random, -8, 4) * in_cube(random); };
    case Wild::Needles: {
      const double thin = power_of_ten(random, -9, -3);
      const bool both = random() % 2;
      return [&random, thin, both] {
        const Vec3 p = in_cube(random);
        const double end = std::floor(between(random, 0, 3));
        return Vec3{thin * p.x, (both ? thin : 1) * p.y, 5 * end + thin * p.z};
      };
    }
    case Wild::Clusters: {
      const double tight = power_of_ten(random, -9, -4);
      return [&random, tight] {
        const Vec3 middle{static_cast<double>(random() % 2), static_cast<double>(random() % 2),
                          static_cast<double>(random() % 2)};
        return middle + tight * in_cube(random);
      };
    }
    case Wild::PowerLaw:
      return [&] {
        return Vec3{sign(random) * power_of_ten(random, -6, 6), sign(random) * power_of_ten(random, -6, 6),
                    sign(random) * power_of_ten(random, -6, 6)};
      };
    case Wild::FarPoint: {
      const double far = power_of_ten(random, 6, 12);
      return
          [&random, far, first = true]() mutable { return (std::exchange(first, false) ? far : 1) * in_cube(random); };
    }
    case Wild::Grid:
    case Wild::Soup:
      return [&] {
        return Vec3{static_cast<double>(random() % 5), static_cast<double>(random() % 3),
                    static_cast<double>(random() % 2)};
      };
    case Wild::Doubled:
    case Wild::Book:
      break;
  }
  return [&] { return in_cube(random); };
}

// Each face over an edge of one before it, so that most hang together; often to a vertex that is there already.
Shape grown(Index faces, double closing, const std::function<Vec3()>& place, Random& random) {
  Shape s{{place(), place(), place()}, {{0, 1, 2}}};
  while (s.faces.size() < faces) {
    const auto recent = std::min<Index>(static_cast<Index>(s.faces.size()), 6);
    const Face& over = s.faces[random() % 3 ? s.faces.size() - 1 - below(random, recent)
                                            : below(random, static_cast<Index>(s.faces.size()))];
    const Index k = below(random, 3), a = over[k], b = over[(k + 1) % 3];
    Index c = below(random, static_cast<Index>(s.positions.size()));
    if (c == a || c == b || uniform(random) > closing) {
      c = static_cast<Index>(s.positions.size());
      s.positions.push_back(place());
    }
    s.faces.push_back(random() % 4 ? Face{b, a, c} : Face{a, b, c});
  }
  std::shuffle(s.faces.begin(), s.faces.end(), random);
  return s;
}

Shape soup(Index vertices, Index faces, const std::function<Vec3()>& place, Random& random) {
  Shape s;
  for (Index v = 0; v < vertices; ++v) s.positions.push_back(place());
  while (s.faces.size() < faces) {
    s.faces.push_back({below(random, vertices), below(random, vertices), below(random, vertices)});
  }
  return s;
}

// Every face again, once or twice, the other way round or rotated.
Shape doubled(Shape s, Random& random) {
  const std::size_t count = s.faces.size();
  const bool thrice = random() % 4 == 0;
  for (std::size_t f = 0; f < count * (thrice ? 2 : 1); ++f) {
    Face t = s.faces[f % count];
    if (random() % 2) std::swap(t[0], t[1]);
    std::rotate(t.begin(), t.begin() + below(random, 3), t.end());
    s.faces.push_back(t);
  }
  return s;
}

// A prism of `sides` without its ends, as the small models are that are two-sided.
Shape prism(Index sides, Random& random) {
  Shape s;
  const double height = between(random, 0.5, 12);
  for (Index k = 0; k < sides; ++k) {
    const double angle = 2 * kPi * k / sides;
    s.positions.push_back({std::cos(angle), std::sin(angle), 0});
    s.positions.push_back({std::cos(angle), std::sin(angle), height});
  }
  for (Index k = 0; k < sides; ++k) {
    const Index a = 2 * k, b = a + 1, c = 2 * ((k + 1) % sides), d = c + 1;
    s.faces.push_back({a, c, b});
    s.faces.push_back({b, c, d});
  }
  return s;
}

// Pages over one spine of several edges; a page's vertices are new, or mirror images of the page's before.
Shape book(Random& random) {
  Shape s;
  const Index edges = 1 + below(random, 4), pages = 3 + below(random, 4);
  for (Index k = 0; k <= edges; ++k) s.positions.push_back({static_cast<double>(k), 0, 0});
  std::vector<double> out(edges + 1), along(edges + 1);
  for (Index p = 0; p < pages; ++p) {
    const bool same = p > 0 && random() % 2;
    const double turn = 2 * kPi * p / pages;
    const auto first = static_cast<Index>(s.positions.size());
    for (Index k = 0; k <= edges; ++k) {
      if (!same) out[k] = between(random, 0.2, 2), along[k] = between(random, -0.4, 0.4);
      s.positions.push_back({k + along[k], out[k] * std::cos(turn), out[k] * std::sin(turn)});
    }
    for (Index k = 0; k < edges; ++k) {
      s.faces.push_back({k, k + 1, first + k});
      s.faces.push_back({first + k, k + 1, first + k + 1});
    }
  }
  return s;
}

}  // namespace

const char* name_of(Wild family) {
  constexpr std::array names{"grid", "scales",    "needles",   "clusters", "doubled",
                             "book", "power law", "far point", "soup"};
  return names[static_cast<std::size_t>(family)];
}

Mesh wild_complex(Wild family, Random& random) {
  const std::function<Vec3()> place = places(family, random);
  const Index faces = 3 + below(random, random() % 3 ? 8 : 40);
  switch (family) {
    case Wild::Doubled:
      if (random() % 2) return doubled(prism(3 + below(random, 7), random), random).mesh();
      return doubled(grown(std::min<Index>(faces, 12), 0.5, place, random), random).mesh();
    case Wild::Book:
      return book(random).mesh();
    case Wild::Soup:
      return soup(8 + below(random, 12), 4 + faces, place, random).mesh();
    default:
      return grown(faces, 0.6, place, random).mesh();
  }
}

SurfacePoint wild_point(const Mesh& mesh, Random& random) {
  Index f = below(random, mesh.face_count());
  for (int tries = 0; !mesh.is_face_usable(f) && tries < 100; ++tries) f = below(random, mesh.face_count());
  const Index i = below(random, 3), j = (i + 1) % 3, k = (i + 2) % 3;
  const double a = uniform(random), b = (1 - a) * uniform(random);
  SurfacePoint p{f, {0, 0, 0}};
  const auto set = [&](double wi, double wj, double wk) { p.weights[i] = wi, p.weights[j] = wj, p.weights[k] = wk; };
  const double near = power_of_ten(random, -16, -3), nearer = near * uniform(random);
  switch (random() % 7) {
    case 0:
    case 1:
      set(1, 0, 0);
      break;
    case 2:
      set(a, 1 - a, 0);
      break;
    case 3:
      set(a, b, 1 - a - b);
      break;
    case 4:  // beside a vertex, in the face
      set(1 - near - nearer, near, nearer);
      break;
    case 5:  // beside a vertex, on an edge
      set(1 - near, near, 0);
      break;
    default:  // beside an edge
      set(a * (1 - near), (1 - a) * (1 - near), near);
  }
  return p;
}

}  // namespace brushfire::oracle
