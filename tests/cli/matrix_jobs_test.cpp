// brushfire matrix as a job, and brushfire merge.
#include <brushfire/io/npy.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "in_folder.h"
#include "job_progress.h"
#include "program.h"

namespace brushfire::test {
namespace {

class MatrixJobVerb : public InFolder {
 protected:
  void SetUp() override { write_squares("m.off", 4, 3); }  // 20 vertices
  Ended run(std::vector<std::string> arguments, const std::string& verb = "matrix") const {
    if (verb == "matrix") arguments.insert(arguments.begin(), {path("m.off"), "--method", "exact"});
    arguments.insert(arguments.begin(), verb);
    return run_program(arguments);
  }
  // The rows that a list means, by their zeros.
  std::vector<std::size_t> rows_of(const std::string& list) const {
    const Ended ended = run({"--rows", list, "-o", path("d.npy")});
    EXPECT_EQ(ended.code, 0) << ended.err;
    const NpyArray d = read_npy(path("d.npy"));
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < d.shape[0]; ++i) {
      const auto row = d.values.begin() + static_cast<std::ptrdiff_t>(20 * i);
      rows.push_back(static_cast<std::size_t>(std::find(row, row + 20, 0.0) - row));
    }
    return rows;
  }
  using List = std::vector<std::size_t>;
};

TEST_F(MatrixJobVerb, RowsAreRangesStepsAndListsOfThem) {
  EXPECT_EQ(rows_of("3:6"), (List{3, 4, 5}));
  EXPECT_EQ(rows_of("3-6"), (List{3, 4, 5, 6}));
  EXPECT_EQ(rows_of("17:"), (List{17, 18, 19}));
  EXPECT_EQ(rows_of(":2"), (List{0, 1}));
  EXPECT_EQ(rows_of("0:20:7"), (List{0, 7, 14}));
  EXPECT_EQ(rows_of("18-19,4,0:2"), (List{18, 19, 4, 0, 1}));
  EXPECT_EQ(rows_of("all").size(), 20u);
  for (const char* wrong : {"3:1:0", "6-3", "0:21", "1-", "-3", "0:1:2:3", "18-20"}) {
    const Ended ended = run({"--rows", wrong, "-o", path("d.npy")});
    EXPECT_EQ(ended.code, 2) << wrong << ": " << ended.err;
  }
}

TEST_F(MatrixJobVerb, RowsAreMasksLabelsAndListsInFiles) {
  write("roi.label", "#!ascii label\n2\n4 0 0 0 1\n9 0 0 0 1\n");
  EXPECT_EQ(rows_of(path("roi.label")), (List{4, 9}));
  write("list.txt", "7\n3\n");
  EXPECT_EQ(rows_of(path("list.txt")), (List{7, 3}));
  std::vector<double> values(20, 0.0);
  values[2] = values[11] = 1;
  write_npy(path("mask.npy"), std::span<const double>(values));
  EXPECT_EQ(rows_of(path("mask.npy")), (List{2, 11}));
  values = {6, 1};
  write_npy(path("list.npy"), std::span<const double>(values));
  EXPECT_EQ(rows_of(path("list.npy")), (List{6, 1}));
  values = {6.5};
  write_npy(path("wrong.npy"), std::span<const double>(values));
  EXPECT_EQ(run({"--rows", path("wrong.npy"), "-o", path("d.npy")}).code, 2);
}

TEST_F(MatrixJobVerb, MergedShardsAreTheMatrix) {
  EXPECT_EQ(run({"-o", path("whole.npy")}).code, 0);
  std::vector<std::string> shards;
  for (const char* k : {"1", "2", "3"}) {
    const Ended ended = run({"--shard", std::string(k) + "/3", "-o", path("d.npy")});
    EXPECT_EQ(ended.code, 0) << ended.err;
    shards.push_back(path("d." + std::string(k) + "-of-3.npy"));
  }
  std::vector<std::string> all = shards;
  all.insert(all.end(), {"-o", path("d.npy")});
  const Ended merged = run(all, "merge");
  EXPECT_EQ(merged.code, 0) << merged.err;
  EXPECT_NE(merged.err.find("3 shards"), std::string::npos) << merged.err;
  EXPECT_EQ(content("d.npy"), content("whole.npy"));

  all = shards;
  all.insert(all.end(), {"--nearest", "4", "-o", path("near.npy"), "--json"});
  EXPECT_NE(run(all, "merge").out.find("\"shards\": 3"), std::string::npos);
  const Ended direct = run({"--nearest", "4", "-o", path("direct.npy")});
  EXPECT_EQ(direct.code, 0);
  EXPECT_NE(direct.err.find("20 x 4, 80 entries"), std::string::npos) << direct.err;
  EXPECT_EQ(content("near.npy"), content("direct.npy"));
  EXPECT_EQ(content("near.index.npy"), content("direct.index.npy"));

  const Ended again = run({"--shard", "2/3", "-o", path("d.npy")});
  EXPECT_NE(again.err.find("is complete already"), std::string::npos) << again.err;
  const Ended hole = run({shards[0], shards[2], "-o", path("e.npy")}, "merge");
  EXPECT_EQ(hole.code, 2);
  EXPECT_NE(hole.err.find("missing: 2"), std::string::npos) << hole.err;
  EXPECT_EQ(run({"--shard", "1/3", "--rows", "0:9", "-o", path("f.npy")}).code, 0);
  const Ended mixed = run({shards[0], path("f.1-of-3.npy"), "-o", path("e.npy")}, "merge");
  EXPECT_NE(mixed.err.find("another matrix"), std::string::npos) << mixed.err;
  EXPECT_EQ(run({path("whole.npy"), "-o", path("e.npy")}, "merge").code, 3);
  EXPECT_FALSE(std::filesystem::exists(path("e.npy")));
}

TEST_F(MatrixJobVerb, SaysThatAFileIsReplaced) {
  for (const std::vector<std::string>& output :
       std::vector<std::vector<std::string>>{{"-o", path("d.npy")}, {"-o", path("d.npz"), "--radius", "2"}}) {
    EXPECT_EQ(run(output).err.find("is there already"), std::string::npos);
    const Ended again = run(output);
    EXPECT_EQ(again.code, 0);
    EXPECT_NE(again.err.find(output[1] + ": is there already; the new matrix takes its place"), std::string::npos)
        << again.err;
  }
}

TEST_F(MatrixJobVerb, SpeaksOfTheMatrixWhereNothingCanBeWrittenBesideIt) {
  const Ended ended = run({"-o", path("nowhere/d.npy")});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.err.find("brushfire: " + path("nowhere/d.npy") + ": no file can be made beside it"), 0U) << ended.err;
}

