// Face records, angle sums, and which vertices bend paths.
#include <brushfire/solvers/windows/detail/structure.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

Beyond beyond(const Mesh& mesh, Index h) {
  const auto opposite = mesh.opposite();
  const Index other = opposite[h];
  if (other == h) return Beyond::Nothing;
  return opposite[other] == h && mesh.from(other) == mesh.to(h) ? Beyond::Face : Beyond::Several;
}

// Half the median edge (of a sample): the mean says nothing where few long edges stand beside many short ones.
double typical_bucket(const Mesh& mesh) {
  constexpr std::size_t kSample = 4096;
  const auto lengths = mesh.lengths();
  std::vector<double> sample;
  const std::size_t stride = std::max<std::size_t>(1, lengths.size() / kSample);
  for (std::size_t i = 0; i < lengths.size(); i += stride) {
    if (lengths[i] > 0) sample.push_back(lengths[i]);
  }
  if (sample.empty()) return 1;
  const auto median = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), median, sample.end());
  return 0.5 * *median;
}

}  // namespace

double angle_at(const WindowFace& f, Index i) {
  const double a = f.length[i], b = f.length[previous3(i)], c = f.length[next3(i)];
  return std::atan2(f.double_area, 0.5 * (a * a + (b - c) * (b + c)));
}

WindowStructure::WindowStructure(const Mesh& m) : mesh(m), order(locality_order(m)) {
  const auto lengths = mesh.lengths();
  const auto opposite = mesh.opposite();
  const auto links = mesh.links();
  const Index n = mesh.vertex_count();
  face_rank.resize(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) face_rank[order.faces[f]] = f;
  faces.resize(mesh.face_count());
  bend.assign(n, Bend::None);
  std::vector<double> total_angle(n, 0), shortest(n, kInfinity), longest(n, 0);
  for (Index inner = 0; inner < mesh.face_count(); ++inner) {
    const Index f = order.faces[inner];
    WindowFace& face = faces[inner];
    face.double_area = mesh.double_areas()[f];
    face.waiting = kNoIndex;
    face.has_target = false;
    face.usable = mesh.is_face_usable(f);
    const double base = std::max({lengths[3 * f], lengths[3 * f + 1], lengths[3 * f + 2]});
    face.thin = face.double_area <= kThin * base * base;
    for (Index k = 0; k < 3; ++k) {
      const Index h = 3 * f + k;
      face.length[k] = lengths[h];
      face.vertex[k] = inner_vertex(mesh.faces()[f][k]);
      face.opposite[k] = inner_halfedge(opposite[h]);
      face.beyond[k] = face.usable ? beyond(mesh, h) : Beyond::Nothing;
    }
    for (Index k = 0; k < 3; ++k) {
      const Index v = face.vertex[k];
      // No area, no angle: light goes everywhere from there.
      if (!face.usable || face.double_area <= kNoArea * base * base) {
        bend[v] = Bend::Full;
        continue;
      }
      total_angle[v] += angle_at(face, k);
      shortest[v] = std::min({shortest[v], face.length[k], face.length[previous3(k)]});
      longest[v] = std::max({longest[v], face.length[k], face.length[previous3(k)]});
    }
  }
  for (Index v = 0; v < n; ++v) {
    const Link link = links[outer_vertex(v)];
    if (link == Link::Other || longest[v] > kUnevenEdges * shortest[v]) bend[v] = Bend::Full;
    if (bend[v] == Bend::Full) continue;
    if (link == Link::Circle && total_angle[v] > 2 * kPi + kFlat) bend[v] = Bend::Saddle;
    if (link == Link::Arc && total_angle[v] > kPi + kFlat) bend[v] = Bend::Boundary;
  }
  bucket_width = typical_bucket(mesh);
}

}  // namespace brushfire::detail
