// The generators of shapes.h.
#include <brushfire/mesh/shapes.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/memory.h>
#include <brushfire/core/detail/random.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/subdivide.h>

#include <cmath>
#include <functional>
#include <string>

namespace brushfire::shapes {
namespace {

void require(bool condition, const char* what) {
  if (!condition) throw Error(ErrorCode::InvalidArgument, what);
}

void check_count(std::uint64_t vertices, std::uint64_t faces) {
  if (vertices >= kNoIndex || faces > kNoIndex / 3) {
    throw Error(ErrorCode::TooLarge, "a shape of " + std::to_string(vertices) + " vertices and " +
                                         std::to_string(faces) + " faces does not fit into 32-bit indices");
  }
}

// Refuses what does not fit into memory, and takes what it needs at once. (A mesh copies both.)
void make_room(Shape& s, std::uint64_t vertices, std::uint64_t faces) {
  require_memory(2 * (vertices * sizeof(Vec3) + faces * sizeof(Face)), 0,
                 "a shape of " + std::to_string(vertices) + " vertices and " + std::to_string(faces) + " faces",
                 "ask for fewer vertices");
  s.positions.reserve(static_cast<std::size_t>(vertices));
  s.faces.reserve(static_cast<std::size_t>(faces));
}

// Cosine and sine of (octant + within) eighths of a turn, from + and * alone (the C library's differ between platforms
// in the last bit), and mirror symmetric to the bit: the angle is folded into [0, pi/4], where Taylor's series is exact
// to rounding.
Vec2 turn_by_octants(Index octant, double within) {
  const double x = (octant % 2 == 0 ? within : 1 - within) * (0.25 * kPi);
  const double xx = x * x;
  double sine = 0, cosine = 0;
  for (int k = 17; k >= 3; k -= 2) sine = (1 + sine) * (-xx / (k * (k - 1)));
  sine = x * (1 + sine);
  for (int k = 16; k >= 2; k -= 2) cosine = (1 + cosine) * (-xx / (k * (k - 1)));
  cosine = 1 + cosine;
  if (octant % 2 == 1 && within == 0) sine = cosine = std::sqrt(0.5);  // the diagonal, where the two swap
  const bool steep = octant == 1 || octant == 2 || octant == 5 || octant == 6;
  const Vec2 p = steep ? Vec2{sine, cosine} : Vec2{cosine, sine};
  return {octant >= 2 && octant <= 5 ? -p.x : p.x, octant >= 4 ? -p.y : p.y};
}

// The point of the unit circle after i/n turns, 0 <= i < n: the octant is found in whole numbers.
Vec2 turn(Index i, Index n) {
  const std::uint64_t eighths = 8 * std::uint64_t{i};
  return turn_by_octants(static_cast<Index>(eighths / n), static_cast<double>(eighths % n) / n);
}

// The same after any number of turns.
Vec2 turn(double turns) {
  const double eighths = 8 * (turns - std::floor(turns));
  return turn_by_octants(static_cast<Index>(eighths) % 8, eighths - std::floor(eighths));
}

double share(Index i, Index n) { return static_cast<double>(i) / n; }

// Two triangles between (a, b) below and (c, d) above: c d
//                                                       a b
void add_quad(std::vector<Face>& faces, Index a, Index b, Index c, Index d) {
  faces.push_back({a, b, d});
  faces.push_back({a, d, c});
}

// A grid of them, row by row; `vertex`: of (x, y).
template <class Vertex>
void add_quads(std::vector<Face>& faces, Index columns, Index rows, Poll& poll, Vertex vertex) {
  for (Index y = 0; y < rows; ++y) {
    for (Index x = 0; x < columns; ++x) {
      poll();
      add_quad(faces, vertex(x, y), vertex(x + 1, y), vertex(x, y + 1), vertex(x + 1, y + 1));
    }
  }
}

// Quads between two rings of n vertices each that start at `lower` and `upper`.
void join_rings(std::vector<Face>& faces, Index lower, Index upper, Index n) {
  Poll poll;
  for (Index j = 0; j < n; ++j) {
    poll();
    const Index next = j + 1 < n ? j + 1 : 0;
    add_quad(faces, lower + j, lower + next, upper + j, upper + next);
  }
}

using Surface = std::function<Vec3(double, double)>;

// A grid of columns x rows cells over [0, 1]^2, mapped by `surface`.
Shape grid(Index columns, Index rows, const Surface& surface) {
  require(columns > 0 && rows > 0, "a grid needs at least one column and one row");
  const std::uint64_t width = std::uint64_t{columns} + 1;
  check_count(width * (std::uint64_t{rows} + 1), 2 * std::uint64_t{columns} * rows);
  Shape s;
  make_room(s, width * (std::uint64_t{rows} + 1), 2 * std::uint64_t{columns} * rows);
  Poll poll;
  for (Index y = 0; y <= rows; ++y) {
    for (Index x = 0; x <= columns; ++x) {
      poll();
      s.positions.push_back(surface(share(x, columns), share(y, rows)));
    }
  }
  add_quads(s.faces, columns, rows, poll, [=](Index x, Index y) { return y * (columns + 1) + x; });
  return s;
}

// t^3 (6t^2 - 15t + 10): 0 to 1 with two flat derivatives at both ends.
double smooth_step(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

// Value noise: random values in [0, 1) at the integer points, joined smoothly.
class ValueNoise {
 public:
  explicit ValueNoise(std::uint64_t seed) : seed_(scrambled(seed)) {}

  double operator()(Vec3 p) const {
    const double x = std::floor(p.x), y = std::floor(p.y), z = std::floor(p.z);
    const double tx = smooth_step(p.x - x), ty = smooth_step(p.y - y), tz = smooth_step(p.z - z);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
      sum += (dx ? tx : 1 - tx) * (dy ? ty : 1 - ty) * (dz ? tz : 1 - tz) * at(x + dx, y + dy, z + dz);
    }
    return sum;
  }

 private:
  double at(double x, double y, double z) const {
    std::uint64_t h = seed_;
    for (const double c : {x, y, z}) h = scrambled(h ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(c)));
    return unit_interval(h);
  }

