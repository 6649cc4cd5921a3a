// Whether two fields are the same to the bit, in everything that they say.
#pragma once

#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <string>

namespace brushfire::test {

inline void expect_equal_bits(const DistanceField& a, const DistanceField& b, const std::string& where) {
  EXPECT_EQ(a.distance, b.distance) << where;
  EXPECT_EQ(a.source, b.source) << where;
  EXPECT_EQ(a.error_bound, b.error_bound) << where;
  EXPECT_EQ(a.max_error_bound, b.max_error_bound) << where;
  EXPECT_EQ(a.target_distance, b.target_distance) << where;
  EXPECT_EQ(a.target_source, b.target_source) << where;
  EXPECT_EQ(a.beyond_radius, b.beyond_radius) << where;
  EXPECT_EQ(a.updates, b.updates) << where;
}

}  // namespace brushfire::test
