// Face records, angle sums, which vertices bend paths, and the cutting into parts.
#include <brushfire/solvers/windows/propagation/structure.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/mesh/detail/connectivity.h>
#include <brushfire/mesh/detail/face_geometry.h>
#include <brushfire/solvers/windows/propagation/around.h>
#include <brushfire/solvers/windows/propagation/fan.h>
#include <brushfire/solvers/windows/store/prefetch.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// Which halfedges are over the same edge, and what the faces around a vertex form: by inner numbers.
struct Connectivity {
  UninitializedArray<Index> opposite;  // [halfedge_count] as Mesh::opposite()
  std::vector<Link> links;             // [vertex_count]
  std::vector<WindowStructure::Crowd> crowds;
};

// Corners that make a crowd.
constexpr Index kCrowd = 64;
// At so many, light that winds round the vertex from face to face would be as many windows as faces squared: they are
// remembered as if the faces were thin.
constexpr Index kWinding = 256;
bool is_winding(const WindowStructure::Crowd& crowd) { return crowd.corners.size() >= kWinding; }
// At more, shortest ways in the link of a vertex take longer than light that goes everywhere.
constexpr Index kManyFaces = 4096;

std::vector<WindowStructure::Crowd> crowds_of(std::span<const Index> offset, std::span<const Index> corner,
                                              const LocalityOrder& order) {
  std::vector<WindowStructure::Crowd> crowds;
  for (std::size_t v = 0; v + 1 < offset.size(); ++v) {
    if (offset[v + 1] - offset[v] <= kCrowd) continue;
    const std::span<const Index> its = corner.subspan(offset[v], offset[v + 1] - offset[v]);
    crowds.push_back({order.vertices[v], {its.begin(), its.end()}, {}});
  }
  detail::sort(crowds.begin(), crowds.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
  return crowds;
}

// Found among renumbered faces: what is near on the surface should be near in memory.
Connectivity connectivity_of(const Mesh& mesh, const LocalityOrder& order) {
  if (mesh.has_slits()) {
    UninitializedArray<Index> face_rank(mesh.face_count());
    for (Index f = 0; f < mesh.face_count(); ++f) face_rank[order.faces[f]] = f;
    const Mesh inner = mesh.renumbered(order.vertices, order.vertex_rank, face_rank);
    const auto opposite = inner.opposite();
    const auto links = inner.links();
    return {{opposite.begin(), opposite.end()},
            {links.begin(), links.end()},
            crowds_of(inner.corner_offsets(), inner.all_corners(), order)};
  }
  UninitializedArray<Face> faces(mesh.face_count());
  prefault(faces);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& t = mesh.faces()[order.faces[f]];
    faces[f] = {order.vertex_rank[t[0]], order.vertex_rank[t[1]], order.vertex_rank[t[2]]};
  }
  const detail::VertexCorners corners = detail::build_corners(mesh.vertex_count(), faces);
  UninitializedArray<Index> opposite = detail::build_opposite(faces, corners);
  std::vector<Link> links = detail::build_links(faces, corners, opposite);
  return {std::move(opposite), std::move(links), crowds_of(corners.offset, corners.corner, order)};
}

// The faces of a mesh in another order, and what comes soon fetched ahead: it may be anywhere.
class FacesInOrder {
 public:
  FacesInOrder(const Mesh& mesh, const LocalityOrder& order)
      : mesh_(mesh), order_(order), faces_(mesh.faces()), positions_(mesh.positions()), scale_(1 / mesh.unit()) {}

  void prefetch_after(Index f) const {
    constexpr Index kSoon = 12, kLater = 24;
    if (f + kLater < faces_.size()) prefetch(&faces_[order_.faces[f + kLater]]);
    if (f + kSoon >= faces_.size()) return;
    for (const Index v : (*this)[f + kSoon]) {
      prefetch(&order_.vertex_rank[v]);
      if (!positions_.empty()) prefetch(&positions_[v]);
    }
  }
  const Face& operator[](Index f) const { return faces_[order_.faces[f]]; }
  FaceShape shape(Index f) const {
    if constexpr (kWide) return shape_of(mesh_, order_.faces[f]);
    const Mesh::FaceGeometry g =
        positions_.empty() ? mesh_.face_geometry(order_.faces[f]) : detail::geometry_of(positions_, (*this)[f], scale_);
    FaceShape shape;
    shape.length = {g.lengths[0], g.lengths[1], g.lengths[2]};
    shape.double_area = g.double_area;
    return shape;
  }

