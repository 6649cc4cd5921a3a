// What a matrix is of, as one number: the mesh with its walls, the places, and the options that values depend on.
#pragma once

#include <brushfire/queries/distance_matrix.h>

#include <cstdint>
#include <string_view>

namespace brushfire::detail {

// FNV-1a, 64 bits: tells apart what was begun from what is asked for now; no defence against forgery.
class Fingerprint {
 public:
  void add(const void* data, std::size_t size);
  void add(double value) { add(&value, sizeof value); }
  void add(std::uint64_t value) { add(&value, sizeof value); }
  void add(std::string_view text) { add(text.data(), text.size()); }
  void add(const Place& place);
  void add(const Places& places);
  void add(const Weighting& weighting);
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

// Of this version of the library, too: another one may round otherwise.
std::uint64_t fingerprint_of(const Domain& domain, const Places& rows, const Places& columns, ValueType type,
                             const DistanceOptions& options, double unit = 1);

}  // namespace brushfire::detail
