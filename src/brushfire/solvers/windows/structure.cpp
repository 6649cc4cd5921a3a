// Face records, angle sums, and which vertices bend paths.
#include <brushfire/solvers/windows/detail/structure.h>

#include <brushfire/core/uninitialized.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

Beyond beyond(const Mesh& mesh, std::span<const Index> opposite, Index h) {
  const Index other = opposite[h];
  if (other == h) return Beyond::Nothing;
  return opposite[other] == h && mesh.from(other) == mesh.to(h) ? Beyond::Face : Beyond::Several;
}

// Half the median edge (of a sample): the mean says nothing where few long edges stand beside many short ones.
double typical_bucket(std::span<const WindowFace> faces) {
  constexpr std::size_t kSample = 4096;
  std::vector<double> sample;
  const std::size_t stride = std::max<std::size_t>(1, 3 * faces.size() / kSample);
  for (std::size_t h = 0; h < 3 * faces.size(); h += stride) {
    const double length = faces[h / 3].length[h % 3];
    if (length > 0) sample.push_back(length);
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

// Faces are in the order of their least vertices, those of one vertex in the mesh's order.
Index WindowStructure::inner_face(Index f) const {
  const Face& t = mesh.faces()[f];
  const Index least = std::min({inner_vertex(t[0]), inner_vertex(t[1]), inner_vertex(t[2])});
  Index low = 0, high = static_cast<Index>(faces.size());
  while (high - low > 1) {
    const Index middle = low + (high - low) / 2;
    const WindowFace& m = faces[middle];
    const Index its = std::min({m.vertex[0], m.vertex[1], m.vertex[2]});
    (its < least || (its == least && order.faces[middle] <= f) ? low : high) = middle;
  }
  return low;
}

WindowStructure::WindowStructure(const Mesh& m) : mesh(m), order(locality_order(m)) {
  const Mesh connected = mesh.for_a_while();
  const auto opposite = connected.opposite();
  const auto links = connected.links();
  const Index n = mesh.vertex_count();
  UninitializedArray<Index> face_rank(mesh.face_count());  // mesh's number to inner
  for (Index f = 0; f < mesh.face_count(); ++f) face_rank[order.faces[f]] = f;
  faces.resize(mesh.face_count());
  bend.assign(n, Bend::None);
  std::vector<double> total_angle(n, 0), shortest(n, kInfinity), longest(n, 0);
  for (Index inner = 0; inner < mesh.face_count(); ++inner) {
    const Index f = order.faces[inner];
    WindowFace& face = faces[inner];
    const Mesh::FaceGeometry geometry = mesh.face_geometry(f);
    face.double_area = geometry.double_area;
    face.waiting = kNoIndex;
    face.has_target = false;
    face.usable = mesh.is_face_usable(f);
    const double base = std::max({geometry.lengths[0], geometry.lengths[1], geometry.lengths[2]});
    face.thin = face.double_area <= kThin * base * base;
    for (Index k = 0; k < 3; ++k) {
      const Index h = 3 * f + k;
      face.length[k] = geometry.lengths[k];
      face.vertex[k] = inner_vertex(mesh.faces()[f][k]);
      face.opposite[k] = 3 * face_rank[opposite[h] / 3] + opposite[h] % 3;
      face.beyond[k] = face.usable ? beyond(mesh, opposite, h) : Beyond::Nothing;
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
  bucket_width = typical_bucket(faces);
}

}  // namespace brushfire::detail
