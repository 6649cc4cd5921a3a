// The mesh that a verb works on: read from a file, welded where that was asked for, and the way back to the file's
// numbers.
#pragma once

#include "command_line.h"
#include "where.h"

#include <brushfire/io/read_mesh.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brushfire::tool {

struct SurfaceArguments {
  std::string file;
  std::optional<double> weld;
};

// Binds FILE, whose help names every format that is read, and --weld.
void add_surface(Verb& verb, SurfaceArguments& arguments);

class Surface {
 public:
  // Throws what read_mesh() and weld() throw.
  explicit Surface(const SurfaceArguments& arguments);

  const Mesh& mesh() const { return mesh_; }          // to compute on
  const LoadedMesh& file() const { return loaded_; }  // as it was read
  bool is_welded() const { return !vertex_map_.empty(); }
  std::vector<std::string> remarks() const;

  // A place whose vertex number is that of the file, as a place on mesh().
  Where place(const Where& where) const;
  // Which vertex of mesh() the file's vertex v is.
  Index vertex(Index v) const { return is_welded() ? vertex_map_[v] : v; }

  // Values on the vertices of mesh(), on those of the file.
  template <class T>
  std::vector<T> on_file(std::span<const T> values) const {
    if (!is_welded() || values.empty()) return {values.begin(), values.end()};
    std::vector<T> out;
    out.reserve(vertex_map_.size());
    for (const Index v : vertex_map_) out.push_back(values[v]);
    return out;
  }

 private:
  LoadedMesh loaded_;
  Mesh mesh_;
  std::vector<Index> vertex_map_;
  Index joined_ = 0;
};

}  // namespace brushfire::tool
