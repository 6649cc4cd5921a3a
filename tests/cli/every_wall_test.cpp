// Every verb that reads a mesh, as the program itself lists them, keeps to walls, and however they are given.
#include "in_folder.h"
#include "program.h"
#include "shared.h"

#include <brushfire/io/npy.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace brushfire::test {
namespace {

std::vector<tool::VerbNames> verbs() {
  tool::CommandLine command_line;
  tool::add_verbs(command_line);
  return command_line.names();
}

std::size_t count_of(const std::vector<tool::OptionNames>& options, const std::string& name) {
  return static_cast<std::size_t>(std::count_if(options.begin(), options.end(), [&](const tool::OptionNames& o) {
    return std::find(o.names.begin(), o.names.end(), name) != o.names.end();
  }));
}

bool reads_a_mesh(const tool::VerbNames& verb) {
  const auto is_mesh = [](const tool::OptionNames& a) {
    return a.help.starts_with("The mesh") || a.help.find("Meshes: ") != std::string::npos;
  };
  return count_of(verb.options, "--mesh") > 0 || std::any_of(verb.arguments.begin(), verb.arguments.end(), is_mesh);
}

std::vector<std::string> wall_options() {
  std::vector<std::string> names;
  for (const tool::Shared option : tool::kWalls) {
    names.push_back(tool::shared_names()[static_cast<std::size_t>(option)]);
  }
  return names;
}

TEST(WallOptions, AreTakenByEveryVerbThatReadsAMesh) {
  int count = 0;
  for (const tool::VerbNames& verb : verbs()) {
    for (const std::string& name : wall_options()) {
      EXPECT_EQ(count_of(verb.options, name), reads_a_mesh(verb) ? 1u : 0u) << verb.name << " " << name;
      count += reads_a_mesh(verb);
    }
  }
  EXPECT_GE(count, 5 * 19);
}

// [0, 4] x [0, 2] in unit squares, vertex y * 5 + x, of which the column x = 3 is closed.
class WallsInEveryVerb : public InFolder {
 protected:
  void SetUp() override {
    write_squares("m.off", 4, 2);
    write("mask.txt", "1 1 1 0 1\n1 1 1 0 1\n1 1 1 0 1\n");
    write("vertices.txt", "3\n8\n13\n");
    write("faces.txt", "4\n5\n6\n7\n12\n13\n14\n15\n");
    write("edges.txt", "2 7\n7 12\n");
    write("x.txt", "0 1 2 3 4\n0 1 2 3 4\n0 1 2 3 4\n");
    write("y.txt", "0 1 2 3 5\n0 1 2 3 5\n0 1 2 3 5\n");
    write("pairs.txt", "0 4\n5 7\n5 2\n");
    write("labels.txt", "1 1 2 2 3\n1 1 2 2 3\n1 1 2 2 3\n");
    write("empty.html", "<html>\n<!-- brushfire view: the mesh -->\n</html>\n");
    setenv("BRUSHFIRE_VIEWER", path("empty.html").c_str(), 1);
  }
  void TearDown() override { unsetenv("BRUSHFIRE_VIEWER"); }

  // How each verb is called so that walls show, and where: in a file, or on the standard output.
  struct Call {
    std::vector<std::string> words;
    std::string output = "";
  };
  std::map<std::string, Call> calls() const {
    const std::string m = path("m.off"), x = path("x.txt"), y = path("y.txt"), s = "--source";
    return {
        {"info", {{m}}},
        {"distance", {{m, s, "0", "-o", "-"}}},
        {"path", {{m, "--from", "0", "--to", "4"}}},
        {"isolines", {{m, s, "0", "--levels", "1.5,3.5"}, "l.json"}},
        {"isochrones", {{m, x, "--levels", "1.5,3.5"}}},
        {"log-map", {{m, s, "0", "-o", "-"}}},
        {"flatten", {{m, "-o", "-"}}},
        {"gradient", {{m, s, "0", "-o", "-"}}},
        {"matrix", {{m}, "d.npy"}},
        {"pairs", {{m, path("pairs.txt")}}},
        {"voronoi", {{m, s, "0,1", "-o", "-"}}},
        {"sample", {{m, "--count", "3"}}},
        {"measure", {{m}}},
        {"parcels", {{m, path("labels.txt")}}},
        {"smooth", {{m, x, "--sigma", "1", "-o", "-"}}},
        {"compare", {{x, y, "--mesh", m}}},
        {"certify", {{m, x, s, "0"}}},
        {"render", {{m, s, "0", "--size", "64x64"}, "p.png"}},
        {"view", {{m}, "p.html"}},
        {"bench", {{m, "--method", "dijkstra", "--repeat", "1", "--no-error", "--json"}}},
        {"convert", {{m, path("out.off")}, "out.off"}},
    };
  }