  std::uint64_t seed_;
};

}  // namespace

Shape plane(Index columns, Index rows, double width, double height) {
  return grid(columns, rows, [=](double u, double v) { return Vec3{width * u, height * v, 0}; });
}

Shape saddle(Index cells, double height) {
  return grid(cells, cells, [=](double u, double v) {
    const double x = 2 * u - 1, y = 2 * v - 1;
    return Vec3{x, y, height * (x * x - y * y)};
  });
}

Shape noise_terrain(Index columns, Index rows, double height, std::uint64_t seed) {
  constexpr int kOctaves = 6;
  constexpr double kHillsAcross = 4;
  const ValueNoise noise(seed);
  return grid(columns, rows, [&](double u, double v) {
    double z = 0, amplitude = height, frequency = kHillsAcross;
    for (int octave = 0; octave < kOctaves; ++octave) {
      // Every octave lives in a layer of its own, or their lattice points would coincide.
      z += amplitude * noise({frequency * u, frequency * v, static_cast<double>(octave)});
      amplitude *= 0.5;
      frequency *= 2;
    }
    return Vec3{u, v, z};
  });
}

Shape cube(Index cells) {
  require(cells > 0, "a cube needs at least one cell a side");
  const std::uint64_t side = std::uint64_t{cells} * cells;
  check_count(6 * side + 2, 12 * side);
  const Index n = cells, width = n + 1, first_wall = width * width, last_layer = first_wall + (n - 1) * 4 * n;
  // The bottom layer in full, then the four walls ring by ring, then the top layer in full.
  const auto number = [=](Index i, Index j, Index k) {
    if (k == 0) return j * width + i;
    if (k == n) return last_layer + j * width + i;
    const Index around = j == 0 ? i : i == n ? n + j : j == n ? 2 * n + (n - i) : 3 * n + (n - j);
    return first_wall + (k - 1) * 4 * n + around;
  };
  Shape s;
  make_room(s, 6 * side + 2, 12 * side);
  in_pieces(static_cast<std::size_t>(6 * side + 2), [&](std::size_t, std::size_t end) { s.positions.resize(end); });
  Poll poll;
  // Corners of a cell on each side, as seen from outside: (u, v) to (i, j, k).
  const std::array<std::function<std::array<Index, 3>(Index, Index)>, 6> sides{
      [=](Index u, Index v) { return std::array<Index, 3>{v, u, 0}; },
      [=](Index u, Index v) { return std::array<Index, 3>{u, v, n}; },
      [=](Index u, Index v) { return std::array<Index, 3>{u, 0, v}; },
      [=](Index u, Index v) { return std::array<Index, 3>{v, n, u}; },
      [=](Index u, Index v) { return std::array<Index, 3>{0, v, u}; },
      [=](Index u, Index v) { return std::array<Index, 3>{n, u, v}; }};
  for (const auto& at : sides) {
    const auto vertex = [&](Index u, Index v) {
      const std::array<Index, 3> c = at(u, v);
      const Index result = number(c[0], c[1], c[2]);
      s.positions[result] = {share(c[0], n), share(c[1], n), share(c[2], n)};
      return result;
    };
    add_quads(s.faces, n, n, poll, vertex);
  }
  return s;
}

