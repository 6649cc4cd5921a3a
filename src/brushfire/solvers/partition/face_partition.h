// The faces of a mesh cut into parts that have vertices of their own.
#pragma once

#include <brushfire/core/types.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace brushfire::partition {

// A part is a run of 2^bits consecutive faces. A vertex whose faces lie in several parts has a number in each of them;
// seen from one part, its numbers in the others are its ghost vertices. How faces are cut depends on nothing but their
// order.
class FacePartition {
 public:
  // One part, until number_vertices().
  FacePartition(Index vertex_count, Index face_count, unsigned bits);

  Index count() const { return static_cast<Index>(first_vertex_.size()) - 1; }
  Index part_of_face(Index f) const { return f >> bits_; }
  Index first_face(Index part) const { return static_cast<Index>(std::uint64_t{part} << bits_); }
  Index end_face(Index part) const {
    return static_cast<Index>(std::min<std::uint64_t>(std::uint64_t{part + 1} << bits_, face_count_));
  }
  Index part_of_vertex(Index v) const;  // O(log parts)
  Index first_vertex(Index part) const { return first_vertex_[part]; }
  Index end_vertex(Index part) const { return first_vertex_[part + 1]; }
  bool is_in(Index part, Index v) const { return first_vertex_[part] <= v && v < first_vertex_[part + 1]; }
  bool has_ghosts() const { return !ghosts_.empty(); }
  // The number of the same vertex in the next part that has it, after the last part in the first; kNoIndex where one
  // part only has it. O(log ghosts).
  Index next_ghost(Index v) const;
  // v's number in a part, found from ghost to ghost; kNoIndex: it has none there.
  Index ghost_in(Index part, Index v) const;
  // visit(v, next_ghost(v)) for all that have any, ascending.
  template <class Visit>
  void for_each_ghost(Visit&& visit) const {
    for (const auto& [vertex, next] : ghosts_) visit(vertex, next);
  }

  // Numbers the vertices part by part, ascending within one, and puts the new numbers in place of the old ones:
  // vertices_of(f) is the face's, as three Index& in an array. Returns the old number of every new one.
  template <class VerticesOf>
  std::vector<Index> number_vertices(Index vertex_count, const VerticesOf& vertices_of);

 private:
  void close_rings(std::vector<std::pair<Index, Index>> links);

  unsigned bits_;
  Index face_count_;
  std::vector<Index> first_vertex_;              // [parts + 1]
  std::vector<std::pair<Index, Index>> ghosts_;  // ascending: a vertex that has ghosts, and its next one
};

template <class VerticesOf>
std::vector<Index> FacePartition::number_vertices(Index vertex_count, const VerticesOf& vertices_of) {
  const Index parts = std::max(Index{1}, part_of_face(face_count_ + (Index{1} << bits_) - 1));
  std::vector<Index> places;                          // the old numbers
  std::vector<Index> latest(vertex_count, kNoIndex);  // the new number in the latest part, by old numbers
  std::vector<std::pair<Index, Index>> links;         // from the number in one part to that in the next one
  std::vector<std::uint64_t> marks(vertex_count / 64 + 1, 0);
  places.reserve(vertex_count + vertex_count / 16);
  first_vertex_.assign(1, 0);
  for (Index part = 0; part < parts; ++part) {
    const std::size_t first = places.size();
    std::size_t low = marks.size(), high = 0;  // of the words with marks
    for (Index f = first_face(part); f < end_face(part); ++f) {
      for (const Index place : vertices_of(f)) {
        const std::size_t word = place / 64;
        marks[word] |= std::uint64_t{1} << place % 64;
        low = std::min(low, word), high = std::max(high, word + 1);
      }
    }
    for (std::size_t word = low; word < high; ++word) {
      for (std::uint64_t bits = std::exchange(marks[word], 0); bits != 0; bits &= bits - 1) {
        places.push_back(static_cast<Index>(64 * word + static_cast<std::size_t>(std::countr_zero(bits))));
      }
    }
    for (std::size_t v = first; v < places.size(); ++v) {
      Index& before = latest[places[v]];
      if (before != kNoIndex) links.emplace_back(before, static_cast<Index>(v));
      before = static_cast<Index>(v);
    }
    for (Index f = first_face(part); f < end_face(part); ++f) {
      for (Index& v : vertices_of(f)) v = latest[v];
    }
    first_vertex_.push_back(static_cast<Index>(places.size()));
  }
  for (Index place = 0; place < vertex_count; ++place) {
    if (latest[place] == kNoIndex) places.push_back(place);  // of no face
  }
  first_vertex_.back() = static_cast<Index>(places.size());
  close_rings(std::move(links));
  return places;
}

}  // namespace brushfire::partition
