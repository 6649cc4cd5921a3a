// Shortest paths in wild complexes (tests/oracle/wild.h), judged by coordinates, the field and the oracle.
//
//   wild_paths COUNT [SEED] [FAMILY]   COUNT complexes of each family, three paths each; exit code 1 where one is bad
//
// Where the field itself misses the oracle, paths are counted apart: no path can be as long as a wrong value says.
#include "oracle/wild_paths.h"
#include "oracle/wild.h"

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using namespace brushfire;
using namespace brushfire::oracle;

struct Row {
  int reached = 0, field_wrong = 0;
  int too_long[4] = {0, 0, 0, 0};           // by the stage of judge_path()
  std::map<std::string, int> bad, bad_too;  // by the complaint's first word; the second where the field is wrong
};

// A field or an oracle that takes longer than this is given up: some never end.
constexpr unsigned kSeconds = 1;

struct Answer {
  bool reached, field_true;
  double field, length, truth;
  char complaint[160];
};

// In a process of its own; false where it was given up, in what stage.
bool judged(const Mesh& mesh, const SurfacePoint& from, const SurfacePoint& to, int* stage, Answer& answer) {
  int pipes[2];
  if (pipe(pipes) != 0) return false;
  const pid_t child = fork();
  if (child == 0) {
    alarm(kSeconds);
    const PathVerdict v = judge_path(mesh, from, to, true, stage);
    Answer a{v.reached, v.field_true, v.field, v.length, static_cast<double>(v.truth), {}};
    std::snprintf(a.complaint, sizeof a.complaint, "%s", v.complaint.c_str());
    _exit(write(pipes[1], &a, sizeof a) == sizeof a ? 0 : 1);
  }
  close(pipes[1]);
  const bool done = read(pipes[0], &answer, sizeof answer) == sizeof answer;
  close(pipes[0]);
  waitpid(child, nullptr, 0);
  return done;
}

void add(const Answer& v, Row& row) {
  row.reached += v.reached;
  row.field_wrong += !v.field_true;
  const std::string complaint = v.complaint;
  if (!complaint.empty()) ++(v.field_true ? row.bad : row.bad_too)[complaint.substr(0, complaint.find(':'))];
}

void print(Wild family, int paths, const Row& row) {
  std::printf("%-10s %7d %8d %12d %12d %8d %8d |", name_of(family), paths, row.reached, row.field_wrong,
              row.too_long[1], row.too_long[2], row.too_long[3]);
  for (const auto& [word, count] : row.bad) std::printf(" %s %d", word.c_str(), count);
  std::printf(" | beside wrong fields:");
  for (const auto& [word, count] : row.bad_too) std::printf(" %s %d", word.c_str(), count);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: wild_paths COUNT [SEED] [FAMILY]\n");
    return 2;
  }
  const int count = std::atoi(argv[1]);
  const auto first = static_cast<std::uint32_t>(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1);
  const std::string only = argc > 3 ? argv[3] : "";
  bool bad = false;
  std::printf("%-10s %7s %8s %12s %30s |\n", "family", "paths", "reached", "field wrong",
              "too long: field, path, oracle");
  auto* const stage =
      static_cast<int*>(mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  for (const Wild family : kWild) {
    if (!only.empty() && only != name_of(family)) continue;
    Row row;
    for (std::uint32_t seed = first; seed < first + static_cast<std::uint32_t>(count); ++seed) {
      std::mt19937 random(seed);
      const Mesh mesh = wild_complex(family, random);
      for (int pair = 0; pair < 3; ++pair) {
        const SurfacePoint from = wild_point(mesh, random), to = wild_point(mesh, random);
        Answer v;
        if (!judged(mesh, from, to, stage, v)) {
          ++row.too_long[*stage];
          std::fprintf(stderr, "%s seed %u pair %d: too long in stage %d\n", name_of(family), seed, pair, *stage);
          continue;
        }
        add(v, row);
        if (v.complaint[0] && (v.field_true || std::getenv("WILD_ALL"))) {
          std::fprintf(stderr, "%s seed %u pair %d: %s; path %.17g field %.17g truth %.17g\n", name_of(family), seed,
                       pair, v.complaint, v.length, v.field, v.truth);
        }
      }
    }
    bad = bad || !row.bad.empty();
    print(family, 3 * count, row);
  }
  return bad ? 1 : 0;
}