Shape icosphere(Index levels, double radius) {
  require(levels <= 14, "an icosphere of more than 14 levels does not fit into 32-bit indices");
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  Shape s;
  const std::uint64_t split = std::uint64_t{1} << 2 * levels;
  make_room(s, 10 * split + 2, 20 * split);
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      s.positions.insert(s.positions.end(), {{0, a, b}, {a, b, 0}, {b, 0, a}});
    }
  }
  // Three vertices at distance 2 of each other, turned outwards, are a face.
  const std::vector<Vec3> p = s.positions;
  const auto near = [&](Index i, Index j) { return norm(p[i] - p[j]) < 2.5; };
  for (Index i = 0; i < 12; ++i) {
    for (Index j = i + 1; j < 12; ++j) {
      for (Index k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
        const bool outward = dot(cross(p[j] - p[i], p[k] - p[i]), p[i]) > 0;
        s.faces.push_back(outward ? Face{i, j, k} : Face{i, k, j});
      }
    }
  }
  const auto project = [&] {
    in_pieces(s.positions.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) s.positions[v] = (radius / norm(s.positions[v])) * s.positions[v];
    });
  };
  project();
  for (Index level = 0; level < levels; ++level) {
    s = subdivided(s.mesh(), {.rule = SubdivisionRule::Midpoint});
    project();
  }
  return s;
}

Shape latlong_sphere(Index stacks, Index slices, double radius) {
  require(stacks >= 2 && stacks < kNoIndex / 2 && slices >= 3, "a sphere needs at least 2 stacks and 3 slices");
  check_count((std::uint64_t{stacks} - 1) * slices + 2, 2 * (std::uint64_t{stacks} - 1) * slices);
  Shape s;
  make_room(s, (std::uint64_t{stacks} - 1) * slices + 2, 2 * (std::uint64_t{stacks} - 1) * slices);
  Poll poll;
  s.positions.push_back({0, 0, radius});
  for (Index i = 1; i < stacks; ++i) {
    const Vec2 meridian = turn(i, 2 * stacks);
    for (Index j = 0; j < slices; ++j) {
      poll();
      const Vec2 parallel = turn(j, slices);
      s.positions.push_back(radius * Vec3{meridian.y * parallel.x, meridian.y * parallel.y, meridian.x});
    }
  }
  s.positions.push_back({0, 0, -radius});
  const Index south = static_cast<Index>(s.positions.size() - 1), last_ring = south - slices;
  for (Index j = 0; j < slices; ++j) s.faces.push_back({0, 1 + j, 1 + (j + 1) % slices});
  for (Index i = 1; i + 1 < stacks; ++i) join_rings(s.faces, 1 + i * slices, 1 + (i - 1) * slices, slices);
  for (Index j = 0; j < slices; ++j) s.faces.push_back({south, last_ring + (j + 1) % slices, last_ring + j});
  return s;
}

Shape cone(Index rings, Index segments, double radius, double height) {
  require(rings >= 1 && segments >= 3, "a cone needs at least 1 ring and 3 segments");
  check_count(std::uint64_t{rings} * segments + 1, 2 * std::uint64_t{rings} * segments);
  Shape s;
  make_room(s, std::uint64_t{rings} * segments + 1, 2 * std::uint64_t{rings} * segments);
  Poll poll;
  s.positions.push_back({0, 0, height});
  for (Index i = 1; i <= rings; ++i) {
    const double t = share(i, rings);
    for (Index j = 0; j < segments; ++j) {
      poll();
      const Vec2 c = turn(j, segments);
      s.positions.push_back({radius * t * c.x, radius * t * c.y, height * (1 - t)});
    }
  }
  for (Index j = 0; j < segments; ++j) s.faces.push_back({0, 1 + j, 1 + (j + 1) % segments});
  for (Index i = 1; i < rings; ++i) join_rings(s.faces, 1 + i * segments, 1 + (i - 1) * segments, segments);
  return s;
}

