// A value beside the truth: whether it keeps what its method promises, and how far rounding alone may move it.
#pragma once

#include "corpus/worker.h"
#include "oracle/polyhedral.h"

#include <brushfire/mesh/surface_path.h>

#include <limits>
#include <string>

namespace brushfire::corpus {

// kExactPromise of the value, or the bound that comes with it, whichever is more.
inline constexpr double kExactPromise = 1e-12;
// Of its length: how far a path may be from the field's value and from the truth, unless the bound is more.
inline constexpr double kPathPromise = 1e-11;

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// What is smaller has no number of its own.
inline constexpr double kLeastStep = std::numeric_limits<double>::denorm_min();
// The truth itself is rounded, to 64 bits.
inline constexpr oracle::Real kTruthRounding = 0x1p-63L;

// A value, what it should be, the length of the path to it (without an offset) and the bound that came along (infinity:
// none).
struct Value {
  double got;
  oracle::Real truth, length;
  double bound;
};

// What a value is off by, in words.
std::string off(const Value& v, const std::string& where);

// These count into `out`, and complain there.
// Both finite or both infinite; true where they are finite.
bool same_reach(const Value& v, const std::string& where, Outcome& out);
// The exact method's promise.
void hold_exact(const Value& v, const std::string& where, Outcome& out);
// A bound's promise. `offsets`: the largest of the sources, whose rounding a bound may hold; `more`: what else it may.
void hold_bound(const Value& v, double tolerance, double offsets, oracle::Real more, const std::string& where,
                Outcome& out);
// One side of the truth.
void hold_side(const Value& v, bool below, const std::string& where, Outcome& out);

// What naming a point, or the points of a path, by three doubles each may move it by: an epsilon of each weight, of the
// longest edge there. (Beside a vertex on an edge 1e16 long there is no place but the vertex.)
oracle::Real rounding_of(const Mesh& mesh, const SurfacePoint& p);
oracle::Real rounding_of(const Mesh& mesh, const SurfacePath& path);

// What frames of doubles may be off by, of which "absolute" in "Rounding" of docs/tolerance.md is made.
oracle::Real lever_rounding(const Mesh& mesh);

// Of the longest and the shortest edge of a face, the largest.
oracle::Real ratio_of(const Mesh& mesh);

// What is not sure of wider numbers at a vertex of that distance: "Rounding" in docs/tolerance.md.
oracle::Real wide_rounding(const Mesh& mesh, oracle::Real length);

oracle::Real shortest_edge(const Mesh& mesh);

}  // namespace brushfire::corpus
