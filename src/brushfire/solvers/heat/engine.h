// method "heat" as an engine of distance().
#pragma once

#include <brushfire/solvers/detail/engine.h>

#include <memory>

namespace brushfire::heat {

std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh);

}  // namespace brushfire::heat
