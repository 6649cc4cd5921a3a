// Voronoi cells from one common field and the sources' own fields along the borders.
#include <brushfire/queries/voronoi.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/detail/walls.h>
#include <brushfire/solvers/weighted/weighting.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace brushfire {
namespace {

std::vector<SharedFace> border_faces(const Mesh& mesh, const VoronoiDiagram& diagram) {
  std::vector<SharedFace> faces;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.faces()[f];
    const std::array<Index, 3> label{diagram.source[a], diagram.source[b], diagram.source[c]};
    if (label[0] == label[1] && label[1] == label[2]) continue;
    if (!mesh.is_face_usable(f) || std::find(label.begin(), label.end(), kNoIndex) != label.end()) continue;
    faces.push_back({f, label, {}});
  }
  return faces;
}

// Fills in the distances: every source runs once, as far as the border faces of its cell need it.
void measure(const Mesh& mesh, const detail::WalledRun& sources, const DistanceOptions& options,
             const VoronoiDiagram& diagram, std::vector<SharedFace>& faces) {
  std::vector<std::vector<std::pair<Index, std::size_t>>> of_source(diagram.area.size());  // (border face, corner)
  for (Index i = 0; i < faces.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) of_source[faces[i].label[k]].emplace_back(i, k);
  }
  std::vector<double> distance(mesh.vertex_count(), kInfinity);
  DistanceSolver solver(mesh);
  DistanceOptions run = options;
  run.targets.clear();
  for (std::size_t s = 0; s < of_source.size(); ++s) {
    if (of_source[s].empty()) continue;
    // No corner is farther than the source's own corner of the face and the way along the edge.
    double reach = 0;
    const auto bound = [&](const SharedFace& face, std::size_t from, std::size_t to) {
      const Index own = 3 * face.face + static_cast<Index>(from);
      const Index edge = (from + 1) % 3 == to ? own : Mesh::previous(own);
      const double along = from == to ? 0
                           : options.weighting
                               ? options.weighting->along(face.face, static_cast<Index>(from), static_cast<Index>(to))
                               : mesh.lengths()[edge] * mesh.unit();
      return diagram.distance[mesh.from(own)] + along;
    };
    for (const auto& [i, k] : of_source[s]) {
      for (std::size_t to = 0; to < 3; ++to) reach = std::max(reach, bound(faces[i], k, to));
    }
    run.max_distance = std::max(0.0, reach);
    const SparseField field = solver.distance_sparse(sources.sides_of(s), run);
    for (std::size_t i = 0; i < field.vertex.size(); ++i) distance[field.vertex[i]] = field.distance[i];
    for (const auto& [i, k] : of_source[s]) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Index v = mesh.faces()[faces[i].face][corner];
        faces[i].distance[corner][k] = std::min(distance[v], bound(faces[i], k, corner));
      }
    }
    for (const Index v : field.vertex) distance[v] = kInfinity;
  }
}

// The share of the way from corner a to corner b at which their two sources are equally far.
double crossing(const SharedFace& face, std::size_t a, std::size_t b) {
  // How much nearer each corner's own source is: not less than nothing, whatever the runs' errors say.
  const double at_a = std::max(0.0, face.distance[a][b] - face.distance[a][a]);
  const double at_b = std::max(0.0, face.distance[b][a] - face.distance[b][b]);
  return at_a + at_b > 0 ? at_a / (at_a + at_b) : 0.5;
}

// Where all three sources are equally far; moved into the face where it lies outside.
std::array<double, 3> triple_point(const SharedFace& face) {
  Vec3 first, second;  // the differences of the distances at the corners, which the weights must cancel
  const auto& d = face.distance;
  first = {d[0][0] - d[0][1], d[1][0] - d[1][1], d[2][0] - d[2][1]};
  second = {d[0][0] - d[0][2], d[1][0] - d[1][2], d[2][0] - d[2][2]};
  const Vec3 n = cross(first, second);
  const double sum = n.x + n.y + n.z;
  constexpr double kThird = 1.0 / 3;
  if (!(std::abs(sum) > 0)) return {kThird, kThird, kThird};
  std::array<double, 3> w{std::max(0.0, n.x / sum), std::max(0.0, n.y / sum), std::max(0.0, n.z / sum)};
  const double total = w[0] + w[1] + w[2];
  for (double& x : w) x /= total;
  return w;
}

