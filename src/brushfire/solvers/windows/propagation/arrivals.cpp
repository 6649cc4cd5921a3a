// What becomes of a vertex or a target that is seen, and who is told.
#include <brushfire/solvers/windows/propagation/arrivals.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// False where it is nothing new.
bool take(PartState& part, Index v, Real value, const Ray& ray, bool all_around) {
  const Real before = part.vertices[v].lower;
  if (!part.vertices.see(v, value, ray)) return false;
  if (!all_around && part.run->structure.bend[v] == Bend::None) return true;
  EventQueue& queue = part.activity->queue;
  VertexLight& light = part.vertices.light(v);
  const bool queued = light.waiting && queue.same_bucket(to_double(before), to_double(value));
  light.came_from(crossed_at(part.run->structure, ray));
  light.all_around = all_around;
  if (!(value < before)) return true;
  light.waiting = true;
  if (!queued) queue.push_vertex(v, to_double(value));
  return true;
}

}  // namespace

void accept(PartState& part, Index v, Real value, const Ray& ray, bool all_around) {
  if (!take(part, v, value, ray, all_around)) return;
  const std::vector<VertexValues>& values = part.run->values;
  for (Index c = part.vertices[v].next_ghost; c != v && c != kNoIndex; c = values[c].next_ghost) {
    send_label(part, part.run->structure.part_of_vertex(c), ray.root);
    part.activity->outbox.send(SightMessage{c, value, ray, all_around});
  }
}

void receive_sight(PartState& part, Index v, Real value, const Ray& ray, bool all_around) {
  take(part, v, value, ray, all_around);
}

void reach_target(PartState& part, Index target, Real value, Real slack, Real lift, const Ray& ray, bool straight) {
  const TargetState& t = part.run->targets[target];
  if (value + slack >= t.upper && !(straight && value <= t.lower)) return;
  part.activity->outbox.send(TargetMessage{target, value, slack, lift, ray, straight});
}

void send_label(PartState& part, Index to, Index root) {
  if (!part.run->several || root >= part.run->structure.vertex_count()) return;
  Outbox& outbox = part.activity->outbox;
  const std::vector<LabelMessage>& sent = outbox.all<LabelMessage>();
  if (!sent.empty() && sent.back().part == to && sent.back().root == root) return;
  outbox.send(LabelMessage{to, root, part.vertices.label_of(root)});
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
