// brushfire pairs as a black box.
#include "in_folder.h"
#include "program.h"

#include <brushfire/io/npy.h>

#include <gtest/gtest.h>

#include <cmath>

namespace brushfire::test {
namespace {

class PairsVerb : public InFolder {
 protected:
  void SetUp() override {
    write("m.off", "OFF\n5 2 0\n0 0 0\n3 0 0\n3 4 0\n0 4 0\n9 9 9\n3 0 1 2\n3 0 2 3\n");
    write("pairs.txt", "0 2\n1 3\n0 1\n4 0\n");
  }
  Ended run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"pairs", path("m.off"), path("pairs.txt"), "--method", "exact"});
    return run_program(arguments);
  }
};

TEST_F(PairsVerb, PrintsBothVerticesAndTheDistance) {
  const Ended ended = run({});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "from,to,distance\n0,2,5\n1,3,5\n0,1,3\n4,0,inf\n");
  EXPECT_NE(ended.err.find("4 pairs, 3 reached"), std::string::npos) << ended.err;
}

TEST_F(PairsVerb, DividesByTheRootOfTheArea) {
  const Ended ended = run({"--normalise", "-o", path("d.npy")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const NpyArray d = read_npy(path("d.npy"));
  ASSERT_EQ(d.shape, (std::vector<std::size_t>{4}));
  EXPECT_NEAR(d.values[0], 5 / std::sqrt(12.0), 1e-15);
  EXPECT_NE(run({"--normalise", "--json"}).out.find("\"normalised_by\": 3.46"), std::string::npos);
}

TEST_F(PairsVerb, RefusesWhatIsNoPair) {
  write("pairs.txt", "0 9\n");
  EXPECT_NE(run({}).code, 0);
  write("pairs.txt", "0\n1\n2\n");
  EXPECT_EQ(run({}).code, 2);
  EXPECT_EQ(run({"-o", path("d.ply")}).code, 2);
}

}  // namespace
}  // namespace brushfire::test
