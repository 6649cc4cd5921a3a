// Rows of a distance matrix that are summed up as they come.
#include <brushfire/queries/vertex_measures.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/core/parallel.h>
#include <brushfire/mesh/detail/components.h>
#include <brushfire/queries/detail/rows.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace brushfire {

std::vector<double> vertex_areas(const Domain& domain) {
  std::vector<double> areas(domain.mesh().vertex_count(), 0);
  const Mesh& open = domain.open();
  constexpr double kShare = 1.0 / 6;  // a third of half of the double area
  for (Index f = 0; f < open.face_count(); ++f) {
    const double third = kShare * open.double_areas()[f] * open.unit() * open.unit();
    for (const Index v : open.faces()[f]) areas[domain.vertex(v)] += third;
  }
  return areas;
}

std::vector<double> eccentricities(const Domain& domain, Places places, const MatrixOptions& options) {
  detail::Rows rows(domain, places, std::nullopt, options);
  std::vector<double> result(rows.count(), kInfinity);
  const std::vector<std::size_t> numbers = rows.numbers_by_place();
  rows.run_sparse(numbers, 1, options.distance.progress, [&](unsigned, std::size_t k, const SparseField& field) {
    if (field.vertex.empty()) return;
    result[numbers[k]] = *std::max_element(field.distance.begin(), field.distance.end());
  });
  return result;
}

std::vector<double> average_distances(const Domain& domain, Places places, const MatrixOptions& options) {
  detail::Rows rows(domain, places, std::nullopt, options);
  const std::vector<double> area = vertex_areas(domain);
  std::vector<double> result(rows.count(), kInfinity);
  const std::vector<std::size_t> numbers = rows.numbers_by_place();
  rows.run_sparse(numbers, 1, options.distance.progress, [&](unsigned, std::size_t k, const SparseField& field) {
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < field.vertex.size(); ++i) {
      sum += area[field.vertex[i]] * field.distance[i];
      weight += area[field.vertex[i]];
    }
    if (weight > 0) result[numbers[k]] = sum / weight;
  });
  return result;
}

namespace {

// A face as a level set cuts it: its values ascending, its area, and its sides' lengths by the order of the values.
struct SortedFace {
  std::array<double, 3> value;
  double area;
  double side01, side02, side12;
};

// Of the part of the face below level r; the rate is by how much it grows with r.
struct Below {
  double area = 0, rate = 0;
};

Below below(const SortedFace& f, double r) {
  const auto [a, b, c] = f.value;
  if (r >= c) return {f.area, 0};
  if (r <= a) return {};
  if (r <= b) {
    const double scale = f.area / ((b - a) * (c - a));
    return {scale * (r - a) * (r - a), 2 * scale * (r - a)};
  }
  const double scale = f.area / ((c - a) * (c - b));
  return {f.area - scale * (c - r) * (c - r), 2 * scale * (c - r)};
}

// The length of the level line in the face: between points on two sides that have a corner in common.
double level_length(const SortedFace& f, double r) {
  const auto [a, b, c] = f.value;
  if (!(r > a && r < c)) return 0;
  // From the corner that is alone on its side of the level: its sides, how far along them, and the side across.
  const bool lowest = r <= b;
  const double s = lowest ? f.side01 * (r - a) / (b - a) : f.side12 * (c - r) / (c - b);
  const double t = f.side02 * (lowest ? r - a : c - r) / (c - a);
  const double p = lowest ? f.side01 : f.side12, q = f.side02, across = lowest ? f.side12 : f.side01;
  if (!(p > 0) || !(q > 0)) return 0;
  const double cosine = std::clamp((p * p + q * q - across * across) / (2 * p * q), -1.0, 1.0);
  return std::sqrt(std::max(0.0, s * s + t * t - 2 * s * t * cosine));
}

// The open mesh's components, and how large they are.
struct ComponentAreas {
  explicit ComponentAreas(const Mesh& open) : components(detail::components_of(open)), area(components.count, 0) {
    const double unit = open.unit();
    for (Index f = 0; f < open.face_count(); ++f) {
      area[components.of_vertex[open.faces()[f][0]]] += 0.5 * open.double_areas()[f] * unit * unit;
    }
  }

