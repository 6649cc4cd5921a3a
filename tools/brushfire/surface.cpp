// Reading and welding.
#include "surface.h"

#include "output.h"
#include "walls.h"
#include "weights.h"

#include <brushfire/io/formats.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/weld.h>
#include <brushfire/solvers/weighted/weighting.h>

#include <algorithm>
#include <cmath>

namespace brushfire::tool {

void add_surface(Verb& verb, std::string& file) {
  verb.argument("FILE", file, ("The mesh, - for standard input: " + names_of(meshes_read())).c_str());
}

Surface::Surface(const std::string& file, const SharedArguments& arguments)
    : loaded_(read_mesh(file)), domain_(loaded_.mesh) {
  if (arguments.weld) {
    Welded welded = weld(loaded_.mesh, *arguments.weld);
    domain_ = std::move(welded.mesh);
    vertex_map_ = std::move(welded.vertex_map);
    joined_ = welded.joined;
  }
  Walls walls;
  if (given(arguments, kWalls)) {
    walls = walls_of(arguments, loaded_.mesh, mesh(), vertex_map_);
    barriers_ = walls.barriers;
    domain_ = Domain(mesh(), barriers_);
  }
  if (given(arguments, kWeights)) {
    weights_ = weights_of(arguments, *this);
    domain_ = with_walls(domain_, walls_of(*weights_));
  }
  for (Index v = 0; v < walls.mask.size(); ++v) {
    left_alone_ += walls.mask[v] && !domain_.is_open(v) && !mesh().corners(v).empty();
  }
}

std::vector<std::string> Surface::remarks() const {
  std::vector<std::string> remarks = loaded_.remarks;
  if (is_welded()) remarks.push_back(counted(joined_, "vertex", "vertices") + " joined to another");
  return remarks;
}

std::vector<std::uint8_t> Surface::open_vertices() const {
  if (!domain_.has_walls()) return {};
  std::vector<std::uint8_t> open;
  for (Index v = 0; v < loaded_.mesh.vertex_count(); ++v) open.push_back(domain_.is_open(vertex(v)));
  return open;
}

const Mesh& Surface::open_for_file() const {
  const Mesh& open = domain_.open();
  if (!domain_.has_walls() || !open.has_positions()) return open;
  if (Mesh(open.positions(), open.faces()).report().boundary_edges != open.report().boundary_edges) {
    refuse("a wall of a single edge has whole ends, and no file tells its sides apart: block an edge beside it, too");
  }
  return open;
}

Where Surface::place(const Where& where) const {
  Where on_mesh = where;
  auto* vertex = std::get_if<VertexPlace>(&on_mesh.place);
  if (vertex != nullptr && vertex->index < vertex_map_.size()) vertex->index = vertex_map_[vertex->index];
  return on_mesh;
}

Index Surface::file_vertex(Index v) const {
  if (!is_welded() || v == kNoIndex) return v;
  return static_cast<Index>(std::find(vertex_map_.begin(), vertex_map_.end(), v) - vertex_map_.begin());
}

std::vector<double> Surface::on_mesh(std::vector<double> values, const std::string& name) const {
  if (!is_welded()) return values;
  std::vector<double> out(mesh().vertex_count());
  std::vector<Index> first(mesh().vertex_count(), kNoIndex);
  for (Index v = 0; v < vertex_map_.size(); ++v) {
    const Index joined = vertex_map_[v];
    if (first[joined] == kNoIndex) {
      first[joined] = v;
      out[joined] = values[v];
    } else if (values[v] != out[joined] && !(std::isnan(values[v]) && std::isnan(out[joined]))) {
      refuse(name + ": --weld joins vertices " + std::to_string(first[joined]) + " and " + std::to_string(v) +
             ", which have different values, " + exact(out[joined]) + " and " + exact(values[v]));
    }
  }
  return out;
}

}  // namespace brushfire::tool
