// Window propagation as an engine of distance(): exact at tolerance 0.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/detail/engine.h>

#include <memory>

namespace brushfire::detail {

std::unique_ptr<Engine> make_windows(const Mesh& mesh);

}  // namespace brushfire::detail
