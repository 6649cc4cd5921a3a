// A case of a family: the mesh, and where distances start and end on it.
#include "corpus/families.h"

#include "corpus/curves.h"
#include "oracle/deviation.h"

#include <brushfire/core/error.h>

#include <cstdio>
#include <fstream>

namespace brushfire::corpus {
namespace {

SurfacePoint near_vertex(const Mesh& mesh, Dice& dice) {
  SurfacePoint p = oracle::random_face_point(mesh, dice.small());
  const double near = dice.power(-16, -3), share = dice.unit();
  const std::size_t k = dice.below(3);
  p.weights[k] = 1 - near;
  p.weights[(k + 1) % 3] = near * share;
  p.weights[(k + 2) % 3] = dice.chance(0.3) ? 0 : near * (1 - share);
  if (p.weights[(k + 2) % 3] == 0) p.weights[(k + 1) % 3] = near;
  return p;
}

SurfacePoint near_edge(const Mesh& mesh, Dice& dice) {
  SurfacePoint p = oracle::random_face_point(mesh, dice.small());
  const double near = dice.power(-16, -3), share = dice.unit();
  const std::size_t k = dice.below(3);
  p.weights[k] = near;
  p.weights[(k + 1) % 3] = (1 - near) * share;
  p.weights[(k + 2) % 3] = (1 - near) * (1 - share);
  return p;
}

SurfacePoint point_of_kind(const Mesh& mesh, Dice& dice, std::uint32_t kind) {
  switch (kind) {
    case 0:
      return oracle::random_vertex(mesh, dice.small());
    case 1:
      return oracle::random_edge_point(mesh, dice.small());
    case 2:
      return oracle::random_face_point(mesh, dice.small());
    case 3:
      return near_vertex(mesh, dice);
    default:
      return near_edge(mesh, dice);
  }
}
constexpr std::uint32_t kKinds = 5;

std::vector<Source> several(const Mesh& mesh, Dice& dice) {
  std::vector<Source> sources;
  const double size = mesh.unit() * (dice.chance(0.5) ? 1 : dice.power(-6, 6));
  for (int count = dice.between(2, 4); count > 0; --count) {
    const double offset = dice.chance(0.4) ? 0 : size * dice.sign_and_unit();
    sources.push_back({point_of_kind(mesh, dice, dice.below(kKinds)), offset});
  }
  return sources;
}

}  // namespace

Case make_case(const Family& family, std::uint64_t seed, std::uint64_t index) {
  Dice dice(family.name, seed, index);
  Draft made = family.make(dice);
  Case c{made.mesh, made.plain.value_or(made.mesh), {}, {}};
  if (family.starts == Starts::Curves) {
    for (int turn = 0; turn < 2; ++turn) c.starts.push_back(curves_and_points(c.plain, dice));
  } else {
    const std::uint32_t kinds = family.starts == Starts::Ordinary ? 3 : kKinds + 1;
    const auto turn = static_cast<std::uint32_t>(index % kinds);
    for (const std::uint32_t kind : {turn, (turn + 1 + dice.below(kinds - 1)) % kinds}) {
      c.starts.push_back(kind == kKinds ? several(c.plain, dice)
                                        : std::vector<Source>{{point_of_kind(c.plain, dice, kind), 0}});
    }
  }
  for (std::uint32_t kind = 0; kind < kKinds; ++kind) c.targets.push_back(point_of_kind(c.plain, dice, kind));
  return c;
}

std::string place_text(const SurfacePoint& point) {
  char text[120];
  std::snprintf(text, sizeof text, "f:%u:%.17g,%.17g,%.17g", point.face, point.weights[0], point.weights[1],
                point.weights[2]);
  return text;
}

void write_obj(const std::string& path, const Mesh& mesh, const std::vector<std::string>& remarks) {
  std::ofstream out(path);
  char line[160];
  for (const std::string& remark : remarks) out << "# " << remark << '\n';
  for (const Vec3& p : mesh.positions()) {
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
    out << line;
  }
  for (const Face& t : mesh.faces()) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  if (!out.flush()) throw Error(ErrorCode::FileNotWritable, path + " cannot be written");
}

}  // namespace brushfire::corpus