 private:
  const Mesh& mesh_;
  const LocalityOrder& order_;
  std::span<const Face> faces_;
  std::span<const brushfire::Vec3> positions_;
  double scale_;
};

Beyond beyond(std::span<const WindowFace> faces, std::span<const Index> opposite, Index h) {
  const Index other = opposite[h];
  if (other == h || !faces[h / 3].usable) return Beyond::Nothing;
  const bool other_way = faces[other / 3].vertex[other % 3] == faces[h / 3].vertex[next3(h % 3)];
  return opposite[other] == h && other_way ? Beyond::Face : Beyond::Several;
}

// What is typical of a mesh is found in as many places, more or less.
constexpr std::size_t kSample = 4096;

double median(std::span<double> numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

// Widths of buckets, and whether faces are needles as a rule.
struct Typical {
  double bucket = 1;
  bool needles = false;
};

// Half the median edge (of a sample): the mean says nothing where few long edges stand beside many short ones. Less
// where faces are needles: all that goes along a rim of thousands of short edges would fall into one bucket, come in
// any order, and have to be corrected again and again. No less than a share of it: every bucket is a round of all
// parts.
Typical typical_of(std::span<const WindowFace> faces) {
  constexpr double kShortEdges = 64, kLeastShare = 0x1p-10;
  std::vector<double> edges, shortest;
  const std::size_t stride = std::max<std::size_t>(1, 3 * faces.size() / kSample);
  for (std::size_t h = 0; h < 3 * faces.size(); h += stride) {
    const WindowFace& f = faces[h / 3];
    const double length = to_double(f.length[h % 3]);
    if (!(length > 0)) continue;
    edges.push_back(length);
    shortest.push_back(to_double(std::min({f.length[0], f.length[1], f.length[2]})));
  }
  if (edges.empty()) return {};
  const double edge = median(edges), width = std::clamp(kShortEdges * median(shortest), kLeastShare * edge, edge);
  return {0.5 * width, width < edge};
}

// By how much the angles around a vertex differ from 2 pi, in the median (of a sample): large ones at a few corners and
// creases say nothing about the rest.
double typical_deficit_of(std::span<const Around> around, std::span<const VertexType> vertex_type,
                          std::span<const Link> links) {
  std::vector<double> sample;
  const std::size_t stride = std::max<std::size_t>(1, around.size() / kSample);
  for (std::size_t v = 0; v < around.size(); v += stride) {
    if (vertex_type[v] == VertexType::Full || links[v] != Link::Circle) continue;
    sample.push_back(abs(2 * kPi - around[v].angles.value()));
  }
  return sample.empty() ? 0 : median(sample);
}

// Every face's record, and what its corners add to their vertices.
void fill_faces(WindowStructure& s, std::span<const Index> opposite, std::span<Around> around) {
  const FacesInOrder outer(s.mesh, s.order);
  Poll poll;
  for (Index f = 0; f < s.mesh.face_count(); ++f) {
    poll();
    outer.prefetch_after(f);
    WindowFace& face = s.faces[f];
    const FaceShape shape = outer.shape(f);
    face.double_area = shape.double_area;
    face.set_feet(shape);
    face.waiting = kNoIndex;
    face.has_target = false;
    face.usable = s.mesh.is_face_usable(s.order.faces[f]);
    const Real base = std::max({shape.length[0], shape.length[1], shape.length[2]});
    s.unevenness.add(to_double(shape.length[0]), to_double(shape.length[1]), to_double(shape.length[2]),
                     to_double(shape.double_area));
    face.thin = face.double_area <= kThin * base * base;
    for (Index k = 0; k < 3; ++k) {
      face.length[k] = shape.length[k];
      face.vertex[k] = s.inner_vertex(outer[f][k]);
      face.opposite[k] = opposite[3 * f + k];
    }
    // No area, no angle: light goes everywhere from there.
    const bool has_angles = face.usable && face.double_area > kNoArea * base * base;
    for (Index k = 0; k < 3; ++k) {
      if (has_angles) {
        around[face.vertex[k]].add(face, k);
      } else {
        s.vertex_type[face.vertex[k]] = VertexType::Full;
      }
    }
  }
}

// What is beyond every edge, and whether three faces meet at any.
void find_neighbours(WindowStructure& s, std::span<const Index> opposite) {
  bool any_several = false;
  for (Index h = 0; h < s.mesh.halfedge_count(); ++h) {
    const Beyond there = beyond(s.faces, opposite, h);
    any_several |= there == Beyond::Several;
    s.faces[h / 3].beyond[h % 3] = there;
  }
  for (Index h = 0; h < s.mesh.halfedge_count() && any_several && !s.has_spines; ++h)
    s.has_spines = opposite[opposite[h]] != h;
}

void find_vertex_types(WindowStructure& s, std::span<const Link> links, std::span<const Around> around) {
  // The vertices of a crowd's rim are as uneven as it has faces, and if all of them sent light everywhere, that would
  // be as many windows as faces squared.
  const bool crowded = std::any_of(s.crowds.begin(), s.crowds.end(), is_winding);
  const auto never_bends = [&](std::size_t v) {
    const double straight = links[v] == Link::Circle ? 2 * kPi : links[v] == Link::Arc ? kPi : 0;
    return crowded && around[v].is_surely_below(straight, s.unevenness.ratio());
  };
  for (std::size_t v = 0; v < around.size(); ++v) {
    VertexType& type = s.vertex_type[v];
    if (around[v].is_uneven() && !never_bends(v)) type = VertexType::Full;
    if (type == VertexType::Full) continue;
    if (links[v] == Link::Other) type = VertexType::Fans;
    if (links[v] == Link::Circle && around[v].angles.exceeds_two_pi()) type = VertexType::Saddle;
    if (links[v] == Link::Arc && around[v].angles.exceeds_pi()) type = VertexType::Boundary;
  }
}

// Corners part by part, and what is done otherwise at vertices of so many faces.
void settle_crowds(WindowStructure& s) {
  std::vector<std::tuple<Index, Index, Index>> by_part;
  for (WindowStructure::Crowd& c : s.crowds) {
    if (is_winding(c)) {
      s.has_needles = true;
      for (const Index h : c.corners) s.faces[h / 3].thin = true;
      s.wheels.add(s.faces, c.corners.front());
    }
    by_part.clear();
    for (const Index h : c.corners) by_part.emplace_back(s.part_of_face(h / 3), s.outer_halfedge(h), h);
    detail::sort(by_part.begin(), by_part.end());
    for (std::size_t i = 0; i < by_part.size(); ++i) c.corners[i] = std::get<2>(by_part[i]);
    VertexType& its = s.vertex_type[s.order.vertex_rank[c.vertex]];
    if (its == VertexType::Fans && c.corners.size() > kManyFaces) its = VertexType::Full;
  }
}

}  // namespace

