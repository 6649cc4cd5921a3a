// brushfire matrix: what it writes, and what it refuses.
#include "in_folder.h"
#include "program.h"

#include <brushfire/io/npy.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace brushfire::test {
namespace {

class MatrixVerb : public InFolder {
 protected:
  void SetUp() override { write("m.off", "OFF\n5 2 0\n0 0 0\n3 0 0\n3 4 0\n0 4 0\n9 9 9\n3 0 1 2\n3 0 2 3\n"); }
  Ended run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"matrix", path("m.off"), "--method", "exact"});
    return run_program(arguments);
  }
};

TEST_F(MatrixVerb, WritesTheDenseMatrixOfChosenRowsAndColumns) {
  write("columns.txt", "3 # a corner\nat:1.5,2,7\nf:0:0,1,0\n");
  const Ended ended =
      run({"--rows", "1,4", "--columns", path("columns.txt"), "--dtype", "float64", "-o", path("d.npy")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const NpyArray d = read_npy(path("d.npy"));
  EXPECT_EQ(d.type, "<f8");
  EXPECT_EQ(d.shape, (std::vector<std::size_t>{2, 3}));
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(d.values, (std::vector<double>{5, 2.5, 0, inf, inf, inf}));
}

TEST_F(MatrixVerb, WritesThoseOfSeveralMeshesIntoAFolder) {
  write("n.off", "OFF\n3 1 0\n0 0 0\n6 0 0\n0 8 0\n3 0 1 2\n");
  const Ended ended = run({path("n.off"), "-o", path("all/")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(read_npy(path("all/n.npy")).values, (std::vector<double>{0, 6, 8, 6, 0, 10, 8, 10, 0}));
  EXPECT_EQ(run({"-o", path("m.npy"), "--quiet"}).code, 0);
  const NpyArray alone = read_npy(path("m.npy")), in_set = read_npy(path("all/m.npy"));
  EXPECT_EQ(alone.values, in_set.values);
  EXPECT_EQ(run({path("m.off"), "-o", path("all/")}).code, 2);   // of one name
  EXPECT_EQ(run({path("n.off"), "-o", path("d.npy")}).code, 2);  // no folder
  const Ended json = run({path("n.off"), "-o", path("all/"), "--json"});
  EXPECT_NE(json.out.find("\"files\": 2,"), std::string::npos) << json.out;
}

TEST_F(MatrixVerb, WritesInUnitsOfTheRootOfTheArea) {
  const double root = std::sqrt(12.0);
  ASSERT_EQ(run({"--normalise", "--dtype", "float64", "-o", path("d.npy")}).code, 0);
  EXPECT_EQ(read_npy(path("d.npy")).values[1 * 5 + 3], 5 / root);
  const Ended ended = run({"--normalise", "--radius", "3", "--rows", "0", "-o", path("d.mtx"), "--json"});
  EXPECT_NE(ended.out.find("\"normalised_by\": 3.46"), std::string::npos) << ended.out;
  EXPECT_NE(content("d.mtx").find("1 2 0.866"), std::string::npos) << content("d.mtx");
  write("line.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  EXPECT_EQ(run_program({"matrix", path("line.off"), "--normalise", "-o", path("l.npy")}).code, 2);
}

TEST_F(MatrixVerb, WritesAllPairsInFloatByDefault) {
  EXPECT_EQ(run({"-o", path("d.npy"), "--quiet"}).err, "");
  const NpyArray d = read_npy(path("d.npy"));
  EXPECT_EQ(d.type, "<f4");
  EXPECT_EQ(d.shape, (std::vector<std::size_t>{5, 5}));
  EXPECT_EQ(d.values[1 * 5 + 3], 5);
}

TEST_F(MatrixVerb, WritesWhatIsWithinARadiusAsMatrixMarket) {
  const Ended ended = run({"--radius", "3", "--rows", "0,2", "-o", path("d.mtx")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(content("d.mtx"), "%%MatrixMarket matrix coordinate real general\n2 5 4\n1 1 0\n1 2 3\n2 3 0\n2 4 3\n");
}

TEST_F(MatrixVerb, WritesAnArchiveOfArraysForScipy) {
  EXPECT_EQ(run({"--radius", "3", "-o", path("d.npz")}).code, 0);
  const std::string bytes = content("d.npz");
  EXPECT_EQ(bytes.substr(0, 4), "PK\x03\x04");
  for (const char* member : {"indices.npy", "indptr.npy", "format.npy", "shape.npy", "data.npy"}) {
    EXPECT_NE(bytes.find(member), std::string::npos) << member;
  }
  EXPECT_EQ(run({"--radius", "3", "-o", path("again.npz")}).code, 0);
  EXPECT_EQ(bytes, content("again.npz"));
}

TEST_F(MatrixVerb, SourcesAreRows) {
  write("rows.txt", "1\n3\n");
  EXPECT_EQ(
      run({"-s", "0,2", "--sources", path("rows.txt"), "--columns", "4", "--unit", "mm", "-o", path("a.npy")}).code, 0);
  EXPECT_EQ(run({"--rows", "0,2,1,3", "--columns", "4", "-o", path("b.npy")}).code, 0);
  EXPECT_EQ(content("a.npy"), content("b.npy"));
  EXPECT_EQ(run({"--rows", "0", "-s", "1", "-o", path("c.npy")}).code, 2);
  EXPECT_EQ(run({"-s", "1@2", "-o", path("c.npy")}).code, 2);
}

TEST_F(MatrixVerb, RefusesWhatMakesNoSenseWithOneLine) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {},
           {"-o", path("d.txt")},
           {"-o", path("d.npz")},
           {"-o", path("d.npz"), "--radius", "3", "--columns", "0"},
           {"-o", path("d.npy"), "--radius", "-1"},
           {"-o", path("d.npy"), "--threads", "1.5"},
           {"-o", path("d.npy"), "--rows", "0,5"},
           {"-o", path("d.npy"), "--rows", "0,,1"},
           {"-o", path("d.npy"), "--dtype", "int8"},
       }) {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(ended.err.find('\n'), ended.err.size() - 1) << ended.err;
  }
  EXPECT_EQ(run({"-o", path("d.npy"), "--rows", path("absent.txt")}).code, 3);
}

}  // namespace
}  // namespace brushfire::test
