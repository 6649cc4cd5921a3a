// A front's values, and at which source the path to each of them begins.
#include <brushfire/solvers/weighted/detail/fields.h>

#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>

#include <algorithm>

namespace brushfire::weighted {
namespace {

using namespace steiner;

// At which source the path to a point begins. What paths have in common is followed once.
class Origins {
 public:
  explicit Origins(const Run& run) : run_(run) {
    if (run.given.size() > 1) known_.assign(run.layout->size(), kUnknown);
  }

  // The label, by the parent of what is asked about.
  Index label(Index parent) {
    if (parent == kNoIndex || known_.empty()) return parent == kNoIndex ? kNoIndex : 0;
    trail_.clear();
    while (parent < kFromSource && known_[parent] == kUnknown) {
      trail_.push_back(parent);
      parent = parent_of(run_, parent);
    }
    Index label = kNoIndex;
    if (parent < kFromSource) {
      label = known_[parent];
    } else if (parent != kNoIndex) {
      label = run_.sources[parent - kFromSource].label;
    }
    for (const Index point : trail_) known_[point] = label;
    return label;
  }

 private:
  static constexpr Index kUnknown = kNoIndex - 1;
  const Run& run_;
  std::vector<Index> known_;  // [points]; empty where there is one source only
  std::vector<Index> trail_;
};

}  // namespace

void check_tolerance(double tolerance) {
  if (!(tolerance >= kLeastWeightedTolerance && tolerance <= kMostWeightedTolerance)) {
    throw Error(ErrorCode::InvalidArgument, "tolerance " + number_as_text(tolerance) + " is not in [" +
                                                number_as_text(kLeastWeightedTolerance) + ", " +
                                                number_as_text(kMostWeightedTolerance) + "]: weighted distances are " +
                                                "computed between bounds");
  }
}

void fill_upper(const Run& run, double max_distance, WeightedField& field) {
  const double unit = run.mesh->mesh().unit(), horizon = run.front.horizon;
  const Index count = run.mesh->domain().mesh().vertex_count();
  Origins origins(run);
  const auto value = [&](double v) { return v <= horizon ? run.base + v * unit : kInfinity; };
  field.distance.assign(count, kInfinity);
  field.source.assign(count, kNoIndex);
  for (Index v = 0; v < run.front.vertex_value.size(); ++v) {
    const double d = value(run.front.vertex_value[v]);
    double& least = field.distance[run.mesh->vertex(v)];
    if (!(d <= max_distance) || d == kInfinity || !(d < least)) continue;
    least = d;
    field.source[run.mesh->vertex(v)] = origins.label(run.front.vertex_parent[v]);
  }
  fill_sides(run, horizon, [&](Index v) { return run.front.vertex_value[v]; }, max_distance, field);
  field.reached = static_cast<Index>(
      std::count_if(field.distance.begin(), field.distance.end(), [](double d) { return d < kInfinity; }));
  for (const std::vector<ValueAt>& sides : run.target_values) {
    ValueAt best;
    for (const ValueAt& at : sides) best = at.value < best.value ? at : best;
    const double d = value(best.value);
    const bool is_reached = d < kInfinity && d <= max_distance;
    field.target_distance.push_back(is_reached ? d : kInfinity);
    field.target_source.push_back(is_reached ? origins.label(best.parent) : kNoIndex);
  }
}

}  // namespace brushfire::weighted