double angle_at(const WindowFace& f, Index i) {
  const Vec2 opening = opening_at(f, i);
  return std::atan2(to_double(opening.y), to_double(opening.x));
}

// In a part faces are in the order of their least vertices, those of one vertex in the mesh's order.
Index WindowStructure::inner_face(Index f) const {
  const Face& t = mesh.faces()[f];
  // A corner, in each of the parts that may hold the face: of one that is in one part only, if there is any.
  Index k = 0;
  while (k < 2 && partition.next_ghost(inner_vertex(t[k])) != kNoIndex) ++k;
  Index first = inner_vertex(t[k]);
  while (true) {
    const Index part = part_of_vertex(first);
    const std::array<Index, 3> v{first, ghost_in(part, inner_vertex(t[next3(k)])),
                                 ghost_in(part, inner_vertex(t[previous3(k)]))};
    const Index least = std::min({v[0], v[1], v[2]});
    const auto key = [&](Index inner) {
      const WindowFace& face = faces[inner];
      return std::pair(std::min({face.vertex[0], face.vertex[1], face.vertex[2]}), order.faces[inner]);
    };
    Index low = partition.first_face(part), high = partition.end_face(part);
    while (high - low > 1) {
      const Index middle = low + (high - low) / 2;
      (key(middle) <= std::pair(least, f) ? low : high) = middle;
    }
    if (order.faces[low] == f) return low;
    first = partition.next_ghost(first);
  }
}

