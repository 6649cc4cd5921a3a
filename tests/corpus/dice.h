// Random numbers that depend on nothing but what is asked for: a word, a seed and an index.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>

namespace brushfire::corpus {

class Dice {
 public:
  Dice(std::string_view word, std::uint64_t seed, std::uint64_t index) {
    std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
    for (const char c : word) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    std::seed_seq mixed{hash, hash >> 32, seed, seed >> 32, index, index >> 32};
    engine_.seed(mixed);
  }

  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(engine_() % n); }
  // A whole number from low to high.
  int between(int low, int high) { return low + static_cast<int>(below(static_cast<std::size_t>(high - low + 1))); }
  bool chance(double share) { return unit() < share; }
  // In (0, 1), in (-1, 1).
  double unit() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }
  double sign_and_unit() { return 2 * unit() - 1; }
  double within(double low, double high) { return low + (high - low) * unit(); }
  // 10 to the power of something in [low, high).
  double power(double low, double high) { return std::pow(10.0, within(low, high)); }

  std::mt19937& small() {  // for what takes a 32-bit engine
    small_.seed(static_cast<std::uint32_t>(engine_()));
    return small_;
  }

 private:
  std::mt19937_64 engine_;
  std::mt19937 small_;
};

}  // namespace brushfire::corpus
