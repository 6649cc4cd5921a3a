// Counts of vertices, and the words for them.
#include "reached.h"

#include <brushfire/mesh/reachable.h>

#include <algorithm>

namespace brushfire::tool {

Reached::Reached(const Mesh& mesh, std::span<const Source> sources, const DistanceOptions& options,
                 const DistanceField& field)
    : reached_(field.reached),
      unreachable_(field.unreachable),
      beyond_radius_(field.beyond_radius),
      has_radius_(options.max_distance < kInfinity) {
  if (!has_radius_ && options.targets.empty()) return;
  std::vector<SurfacePoint> points;
  for (const Source& s : sources) points.push_back(s.point);
  is_reachable_ = reachable(mesh, points);
  unreachable_ = static_cast<Index>(std::count(is_reachable_.begin(), is_reachable_.end(), 0));
  not_visited_ = field.unreachable - unreachable_;
}

bool Reached::is_unreachable(const Mesh& mesh, const SurfacePoint& point) const {
  return point.is_nowhere() || is_reachable_.empty() || is_reachable_[mesh.faces()[point.face][0]] == 0;
}

void Reached::add_to(Record& record) const {
  record.add("reached", std::int64_t{reached_})
      .add("unreachable", std::int64_t{unreachable_})
      .add("beyond_radius", std::int64_t{beyond_radius_})
      .add("not_visited", std::int64_t{not_visited_});
}

std::string Reached::in_words() const {
  std::string text;
  const Index farther = has_radius_ ? beyond_radius_ + not_visited_ : 0;
  const Index not_needed = has_radius_ ? 0 : beyond_radius_ + not_visited_;
  if (farther > 0) text += ", " + std::to_string(farther) + " lie beyond the radius";
  if (not_needed > 0) text += ", " + std::to_string(not_needed) + " were not needed for the targets";
  if (unreachable_ > 0) text += ", " + std::to_string(unreachable_) + " cannot be reached";
  return text;
}

}  // namespace brushfire::tool
