// The verb certify, and compare --fail-above, as black boxes: verdicts, exit codes, the files they write.
#include "in_folder.h"
#include "program.h"

#include <brushfire/io/npy.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace brushfire::test {
namespace {

// A unit square, a triangle that nothing joins to it, and a vertex in no face. From vertex 0 the distances are kRight.
constexpr const char* kRight = "0 1 1.4142135623730951 1 inf inf inf inf\n";

class Certify : public InFolder {
 protected:
  void SetUp() override {
    write("islands.off",
          "OFF\n8 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n9 9 9\n3 0 1 2\n3 0 2 3\n3 4 5 6\n");
  }

  Ended certify(const std::string& values, std::vector<std::string> arguments = {}) const {
    write("field.txt", values);
    arguments.insert(arguments.begin(), {"certify", path("islands.off"), path("field.txt"), "--source", "0"});
    return run_program(arguments);
  }
};

bool says(const Ended& ended, const std::string& what) { return ended.out.find(what) != std::string::npos; }

TEST_F(Certify, ARightFieldIsNotProvenWrong) {
  const Ended ended = certify(kRight);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(says(ended, "nothing is proven wrong\n  8 vertices may be right")) << ended.out;
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(certify(kRight, {"--tolerance", "1e-3"}).code, 0);
}

TEST_F(Certify, SourcesArePlacesAsElsewhere) {
  const std::string field = path("field.txt");
  write("field.txt", "0 0 1 1 inf inf inf inf\n");
  const auto from = [&](const std::string& where, const std::string& within) {
    return run_program(
        {"certify", path("islands.off"), field, "--source", where, "--source", "0,1", "--snap-within", within});
  };
  const Ended ended = from("at:0.5,0,2", "3");
  EXPECT_EQ(ended.code, 0) << ended.out;
  EXPECT_NE(ended.err.find("'at:0.5,0,2' is 2 from the surface"), std::string::npos) << ended.err;
  EXPECT_EQ(from("at:0.5,0,2", "1").code, 2);
}

TEST_F(Certify, OneVertexMovedByTwoPerMilleEndsWithFive) {
  const std::string moved = "0 1 1.4170419894978412 1 inf inf inf inf\n";
  const Ended ended = certify(moved);
  EXPECT_EQ(ended.code, 5);
  EXPECT_TRUE(says(ended, "field.txt on ")) << ended.out;
  EXPECT_TRUE(says(ended, ": proven wrong\n  1 of 8 vertices cannot be right")) << ended.out;
  EXPECT_TRUE(says(ended, "vertex 2 reads 1.4170419894978412: too long by 0.00282843 or more")) << ended.out;
  EXPECT_EQ(certify(moved, {"--within", "0.0021"}).code, 0);
  EXPECT_EQ(certify(moved, {"--within", "0.0019"}).code, 5);
  EXPECT_EQ(certify("0 0.998 1.4142135623730951 1 inf inf inf inf\n").code, 5);
}

TEST_F(Certify, ZeroWhereNothingLeadsIsWrongWhateverIsClaimed) {
  const Ended ended = certify("0 1 1.4142135623730951 1 0 0 0 -1\n", {"--within", "1"});
  EXPECT_EQ(ended.code, 5);
  EXPECT_TRUE(says(ended, "4 a number where no source leads")) << ended.out;
  EXPECT_TRUE(says(ended, "vertex 4 reads 0: no source leads there, only inf is right")) << ended.out;
}

TEST_F(Certify, NaNAndNegativeNumbersAndMissingValuesAreWrong) {
  const Ended ended = certify("0 nan -1e-9 inf inf inf inf inf\n", {"--json"});
  EXPECT_EQ(ended.code, 5);
  for (const char* line : {"\"verdict\": \"proven wrong\"", "\"not_a_number\": 1", "\"too_short\": 1",
                           "\"not_reached\": 1", "\"proven_wrong\": 3", "\"possible\": 5"}) {
    EXPECT_TRUE(says(ended, line)) << line << ended.out;
  }
  EXPECT_EQ(certify("0 1 inf 1 inf inf inf inf\n", {"--radius", "1.2"}).code, 0);
  EXPECT_EQ(certify("0 1 inf 1 inf inf inf inf\n", {"--radius", "1.5"}).code, 5);
}

TEST_F(Certify, JsonHasStableKeys) {
  const Ended ended = certify(kRight, {"--json"});
  EXPECT_EQ(ended.code, 0);
  std::istringstream lines(ended.out);
  std::string keys, line;
  while (std::getline(lines, line)) {
    if (line.starts_with("  \"")) keys += line.substr(3, line.find('"', 3) - 3) + " ";
  }
  EXPECT_EQ(keys,
            "schema brushfire mesh field verdict vertices possible proven_wrong too_short too_long not_reachable "
            "not_reached not_a_number tolerance within radius unit least_within worst_vertex max_gap wrong snapped "
            "max_snap_distance output ");
}

TEST_F(Certify, WhatIsKnownOfEveryVertexIsWritten) {
  const std::string wrong = "0 1 1.5 1 0 inf inf inf\n";
  EXPECT_EQ(certify(wrong, {"-o", path("all.csv")}).code, 5);
  const std::string csv = content("all.csv");
  EXPECT_EQ(csv.find("vertex,value,lower,upper,proven_error,finding\n0,0,0,0,0,possible\n"), 0u) << csv;
  EXPECT_NE(csv.find("\n4,0,inf,inf,-inf,not reachable\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",too long\n"), std::string::npos) << csv;
  EXPECT_EQ(certify(wrong, {"-o", path("all.npy")}).code, 5);
  const NpyArray rows = read_npy(path("all.npy"));
  EXPECT_EQ(rows.shape, (std::vector<std::size_t>{8, 3}));
  EXPECT_LE(rows.values[6], std::sqrt(2.0));
  EXPECT_GE(rows.values[7], std::sqrt(2.0));
  EXPECT_NEAR(rows.values[8], 1.5 - std::sqrt(2.0), 1e-9);
  EXPECT_EQ(certify(wrong, {"-o", path("all.ply")}).code, 5);
  EXPECT_EQ(run_program({"compare", path("all.ply"), path("all.ply")}).code, 0);
  const Ended piped = certify(wrong, {"-o", "-", "--quiet"});
  EXPECT_EQ(piped.out, csv);
}

TEST_F(Certify, OurOwnFieldsKeepTheirPromiseAndMarchingIsFoundOut) {
  run_program({"shape", "terrain", "-n", "2000", "-o", path("t.ply")});
  run_program({"distance", path("t.ply"), "-s", "7", "-o", path("w.npy")});
  run_program({"distance", path("t.ply"), "-s", "7", "-m", "kimmel-sethian", "-o", path("k.npy")});
  EXPECT_EQ(run_program({"certify", path("t.ply"), path("w.npy"), "-s", "7", "--within", "1e-3"}).code, 0);
  EXPECT_EQ(run_program({"certify", path("t.ply"), path("k.npy"), "-s", "7", "--within", "1e-3"}).code, 5);
  EXPECT_EQ(run_program({"certify", path("t.ply"), path("w.npy"), "-s", "8", "--within", "1e-3"}).code, 5);
}

TEST_F(Certify, WrongUseEndsWithTwo) {
  EXPECT_EQ(certify("0 1\n").code, 2);
  EXPECT_EQ(certify(kRight, {"--within", "-1"}).code, 2);
  EXPECT_EQ(certify(kRight, {"--tolerance", "0.5"}).code, 2);
  EXPECT_EQ(certify(kRight, {"--radius", "-1"}).code, 2);
  EXPECT_EQ(certify(kRight, {"--show", "0.5"}).code, 2);
  EXPECT_EQ(certify(kRight, {"-o", path("x.foo")}).code, 2);
  EXPECT_EQ(certify(kRight, {"-o", "-", "--json"}).code, 2);
  write("field.txt", kRight);
  EXPECT_EQ(run_program({"certify", path("islands.off"), path("field.txt")}).code, 2);
  EXPECT_EQ(run_program({"certify", path("islands.off"), path("no.txt"), "-s", "0"}).code, 3);
  EXPECT_EQ(run_program({"certify", path("no.off"), path("field.txt"), "-s", "0"}).code, 3);
}

TEST_F(Certify, HelpHasExamplesAndFitsTheTerminal) {
  std::istringstream help(run_program({"certify", "--help"}).out);
  bool examples = false;
  for (std::string line; std::getline(help, line);) {
    EXPECT_LE(line.size(), 120u) << line;
    examples = examples || line == "Examples:";
  }
  EXPECT_TRUE(examples);
}

TEST_F(Certify, ComparisonsFailAboveALimit) {
  write("a.txt", "0 1.5 3 inf\n");
  write("b.txt", "0 1 4 inf\n");
  const auto compare = [&](const std::string& limit, const std::string& a = "a.txt") {
    return run_program({"compare", path(a), path("b.txt"), "--fail-above", limit});
  };
  EXPECT_EQ(compare("0.6").code, 0);
  const Ended failed = compare("0.4");
  EXPECT_EQ(failed.code, 5);
  EXPECT_TRUE(says(failed, "farther apart than 0.4\n")) << failed.out;
  write("c.txt", "0 1 4 7\n");
  EXPECT_EQ(compare("9", "c.txt").code, 5) << "reached by one only";
  EXPECT_EQ(compare("-1").code, 2);
  const Ended json = run_program({"compare", path("a.txt"), path("b.txt"), "--fail-above", "0.4", "--json"});
  EXPECT_TRUE(says(json, "\"fail_above\": 0.4")) << json.out;
  EXPECT_TRUE(says(json, "\"failed\": true")) << json.out;
}

}  // namespace
}  // namespace brushfire::test
