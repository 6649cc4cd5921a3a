// Help, completion and manual pages.
#include "small_files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace brushfire::test {
namespace {

TEST_F(Program, HelpOfEveryVerbHasExamplesAndFitsTheTerminal) {
  for (const char* verb : {"info", "distance", "path", "isolines", "matrix", "compare", "certify", "render", "bench",
                           "convert", "shape", "completion", "manual"}) {
    const Ended ended = run_program({verb, "--help"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_NE(ended.out.find("Examples:\n"), std::string::npos) << verb;
    for (const std::string& line : lines_of(ended.out)) EXPECT_LE(line.size(), 120u) << line;
  }
}

// A shell that has sourced the script, with the cursor at the end of "brushfire distance --method dij".
TEST_F(Program, BashCompletesAMethod) {
  write("script", run_program({"completion", "bash"}).out);
  const std::string command = "bash -c 'source \"" + path("script") +
                              "\"; COMP_WORDS=(brushfire distance --method dij); COMP_CWORD=3; _brushfire; "
                              "echo \"${COMPREPLY[*]}\"' > \"" +
                              path("completed") + "\"";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(path("completed"));
  std::string completed;
  std::getline(file, completed);
  EXPECT_EQ(completed, "dijkstra");
}

TEST_F(Program, CompletionKnowsVerbsOptionsAndMethods) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Ended ended = run_program({"completion", shell});
    EXPECT_EQ(ended.code, 0);
    const bool fish = std::string(shell) == "fish";
    for (const char* word : {"info", "distance", "completion", fish ? "-l source" : "--source",
                             fish ? "-l json" : "--json", "dijkstra", "float32 float64"}) {
      EXPECT_NE(ended.out.find(word), std::string::npos) << shell << " " << word;
    }
  }
}

TEST_F(Program, ManualPagesTellWhatHelpTells) {
  const std::string all = run_program({"manual"}).out;
  EXPECT_EQ(all.rfind(".\\\" made by: brushfire manual\n.TH brushfire 1 ", 0), 0u) << all;
  const std::string page = run_program({"manual", "--verb", "distance"}).out;
  for (const char* text : {".SH NAME\nbrushfire\\-distance \\- ", "\\fB\\-\\-source\\fR", ".SH SYNOPSIS\n",
                           "brushfire distance bunny.ply \\-\\-source 0"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text << "\n" << page;
  }
  // Every line is text or one of the requests that the pages use: nothing of the help is read as a command.
  for (const std::string& line : lines_of(page)) {
    if (line.empty() || line[0] != '.') continue;
    EXPECT_TRUE(line.rfind(".\\\"", 0) == 0 || line.rfind(".TH ", 0) == 0 || line.rfind(".SH ", 0) == 0 ||
                line == ".TP" || line == ".nf" || line == ".fi" || line.rfind(".BR ", 0) == 0)
        << line;
  }
}

TEST_F(Program, ManualWritesOnePageForEachVerb) {
  const std::string folder = path("man1");
  std::filesystem::create_directory(folder);
  EXPECT_EQ(run_program({"manual", "--folder", folder}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder + "/brushfire.1"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/brushfire-isolines.1"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/brushfire-manual.1"));
  expect_error({"manual", "--folder", path("missing")}, 1, "brushfire: missing/brushfire.1: cannot be written");
}

}  // namespace
}  // namespace brushfire::test
