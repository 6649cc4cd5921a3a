// Which faces, rows and vertices of one weighted mesh are those of another one of the same domain.
#pragma once

#include <brushfire/solvers/steiner/detail/run.h>

#include <vector>

namespace brushfire::steiner {

// In the numbers of `after`, what had which number before; kNoIndex: nothing like it was there. Fences, and walls that
// have to be cut out (wall_faces.h), cut the mesh anew when they come and go, which renumbers it and lays some rows out
// anew.
struct Match {
  Match(const Run& before, const Run& after);

  const bool is_identity;  // everything has the number that it had

  Index face(Index f) const { return is_identity ? f : face_[f]; }
  // A row of the same points between the same faces, that runs the same way.
  Index row(Index e) const { return is_identity ? e : row_[e]; }
  Index vertex(Index v) const { return is_identity ? v : vertex_[v]; }  // the end of the same rows
  // The way back.
  Index row_after(Index e) const { return is_identity ? e : row_after_[e]; }
  Index face_after(Index f) const { return is_identity ? f : face_after_[f]; }
  Index vertex_after(Index v) const { return is_identity ? v : vertex_after_[v]; }

 private:
  void match_faces(const Run& before, const Run& after);
  void match_rows(const Run& before, const Run& after);
  void match_vertices(const Run& before, const Run& after);

  std::vector<Index> face_, row_, vertex_;                    // [faces], [edges], [vertices] after
  std::vector<Index> face_after_, row_after_, vertex_after_;  // [faces], [edges], [vertices] before
};

}  // namespace brushfire::steiner
