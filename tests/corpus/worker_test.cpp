// What hangs, crashes or throws is one outcome, and the steps after it are taken.
#include "corpus/worker.h"
#include "corpus/families.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <utility>

namespace brushfire::corpus {
namespace {

std::map<std::pair<std::size_t, std::size_t>, Outcome> all_outcomes(unsigned lanes) {
  std::map<std::pair<std::size_t, std::size_t>, Outcome> outcomes;
  Steps steps;
  steps.blocks = 5;
  steps.block_size = 3;
  steps.lanes = lanes;
  steps.run = [](std::size_t block, std::size_t step) {
    if (block == 1 && step == 1) {
      std::atomic<bool> forever = true;
      while (forever) {
      }
    }
    if (block == 2 && step == 0) std::abort();
    if (block == 3 && step == 2) throw std::runtime_error("refused");
    Outcome outcome;
    outcome.compared = static_cast<std::uint32_t>(10 * block + step);
    return outcome;
  };
  steps.seconds = [](std::size_t) { return 0.2; };
  steps.resume = [](std::size_t step) { return step == 0 ? 3 : step + 1; };  // nothing without the first
  steps.done = [&](std::size_t block, std::size_t step, const Outcome& o) { outcomes[{block, step}] = o; };
  run_in_children(steps);
  return outcomes;
}

TEST(CorpusWorker, HangsCrashesAndExceptionsAreOneOutcomeEach) {
  for (const unsigned lanes : {1u, 2u, 9u}) {
    const auto outcomes = all_outcomes(lanes);
    EXPECT_EQ(outcomes.size(), 13u) << lanes;  // of 15, two that need the one that crashed
    EXPECT_EQ(outcomes.at({1, 1}).ending, Ending::Hung);
    EXPECT_EQ(outcomes.at({2, 0}).ending, Ending::Crashed);
    EXPECT_EQ(outcomes.at({3, 2}).ending, Ending::Refused);
    EXPECT_STREQ(outcomes.at({3, 2}).text, "refused");
    EXPECT_EQ(outcomes.count({2, 1}), 0u);
    for (const auto& [place, outcome] : outcomes) {
      if (outcome.ending == Ending::Done) {
        EXPECT_EQ(outcome.compared, 10 * place.first + place.second);
      }
    }
  }
}

TEST(CorpusFamilies, ACaseIsTheSameWheneverItIsMade) {
  for (const Family& family : small_families()) {
    const Case a = make_case(family, 7, 3), b = make_case(family, 7, 3), other = make_case(family, 8, 3);
    ASSERT_EQ(a.mesh.face_count(), b.mesh.face_count()) << family.name;
    EXPECT_LE(a.mesh.face_count(), 110u) << family.name;
    for (Index v = 0; a.mesh.has_positions() && v < a.mesh.vertex_count(); ++v) {
      EXPECT_EQ(a.mesh.positions()[v], b.mesh.positions()[v]) << family.name;
    }
    EXPECT_EQ(place_text(a.targets[2]), place_text(b.targets[2])) << family.name;
    EXPECT_NE(place_text(a.targets[2]), place_text(other.targets[2])) << family.name;
  }
}

}  // namespace
}  // namespace brushfire::corpus
