// Mesh: validation, lazily derived arrays, intrinsic geometry.
#include <brushfire/mesh/mesh.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/lazy.h>
#include <brushfire/core/detail/planar.h>
#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/checked_copy.h>
#include <brushfire/mesh/detail/connectivity.h>
#include <brushfire/mesh/detail/face_geometry.h>
#include <brushfire/mesh/detail/geometry.h>
#include <brushfire/mesh/detail/kept_array.h>
#include <brushfire/mesh/detail/report.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

namespace brushfire {

using detail::checked_copy, detail::unit_from_positions, detail::geometry_from_positions;
using detail::kMostCoordinate, detail::KeptArray, detail::Geometry, detail::length_of, detail::scaled_difference;

// What the caller gave, and what follows from the faces alone; shared by meshes that differ in slits only.
struct Mesh::Arrays {
  Index vertex_count = 0;
  bool has_positions = true;
  detail::KeptArray<Vec3> positions;
  Box bounds;  // of the positions
  detail::KeptArray<Face> faces;
  std::vector<double> input_lengths;  // [halfedge_count], meshes from lengths only

  Lazy<detail::VertexCorners> corners;
  mutable std::atomic<bool> searched = false;  // first_corner() has been called
};

struct Mesh::Data {
  std::shared_ptr<const Arrays> arrays = std::make_shared<Arrays>();
  std::vector<Index> slits;  // halfedges whose rings are opened

  Lazy<double> unit;
  Lazy<UninitializedArray<Index>> opposite;
  Lazy<std::vector<Link>> links;
  Lazy<Geometry> geometry;
  Lazy<MeshReport> report;

  const detail::VertexCorners& get_corners() const {
    return arrays->corners.get([this] { return detail::build_corners(arrays->vertex_count, arrays->faces); });
  }
  const UninitializedArray<Index>& get_opposite() const {
    return opposite.get([this] {
      UninitializedArray<Index> ring = detail::build_opposite(arrays->faces, get_corners());
      for (const Index h : slits) detail::open_ring(h, ring);
      return ring;
    });
  }
  const std::vector<Link>& get_links() const {
    return links.get([this] { return detail::build_links(arrays->faces, get_corners(), get_opposite()); });
  }
  const Geometry& get_geometry() const {
    return geometry.get([this] {
      return arrays->has_positions ? geometry_from_positions(arrays->positions, arrays->faces, get_unit())
                                   : geometry_from_lengths(arrays->input_lengths);
    });
  }
  double get_unit() const {
    return unit.get([this] {
      return arrays->has_positions ? unit_from_positions(arrays->positions, arrays->faces, arrays->bounds)
                                   : detail::unit_from_lengths(arrays->input_lengths);
    });
  }

  void check_lengths() const;
  Geometry geometry_from_lengths(const std::vector<double>& input_lengths) const;

