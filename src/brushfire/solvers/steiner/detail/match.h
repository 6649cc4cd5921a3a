// Which faces, rows and vertices of one weighted mesh are those of another one of the same domain.
#pragma once

#include <brushfire/solvers/steiner/detail/run.h>

#include <vector>

namespace brushfire::steiner {

// In the numbers of `after`, what had which number before; kNoIndex: nothing like it was there. Walls and fences that
// come and go cut the mesh anew, which renumbers it and lays some rows out anew.
struct Match {
  Match(const Run& before, const Run& after);

  std::vector<Index> face;        // [faces]
  std::vector<Index> row;         // [edges] a row of the same points between the same faces, that runs the same way
  std::vector<Index> vertex;      // [vertices] the end of the same rows
  std::vector<Index> row_after;   // [edges before] the way back of `row`
  std::vector<Index> face_after;  // [faces before]
  bool is_identity = false;

 private:
  void match_all(const Run& run);
  void match_faces(const Run& before, const Run& after);
  void match_rows(const Run& before, const Run& after);
  void match_vertices(const Run& before, const Run& after);
};

}  // namespace brushfire::steiner
