// Reading and welding.
#include "surface.h"

#include "output.h"

#include <brushfire/core/error.h>
#include <brushfire/io/formats.h>
#include <brushfire/mesh/weld.h>

namespace brushfire::tool {

void add_surface(Verb& verb, SurfaceArguments& arguments) {
  verb.argument("FILE", arguments.file, ("The mesh, - for standard input: " + names_of(meshes_read())).c_str());
  verb.option("--weld", arguments.weld, "T", "Join vertices within T of one another (0: equal ones)");
}

Surface::Surface(const SurfaceArguments& arguments) : loaded_(read_mesh(arguments.file)), mesh_(loaded_.mesh) {
  if (!arguments.weld) return;
  if (!(*arguments.weld >= 0)) refuse("--weld " + exact(*arguments.weld) + " is not a number >= 0");
  Welded welded = weld(loaded_.mesh, *arguments.weld);
  mesh_ = std::move(welded.mesh);
  vertex_map_ = std::move(welded.vertex_map);
  joined_ = welded.joined;
}

std::vector<std::string> Surface::remarks() const {
  std::vector<std::string> remarks = loaded_.remarks;
  if (is_welded()) remarks.push_back(counted(joined_, "vertex", "vertices") + " joined to another");
  return remarks;
}

Where Surface::place(const Where& where) const {
  Where on_mesh = where;
  auto* vertex = std::get_if<VertexPlace>(&on_mesh.place);
  if (vertex != nullptr && vertex->index < vertex_map_.size()) vertex->index = vertex_map_[vertex->index];
  return on_mesh;
}

}  // namespace brushfire::tool
