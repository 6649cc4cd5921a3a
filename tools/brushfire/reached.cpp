// Counts of vertices, and the words for them.
#include "reached.h"

#include "sources.h"

#include <brushfire/mesh/reachable.h>

#include <algorithm>

namespace brushfire::tool {

Reached::Reached(const Domain& domain, std::span<const Source> sources, const DistanceOptions& options,
                 const DistanceField& field)
    : reached_(field.reached),
      unreachable_(field.unreachable),
      beyond_radius_(field.beyond_radius),
      has_radius_(options.max_distance < kInfinity),
      domain_(domain) {
  if (!has_radius_ && options.targets.empty()) return;
  is_reachable_ = reachable(domain.open(), open_places_of(domain, sources));
  std::vector<std::uint8_t> on_any_side(domain.mesh().vertex_count(), 0);
  for (Index v = 0; v < is_reachable_.size(); ++v) {
    if (is_reachable_[v]) on_any_side[domain.vertex(v)] = 1;
  }
  unreachable_ = static_cast<Index>(std::count(on_any_side.begin(), on_any_side.end(), 0));
  not_visited_ = field.unreachable > unreachable_ ? field.unreachable - unreachable_ : 0;
}

bool Reached::is_unreachable(const SurfacePoint& point) const {
  if (is_reachable_.empty()) return true;
  const std::vector<SurfacePoint> sides = domain_.on_open(point);
  return std::none_of(sides.begin(), sides.end(),
                      [&](const SurfacePoint& p) { return is_reachable_[domain_.open().faces()[p.face][0]] != 0; });
}

std::vector<std::uint8_t> Reached::not_visited(std::span<const double> distance) const {
  if (beyond_radius_ + not_visited_ == 0) return {};
  std::vector<std::uint8_t> not_visited(distance.size(), 0);
  for (Index v = 0; v < is_reachable_.size(); ++v) {
    const Index of_mesh = domain_.vertex(v);
    if (is_reachable_[v] && distance[of_mesh] == kInfinity) not_visited[of_mesh] = 1;
  }
  return not_visited;
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
