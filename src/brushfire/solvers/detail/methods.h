// Which engine runs which method.
#pragma once

#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/distance.h>

#include <memory>

namespace brushfire::detail {

// Methods that share one engine go by the name of the first.
Method engine_of(Method method);

// The engine of engine_of(method): a new method is a line there.
std::unique_ptr<Engine> make_engine(const Mesh& mesh, Method method);

}  // namespace brushfire::detail