struct Piece {
  std::array<Index, 2> sources;
  std::array<Index, 2> node;  // lowest halfedge of the edge, or halfedge_count + face: where pieces are joined
  std::array<SurfacePoint, 2> point;
};

// Shares a face out among the cells of its corners, and collects the pieces of border in it.
class FaceDivider {
 public:
  FaceDivider(const Mesh& mesh, std::vector<double>& area) : mesh_(mesh), area_(area) {}

  void divide(const SharedFace& face) {
    const double whole = 0.5 * mesh_.double_areas()[face.face] * mesh_.unit() * mesh_.unit();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      if (face.label[i] != face.label[j]) continue;
      // Corner k against the two others.
      const double share = crossing(face, k, i) * crossing(face, k, j);
      area_[face.label[k]] += share * whole;
      area_[face.label[i]] += (1 - share) * whole;
      add(face, on_edge(face, k, i), on_edge(face, k, j), k, i);
      return;
    }
    const std::array<double, 3> middle = triple_point(face);
    const End centre{mesh_.halfedge_count() + face.face, {face.face, middle}};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      add(face, on_edge(face, k, i), centre, k, i);
      // The corner's cell is a quadrilateral; in (weight of i, weight of j) the face has area 1/2.
      const Vec2 a{crossing(face, k, i), 0}, b{middle[i], middle[j]}, c{0, crossing(face, k, j)};
      area_[face.label[k]] += (cross(a, b) + cross(b, c)) * whole;
    }
  }

  std::vector<Piece> pieces;

 private:
  struct End {
    Index node;
    SurfacePoint point;
  };

  End on_edge(const SharedFace& face, std::size_t a, std::size_t b) const {
    SurfacePoint p{face.face, {0, 0, 0}};
    const double t = crossing(face, a, b);
    p.weights[a] = 1 - t;
    p.weights[b] = t;
    const Index h = 3 * face.face + static_cast<Index>((a + 1) % 3 == b ? a : b);
    Index lowest = h;
    for (Index g = mesh_.opposite()[h]; g != h; g = mesh_.opposite()[g]) lowest = std::min(lowest, g);
    return {lowest, p};
  }

  void add(const SharedFace& face, const End& a, const End& b, std::size_t one, std::size_t other) {
    const auto [low, high] = std::minmax(face.label[one], face.label[other]);
    pieces.push_back({{low, high}, {a.node, b.node}, {a.point, b.point}});
  }

  const Mesh& mesh_;
  std::vector<double>& area_;
};

// Joins the pieces of one pair of sources into lines, at nodes where two of them meet.
class Joiner {
 public:
  Joiner(const Mesh& mesh, std::span<const Piece> pieces) : mesh_(mesh), pieces_(pieces), used_(pieces.size(), false) {
    for (Index i = 0; i < pieces.size(); ++i) {
      for (Index end = 0; end < 2; ++end) ends_.emplace_back(pieces[i].node[end], i, end);
    }
    detail::sort(ends_.begin(), ends_.end());
  }

  void join(std::vector<VoronoiBorder>& borders) {
    // Open lines first, from their ends; what is left then is closed.
    for (const auto& [node, piece, end] : ends_) {
      if (!used_[piece] && !partner(node, piece)) follow(piece, end, borders);
    }
    Poll poll;
    for (Index i = 0; i < pieces_.size(); ++i) {
      poll();
      if (!used_[i]) follow(i, 0, borders);
    }
  }

 private:
  using PieceEnd = std::tuple<Index, Index, Index>;  // node, piece, which of its ends

  // The other piece at the node, where exactly two meet.
  const PieceEnd* partner(Index node, Index piece) const {
    const auto first = std::lower_bound(ends_.begin(), ends_.end(), PieceEnd{node, 0, 0});
    auto last = first;
    while (last != ends_.end() && std::get<0>(*last) == node) ++last;
    if (last - first != 2) return nullptr;
    return std::get<1>(*first) == piece ? &*(first + 1) : &*first;
  }

