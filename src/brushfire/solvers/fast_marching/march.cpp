// The loops of the march, once per front model, label mode and target.
//
// Compiled without math errno and floating-point traps (see CMakeLists.txt): a square root is one instruction. Nothing
// is contracted or reordered: every target gives the same bits.
#include <brushfire/solvers/fast_marching/detail/march.h>

#include <brushfire/core/detail/lanes.h>
#include <brushfire/solvers/fast_marching/detail/candidate_updates.h>
#include <brushfire/solvers/fast_marching/detail/fronts.h>
#include <brushfire/solvers/fast_marching/detail/march_prefetch.h>
#include <brushfire/solvers/fast_marching/detail/messages.h>
#include <brushfire/solvers/fast_marching/detail/relax.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <queue>
#include <utility>

#define BRUSHFIRE_KERNEL <brushfire/solvers/fast_marching/detail/march_kernel.h>
#include <brushfire/core/detail/each_target.h>

namespace brushfire::fast_marching {

template <class T>
MarchPart<T> march_part(FrontModel model, bool labelled, Variant variant) {
  return BRUSHFIRE_ON_TARGET(variant, march_part<T>(model, labelled));
}

template <class T>
void march_label_setting(const Rings<T>& rings, MarchState<T>& s, const std::function<void()>& poll) {
  BRUSHFIRE_ON_TARGET(Variant::Best, march_label_setting(rings, s, poll));
}

template MarchPart<float> march_part<float>(FrontModel, bool, Variant);
template MarchPart<double> march_part<double>(FrontModel, bool, Variant);
template void march_label_setting<float>(const Rings<float>&, MarchState<float>&, const std::function<void()>&);
template void march_label_setting<double>(const Rings<double>&, MarchState<double>&, const std::function<void()>&);

}  // namespace brushfire::fast_marching
