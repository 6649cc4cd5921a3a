// Method::CarriedSource.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/detail/engine.h>

#include <memory>

namespace brushfire::carried_source {

// Both precisions: which one runs stands in the problem's options.
std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh);

}  // namespace brushfire::carried_source
