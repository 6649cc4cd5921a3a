// The mesh that a verb works on: read from a file, welded where that was asked for, with the walls in it, and the way
// back to the file's numbers.
#pragma once

#include "shared.h"
#include "where.h"

#include <brushfire/io/read_field.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/steiner/weights.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brushfire::tool {

// Binds FILE, whose help names every format that is read.
void add_surface(Verb& verb, std::string& file);

class Surface {
 public:
  // Throws what read_mesh(), weld() and walls_of() throw.
  Surface(const std::string& file, const SharedArguments& arguments);

  const Domain& domain() const { return domain_; }        // to compute in
  const Barriers& barriers() const { return barriers_; }  // those of options, which are in domain()
  const Mesh& mesh() const { return domain_.mesh(); }     // all of it, whose numbers are used
  const LoadedMesh& file() const { return loaded_; }      // as it was read
  // What going costs; null where nothing was said. Its walls are walls of domain().
  const Weights* weights() const { return weights_ ? &*weights_ : nullptr; }
  bool is_welded() const { return !vertex_map_.empty(); }
  std::vector<std::string> remarks() const;

  // A place whose vertex number is that of the file, as a place on mesh().
  Where place(const Where& where) const;
  // Which vertex of mesh() the file's vertex v is.
  Index vertex(Index v) const { return is_welded() ? vertex_map_[v] : v; }
  // The first of the file's vertices that became v; kNoIndex stays.
  Index file_vertex(Index v) const;

  // Values on the vertices of mesh(), on those of the file.
  template <class T>
  std::vector<T> on_file(std::span<const T> values) const {
    if (!is_welded() || values.empty()) return {values.begin(), values.end()};
    std::vector<T> out;
    out.reserve(vertex_map_.size());
    for (const Index v : vertex_map_) out.push_back(values[v]);
    return out;
  }
  // What walls leave open, for a file. Throws Error(InvalidArgument) where a wall is a single edge, whose ends stay
  // whole: files tell the sides of an edge apart by its vertices.
  const Mesh& open_for_file() const;

  // Vertices that a mask leaves open, and none of their faces.
  Index left_alone() const { return left_alone_; }

  // [file's vertices] 1 where a vertex is in a face that is open; empty where there are no walls.
  std::vector<std::uint8_t> open_vertices() const;

  // Values on the vertices of the file, on those of mesh(). Throws Error(InvalidArgument) where vertices that were
  // joined have different ones; `name` is the values' file.
  std::vector<double> on_mesh(std::vector<double> values, const std::string& name) const;

 private:
  LoadedMesh loaded_;
  Domain domain_;
  Barriers barriers_;
  std::optional<Weights> weights_;
  std::vector<Index> vertex_map_;
  Index joined_ = 0, left_alone_ = 0;
};

}  // namespace brushfire::tool
