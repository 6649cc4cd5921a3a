// brushfire bench: what its table and its JSON say, and what it refuses.
#include "in_folder.h"
#include "program.h"

#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace brushfire::test {
namespace {

class BenchVerb : public InFolder {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_program({"shape", "torus", "-n", "600", "-o", path("torus.ply"), "-q"}).code, 0);
  }

  Ended run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"bench", path("torus.ply")});
    return run_program(arguments);
  }
  // The value of the first such key, read as a number.
  static double number(const std::string& json, const std::string& key, std::size_t from = 0) {
    const std::size_t at = json.find("\"" + key + "\": ", from);
    return at == std::string::npos ? -1 : std::stod(json.substr(at + key.size() + 4));
  }
};

TEST_F(BenchVerb, TableHasALineForEveryMethod) {
  const Ended ended = run({"--repeat", "1"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* method : {"windows:0.001 ", "exact ", "carried-source ", "novotni-klein ", "novotni-klein-2002 ",
                             "kimmel-sethian ", "dijkstra ", "vertices/s", "mean error"}) {
    EXPECT_NE(ended.out.find(method), std::string::npos) << method << "\n" << ended.out;
  }
  // Two lines of words, and one for each method.
  EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 2 + static_cast<int>(all_methods().size()));
}

TEST_F(BenchVerb, JsonTellsTimesMemoryAndErrors) {
  const Ended ended = run({"--methods", "exact", "-m", "dijkstra", "-m", "windows:1e-2", "-m", "novotni-klein:float64",
                           "--spread", "3", "--repeat", "2", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(number(ended.out, "sources"), 3);
  EXPECT_EQ(number(ended.out, "repetitions"), 2);
  EXPECT_NE(ended.out.find("\"clock\": \"processor\""), std::string::npos);
  EXPECT_EQ(number(ended.out, "mean_relative_error"), 0);  // exact against itself
  EXPECT_GT(number(ended.out, "solve_s"), 0);
  EXPECT_GT(number(ended.out, "vertices_per_s"), 0);
  const std::size_t dijkstra = ended.out.find("\"dijkstra\"");
  ASSERT_NE(dijkstra, std::string::npos);
  EXPECT_GT(number(ended.out, "mean_relative_error", dijkstra), 0.001);
  EXPECT_GE(number(ended.out, "max_relative_error", dijkstra), number(ended.out, "mean_relative_error", dijkstra));
  const std::size_t windows = ended.out.find("\"windows\"");
  EXPECT_EQ(number(ended.out, "tolerance", windows), 0.01);
  EXPECT_LE(number(ended.out, "max_relative_error", windows), number(ended.out, "max_error_bound", windows));
  EXPECT_NE(ended.out.find("\"precision\": \"float64\""), std::string::npos);
}

TEST_F(BenchVerb, ThreadsShareOutTheSourcesAndFindTheSame) {
  const std::vector<std::string> arguments{"-m", "dijkstra", "--spread", "4", "--repeat", "1", "--json"};
  const Ended one = run(arguments);
  std::vector<std::string> with_threads = arguments;
  with_threads.insert(with_threads.end(), {"--threads", "2"});
  const Ended two = run(with_threads);
  EXPECT_EQ(two.code, 0) << two.err;
  EXPECT_NE(two.out.find("\"clock\": \"wall\""), std::string::npos);
  EXPECT_EQ(number(two.out, "updates"), number(one.out, "updates"));
  EXPECT_EQ(number(two.out, "max_relative_error"), number(one.out, "max_relative_error"));
}

TEST_F(BenchVerb, WithoutErrorsNothingIsComparedWithTheExactDistances) {
  const Ended ended = run({"-m", "dijkstra", "--no-error", "--repeat", "1", "--json", "--source", "at:1.4,0,0"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("\"mean_relative_error\": null"), std::string::npos);
}

TEST_F(BenchVerb, RefusesMalformedOptions) {
  const std::vector<std::vector<std::string>> bad{
      {"-m", "fast"},       {"-m", "windows:2"},        {"-m", "windows:"},    {"-m", "windows:float32"},
      {"-m", "exact:1e-3"}, {"-m", "dijkstra:float32"}, {"--spread", "0"},     {"--spread", "1.5"},
      {"--repeat", "0"},    {"--threads", "-1"},        {"--threads", "many"}, {"--spread", "2", "--source", "1"},
      {"--source", "9999"}, {"--source", "north"}};
  for (const std::vector<std::string>& options : bad) {
    const Ended ended = run(options);
    EXPECT_EQ(ended.code, 2) << testing::PrintToString(options) << ended.err;
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  }
  EXPECT_EQ(run_program({"bench", "no-such-mesh.ply"}).code, 3);
}

}  // namespace
}  // namespace brushfire::test