  void follow(Index piece, Index end, std::vector<VoronoiBorder>& borders) {
    VoronoiBorder border{pieces_[piece].sources, {}};
    SurfacePath& line = border.line;
    const Index start = pieces_[piece].node[end];
    while (true) {
      used_[piece] = true;
      append(line, pieces_[piece].point[end]);
      const Index node = pieces_[piece].node[1 - end];
      const PieceEnd* next = node == start ? nullptr : partner(node, piece);
      line.closed = node == start;
      if (!next) {
        if (!line.closed) append(line, pieces_[piece].point[1 - end]);
        break;
      }
      std::tie(std::ignore, piece, end) = *next;
    }
    while (line.closed && line.points.size() > 1 && same_vertex(line.points.front(), line.points.back())) {
      line.points.pop_back();
    }
    if (line.points.size() < 2) return;
    line.length = length_of(mesh_, line.points, line.closed);
    borders.push_back(std::move(border));
  }

  // Borders through a vertex meet it on several edges: once is enough.
  void append(SurfacePath& line, const SurfacePoint& point) const {
    if (!line.points.empty() && same_vertex(line.points.back(), point)) line.points.pop_back();
    line.points.push_back(point);
  }

  bool same_vertex(const SurfacePoint& a, const SurfacePoint& b) const {
    const PointLocation at = locate(mesh_, a);
    return at.on == PointLocation::On::Vertex && at.vertex == locate(mesh_, b).vertex;
  }

  const Mesh& mesh_;
  std::span<const Piece> pieces_;
  std::vector<PieceEnd> ends_;
  std::vector<char> used_;
};

}  // namespace

namespace {

std::vector<Face> dual_of(std::span<const SharedFace> faces) {
  std::vector<Face> dual;
  for (const SharedFace& face : faces) {
    Face t = face.label;
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    dual.push_back(t);
  }
  detail::sort(dual.begin(), dual.end());
  dual.erase(std::unique(dual.begin(), dual.end()), dual.end());
  return dual;
}

}  // namespace

VoronoiDiagram voronoi(const Domain& domain, std::span<const Source> sources, const DistanceOptions& options) {
  DistanceOptions run = options;
  run.targets.clear();
  // All of it on the open mesh, where what lies at walls is there once for every side.
  const Mesh& mesh = domain.open();
  if (run.weighting && domain.has_walls()) run.weighting = run.weighting->on_open();
  const detail::WalledRun walled(domain, sources, run);
  DistanceField field = distance(mesh, walled.sources(), run);
  VoronoiDiagram diagram;
  diagram.distance = field.distance;
  for (const Index s : field.source) diagram.source.push_back(walled.origin(s));
  diagram.area.assign(sources.size(), 0);
  std::vector<SharedFace> faces = border_faces(mesh, diagram);
  measure(mesh, walled, run, diagram, faces);

  diagram.dual = dual_of(faces);
  FaceDivider divider(mesh, diagram.area);
  Poll poll(256);
  for (const SharedFace& face : faces) {
    poll();
    divider.divide(face);
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.faces()[f];
    const Index s = diagram.source[a];
    if (s == kNoIndex || s != diagram.source[b] || s != diagram.source[c] || !mesh.is_face_usable(f)) continue;
    diagram.area[s] += 0.5 * mesh.double_areas()[f] * mesh.unit() * mesh.unit();
  }

  std::vector<Piece>& pieces = divider.pieces;
  detail::stable_sort(pieces.begin(), pieces.end(),
                      [](const Piece& a, const Piece& b) { return a.sources < b.sources; });
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
    while (end < pieces.size() && pieces[end].sources == pieces[begin].sources) ++end;
    Joiner(mesh, std::span(pieces).subspan(begin, end - begin)).join(diagram.borders);
  }
  for (VoronoiBorder& border : diagram.borders) domain.to_mesh(border.line.points);
  for (SharedFace& face : faces) face.face = domain.face(face.face);
  diagram.shared_faces = std::move(faces);
  if (domain.has_walls()) {
    walled.bring_back(field);
    diagram.distance = std::move(field.distance);
    diagram.source = std::move(field.source);
  }
  return diagram;
}

}  // namespace brushfire