Index WindowStructure::ghost_in(Index part, Index v) const {
  if (partition.is_in(part, v)) return v;
  if (const Crowd* crowd = crowd_at(v)) return crowd->ghosts.empty() ? kNoIndex : crowd->ghosts[part];
  return partition.ghost_in(part, v);
}

const WindowStructure::Crowd* WindowStructure::crowd_at(Index v) const {
  if (crowds.empty()) return nullptr;
  const Index outer = outer_vertex(v);
  const auto c = std::lower_bound(crowds.begin(), crowds.end(), outer,
                                  [](const Crowd& crowd, Index x) { return crowd.vertex < x; });
  return c != crowds.end() && c->vertex == outer ? &*c : nullptr;
}

std::span<const Index> WindowStructure::corners_of(Index v, std::vector<Index>& room) const {
  if (const Crowd* crowd = crowd_at(v)) return crowd->corners;
  room.clear();
  for (const Index corner : mesh.corners(outer_vertex(v))) room.push_back(inner_halfedge(corner));
  return room;
}

std::span<const Index> WindowStructure::corners_of(Index v, Index part, std::vector<Index>& room) const {
  if (const Crowd* crowd = crowd_at(v)) {
    const auto begin_of = [&](Index p) {
      return std::lower_bound(crowd->corners.begin(), crowd->corners.end(), p,
                              [this](Index h, Index number) { return part_of_face(h / 3) < number; });
    };
    return {begin_of(part), begin_of(part + 1)};
  }
  room.clear();
  for (const Index corner : mesh.corners(outer_vertex(v))) {
    const Index h = inner_halfedge(corner);
    if (part_of_face(h / 3) == part) room.push_back(h);
  }
  return room;
}

WindowStructure::WindowStructure(const Mesh& m, unsigned bits)
    : mesh(m), order(locality_order(m)), partition(m.vertex_count(), m.face_count(), bits) {
  auto [opposite, links, its_crowds] = connectivity_of(mesh, order);
  crowds = std::move(its_crowds);
  faces.resize(mesh.face_count());
  vertex_type.assign(mesh.vertex_count(), VertexType::None);
  std::vector<Around> around(mesh.vertex_count());
  fill_faces(*this, opposite, around);
  find_neighbours(*this, opposite);
  find_vertex_types(*this, links, around);
  settle_crowds(*this);
  const Typical typical = typical_of(faces);
  bucket_width = typical.bucket;
  has_needles |= typical.needles;
  typical_deficit = typical_deficit_of(around, vertex_type, links);
  cut_into_parts();
}

// From numbers by place in the order to numbers by part, and by place within a part.
void WindowStructure::cut_into_parts() {
  if (faces.empty() || part_of_face(static_cast<Index>(faces.size()) - 1) == 0) return;
  renumber(partition.number_vertices(mesh.vertex_count(), [&](Index f) -> Index(&)[3] { return faces[f].vertex; }));
  find_ghosts_of_crowds();
}

std::span<WindowFace> WindowStructure::faces_of(Index part) {
  const Index begin = partition.first_face(part);
  return std::span(faces).subspan(begin, partition.end_face(part) - begin);
}

void WindowStructure::renumber(const std::vector<Index>& places) {
  UninitializedArray<Index> outer(places.size());
  std::vector<VertexType> types(places.size());
  for (std::size_t v = places.size(); v-- > 0;) {
    outer[v] = order.vertices[places[v]];
    types[v] = vertex_type[places[v]];
    order.vertex_rank[outer[v]] = static_cast<Index>(v);  // its number in the first part comes last
  }
  order.vertices = std::move(outer);
  vertex_type = std::move(types);
}

void WindowStructure::find_ghosts_of_crowds() {
  for (Crowd& crowd : crowds) {
    const Index first = order.vertex_rank[crowd.vertex];
    if (partition.next_ghost(first) == kNoIndex) continue;
    crowd.ghosts.assign(part_count(), kNoIndex);
    Index v = first;
    do {
      crowd.ghosts[part_of_vertex(v)] = v;
      v = partition.next_ghost(v);
    } while (v != first);
  }
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
