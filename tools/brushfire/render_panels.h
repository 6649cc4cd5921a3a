// What the panels of a picture show: values, labels, sources, paths, errors.
#pragma once

#include "sources.h"
#include "surface.h"
#include "talk.h"

#include <brushfire/figure/render.h>
#include <brushfire/solvers/distance.h>

#include <string>
#include <vector>

namespace brushfire::tool {

// The scale of the distances (or other values), and the scale of the errors.
inline constexpr std::size_t kValues = 0, kErrors = 1;

// What is shown of distances, once for all methods.
struct Shown {
  std::vector<Source> sources;
  std::vector<Where> ends;  // of paths
  std::vector<Polyline> paths;
};

// Paths are exact whatever the method of the colours: that is what a path is compared with. Of costs, where they are
// asked for.
void find_paths(const Surface& surface, PlaceFinder& places, const DistanceOptions& how, Shown& shown);

// Where a source looks to: away from the middle of the mesh, and along its face's normal.
Vec3 outward_at(const Mesh& mesh, const Source& source);

// Distances from the sources by one method, and what is drawn with them. Negative on the left of curves where the
// options keep paths.
Panel solved_panel(const Domain& domain, const Shown& shown, DistanceOptions options, const Talk& talk);

// Cells with their borders as exact as voronoi() has them, and colours that differ from one cell to the next.
void add_cells(const Surface& surface, const Shown& shown, const DistanceOptions& how, std::vector<Panel>& panels);

// One more panel for each but the last: its relative difference from the last. Returns where their colours end.
double add_errors(std::vector<Panel>& panels);

// Crevices darker, where Embree was there when this was built.
void add_ambient_occlusion(const Mesh& mesh, const Talk& talk, std::vector<Panel>& panels);

// Labels from a file: whole numbers, negative ones for none; names where the file has some.
std::vector<Index> labels_of(const std::string& file, const Surface& surface, Panel& panel);

}  // namespace brushfire::tool
