// Finds copies of faces, translates places, and runs engines on what is left.
#include <brushfire/solvers/detail/sheets.h>

#include <brushfire/core/detail/sort.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace brushfire::detail {
namespace {

// A usable face by the two higher of its vertices, ascending; the lowest is known from where it stands.
struct ByVertices {
  Index middle, highest, face;
  bool is_copy_of(const ByVertices& o) const { return middle == o.middle && highest == o.highest; }
  bool operator<(const ByVertices& o) const {
    return std::tie(middle, highest, face) < std::tie(o.middle, o.highest, o.face);
  }
};

std::array<Index, 3> sorted(Face t) {
  detail::sort(t.begin(), t.end());
  return t;
}

// The lowest of the faces over the same three vertices, for every face, or of those of them that are not `apart`. Faces
// that name a vertex twice have no copies: they conduct along their edges only.
std::vector<Index> lowest_copies(const Mesh& mesh, std::span<const Index> apart) {
  const auto is_single = [&](Index f) {
    return !mesh.is_face_usable(f) || std::binary_search(apart.begin(), apart.end(), f);
  };
  std::vector<std::size_t> begin(std::size_t{mesh.vertex_count()} + 1, 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (!is_single(f)) ++begin[sorted(mesh.faces()[f])[0]];
  }
  std::size_t sum = 0;
  for (std::size_t& b : begin) b = std::exchange(sum, sum + b);
  std::vector<ByVertices> faces(sum);
  std::vector<Index> lowest(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    lowest[f] = f;
    if (is_single(f)) continue;
    const std::array<Index, 3> v = sorted(mesh.faces()[f]);
    faces[begin[v[0]]++] = {v[1], v[2], f};  // afterwards begin[v] is where the faces of v end
  }
  for (std::size_t v = 0, first = 0; v < mesh.vertex_count(); first = begin[v++]) {
    const std::span<ByVertices> its(faces.data() + first, begin[v] - first);
    detail::sort(its.begin(), its.end());
    for (std::size_t i = 1; i < its.size(); ++i) {
      if (its[i].is_copy_of(its[i - 1])) lowest[its[i].face] = lowest[its[i - 1].face];
    }
  }
  return lowest;
}

// Whatever it lies on, by its face alone.
PointLocation point_inside(Index face, const std::array<double, 3>& weights) {
  PointLocation at;
  at.face = face;
  at.weights = weights;
  return at;
}

PointLocation middle_of(const CurveSegment& s) {
  PointLocation at = point_inside(s.face, s.from);
  for (Index k = 0; k < 3; ++k) {
    at.weights[k] = 0.5 * (s.from[k] + s.to[k]);
    if (!s.along_edge || at.weights[k] > 0) continue;
    at.on = PointLocation::On::Edge;
    at.halfedge = 3 * s.face + (k + 1) % 3;
  }
  return at;
}

class OneSheet final : public Engine {
 public:
  OneSheet(std::shared_ptr<const Sheets> sheets, std::function<std::unique_ptr<Engine>(const Mesh&)> make)
      : sheets_(std::move(sheets)), make_(std::move(make)), engine_(make_(sheets_->single())) {}

  bool lists_touched() const override { return engine_->lists_touched(); }
  void set_up(const DistanceOptions& options) override { engine_->set_up(options); }

  void solve(const Problem& problem, DistanceField& field) override {
    find_apart(problem);
    if (apart_.empty()) {
      run(problem, field, sheets_, *engine_);
    } else {
      const auto sheets = Sheets::of(sheets_->mesh(), apart_);
      run(problem, field, sheets, *make_(sheets->single()));
    }
  }

 private:
  // The faces with a source inside in which that makes a difference: a point inside of a copy is asked for. Then the
  // copies are as near to the source as light makes them that comes over their edges.
  void find_apart(const Problem& problem) {
    apart_.clear();
    const auto look_at = [&](const PointLocation& at) {
      if (!sheets_->is_inside_copy(at)) return;
      const bool asked = problem.options->keep_windows ||
                         std::any_of(problem.targets.begin(), problem.targets.end(),
                                     [&](const PointLocation& t) { return sheets_->are_inside_two_copies(at, t); });
      if (asked) apart_.push_back(at.face);
    };
    for (const LocatedSource& s : problem.sources) {
      look_at(s.at);
      if (!s.curve) continue;
      for (const CurveSegment& segment : s.curve->segments) look_at(middle_of(segment));
      for (const CurvePlace& p : s.curve->places) look_at(p.at);
    }
    detail::sort(apart_.begin(), apart_.end());
    apart_.erase(std::unique(apart_.begin(), apart_.end()), apart_.end());
  }

