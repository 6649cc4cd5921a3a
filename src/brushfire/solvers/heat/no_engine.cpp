// In place of engine.cpp where there is no Eigen, or no BRUSHFIRE_HEAT: what cannot run is not linked either, and the
// WebAssembly stays small.
#include <brushfire/core/error.h>
#include <brushfire/solvers/heat/cholesky.h>
#include <brushfire/solvers/heat/engine.h>

namespace brushfire::heat {

std::unique_ptr<detail::Engine> make_engine(const Mesh&) {
  require_factorization();
  throw Error(ErrorCode::Internal, "heat: this build has Eigen, and no engine");
}

}  // namespace brushfire::heat
