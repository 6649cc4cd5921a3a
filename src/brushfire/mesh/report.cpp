// Counts what is in a mesh, and says it.
#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/mesh/detail/disjoint_sets.h>
#include <brushfire/mesh/detail/point_grid.h>
#include <brushfire/mesh/detail/report.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace brushfire {
namespace {

Index count_components(const Mesh& mesh) {
  detail::DisjointSets sets(mesh.vertex_count());
  Poll poll;
  for (const Face& t : mesh.faces()) {
    poll();
    sets.unite(t[0], t[1]);
    sets.unite(t[1], t[2]);
  }
  Index count = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) count += sets.find(v) == v && !mesh.corners(v).empty();
  return count;
}

// Millions of comparisons take seconds: every some thousand of them look whether to go on.
template <class T>
void sort_listening(std::vector<T>& items) {
  Poll poll(std::size_t{1} << 16);
  detail::sort(items.begin(), items.end(), [&](const T& a, const T& b) {
    poll();
    return a < b;
  });
}

// Faces that name the same three vertices as one before them, found by sorting.
Index count_duplicate_faces(const Mesh& mesh) {
  std::vector<Face> sorted(mesh.faces().begin(), mesh.faces().end());
  for (Face& t : sorted) detail::sort(t.begin(), t.end());
  sort_listening(sorted);
  Index count = 0;
  for (std::size_t f = 1; f < sorted.size(); ++f) count += sorted[f] == sorted[f - 1];
  return count;
}

Index count_duplicate_positions(const Mesh& mesh) {
  // Compared bit by bit after + 0.0, which turns -0 into 0.
  std::vector<std::array<std::uint64_t, 3>> keys;
  keys.reserve(mesh.positions().size());
  for (const Vec3& p : mesh.positions()) {
    keys.push_back({std::bit_cast<std::uint64_t>(p.x + 0.0), std::bit_cast<std::uint64_t>(p.y + 0.0),
                    std::bit_cast<std::uint64_t>(p.z + 0.0)});
  }
  sort_listening(keys);
  Index count = 0;
  for (std::size_t v = 1; v < keys.size(); ++v) count += keys[v] == keys[v - 1];
  return count;
}

// What lies nearer than this part of an edge is meant to be one place: files cut their digits, and CAD programs mesh
// each sheet on its own.
constexpr double kNear = 1e-3;

double shortest_edge_at(const Mesh& mesh, Index v) {
  double shortest = kInfinity;
  for (const Index h : mesh.corners(v)) {
    for (const Index side : {h, Mesh::previous(h)}) {
      const double length = mesh.length(side);
      if (length > 0) shortest = std::min(shortest, length);
    }
  }
  return shortest * mesh.unit();
}

bool are_joined(const Mesh& mesh, Index v, Index w) {
  const auto corners = mesh.corners(v);
  return std::any_of(corners.begin(), corners.end(),
                     [&](Index h) { return mesh.to(h) == w || mesh.from(Mesh::previous(h)) == w; });
}

void count_near_positions(const Mesh& mesh, MeshReport& r) {
  if (!mesh.has_positions() || r.boundary_edges == 0 || r.looks_like_soup) return;
  const auto opposite = mesh.opposite();
  std::vector<bool> is_boundary(mesh.vertex_count(), false);
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (opposite[h] == h && mesh.is_face_usable(Mesh::face_of(h))) {
      is_boundary[mesh.from(h)] = is_boundary[mesh.to(h)] = true;
    }
  }
  detail::PointGrid grid(mesh.positions(), kNear * r.mean_edge_length);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (is_boundary[v]) grid.add(v);
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!is_boundary[v]) continue;
    double nearest = kInfinity;
    grid.for_each_near(mesh.positions()[v], [&](Index w, double d) {
      if (d == 0 || d >= nearest || are_joined(mesh, v, w)) return;
      if (d < kNear * std::min(shortest_edge_at(mesh, v), shortest_edge_at(mesh, w))) nearest = d;
    });
    if (nearest == kInfinity) continue;
    ++r.near_positions;
    r.near_tolerance = std::max(r.near_tolerance, nearest);
  }
}

void count_edges(const Mesh& mesh, MeshReport& r) {
  const auto opposite = mesh.opposite();
  const auto lengths = mesh.lengths();
  double sum = 0;
  Poll poll;
  std::vector<bool> met(mesh.halfedge_count(), false);  // in the ring of an edge that is already counted
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    poll();
    if (met[h] || !mesh.is_face_usable(Mesh::face_of(h))) continue;
    Index faces = 0;
    for (Index g = h; !met[g]; g = opposite[g]) {
      met[g] = true;
      ++faces;
    }
    ++r.edges;
    sum += lengths[h];
    r.zero_length_edges += lengths[h] == 0;
    r.boundary_edges += faces == 1;
    r.nonmanifold_edges += faces > 2;
    r.misoriented_edges += faces == 2 && mesh.from(h) == mesh.from(opposite[h]);
  }
  r.mean_edge_length = r.edges > 0 ? sum / r.edges * mesh.unit() : 0;
}

