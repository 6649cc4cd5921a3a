// How far a distance field is from a reference.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>

#include <span>
#include <vector>

namespace brushfire {

// Of a set of vertices, over |field - reference|; zero where there are none.
struct ErrorMeasure {
  double mean = 0;
  double root_mean_square = 0;
  double max = 0;
  Index max_vertex = kNoIndex;  // the lowest where the greatest error is; kNoIndex where there is no vertex
};

struct FieldComparison {
  // Every vertex is counted in one of these five.
  Index compared = 0;           // finite in both, reference not 0: the errors below are over these
  Index zero_reference = 0;     // reference 0 (sources), finite in the field: left out, a relative error has no meaning
  Index missing = 0;            // finite in the reference, +inf in the field
  Index surplus = 0;            // finite in the field, +inf in the reference
  Index unreached_in_both = 0;  // +inf in both

  ErrorMeasure absolute;             // the fields' units
  ErrorMeasure relative;             // |field - reference| / |reference|
  double mean_signed_relative = 0;   // (field - reference) / |reference|: negative where the field is too short
  double max_at_zero_reference = 0;  // greatest |field| where the reference is 0
  bool has_weights = false;          // whether the weighted measures below mean anything
  ErrorMeasure weighted_absolute;    // means weighted by vertex (area); max as above
  ErrorMeasure weighted_relative;
};

// Compares two fields of one value per vertex, +inf where unreachable. `vertex_weights` is empty or has one weight >= 0
// per vertex, usually vertex_areas(): a dense corner of a mesh then counts by its size and not by its vertices. Throws
// Error(InvalidArgument) where the sizes differ, for a weight that is not finite and >= 0, and for a value that is NaN
// or -inf, with its vertex. O(vertices).
FieldComparison compare_fields(std::span<const double> field, std::span<const double> reference,
                               std::span<const double> vertex_weights = {});

// A third of the area of the faces around each vertex, [vertex_count], in units of the mesh squared; 0 where there is
// no face. They sum to the area of the mesh.
std::vector<double> vertex_areas(const Mesh& mesh);

}  // namespace brushfire
