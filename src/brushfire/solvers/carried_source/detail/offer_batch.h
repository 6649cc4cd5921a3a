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
  // Beside the bits of the Update below kAcross: what is true of the sources, seen from either end of the edge.
  enum Fact : std::uint32_t { kTurnedHere = 32, kTurnedThere = 64, kDarkHere = 128, kDarkThere = 256 };
  enum BendFact : std::uint32_t { kBendsHere = 512, kBendsThere = 1024 };

  int count = 0;
  Index target[kLanes];
  Index label[kLanes];
  std::uint8_t sector[kLanes];  // of the target
  std::uint32_t facts[kLanes] = {};
  Four<T> here[kLanes], there[kLanes];  // value, sigma, x, y of the vertex and of the support's end
  Four<T> by[kLanes], to[kLanes];       // length, c, s, end_c of the sides to the support's end and to the target
  Four<T> ends[kLanes];                 // end_s of both sides, Around of the target
  Four<T> around[kLanes];               // of the vertex and of the support's end
  alignas(8 * sizeof(T)) T value[kLanes], sigma[kLanes], x[kLanes], y[kLanes];  // what came out: the offers
};

}  // namespace brushfire::carried_source

#define BRUSHFIRE_KERNEL <brushfire/solvers/carried_source/detail/offer_batch_kernel.h>
#include <brushfire/core/detail/each_target.h>
