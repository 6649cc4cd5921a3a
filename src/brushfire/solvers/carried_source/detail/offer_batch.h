// Offers that are worked out together, one to a lane: those of a few turns that follow each other.
#pragma once

#include <brushfire/solvers/carried_source/detail/offer_frame.h>
#include <brushfire/solvers/carried_source/detail/records.h>
#include <brushfire/solvers/carried_source/detail/update.h>

#include <cstdint>

namespace brushfire::carried_source {

// Four numbers of an offer as they lie in memory: lanes are made of them when all are there.
template <class T>
struct alignas(4 * sizeof(T)) Four {
  T a = 0, b = 0, c = 0, d = 0;
};

template <class T>
struct OfferBatch {
  static constexpr int kLanes = 8;
  // Beside the bits of the Update up to kAcross: the ends of the edge that bend light.
  enum Fact : std::uint32_t { kBendsHere = 32, kBendsThere = 64 };
  // In words: of the vertex in the lower half, of the support's end in the upper one.
  static constexpr std::uint32_t kHere = 0xffff, kThere = 0xffff0000;

  int count = 0;
  Index target[kLanes];
  Index label[kLanes];
  std::uint8_t sector[kLanes];  // of the target
  std::uint32_t facts[kLanes] = {};
  std::uint32_t sectors[kLanes] = {}, turned[kLanes] = {}, dark[kLanes] = {};  // and SightSets of the edge
  Four<T> here[kLanes], there[kLanes];  // value, sigma, x, y of the vertex and of the support's end
  Four<T> by[kLanes], to[kLanes];       // length, c, s, end_c of the sides to the support's end and to the target
  Four<T> ends[kLanes];                 // end_s of both sides, Around of the target
  Four<T> around[kLanes];               // of the vertex and of the support's end
  alignas(8 * sizeof(T)) T value[kLanes], sigma[kLanes], x[kLanes], y[kLanes];  // what came out: the offers
};

}  // namespace brushfire::carried_source

#define BRUSHFIRE_KERNEL <brushfire/solvers/carried_source/detail/offer_batch_kernel.h>
#include <brushfire/core/detail/each_target.h>
