// Asks the processor: cpuid for its instruction sets, xgetbv for the registers that the system keeps for each thread.
// Not by the compiler's own __builtin_cpu_supports(), which zig's runtime library has no answer to.
#include <brushfire/core/detail/targets.h>

#ifdef BRUSHFIRE_HAS_AVX2_TARGET
#include <cpuid.h>

namespace brushfire {
namespace {

struct Answer {
  unsigned a = 0, b = 0, c = 0, d = 0;  // what the registers eax to edx hold
};

// Zeros where the processor does not know the question.
Answer ask(unsigned question) {
  Answer answer;
  __get_cpuid_count(question, 0, &answer.a, &answer.b, &answer.c, &answer.d);
  return answer;
}

bool has_all(unsigned word, unsigned bits) { return (word & bits) == bits; }

unsigned kept_registers() {
  unsigned low = 0;
  unsigned high = 0;
  __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return low;
}

constexpr unsigned kVectorsOf256 = 0x06;  // XCR0: SSE, AVX
constexpr unsigned kVectorsOf512 = 0xe6;  // and AVX-512: masks, upper halves, registers 16 to 31

Instructions instructions() {
  const Answer basic = ask(1);
  const Answer extended = ask(7);
  if (!has_all(basic.c, bit_OSXSAVE | bit_AVX | bit_POPCNT) || !has_all(extended.b, bit_AVX2 | bit_BMI)) return {};
  const unsigned kept = kept_registers();
  return {.avx2 = has_all(kept, kVectorsOf256),
          .avx512 = has_all(kept, kVectorsOf512) &&
                    has_all(extended.b, bit_AVX512F | bit_AVX512DQ | bit_AVX512BW | bit_AVX512VL)};
}

}  // namespace

const Instructions kInstructions = instructions();

}  // namespace brushfire
#endif