  // Of those that these points are in: several for a point on a wall that parts the surface.
  double around(const Mesh& open, std::span<const Source> points) const {
    std::vector<Index> known;
    double sum = 0;
    for (const Source& p : points) {
      const Index c = components.of_vertex[open.faces()[p.point.face][0]];
      if (std::find(known.begin(), known.end(), c) != known.end()) continue;
      known.push_back(c);
      sum += area[c];
    }
    return sum;
  }

  detail::Components components;
  std::vector<double> area;
};

// Measures discs around one place after the other, on the open mesh.
class DiscMeter {
 public:
  DiscMeter(const Domain& domain, DistanceOptions options, const ComponentAreas& areas, double longest_edge)
      : mesh_(domain.open()),
        domain_(domain),
        solver_(mesh_),
        options_(std::move(options)),
        areas_(areas),
        longest_edge_(longest_edge),
        value_(mesh_.vertex_count(), kInfinity) {}

  struct Disc {
    double radius = kInfinity, perimeter = 0, area = 0;
  };

  Disc measure(const SurfacePoint& place, double share) {
    std::vector<Source> sources;
    for (const SurfacePoint& p : domain_.on_open(place)) sources.push_back({p});
    if (sources.empty()) return {};
    const double wanted = share * areas_.around(mesh_, sources);
    // A run holds the disc where it goes an edge farther than the disc's radius: faces on the rim are whole then.
    constexpr double kFarther = 1.5;  // than a flat disc: most are found by the first run
    for (double limit = kFarther * std::sqrt(wanted / kPi) + longest_edge_;; limit *= 2) {
      const bool all = share > kMostLimited || !(limit < kInfinity);
      DistanceOptions run = options_;
      if (!all) run.max_distance = std::min(limit, options_.max_distance);
      solver_.distance_sparse(sources, run, field_);
      collect();
      const double inside = all ? kInfinity : limit - longest_edge_;
      const double radius = radius_of(wanted);
      if (radius <= inside || run.max_distance == options_.max_distance) return finish(radius, wanted);
    }
  }

 private:
  // Beyond this share of the component a limit saves nothing.
  static constexpr double kMostLimited = 0.25;

  void collect() {
    faces_.clear();
    for (std::size_t i = 0; i < field_.vertex.size(); ++i) value_[field_.vertex[i]] = field_.distance[i];
    for (const Index v : field_.vertex) {
      for (const Index h : mesh_.corners(v)) {
        const Index f = Mesh::face_of(h);
        const Face& t = mesh_.faces()[f];
        // Each face once, at its lowest vertex that was reached; unreached corners are far beyond the rim.
        const auto is_before = [&](Index w) { return w < v && value_[w] < kInfinity; };
        if (!mesh_.is_face_usable(f) || is_before(t[0]) || is_before(t[1]) || is_before(t[2])) continue;
        add(f);
      }
    }
    for (const Index v : field_.vertex) value_[v] = kInfinity;
  }

  void add(Index f) {
    const Face& t = mesh_.faces()[f];
    std::array<Index, 3> k{0, 1, 2};
    std::sort(k.begin(), k.end(), [&](Index a, Index b) { return value_[t[a]] < value_[t[b]]; });
    if (value_[t[k[2]]] == kInfinity) return;
    const double unit = mesh_.unit();
    const auto side = [&](Index a, Index b) { return unit * mesh_.length(3 * f + ((a + 1) % 3 == b ? a : b)); };
    faces_.push_back({{value_[t[k[0]]], value_[t[k[1]]], value_[t[k[2]]]},
                      0.5 * mesh_.double_area(f) * unit * unit,
                      side(k[0], k[1]),
                      side(k[0], k[2]),
                      side(k[1], k[2])});
  }