TEST_F(MatrixJobVerb, RefusesOptionsThatAFileHasNoUseFor) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"-o", path("d.npy"), "--shard", "4/3"},
           {"-o", path("d.npy"), "--shard", "1/3", "--nearest", "2"},
           {"-o", path("d.npy"), "--shard", "1/3", "--symmetric", "mean"},
           {"-o", path("d.npy"), "--symmetric", "min", "--nearest", "2"},
           {"-o", path("d.npy"), "--nearest", "21"},
           {"-o", path("d.npy"), "--chunk-rows", "5"},
           {"-o", path("d.zarr"), "--nearest", "2"},
           {"-o", path("d.zarr"), "--zarr-format", "4"},
           {"-o", path("d.npz"), "--radius", "2", "--shard", "1/2"},
       }) {
    EXPECT_EQ(run(arguments).code, 2) << arguments[2] << ' ' << arguments[3];
  }
}

TEST(JobProgress, LogsTellRowsRateAndTheTimeLeft) {
  testing::internal::CaptureStderr();
  const Progress log = tool::log_lines(1000, 100, 0, 0);
  log(0.25);
  const std::string line = testing::internal::GetCapturedStderr();
  EXPECT_NE(line.find("matrix: 25 % (250 of 1000 rows), "), std::string::npos) << line;
  EXPECT_NE(line.find(" left\n"), std::string::npos) << line;
  EXPECT_EQ(tool::time_left(45), "45 s");
  EXPECT_EQ(tool::time_left(180), "3 min");
  EXPECT_EQ(tool::time_left(7800), "2 h 10 min");
}

}  // namespace
}  // namespace brushfire::test