  static void run(const Problem& problem, DistanceField& field, const std::shared_ptr<const Sheets>& sheets,
                  Engine& engine) {
    auto view = std::make_shared<SheetView>();
    view->sheets = sheets;
    std::vector<LocatedSource> sources;
    std::vector<PointLocation> targets;
    for (const LocatedSource& s : problem.sources) {
      sources.push_back({sheets->to_single(s.at), s.offset, s.label, sheets->to_single(s.curve)});
      view->sources.push_back(s.at);
    }
    for (const PointLocation& t : problem.targets) {
      targets.push_back(sheets->to_single(t));
      view->targets.push_back(t);
    }
    Problem single = problem;
    single.sources = sources;
    single.targets = targets;
    single.view = std::move(view);
    engine.solve(single, field);
  }

  std::shared_ptr<const Sheets> sheets_;
  std::function<std::unique_ptr<Engine>(const Mesh&)> make_;
  std::unique_ptr<Engine> engine_;
  std::vector<Index> apart_;
};

}  // namespace

std::shared_ptr<const Sheets> Sheets::of(const Mesh& mesh, std::span<const Index> apart) {
  if (mesh.has_slits() && !mesh.has_positions()) return nullptr;
  const std::vector<Index> lowest = lowest_copies(mesh, apart);
  std::shared_ptr<Sheets> sheets(new Sheets(mesh));
  std::vector<bool>& is_copied = sheets->is_copied_;
  sheets->number_.resize(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (lowest[f] != f) {
      sheets->number_[f] = sheets->number_[lowest[f]];
      is_copied[sheets->number_[f]] = true;
      continue;
    }
    sheets->number_[f] = static_cast<Index>(sheets->face_.size());
    sheets->face_.push_back(f);
    is_copied.push_back(false);
  }
  if (sheets->face_.size() == mesh.face_count() && apart.empty()) return nullptr;  // no face has a copy
  sheets->single_ = mesh.with_faces(sheets->face_);
  return sheets;
}

// A slit parts the copies beside it as well: its points are theirs alone.
bool Sheets::is_inside_copy(const PointLocation& at) const {
  if (at.on == PointLocation::On::Vertex || !is_copied_[number_[at.face]]) return false;
  return at.on == PointLocation::On::Interior || mesh_.opposite(at.halfedge) == at.halfedge;
}

bool Sheets::are_inside_two_copies(const PointLocation& a, const PointLocation& b) const {
  return number_[a.face] == number_[b.face] && a.face != b.face && is_inside_copy(a) && is_inside_copy(b);
}

PointLocation Sheets::to_single(const PointLocation& at) const {
  const Index f = number_[at.face];
  if (face_[f] == at.face || !mesh_.is_face_usable(at.face)) {
    PointLocation same = at;
    same.face = f;
    if (at.halfedge != kNoIndex) same.halfedge = 3 * f + at.halfedge % 3;
    return same;
  }
  const Face &own = mesh_.faces()[at.face], &other = single_.faces()[f];
  PointLocation moved;
  moved.on = at.on;
  moved.vertex = at.vertex;
  moved.face = f;
  Index without = 0;  // the corner that an edge does not have
  for (Index k = 0; k < 3; ++k) {
    const auto j = static_cast<Index>(std::find(other.begin(), other.end(), own[k]) - other.begin());
    moved.weights[j] = at.weights[k];
    if (at.halfedge != kNoIndex && k == Mesh::previous(at.halfedge) % 3) without = j;
  }
  if (at.halfedge != kNoIndex) {
    moved.halfedge = 3 * f + (without + 1) % 3;
    moved.t = moved.weights[(without + 2) % 3];
  }
  return moved;
}

std::shared_ptr<const LocatedCurve> Sheets::to_single(const std::shared_ptr<const LocatedCurve>& curve) const {
  if (!curve) return nullptr;
  LocatedCurve moved = *curve;
  for (CurvePlace& p : moved.places) p.at = to_single(p.at);
  for (CurveSegment& s : moved.segments) {
    const PointLocation from = to_single(point_inside(s.face, s.from)), to = to_single(point_inside(s.face, s.to));
    s.face = from.face;
    s.from = from.weights;
    s.to = to.weights;
  }
  for (Index& f : moved.inside) f = number_[f];
  detail::sort(moved.inside.begin(), moved.inside.end());
  return std::make_shared<const LocatedCurve>(std::move(moved));
}

std::unique_ptr<Engine> make_on_one_sheet(std::shared_ptr<const Sheets> sheets,
                                          std::function<std::unique_ptr<Engine>(const Mesh&)> make) {
  return std::make_unique<OneSheet>(std::move(sheets), std::move(make));
}

}  // namespace brushfire::detail
