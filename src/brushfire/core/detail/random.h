// A small random generator whose numbers are the same on every platform.
//
// Based on: Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014 (SplitMix64).
#pragma once

#include <cstdint>

namespace brushfire {

// Scrambles 64 bits; neighbouring numbers give unrelated results.
constexpr std::uint64_t scrambled(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// The upper 53 bits as a number in [0, 1).
constexpr double unit_interval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) : state_(seed) {}

  constexpr std::uint64_t bits() {
    const std::uint64_t result = scrambled(state_);
    state_ += 0x9e3779b97f4a7c15u;
    return result;
  }
  constexpr double uniform() { return unit_interval(bits()); }  // in [0, 1)
  constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // In [0, n), n > 0; the bias of the remainder is below n / 2^64.
  constexpr std::uint64_t below(std::uint64_t n) { return bits() % n; }

 private:
  std::uint64_t state_;
};

}  // namespace brushfire
