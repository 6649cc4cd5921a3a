// Which numbers a mesh needs.
#include <brushfire/solvers/windows/detail/engine.h>

#include <brushfire/core/error.h>

namespace brushfire::detail {

std::unique_ptr<Engine> make_windows(const Mesh& mesh, unsigned part_bits, Merging merging) {
  if (mesh.vertex_count() >= kNoIndex / 2) throw Error(ErrorCode::TooLarge, "too many vertices for windows");
  return in_doubles::make_engine(mesh, part_bits, merging);
}

}  // namespace brushfire::detail
