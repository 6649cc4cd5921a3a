// The fast marching methods: novotni-klein, novotni-klein-2002 and kimmel-sethian.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/detail/engine.h>

#include <memory>

namespace brushfire::detail {

// One engine for the three methods and both precisions: which one runs stands in the problem's options.
std::unique_ptr<Engine> make_fast_marching(const Mesh& mesh);

}  // namespace brushfire::detail