  // The next halfedge around an edge, and how many there are, looked up in the corners of an end.
  struct EdgeFaces {
    Index next, faces;
  };
  EdgeFaces find_opposite(Index h) const;
  EdgeFaces ring_of(Index h) const;  // from the array
  // Where as many faces meet at both ends, looking for one of them again and again would take longer than the array.
  static constexpr Index kCrowd = 64;
};

namespace {

// How far two faces may disagree on an edge, and a triangle may miss closing, relative to the lengths: room for
// lengths that were written with ten digits.
constexpr double kLengthAgreement = 1e-9;

[[noreturn]] void throw_length_error(Index f, const std::string& what) {
  throw Error(ErrorCode::InvalidMesh, "face " + std::to_string(f) + ": " + what);
}

}  // namespace

// Every face's own lengths; agreement across an edge is checked against the first face of its ring.
void Mesh::Data::check_lengths() const {
  const std::span<const Face> faces = arrays->faces;
  const std::vector<double>& input_lengths = arrays->input_lengths;
  const UninitializedArray<Index>& ring = get_opposite();
  for (Index f = 0; f < faces.size(); ++f) {
    std::array<double, 3> l;
    for (Index k = 0; k < 3; ++k) {
      l[k] = input_lengths[3 * f + k];
      const bool loop = faces[f][k] == faces[f][(k + 1) % 3];
      if (!std::isfinite(l[k]) || l[k] < 0 || (loop && l[k] != 0)) {
        throw_length_error(f, "length " + number_as_text(l[k]) + " of edge " + std::to_string(k) +
                                  (loop ? " between a vertex and itself is not 0" : " is not finite and >= 0"));
      }
      if (l[k] > kMostCoordinate) {
        throw_length_error(f, "length " + number_as_text(l[k]) + " of edge " + std::to_string(k) +
                                  " is beyond 1e298, where sums leave the range of numbers; scale the mesh down");
      }
      const double other = input_lengths[ring[3 * f + k]];
      if (std::abs(l[k] - other) > kLengthAgreement * std::max(l[k], other)) {
        throw_length_error(f, "edge " + std::to_string(k) + " has length " + number_as_text(l[k]) + ", but " +
                                  number_as_text(other) + " in face " + std::to_string(ring[3 * f + k] / 3));
      }
    }
    detail::sort(l.begin(), l.end());
    if (l[2] - (l[0] + l[1]) > kLengthAgreement * l[2]) {
      throw_length_error(f, "lengths break the triangle inequality");
    }
  }
}

Geometry Mesh::Data::geometry_from_lengths(const std::vector<double>& input_lengths) const {
  Geometry g;
  g.lengths.resize(input_lengths.size());
  const UninitializedArray<Index>& ring = get_opposite();
  std::vector<bool> done(input_lengths.size(), false);
  for (Index h = 0; h < input_lengths.size(); ++h) {
    // One length for all faces of an edge: that of the ring's lowest halfedge, which comes first.
    const double length = input_lengths[h] / get_unit();
    for (Index i = h; !done[i]; i = ring[i]) {
      done[i] = true;
      g.lengths[i] = length;
    }
  }
  g.double_areas.resize(arrays->faces.size());
  for (std::size_t f = 0; f < g.double_areas.size(); ++f) {
    const double q = heron_sorted(g.lengths[3 * f], g.lengths[3 * f + 1], g.lengths[3 * f + 2]);
    g.double_areas[f] = q > 0 ? 0.5 * std::sqrt(q) : 0.0;
  }
  return g;
}

Mesh::Data::EdgeFaces Mesh::Data::ring_of(Index h) const {
  const UninitializedArray<Index>& ring = get_opposite();
  EdgeFaces found{ring[h], 1};
  for (Index g = ring[h]; g != h; g = ring[g]) ++found.faces;
  return found;
}

// The halfedges of an edge ascend around its ring, and with the corners at either of its ends.
Mesh::Data::EdgeFaces Mesh::Data::find_opposite(Index h) const {
  EdgeFaces found{h, 1};
  const Index f = face_of(h), corner = h - 3 * f;
  const Face& own = arrays->faces[f];
  if (own[0] == own[1] || own[1] == own[2] || own[2] == own[0]) return found;
  const detail::VertexCorners& all = get_corners();
  Index v = own[corner], w = own[corner == 2 ? 0 : corner + 1];
  if (all.count(v) > kCrowd) {
    if (all.count(w) > kCrowd) return ring_of(h);
    std::swap(v, w);
  }
  Index lowest = h, higher = kNoIndex;
  for (Index i = all.offset[v]; i < all.offset[v + 1]; ++i) {
    const Index other_face = face_of(all.corner[i]);
    const Face& t = arrays->faces[other_face];
    const bool has_w = (t[0] == w) | (t[1] == w) | (t[2] == w);
    if (!has_w || other_face == f || t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    const Index k = all.corner[i] - 3 * other_face;
    const Index other = t[k == 2 ? 0 : k + 1] == w ? all.corner[i] : previous(all.corner[i]);
    ++found.faces;
    lowest = std::min(lowest, other);
    if (other > h) higher = std::min(higher, other);
  }
  found.next = higher != kNoIndex ? higher : lowest;
  return found;
}

Mesh::Mesh() : data_(std::make_shared<Data>()) {}
Mesh::Mesh(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

Mesh::Mesh(std::span<const Vec3> positions, std::span<const Face> faces) {
  auto arrays = std::make_shared<Arrays>();
  arrays->positions = KeptArray(checked_copy(positions, arrays->bounds));
  arrays->vertex_count = static_cast<Index>(positions.size());
  arrays->faces = KeptArray(checked_copy(arrays->vertex_count, faces));
  auto data = std::make_shared<Data>();
  data->arrays = std::move(arrays);
  data_ = std::move(data);
}

Mesh::Mesh(std::vector<Vec3>&& positions, std::vector<Face>&& faces) {
  auto arrays = std::make_shared<Arrays>();
  arrays->bounds = detail::check(positions);
  arrays->vertex_count = static_cast<Index>(positions.size());
  detail::check(arrays->vertex_count, faces);
  arrays->positions = KeptArray(std::move(positions));
  arrays->faces = KeptArray(std::move(faces));
  auto data = std::make_shared<Data>();
  data->arrays = std::move(arrays);
  data_ = std::move(data);
}

Mesh Mesh::from_lengths(Index vertex_count, std::span<const Face> faces,
                        std::span<const std::array<double, 3>> lengths) {
  if (lengths.size() != faces.size()) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(faces.size()) + " faces, but lengths for " +
                                                std::to_string(lengths.size()) + ": one triple per face is needed");
  }
  auto arrays = std::make_shared<Arrays>();
  arrays->vertex_count = vertex_count;
  arrays->has_positions = false;
  arrays->faces = KeptArray(checked_copy(vertex_count, faces));
  arrays->input_lengths.reserve(3 * lengths.size());
  for (const auto& l : lengths) arrays->input_lengths.insert(arrays->input_lengths.end(), l.begin(), l.end());
  auto data = std::make_shared<Data>();
  data->arrays = std::move(arrays);
  data->check_lengths();
  return Mesh(std::move(data));
}

Mesh Mesh::with_slits(std::span<const Index> halfedges) const {
  for (const Index h : halfedges) {
    if (h >= halfedge_count()) {
      throw Error(ErrorCode::IndexOutOfRange, "halfedge " + std::to_string(h) + " does not exist: the mesh has " +
                                                  std::to_string(halfedge_count()));
    }
  }
  auto data = std::make_shared<Data>();
  data->arrays = data_->arrays;
  data->slits = data_->slits;
  data->slits.insert(data->slits.end(), halfedges.begin(), halfedges.end());
  return Mesh(std::move(data));
}

Mesh Mesh::renumbered(std::span<const Index> vertices, std::span<const Index> vertex_rank,
                      std::span<const Index> face_rank) const {
  const Arrays& old = *data_->arrays;
  auto arrays = std::make_shared<Arrays>();
  arrays->vertex_count = old.vertex_count;
  arrays->has_positions = old.has_positions;
  arrays->bounds = old.bounds;
  const std::span<const Vec3> old_positions = old.positions;
  UninitializedArray<Vec3> positions(old_positions.size());
  prefault(positions);
  in_pieces(positions.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) positions[i] = old_positions[vertices[i]];
  });
  arrays->positions = KeptArray(std::move(positions));
  const std::span<const Face> old_faces = old.faces;
  UninitializedArray<Face> faces(old_faces.size());
  prefault(faces);
  arrays->input_lengths.resize(old.input_lengths.size());
  in_pieces(old_faces.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Face& t = old_faces[f];
      faces[face_rank[f]] = {vertex_rank[t[0]], vertex_rank[t[1]], vertex_rank[t[2]]};
    }
  });
  arrays->faces = KeptArray(std::move(faces));
  if (!has_positions()) {
    for (std::size_t f = 0; f < old_faces.size(); ++f) {
      const std::size_t from = 3 * f, to = 3 * std::size_t{face_rank[f]};
      for (std::size_t k = 0; k < 3; ++k) arrays->input_lengths[to + k] = unit() * lengths()[from + k];
    }
  }
  auto data = std::make_shared<Data>();
  data->arrays = std::move(arrays);
  data->unit.set(unit());
  for (const Index h : data_->slits) data->slits.push_back(3 * face_rank[h / 3] + h % 3);
  return Mesh(std::move(data));
}

