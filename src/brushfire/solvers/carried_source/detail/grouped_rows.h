// Rows of distance matrices with carried sources: sixteen neighbouring vertices at a time.
#pragma once

#include <brushfire/core/detail/marks.h>
#include <brushfire/core/detail/targets.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/carried_source/detail/group_march.h>
#include <brushfire/solvers/carried_source/detail/source_groups.h>
#include <brushfire/solvers/detail/local_mesh.h>
#include <brushfire/solvers/distance.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace brushfire::carried_source {

// What threads share: the records of the mesh, and which vertices are sources together. A group is run as a whole,
// whichever of its rows are asked for: so a row is the same whatever else is.
class GroupedRows {
 public:
  // Whether these options are those of grouped rows: in single precision, where that is enough for the mesh.
  static bool serve(const Domain& domain, const DistanceOptions& options);

  // `asked`: vertices of domain.mesh(). Those that are in no group afterwards are to be run alone: vertices on walls
  // (each is a source on every side), with hardly any others close by, or in no face.
  GroupedRows(const Domain& domain, std::span<const Index> asked);

  struct Group {
    std::vector<Index> vertices;  // of domain.mesh(), by lane
    double spread = 0;
  };
  const std::vector<Group>& groups() const { return groups_; }

 private:
  friend class GroupRunner;

  double unit_ = 1;
  detail::LocalMesh local_;  // of domain.open(), where faces over the same vertices are one
  Records<float> records_;
  // A vertex of domain.mesh() and where it is in the records: a vertex on a wall is in several places.
  using Placed = std::pair<Index, Index>;
  std::vector<Index> place_;       // [vertices of domain.mesh()] the first one
  std::vector<Placed> copies_;     // the others
  std::vector<Placed> by_vertex_;  // all, ascending
  std::vector<Index> rank_;        // [records] in by_vertex_
  std::vector<Group> groups_;
};

// One thread's memory for the march: some 350 bytes a vertex, and 64 more for the rows.
class GroupRunner {
 public:
  explicit GroupRunner(const GroupedRows& rows, Variant variant = Variant::Best,
                       int most_turns = GroupMarch::kMostTurns);

  // A lane's distances to all vertices of domain.mesh(), in unit()s of the mesh. Valid during the call.
  using Take = std::function<void(int lane, std::span<const float> distances)>;
  // Hands out lanes in any order, their values right up to max_distance (in the mesh's units; those beyond may be
  // there, too), and returns the lanes that it did not hand out: they are to be run alone. Where a vertex uses up its
  // turns the group is split and its halves are run, down to single lanes, which are returned. Throws Error(Cancelled).
  std::vector<int> run(const GroupedRows::Group& group, double max_distance, const Take& take);

  // What a lane reaches within max_distance: vertices of domain.mesh(), ascending, and distances to them in unit()s of
  // the mesh. Valid during the call.
  using TakeReached = std::function<void(int lane, std::span<const Index> vertices, std::span<const float> distances)>;
  // The same, at the price of what it reaches. Values may differ from run()'s, by some 0.01 %; for one and the same
  // max_distance they are always the same bits.
  std::vector<int> run_within(const GroupedRows::Group& group, double max_distance, const TakeReached& take);

  double unit() const { return rows_.unit_; }
  const GroupMarch& march() const { return march_; }

 private:
  using Beyond = GroupMarch::Beyond;
  // finish(begin, end) for lanes that marched together.
  template <class Finish>
  std::vector<int> run_parts(const GroupedRows::Group& group, double max_distance, Beyond beyond, const Finish& finish);
  bool run_lanes(const GroupedRows::Group& group, int begin, int end, double max_distance, Beyond beyond);
  template <class PlaceOf>
  void transpose(std::size_t count, const PlaceOf& place_of);
  void list_reached();
  std::size_t keep(std::span<const float> values, float last);
  std::span<const float> of_lane(int lane, std::size_t count) const {
    return std::span(values_).subspan(static_cast<std::size_t>(lane) * count, count);
  }

  const GroupedRows& rows_;
  GroupMarch march_;
  std::vector<float> values_;  // [kGroupLanes][count], in units of the open mesh
  detail::Marks marks_;        // of ranks
  std::vector<GroupedRows::Placed> reached_;
  std::vector<Index> columns_;  // of a lane within the radius
  std::vector<float> kept_;     // the same
};

}  // namespace brushfire::carried_source