Shape cylinder(Index rings, Index segments, double radius, double height) {
  require(rings >= 1 && segments >= 3, "a cylinder needs at least 1 ring and 3 segments");
  check_count((std::uint64_t{rings} + 1) * segments, 2 * std::uint64_t{rings} * segments);
  Shape s;
  make_room(s, (std::uint64_t{rings} + 1) * segments, 2 * std::uint64_t{rings} * segments);
  Poll poll;
  for (Index i = 0; i <= rings; ++i) {
    for (Index j = 0; j < segments; ++j) {
      poll();
      const Vec2 c = turn(j, segments);
      s.positions.push_back({radius * c.x, radius * c.y, height * share(i, rings)});
    }
  }
  for (Index i = 0; i < rings; ++i) join_rings(s.faces, i * segments, (i + 1) * segments, segments);
  return s;
}

Shape torus(Index major_segments, Index minor_segments, double major_radius, double minor_radius) {
  require(major_segments >= 3 && minor_segments >= 3, "a torus needs at least 3 segments both ways");
  check_count(std::uint64_t{major_segments} * minor_segments, 2 * std::uint64_t{major_segments} * minor_segments);
  Shape s;
  make_room(s, std::uint64_t{major_segments} * minor_segments, 2 * std::uint64_t{major_segments} * minor_segments);
  Poll poll;
  for (Index i = 0; i < major_segments; ++i) {
    const Vec2 a = turn(i, major_segments);
    for (Index j = 0; j < minor_segments; ++j) {
      poll();
      const Vec2 b = turn(j, minor_segments);
      const double r = major_radius + minor_radius * b.x;
      s.positions.push_back({r * a.x, r * a.y, minor_radius * b.y});
    }
  }
  for (Index i = 0; i < major_segments; ++i) {
    join_rings(s.faces, (i + 1) % major_segments * minor_segments, i * minor_segments, minor_segments);
  }
  return s;
}

Shape folded_sphere(Index levels, double folds, double depth, std::uint64_t seed) {
  require(depth >= 0 && depth < 1, "the depth of the folds must be in [0, 1)");
  constexpr double kNoiseCellsPerRadius = 1.5;
  const ValueNoise noise(seed);
  Shape s = icosphere(levels);
  Poll poll;
  for (Vec3& p : s.positions) {
    poll();
    p = (1 + depth * turn(folds * noise(kNoiseCellsPerRadius * p)).y) * p;
  }
  return s;
}

Shape book(Index pages, Index columns, Index rows) {
  require(pages > 0 && columns > 0 && rows > 0, "a book needs at least one page of one cell");
  check_count((std::uint64_t{pages} * columns + 1) * (std::uint64_t{rows} + 1),
              2 * std::uint64_t{pages} * columns * rows);
  Shape s;
  make_room(s, (std::uint64_t{pages} * columns + 1) * (std::uint64_t{rows} + 1),
            2 * std::uint64_t{pages} * columns * rows);
  Poll poll;
  for (Index y = 0; y <= rows; ++y) s.positions.push_back({0, 0, share(y, rows)});
  for (Index page = 0; page < pages; ++page) {
    const Vec2 direction = turn(page, pages);
    const Index first = static_cast<Index>(s.positions.size());
    for (Index y = 0; y <= rows; ++y) {
      for (Index x = 1; x <= columns; ++x) {
        poll();
        const double r = share(x, columns);
        s.positions.push_back({r * direction.x, r * direction.y, share(y, rows)});
      }
    }
    const auto vertex = [&](Index x, Index y) { return x == 0 ? y : first + y * columns + x - 1; };
    add_quads(s.faces, columns, rows, poll, vertex);
  }
  return s;
}

Shape bow_tie(Index fans, Index segments) {
  require(fans > 0 && segments >= 3, "a bow tie needs at least one fan of 3 segments");
  check_count(std::uint64_t{fans} * segments + 1, std::uint64_t{fans} * segments);
  Shape s;
  make_room(s, std::uint64_t{fans} * segments + 1, std::uint64_t{fans} * segments);
  Poll poll;
  s.positions.push_back({0, 0, 0});
  for (Index fan = 0; fan < fans; ++fan) {
    const Vec2 axis = turn(fan, fans);
    const Index first = static_cast<Index>(s.positions.size());
    for (Index j = 0; j < segments; ++j) {
      // A flat cone around the axis: its rim is narrow enough for the fans to stay apart.
      poll();
      const Vec2 rim = turn(j, segments);
      const double side = rim.x / fans;
      s.positions.push_back({axis.x - side * axis.y, axis.y + side * axis.x, rim.y});
    }
    for (Index j = 0; j < segments; ++j) s.faces.push_back({0, first + j, first + (j + 1) % segments});
  }
  return s;
}

}  // namespace brushfire::shapes
