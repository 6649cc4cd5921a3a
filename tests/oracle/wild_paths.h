// A judge of single paths in wild complexes: from coordinates, in long double, against the field and the oracle.
#pragma once

#include <brushfire/core/progress.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <string>

namespace brushfire::oracle {

struct PathVerdict {
  bool reached = false;     // by the field
  bool field_true = false;  // the field agrees with the oracle to 1e-12 or within its own error_bound
  // What is wrong with the path: empty, or a word ("lost", "none", "face", "length", "chord", "bend", "edge bend",
  // "field") and the particulars. "field": its length is not the field's value, to 1e-11 or within its error_bound.
  std::string complaint;
  double field = 0, length = 0;
  long double truth = 0;
};

// The path from one point to the other and the field from the first, both of method Exact. `ask_oracle`: false leaves
// field_true true; the oracle does not always end. `stage`, where given, says what is being done: 1 the field, 2 the
// path, 3 the truth. Throws Error(Cancelled) where the field is cancelled.
PathVerdict judge_path(const Mesh& mesh, const SurfacePoint& from, const SurfacePoint& to, bool ask_oracle = true,
                       int* stage = nullptr, const CancelToken* cancel = nullptr);

}  // namespace brushfire::oracle