void measure_geometry(const Mesh& mesh, MeshReport& r) {
  const auto lengths = mesh.lengths();
  const auto areas = mesh.double_areas();
  const double unit = mesh.unit();
  Poll poll;
  double area = 0, shortest = kInfinity, longest = 0, flattest = 1;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    poll();
    if (!mesh.is_face_usable(f)) {
      ++r.repeated_index_faces;
      continue;
    }
    double face_longest = 0;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      shortest = std::min(shortest, lengths[h]);
      face_longest = std::max(face_longest, lengths[h]);
    }
    longest = std::max(longest, face_longest);
    area += 0.5 * areas[f];
    if (areas[f] == 0) {
      ++r.zero_area_faces;
    } else {
      flattest = std::min(flattest, areas[f] / (face_longest * face_longest));
    }
  }
  r.min_edge_length = r.edges > 0 ? shortest * unit : 0;
  r.max_edge_length = longest * unit;
  r.area = area * unit * unit;
  constexpr double kPrecisionWithPositions = 1e-12;
  r.length_precision =
      mesh.has_positions() ? kPrecisionWithPositions : 64 * std::numeric_limits<double>::epsilon() / flattest;
}

// Two digits, and no less than the value, which is positive.
std::string rounded_up(double value) {
  constexpr double kLeastExponent = -300;  // whose power of ten is far from infinite
  const double exponent = std::max(std::floor(std::log10(value)) - 1, kLeastExponent);
  // Divided by where it is small: what 1e22 and less divide has one rounding only.
  const double scale = std::pow(10.0, std::abs(exponent));
  const auto number = [&](double digits) { return exponent < 0 ? digits / scale : digits * scale; };
  double digits = std::floor(exponent < 0 ? value * scale : value / scale);
  while (number(digits) < value) ++digits;
  return number_as_text(number(digits));
}

std::string counted(Index n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

}  // namespace

namespace detail {

MeshReport build_report(const Mesh& mesh) {
  MeshReport r;
  r.vertices = mesh.vertex_count();
  r.faces = mesh.face_count();
  r.components = count_components(mesh);
  count_edges(mesh, r);
  measure_geometry(mesh, r);
  Index isolated = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    isolated += mesh.corners(v).empty();
    r.nonmanifold_vertices += mesh.links()[v] == Link::Other;
  }
  r.isolated_vertices = isolated;
  r.duplicate_faces = count_duplicate_faces(mesh);
  r.duplicate_positions = count_duplicate_positions(mesh);
  r.looks_like_soup = 2 * r.boundary_edges > r.edges && 2 * r.duplicate_positions > r.vertices;
  count_near_positions(mesh, r);
  r.euler_characteristic = static_cast<long long>(r.vertices - isolated) - static_cast<long long>(r.edges) +
                           static_cast<long long>(r.faces - r.repeated_index_faces);
  return r;
}

}  // namespace detail

std::vector<std::string> MeshReport::remarks() const {
  std::vector<std::string> out;
  if (faces == 0) out.emplace_back("no faces: every distance is infinite");
  if (looks_like_soup) {
    out.emplace_back("looks like triangle soup (" + std::to_string(duplicate_positions) +
                     " vertices repeat a position): weld equal positions first (--weld 0), or nothing is connected");
  }
  if (components > 1) {
    out.push_back(std::to_string(components) + " components: distances between them are infinite");
  }
  if (isolated_vertices > 0) {
    out.push_back(counted(isolated_vertices, "vertex is", "vertices are") + " in no face and cannot be reached");
  }
  if (nonmanifold_edges > 0) {
    out.push_back(counted(nonmanifold_edges, "edge has", "edges have") + " three or more faces");
  }
  if (nonmanifold_vertices > 0) {
    out.push_back(counted(nonmanifold_vertices, "vertex joins", "vertices join") + " several fans of faces");
  }
  if (boundary_edges > 0) out.push_back(counted(boundary_edges, "boundary edge", "boundary edges"));
  if (misoriented_edges > 0) {
    out.push_back(counted(misoriented_edges, "edge joins", "edges join") + " faces of opposite orientation (harmless)");
  }
  if (duplicate_faces > 0) out.push_back(counted(duplicate_faces, "duplicate face", "duplicate faces"));
  if (repeated_index_faces > 0) {
    out.push_back(counted(repeated_index_faces, "face names", "faces name") + " a vertex twice");
  }
  if (zero_area_faces > 0) out.push_back(counted(zero_area_faces, "face has", "faces have") + " no area");
  if (area == kInfinity || (area == 0 && zero_area_faces < faces)) {
    out.emplace_back(std::string("areas are beyond the range of numbers: the whole reads ") +
                     (area == 0 ? "0" : "infinite"));
  }
  if (zero_length_edges > 0) out.push_back(counted(zero_length_edges, "edge has", "edges have") + " no length");
  if (!looks_like_soup && duplicate_positions > 0) {
    out.push_back(counted(duplicate_positions, "vertex repeats", "vertices repeat") +
                  " the position of another (--weld 0 joins them)");
  }
  if (near_positions > 0) {
    const std::string tolerance = rounded_up(near_tolerance);
    out.push_back(counted(near_positions, "boundary vertex lies", "boundary vertices lie") + " within " + tolerance +
                  " of another without being joined: no way leads across there (--weld " + tolerance + " joins them)");
  }
  constexpr double kUnevenEdges = 1e6;
  if (min_edge_length > 0 && max_edge_length > kUnevenEdges * min_edge_length) {
    out.emplace_back("edge lengths differ by a factor of more than a million");
  }
  return out;
}

}  // namespace brushfire