  // What it says and writes, without what changes from run to run or is said of one kind of wall only.
  std::string result(const std::string& verb, const Call& call, const std::vector<std::string>& walls) const {
    std::vector<std::string> words{verb};
    words.insert(words.end(), call.words.begin(), call.words.end());
    if (!call.output.empty() && call.words.back() != path(call.output)) {
      words.insert(words.end(), {"-o", path(call.output)});
    }
    words.insert(words.end(), walls.begin(), walls.end());
    const Ended ended = run_program(words);
    const bool is_parted = ended.err.find("in several pieces") != std::string::npos;  // which flatten refuses
    EXPECT_TRUE(ended.code == 0 || ended.code == 4 || ended.code == 5 || is_parted) << verb << ended.code << ended.err;
    std::string text = std::to_string(ended.code) + "\n";
    std::string out = ended.out;
    for (std::size_t begin = 0, end; (end = out.find('\n', begin)) != std::string::npos; begin = end + 1) {
      const std::string line = out.substr(begin, end - begin);
      const bool changes = line.find("_s\": ") != std::string::npos || line.find("per_s") != std::string::npos ||
                           line.find("memory") != std::string::npos || line.find("by the mask") != std::string::npos;
      if (!changes) text += line + "\n";
    }
    return call.output.empty() ? text : text + content(call.output);
  }
};

TEST_F(WallsInEveryVerb, AreTheSameHoweverTheyAreGiven) {
  const std::map<std::string, Call> all = calls();
  for (const tool::VerbNames& verb : verbs()) {
    if (!reads_a_mesh(verb)) continue;
    const auto call = all.find(verb.name);
    if (call == all.end()) {
      ADD_FAILURE() << verb.name << ": how is it called so that walls show?";
      continue;
    }
    const std::string open = result(verb.name, call->second, {});
    EXPECT_EQ(open, result(verb.name, call->second, {})) << verb.name;
    const std::string masked = result(verb.name, call->second, {"--mask", path("mask.txt")});
    EXPECT_NE(open, masked) << verb.name;
    EXPECT_EQ(masked, result(verb.name, call->second, {"--region", path("mask.txt") + ":1"})) << verb.name;
    EXPECT_EQ(masked, result(verb.name, call->second, {"--block-faces", path("faces.txt")})) << verb.name;
    EXPECT_EQ(masked, result(verb.name, call->second, {"--block-vertices", path("vertices.txt")})) << verb.name;
    const std::string parted = result(verb.name, call->second, {"--block-edges", path("edges.txt")});
    EXPECT_EQ(open == parted, verb.name == "compare") << verb.name << ": edges close no vertex, and have no area";
  }
}

TEST_F(WallsInEveryVerb, AFileOfWhatIsOpenHasTheSameDistances) {
  const auto numbers = [&](const std::string& mesh, const std::vector<std::string>& walls) {
    std::vector<std::string> words{"distance", path(mesh), "-s", "0", "-m", "exact", "-o", path("d.npy"), "-q"};
    words.insert(words.end(), walls.begin(), walls.end());
    EXPECT_EQ(run_program(words).code, 0);
    return read_npy(path("d.npy")).values;
  };
  const std::vector<std::string> wall{"--block-edges", path("one.txt")};
  write("one.txt", "2 7\n");
  EXPECT_EQ(run_program({"convert", path("m.off"), path("o.off"), wall[0], wall[1]}).code, 0);
  std::vector<double> open = numbers("o.off", {});
  ASSERT_EQ(open.size(), 16u);  // vertex 2 is there twice
  EXPECT_NE(open[2], open[15]);
  open[2] = std::min(open[2], open[15]);
  open.pop_back();
  EXPECT_EQ(open, numbers("m.off", wall));
  // Inside, one edge alone has ends that stay whole.
  write("one.txt", "7 8\n");
  const Ended alone = run_program({"convert", path("m.off"), path("o.off"), wall[0], wall[1]});
  EXPECT_EQ(alone.code, 2);
  EXPECT_NE(alone.err.find("single edge"), std::string::npos) << alone.err;
}

}  // namespace
}  // namespace brushfire::test
