// Windows through a weighted mesh: proven lower bounds of what it costs to get to every vertex, and upper ones.
//
// The propagation is that of solvers/windows/, one window at a time on one thread, and docs/tolerance.md is its proof;
// what weights add is in docs/weights.md. Values of windows are costs divided by the weight of the face that they are
// about to enter; those of vertices and targets are costs.
#pragma once

#include <brushfire/core/cancel.h>
#include <brushfire/core/progress.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/refraction/detail/medium.h>
#include <brushfire/solvers/refraction/detail/refract.h>
#include <brushfire/solvers/steiner/detail/apex_costs.h>
#include <brushfire/solvers/windows/algebra/dominance.h>
#include <brushfire/solvers/windows/algebra/envelope.h>
#include <brushfire/solvers/windows/algebra/merge.h>
#include <brushfire/solvers/windows/propagation/fan.h>
#include <brushfire/solvers/windows/propagation/links.h>
#include <brushfire/solvers/windows/propagation/targets.h>
#include <brushfire/solvers/windows/store/lists.h>
#include <brushfire/solvers/windows/store/queue.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace brushfire::refraction {

// In mesh.unit() times weight, from the least offset of a source on; +inf: not reached.
struct Known {
  double lower = kInfinity, upper = kInfinity;
  Index source = kNoIndex;  // whose path the upper bound is: a position in the run's list
};

struct RunLimits {
  double share = 0.01;                 // (upper - lower) of the length of a path, as far as windows can be cut for it
  double max_value = kInfinity;        // what costs more is not wanted
  double most_per_vertex = kInfinity;  // windows for each vertex reached; where it takes more, the run gives up
  std::span<const PointLocation> targets{};
  Progress progress{};
  // [sources], or empty: light of sources next to a vertex starts there, where it cannot go round the vertex in circles
  // that are lost in rounding. What that may be off by is far below what is asked for (kHidden).
  std::span<const steiner::NearVertex> near{};
};

class Run {
 public:
  // `medium` must be followable and outlive the run. The sources' offsets are >= 0.
  Run(Medium& medium, std::span<const detail::LocatedSource> sources, const RunLimits& limits);
  ~Run() { targets_.clear(medium_.structure); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  // False where it takes more windows than the limits allow, or rounding lost some light: nothing is known then. Polls
  // what the thread listens to.
  bool operator()();
  // With rounding taken off and added. Vertices by the numbers of the medium's mesh.
  Known at_vertex(Index outer) const;
  Known at_target(std::size_t target) const;
  std::uint64_t windows() const { return windows_; }  // that came to wait somewhere
  double horizon() const { return radius_; }          // values up to this are final

 private:
  struct Vertex {
    double lower = kInfinity, upper = kInfinity;
    Index source = kNoIndex;
    bool waiting = false, all_around = false;
    windows::CrossedAt from;  // of what gave `lower`
  };

  // From where light goes on: what is known there, in costs.
  struct Origin {
    double value = 0, slack = 0;
    Index source = 0;
  };

  // ---- sources.cpp: light that begins, or begins anew
  void start(const detail::LocatedSource& source, Index number);
  bool start_at_near_vertex(Index number);
  void start_in_face(const windows::FaceWeights& at, const Origin& origin);
  void start_on_edge(const PointLocation& at, const Origin& origin);
  void leave_vertex(Index v);
  void leave_through(Index v, Index corner);
  void leave_into(Index v, windows::Sector sector);
  void reach_along(const Origin& origin, Index v, Index face, Index corner);
  void run_along(const Origin& origin, Index halfedge, double place, bool forwards);
  void run_into(const Origin& origin, Index halfedge, double place, bool forwards);
  void finish_targets();
  bool is_complete() const;
  bool is_too_dear() const;

  // ---- run.cpp: windows on their way
  void leave_face(Index h, const Window& w);
  void refract_at(Index h, const Window& w);
  void run_from_critical(Index h, const Window& w);
  void enter(Index h, const Window& w);
  void enter_from(Index end, Index g, const Window& w);
  void pass_halfedge(Index h);
  void pass_face(Index h, const windows::Frame& frame, const Window& w);
  void pass_along(Index h, const windows::Frame& frame, const Window& w);
  std::span<Window> what_is_left(std::span<Window> windows, const windows::WindowFace& face, double weight);
  void see(Index v, double value, const windows::Ray* ray, bool all_around);
  void reach(Index v, double cost, Index source);
  void reach_target(Index target, double value, double slack, Index source, bool straight);
  void narrow();
  bool gives_up();

  double start_of(Index source) const { return sources_[source].offset; }
  Origin origin_at(Index v) const;
  windows::WindowFace& face(Index h) { return medium_.structure.faces[h / 3]; }
  windows::EdgeBounds bounds(const windows::WindowFace& f, Index k, double inverse_weight) const;

  Medium& medium_;
  std::span<const detail::LocatedSource> sources_;
  RunLimits limits_;
  double radius_ = kInfinity;
  std::vector<Vertex> vertices_;
  windows::Targets targets_;
  windows::WindowLists waiting_;
  windows::EventQueue queue_;
  windows::Envelope envelope_;
  windows::LinkShadow link_;
  std::vector<Window> taken_, on_edge_, refracted_;
  std::vector<Index> corners_;
  std::uint64_t windows_ = 0, next_look_ = 0;
  bool given_up_ = false;
  Index seen_ = 0;
  Poll poll_{256};
};

}  // namespace brushfire::refraction