  Below below_all(double r) const {
    Below sum;
    for (const SortedFace& f : faces_) {
      const Below b = below(f, r);
      sum.area += b.area;
      sum.rate += b.rate;
    }
    return sum;
  }

  // Where the area below the level is `wanted`: Newton's steps, kept between bounds that close in. +inf where all that
  // was reached is less.
  double radius_of(double wanted) const {
    double low = 0, high = 0;
    for (const SortedFace& f : faces_) high = std::max(high, f.value[2]);
    const double whole = below_all(high).area;
    constexpr double kRounding = 1e-12;
    if (whole < wanted * (1 - kRounding)) return kInfinity;
    double r = high * std::sqrt(std::min(1.0, wanted / whole));
    if (wanted >= whole * (1 - kRounding)) return high;
    constexpr int kMostSteps = 100;
    for (int step = 0; step < kMostSteps && high - low > kRounding * high; ++step) {
      const Below b = below_all(r);
      if (std::abs(b.area - wanted) <= kRounding * wanted) return r;
      (b.area < wanted ? low : high) = r;
      const double next = b.rate > 0 ? r + (wanted - b.area) / b.rate : high;
      r = next > low && next < high ? next : 0.5 * (low + high);
    }
    return r;
  }

  Disc finish(double radius, double wanted) const {
    if (radius == kInfinity) return {};
    Disc disc{radius, 0, wanted};
    for (const SortedFace& f : faces_) disc.perimeter += level_length(f, radius);
    return disc;
  }

  const Mesh& mesh_;
  const Domain& domain_;
  DistanceSolver solver_;
  DistanceOptions options_;
  const ComponentAreas& areas_;
  double longest_edge_;
  std::vector<double> value_;  // +inf between runs
  SparseField field_;
  std::vector<SortedFace> faces_;
};

}  // namespace

Discs discs_of_share(const Domain& domain, double share, Places places, const MatrixOptions& options) {
  if (!(share > 0 && share <= 1)) {
    throw Error(ErrorCode::InvalidArgument, "a share of the surface is in (0, 1], not " + std::to_string(share));
  }
  const Mesh& open = domain.open();
  const ComponentAreas areas(open);
  double longest_edge = 0;
  for (const double l : open.lengths()) longest_edge = std::max(longest_edge, l * open.unit());
  const std::size_t count = places ? places->size() : domain.mesh().vertex_count();
  Discs discs{std::vector<double>(count), std::vector<double>(count), std::vector<double>(count)};
  DistanceOptions run = options.distance;
  run.progress = nullptr;
  const CancelScope listen(options.distance.cancel);
  const unsigned threads = static_cast<unsigned>(std::clamp<std::size_t>(count, 1, thread_count(options.threads)));
  std::vector<std::unique_ptr<DiscMeter>> meters(threads);
  std::atomic<std::size_t> done{0};
  parallel_for(
      count, threads,
      [&](unsigned worker, std::size_t i) {
        if (!meters[worker]) {
          meters[worker] = std::make_unique<DiscMeter>(domain, run, areas, longest_edge);
        }
        const Place place = places ? (*places)[i] : Place(static_cast<Index>(i));
        const Index* v = std::get_if<Index>(&place);
        const SurfacePoint point = v ? target_point(domain.mesh(), *v) : std::get<SurfacePoint>(place);
        const DiscMeter::Disc disc = meters[worker]->measure(point, share);
        discs.radius[i] = disc.radius;
        discs.perimeter[i] = disc.perimeter;
        discs.area[i] = disc.area;
        const std::size_t finished = ++done;
        if (worker == 0 && options.distance.progress) {
          options.distance.progress(static_cast<double>(finished) / static_cast<double>(count));
        }
      },
      current_cancel_token());
  return discs;
}

}  // namespace brushfire
