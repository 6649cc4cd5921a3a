// The march: takes vertices from the queue in order of their values and updates their neighbours.
#pragma once

#include <brushfire/core/detail/targets.h>
#include <brushfire/solvers/fast_marching/detail/march_state.h>
#include <brushfire/solvers/fast_marching/detail/ring_blocks.h>

#include <cstdint>
#include <functional>

namespace brushfire::fast_marching {

enum class FrontModel : std::uint8_t { Circular, LiteralCircular, Planar };

// Part `part` does its share of the current round.
template <class T>
using MarchPart = void (*)(const Rings<T>&, MarchState<T>&, Index part);

template <class T>
MarchPart<T> march_part(FrontModel model, bool labelled, Variant variant = Variant::Best);

// Label-setting in strict order, as the paper of 2002 has it, to the end: its values need not grow along the way, so
// there is no radius to stop at. Calls `poll` every kSlice vertices. The mesh must be one part.
inline constexpr std::size_t kSlice = 8192;
template <class T>
void march_label_setting(const Rings<T>& rings, MarchState<T>& state, const std::function<void()>& poll);

}  // namespace brushfire::fast_marching
