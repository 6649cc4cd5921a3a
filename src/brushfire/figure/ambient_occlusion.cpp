// Rays from every vertex to a lattice of directions, traced by Embree.
//
// Based on: Landis, "Production-ready global illumination", 2002 (ambient occlusion); Gonzalez, "Measurement of areas
// on a sphere using Fibonacci and latitude-longitude lattices", 2010.
#include <brushfire/figure/ambient_occlusion.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>

#ifdef BRUSHFIRE_HAS_EMBREE
#include <brushfire/core/parallel.h>
#include <brushfire/figure/detail/corner_normals.h>

#if BRUSHFIRE_HAS_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <atomic>
#include <cmath>
#endif

namespace brushfire {

#ifndef BRUSHFIRE_HAS_EMBREE

bool has_ambient_occlusion() noexcept { return false; }

std::vector<std::array<float, 2>> ambient_occlusion(const Mesh&, const AmbientOcclusionOptions&) {
  throw Error(ErrorCode::InvalidArgument,
              "this brushfire was built without Embree, which ambient occlusion needs: install Embree 3 or 4 (Debian: "
              "libembree-dev) and build again");
}

#else

namespace {

using Vec3f = std::array<float, 3>;
constexpr std::size_t kLanes = 8;  // rays that Embree is given at once

// Evenly over the sphere; eight consecutive ones look into about the same direction.
std::vector<Vec3f> fibonacci_sphere(std::size_t count) {
  const double golden_angle = kPi * (3 - std::sqrt(5.0));
  struct Direction {
    double z, azimuth;
  };
  std::vector<Direction> lattice(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double turns = static_cast<double>(i) * golden_angle / (2 * kPi);
    lattice[i] = {1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count), turns - std::floor(turns)};
  }
  const auto band = static_cast<std::size_t>(std::sqrt(2.0 * static_cast<double>(count)));  // as wide as it is high
  for (std::size_t i = 0; i < count; i += band) {
    const auto first = lattice.begin() + static_cast<std::ptrdiff_t>(i);
    std::sort(first, first + static_cast<std::ptrdiff_t>(std::min(band, count - i)),
              [](const Direction& a, const Direction& b) { return a.azimuth < b.azimuth; });
  }
  std::vector<Vec3f> directions;
  for (const Direction& d : lattice) {
    const double across = std::sqrt(1 - d.z * d.z), angle = 2 * kPi * d.azimuth;
    directions.push_back({static_cast<float>(across * std::cos(angle)), static_cast<float>(across * std::sin(angle)),
                          static_cast<float>(d.z)});
  }
  return directions;
}

float dot(const Vec3f& a, const Vec3f& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The mesh, scaled into the unit ball: Embree computes with floats.
class Scene {
 public:
  explicit Scene(const Mesh& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    Vec3 low{kInfinity, kInfinity, kInfinity}, high = -1.0 * low;
    for (const Vec3& p : mesh.positions()) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    // Halves first: the sum of two large numbers may overflow.
    const Vec3 centre = 0.5 * low + 0.5 * high, half = 0.5 * high - 0.5 * low;
    const double extent = std::max({half.x, half.y, half.z});
    scale_ = extent > 0 ? 1 / extent : 1;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    points_ = static_cast<Vec3f*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                          sizeof(Vec3f), mesh.vertex_count()));
    void* faces =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Face), mesh.face_count());
    if (points_ == nullptr || faces == nullptr) throw std::bad_alloc();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3 p = scale_ * (mesh.positions()[v] - centre);
      points_[v] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    }
    std::copy(mesh.faces().begin(), mesh.faces().end(), static_cast<Face*>(faces));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::bad_alloc();
  }
  ~Scene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  double scale() const { return scale_; }

  const Vec3f& point(Index vertex) const { return points_[vertex]; }

  // Sets blocked[i] where something lies between `from` and `reach` in direction i, for those directions that are
  // wanted.
  void look(const Vec3f& from, float reach, const std::vector<Vec3f>& directions,
            const std::vector<std::uint8_t>& wanted, std::vector<std::uint8_t>& blocked) const {
    for (std::size_t i = 0; i < directions.size(); i += kLanes) {
      const std::size_t count = std::min(kLanes, directions.size() - i);
      alignas(32) int valid[kLanes] = {};
      RTCRay8 rays{};
      bool any = false;
      for (std::size_t k = 0; k < count; ++k) {
        const Vec3f& d = directions[i + k];
        if (wanted[i + k] != 0) valid[k] = -1, any = true;
        rays.org_x[k] = from[0], rays.org_y[k] = from[1], rays.org_z[k] = from[2];
        rays.dir_x[k] = d[0], rays.dir_y[k] = d[1], rays.dir_z[k] = d[2];
        rays.tfar[k] = reach;
        rays.mask[k] = ~0U;
      }
      if (!any) continue;
#if BRUSHFIRE_HAS_EMBREE == 4
      rtcOccluded8(valid, scene_, &rays, nullptr);
#else
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcOccluded8(valid, scene_, &context, &rays);
#endif
      for (std::size_t k = 0; k < count; ++k) blocked[i + k] = rays.tfar[k] < 0;
    }
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
  Vec3f* points_ = nullptr;
  double scale_ = 1;
};

