// What becomes of a vertex or a target that is seen, and who receives a message.
#include <brushfire/solvers/windows/propagation/arrivals.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// False where it is nothing new.
bool take(PartState& part, Index v, Real value, const Ray& ray, bool all_around) {
  const Real before = part.vertices[v].lower;
  if (!part.vertices.see(v, value, ray)) return false;
  if (!all_around && part.run->structure.vertex_type[v] == VertexType::None) return true;
  EventQueue& queue = part.activity->queue;
  PseudoSource& pseudo_source = part.vertices.pseudo_source(v);
  const bool queued = pseudo_source.waiting && queue.same_bucket(to_double(before), to_double(value));
  pseudo_source.came_from(crossed_at(part.run->structure, ray));
  pseudo_source.all_around = all_around;
  if (!(value < before)) return true;
  pseudo_source.waiting = true;
  if (!queued) queue.push_vertex(v, to_double(value));
  return true;
}

}  // namespace

void accept(PartState& part, Index v, Real value, const Ray& ray, bool all_around) {
  if (!take(part, v, value, ray, all_around)) return;
  const std::vector<VertexValues>& values = part.run->values;
  for (Index c = part.vertices[v].next_ghost; c != v && c != kNoIndex; c = values[c].next_ghost) {
    send_label(part, part.run->structure.part_of_vertex(c), ray.pseudo_source);
    part.activity->outbox.send(ArrivalMessage{c, value, ray, all_around});
  }
}

void receive(PartState& part, const ArrivalMessage& m) { take(part, m.vertex, m.value, m.ray, m.all_around); }

void reach_target(PartState& part, Index target, Real value, Real slack, Real lift, const Ray& ray, bool straight) {
  const TargetState& t = part.run->targets[target];
  if (value + slack >= t.upper && !(straight && value <= t.lower)) return;
  part.activity->outbox.send(TargetMessage{target, value, slack, lift, ray, straight});
}

void send_label(PartState& part, Index to, Index pseudo_source) {
  if (!part.run->several || pseudo_source >= part.run->structure.vertex_count()) return;
  Outbox& outbox = part.activity->outbox;
  const std::vector<LabelMessage>& sent = outbox.all<LabelMessage>();
  if (!sent.empty() && sent.back().part == to && sent.back().pseudo_source == pseudo_source) return;
  outbox.send(LabelMessage{to, pseudo_source, part.vertices.label_of(pseudo_source)});
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