Mesh Mesh::with_faces(std::span<const Index> faces) const {
  const Arrays& old = *data_->arrays;
  auto arrays = std::make_shared<Arrays>();
  arrays->vertex_count = old.vertex_count;
  arrays->has_positions = old.has_positions;
  arrays->bounds = old.bounds;
  arrays->positions = old.positions;
  UninitializedArray<Face> kept(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    kept[i] = old.faces[faces[i]];
    for (std::size_t k = 0; k < 3 && !has_positions(); ++k) {
      arrays->input_lengths.push_back(unit() * lengths()[3 * std::size_t{faces[i]} + k]);
    }
  }
  arrays->faces = KeptArray(std::move(kept));
  auto data = std::make_shared<Data>();
  data->arrays = std::move(arrays);
  data->unit.set(unit());
  // A slit is named by any of the halfedges over its edge.
  for (const Index slit : data_->slits) {
    const Index v = from(slit), w = to(slit);
    for (const Index corner : corners(v)) {
      const auto i = std::lower_bound(faces.begin(), faces.end(), face_of(corner));
      if (i == faces.end() || *i != face_of(corner)) continue;
      const Index h = 3 * static_cast<Index>(i - faces.begin()) + corner % 3;
      if (to(corner) == w) data->slits.push_back(h);
      if (from(previous(corner)) == w) data->slits.push_back(previous(h));
    }
  }
  return Mesh(std::move(data));
}