// What one vertex's corners see.
class Lookout {
 public:
  Lookout(const Mesh& mesh, const std::vector<Vec3f>& normals, const std::vector<Vec3f>& directions, const Scene& scene,
          float reach)
      : mesh_(mesh),
        normals_(normals),
        directions_(directions),
        scene_(scene),
        reach_(reach),
        wanted_(directions.size()),
        blocked_(directions.size()) {}

  void look(Index vertex, std::vector<std::array<float, 2>>& openness) {
    const Vec3f outward = mean_normal(vertex);
    for (const float side : {1.0F, -1.0F}) {
      views_.clear();
      for (const Index h : mesh_.corners(vertex)) {
        const float sign = dot(normals_[h], outward) < 0 ? -side : side;
        views_.push_back({&openness[h][sign > 0 ? 0 : 1], times(sign, normals_[h])});
      }
      for (std::size_t i = 0; i < directions_.size(); ++i) {
        wanted_[i] = std::any_of(views_.begin(), views_.end(),
                                 [&](const View& view) { return dot(view.normal, directions_[i]) > 0; });
      }
      scene_.look(beside(vertex, times(side, outward)), reach_, directions_, wanted_, blocked_);
      for (const View& view : views_) *view.openness = open_share(view.normal);
    }
  }

 private:
  struct View {
    float* openness;
    Vec3f normal;
  };

  static Vec3f times(float s, const Vec3f& a) { return {s * a[0], s * a[1], s * a[2]}; }

  Vec3f mean_normal(Index vertex) const {
    Vec3f sum{0, 0, 0};
    for (const Index h : mesh_.corners(vertex)) {
      for (std::size_t k = 0; k < 3; ++k) sum[k] += normals_[h][k];
    }
    const float length = std::sqrt(dot(sum, sum));
    return length > 0 ? times(1 / length, sum) : normals_[mesh_.corners(vertex).front()];
  }

  // A place just off the vertex: rays from the vertex itself would start in its own faces and not be stopped by them.
  Vec3f beside(Index vertex, const Vec3f& outward) const {
    // As far as a float needs to tell it from the vertex, and, where edges are long enough, a 4096th of the mesh.
    constexpr float kLeast = 0x1p-20F, kMost = 0x1p-12F, kShareOfEdge = 0.125F;
    double shortest = kInfinity;
    for (const Index h : mesh_.corners(vertex)) {
      shortest = std::min({shortest, mesh_.lengths()[h], mesh_.lengths()[Mesh::previous(h)]});
    }
    const auto edge = static_cast<float>(shortest * mesh_.unit() * scene_.scale());
    const Vec3f step = times(std::clamp(kShareOfEdge * edge, kLeast, kMost), outward);
    const Vec3f& p = scene_.point(vertex);
    return {p[0] + step[0], p[1] + step[1], p[2] + step[2]};
  }

  float open_share(const Vec3f& normal) const {
    float open = 0, all = 0;
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      const float cosine = std::max(0.0F, dot(normal, directions_[i]));
      all += cosine;
      if (blocked_[i] == 0) open += cosine;
    }
    return all > 0 ? open / all : 1;
  }

  const Mesh& mesh_;
  const std::vector<Vec3f>& normals_;
  const std::vector<Vec3f>& directions_;
  const Scene& scene_;
  float reach_;
  std::vector<View> views_;
  std::vector<std::uint8_t> wanted_, blocked_;
};

void check(const Mesh& mesh, const AmbientOcclusionOptions& options) {
  constexpr int kFewest = 8, kMost = 65536;
  if (options.directions < kFewest || options.directions > kMost) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(options.directions) + " directions: ambient occlusion takes from 8 to 65536");
  }
  if (!(options.reach > 0)) throw Error(ErrorCode::InvalidArgument, "the reach of ambient occlusion must be > 0");
  if (!mesh.has_positions()) {
    throw Error(ErrorCode::InvalidArgument, "a mesh from lengths has no positions, and nothing is in its way");
  }
}

}  // namespace

bool has_ambient_occlusion() noexcept { return true; }

std::vector<std::array<float, 2>> ambient_occlusion(const Mesh& mesh, const AmbientOcclusionOptions& options) {
  check(mesh, options);
  if (mesh.face_count() == 0) return {};
  const std::vector<Vec3f> directions = fibonacci_sphere(static_cast<std::size_t>(options.directions));
  const std::vector<Vec3f> normals = detail::corner_normals(mesh);
  const Scene scene(mesh);
  const auto reach = static_cast<float>(options.reach * scene.scale());
  std::vector<std::array<float, 2>> result(mesh.halfedge_count());
  constexpr std::size_t kBlock = 256;  // vertices
  const std::size_t blocks = (mesh.vertex_count() + kBlock - 1) / kBlock;
  std::atomic<std::size_t> done{0};
  parallel_for(
      blocks, options.threads,
      [&](unsigned worker, std::size_t block) {
        Lookout lookout(mesh, normals, directions, scene, reach);
        const auto end = static_cast<Index>(std::min<std::size_t>((block + 1) * kBlock, mesh.vertex_count()));
        for (auto v = static_cast<Index>(block * kBlock); v < end; ++v) {
          if (!mesh.corners(v).empty()) lookout.look(v, result);
        }
        const std::size_t so_far = ++done;
        if (worker == 0 && options.progress) {
          options.progress(static_cast<double>(so_far) / static_cast<double>(blocks));
        }
      },
      options.cancel != nullptr ? options.cancel : current_cancel_token());
  return result;
}

#endif

}  // namespace brushfire
