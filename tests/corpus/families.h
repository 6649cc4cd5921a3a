// The families of the corpus: complexes that are awkward to compute on, made at random. A case is named by its family,
// a seed and an index, and by nothing else: the same three make the same case anywhere.
#pragma once

#include "corpus/dice.h"

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/distance.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brushfire::corpus {

struct Draft {
  Mesh mesh;
  std::optional<Mesh> plain;  // the same without copies of faces, whose numbers stay: the same distances, told faster
};

enum class Starts : std::uint8_t {
  Points,    // of all kinds, and several with offsets
  Ordinary,  // points at vertices, on edges and in faces, and not next to them
  Curves,    // curves, and curves and points
};

struct Family {
  std::string name;
  std::string what;
  std::function<Draft(Dice&)> make;
  Starts starts = Starts::Points;
};

// Complexes of at most 100 faces, for the oracle.
std::span<const Family> small_families();

// Complexes whose largest length is some 10^decades of the shortest, with ordinary starts.
Family family_of_ratio(int decades);

// The complexes of a small family, made anew, and curves on them.
Family with_curves(const Family& family);

struct Case {
  Mesh mesh, plain;
  std::vector<std::vector<Source>> starts;  // each a list of sources for one field
  std::vector<SurfacePoint> targets;
};

// The case `index` of a family: starts at a vertex, on an edge, in a face, 1e-16 .. 1e-3 from a vertex or an edge, and
// at several points with offsets, two of these by turns (the first three where starts are ordinary), or two of curves;
// targets of all kinds.
Case make_case(const Family& family, std::uint64_t seed, std::uint64_t index);

// A mesh with all the digits of its coordinates as OBJ, the remarks in front as comments. Throws
// Error(FileNotWritable).
void write_obj(const std::string& path, const Mesh& mesh, const std::vector<std::string>& remarks);

// A place as the command line reads it: f:120:.2,.3,.5
std::string place_text(const SurfacePoint& point);

}  // namespace brushfire::corpus
