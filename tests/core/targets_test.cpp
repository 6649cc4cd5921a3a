// What the processor is said to have, beside what the compiler's own question says.
#include <brushfire/core/detail/targets.h>

#include <gtest/gtest.h>

namespace brushfire {
namespace {

#ifdef BRUSHFIRE_HAS_AVX2_TARGET
TEST(Targets, AreWhatTheCompilersOwnQuestionSays) {
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("popcnt");
  EXPECT_EQ(has_avx2(), avx2);
  EXPECT_EQ(has_avx512(), avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                              __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"));
}
#else
TEST(Targets, AreOneWhereThereAreNoOthers) {
  EXPECT_FALSE(has_avx2());
  EXPECT_FALSE(has_avx512());
}
#endif

}  // namespace
}  // namespace brushfire
