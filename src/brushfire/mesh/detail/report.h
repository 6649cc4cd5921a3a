// Builds the MeshReport of a mesh.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/report.h>

namespace brushfire::detail {

MeshReport build_report(const Mesh& mesh);

}  // namespace brushfire::detail