Index Mesh::vertex_count() const noexcept { return data_->arrays->vertex_count; }
Index Mesh::face_count() const noexcept { return static_cast<Index>(data_->arrays->faces.size()); }
bool Mesh::has_positions() const noexcept { return data_->arrays->has_positions; }
bool Mesh::has_slits() const noexcept { return !data_->slits.empty(); }
std::span<const Vec3> Mesh::positions() const noexcept { return data_->arrays->positions; }
std::span<const Face> Mesh::faces() const noexcept { return data_->arrays->faces; }
const Box& Mesh::bounds() const noexcept { return data_->arrays->bounds; }
std::span<const Index> Mesh::opposite() const { return data_->get_opposite(); }
std::span<const Link> Mesh::links() const { return data_->get_links(); }
Index Mesh::opposite(Index h) const {
  return data_->slits.empty() && !data_->opposite.ready() ? data_->find_opposite(h).next : data_->get_opposite()[h];
}
double Mesh::unit() const { return data_->get_unit(); }
std::span<const double> Mesh::lengths() const { return data_->get_geometry().lengths; }
std::span<const double> Mesh::double_areas() const { return data_->get_geometry().double_areas; }

Mesh::FaceGeometry Mesh::face_geometry(Index f) const {
  const Data& d = *data_;
  if (d.geometry.ready() || !d.arrays->has_positions) {
    const Geometry& g = d.get_geometry();
    return {{g.lengths[3 * f], g.lengths[3 * f + 1], g.lengths[3 * f + 2]}, g.double_areas[f]};
  }
  return detail::geometry_of(d.arrays->positions, d.arrays->faces[f], 1 / d.get_unit());
}

Index Mesh::neighbour(Index h) const {
  if (data_->slits.empty() && !data_->opposite.ready()) {
    const Data::EdgeFaces edge = data_->find_opposite(h);
    return edge.faces == 2 ? edge.next : h;
  }
  const Index g = opposite(h);
  return opposite(g) == h ? g : h;
}

double Mesh::length(Index h) const {
  if (data_->geometry.ready() || !has_positions()) return lengths()[h];
  return length_of(scaled_difference(positions()[from(h)], positions()[to(h)], 1 / unit()));
}

double Mesh::double_area(Index f) const { return face_geometry(f).double_area; }

Index Mesh::first_corner(Index v) const {
  Index first = kNoIndex;
  if (data_->arrays->corners.ready() || data_->arrays->searched.exchange(true)) {
    for (const Index h : corners(v)) {
      if (is_face_usable(face_of(h))) return h;
      first = std::min(first, h);
    }
    return first;
  }
  for (Index f = 0; f < face_count(); ++f) {
    const Face& t = faces()[f];
    if ((t[0] != v) & (t[1] != v) & (t[2] != v)) continue;
    const Index h = 3 * f + (t[0] == v ? 0 : t[1] == v ? 1 : 2);
    if (is_face_usable(f)) return h;
    first = std::min(first, h);
  }
  return first;
}

std::span<const Index> Mesh::corner_offsets() const { return data_->get_corners().offset; }
std::span<const Index> Mesh::all_corners() const { return data_->get_corners().corner; }

std::span<const Index> Mesh::corners(Index v) const {
  const detail::VertexCorners& c = data_->get_corners();
  return std::span(c.corner).subspan(c.offset[v], c.offset[v + 1] - c.offset[v]);
}

double Mesh::corner_angle(Index h) const {
  const std::span<const double> l = lengths();
  const double a = l[h], b = l[previous(h)], c = l[next(h)];
  // Both arguments are scaled by the same 2ab: cosine from lengths, sine from the area, so flat corners keep digits.
  const double cosine = 0.5 * (a * a + b * b - c * c);
  const double sine = double_areas()[face_of(h)];
  if (cosine == 0 && sine == 0) return a == 0 && b == 0 ? kPi / 3 : 0.5 * kPi;
  return std::atan2(sine, cosine);
}

const MeshReport& Mesh::report() const {
  return data_->report.get([this] { return detail::build_report(*this); });
}

}  // namespace brushfire
