// Places on a mesh as text: how --source, --target and the lines of --sources FILE are read.
//
//   17                 vertex 17
//   0,5,9              three vertices, where several places go: everywhere, as [0, 5, 9] is in Python
//   f:120:.2,.3,.5     in face 120, with these weights of its three corners (they sum to one)
//   at:1.5,0,-2        the point of the surface nearest to this position
//   17@0.5             any of them, with the value 0.5 to start from (sources only)
//
// and, for sources, the names of whole curves: see curves.h.
#pragma once

#include "command_line.h"

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/distance.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace brushfire::tool {

// A number may be larger than any index: that it is not in the mesh is found out when it is looked up there.
struct VertexPlace {
  std::uint64_t index = 0;
};

struct FacePlace {
  std::uint64_t face = 0;
  std::array<double, 3> weights{};
};

// A whole curve: what kind of, and the rest of its name.
struct CurvePlace {
  enum class Kind : std::uint8_t { Boundary, Path, Chain, Region, File };
  Kind kind = Kind::Boundary;
  std::string detail;
};

struct Where {
  std::variant<VertexPlace, FacePlace, Vec3, CurvePlace> place;
  double offset = 0;
  bool has_offset = false;
  std::string text;  // as it was written

  bool is_curve() const { return std::holds_alternative<CurvePlace>(place); }
};

// One place. Throws Error(InvalidArgument) that quotes the text and says what was expected.
Where parse_where(std::string_view text);

// The places of an option that may be repeated, with lists of vertices taken apart.
std::vector<std::string> split_places(const std::vector<std::string>& texts);

// One place, or a list of vertices, per line; empty lines and what follows a # are skipped. "-" is standard input, and
// named pipes are read. Throws Error(FileNotReadable), and Error(InvalidArgument) with file and line number: also for a
// line of more than 65536 bytes, and for more than ten million places.
// `or_curves`: files of curves can be given here by their names, which one that was given as a list is told.
std::vector<Where> read_where_file(const std::string& path, bool or_curves = false);

// From a position in space to the surface.
using Snap = std::function<SurfacePoint(Vec3)>;

// Where it is on this mesh. `snap` finds the nearest surface point of a position. Throws Error(IndexOutOfRange) for a
// vertex or face that the mesh has not, Error(InvalidArgument) for a curve, and whatever locate() throws. A vertex in
// no face is nowhere (see SurfacePoint): a target that nothing reaches, which no distance starts from.
SurfacePoint resolve(const Where& where, const Mesh& mesh, const Snap& snap);

// Finds places on a mesh, and remembers how far positions were from it: what lies kilometres off is not moved to the
// surface without a word.
class PlaceFinder {
 public:
  // What finds the nearest point is built for the first position that is asked for. `within`: --snap-within.
  PlaceFinder(Mesh mesh, std::optional<double> within) : mesh_(std::move(mesh)), within_(within) {}

  // Throw as resolve() does, and Error(InvalidArgument) for a position that is farther than `within` from the surface.
  SurfacePoint target(const Where& where);
  SurfacePoint source(const Where& where);  // also for a vertex in no face

  // A curve that was put onto the surface, from so far away at most. Throws as target() does.
  void moved(const Where& where, double distance);

  // How many positions were moved by more than the rounding of coordinates, and the farthest: one line, or nothing.
  void tell(const Talk& talk) const;
  // "snapped": every position and its distance from the surface; "max_snap_distance".
  void add_to(Record& record) const;

 private:
  struct Snapped {
    std::string where;
    double distance;
  };

  Mesh mesh_;
  std::optional<double> within_;
  std::optional<NearestPointFinder> finder_;
  std::vector<Snapped> snapped_;
  std::set<std::string> known_;  // in snapped_
};

}  // namespace brushfire::tool
