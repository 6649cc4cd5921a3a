// Ctrl-C and SIGTERM end whatever the program is at within 0.3 s: a table of verb, phase and signal.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "io/io_support.h"

namespace brushfire::test {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kPromise{300};
// What a machine with more to do than it has processors may add, before a process is looked at at all.
constexpr milliseconds kLoadedSlack{1500};

milliseconds limit() {
  double load = 0;
  const bool known = getloadavg(&load, 1) == 1;
  return known && load > 0.75 * std::thread::hardware_concurrency() ? kPromise + kLoadedSlack : kPromise;
}

enum class Input { None, Silent, Endless };  // standard input: empty; a pipe that says nothing; one that never ends
enum class Output { Dropped, NobodyReads };  // standard output

struct Case {
  const char* phase;
  std::vector<std::string> arguments;
  milliseconds delay{200};  // from the start to the signal: the phase has begun by then on a slow machine
  Input input = Input::None;
  Output output = Output::Dropped;
};

// The files that the cases need.
class Folder {
 public:
  void fill() const {
    run({"shape", "terrain", "-n", "600000", "-o", path("terrain.ply"), "-q"});
    run({"distance", path("terrain.ply"), "-s", "0", "-m", "dijkstra", "-o", path("field.npy"), "-q"});
    run({"shape", "sphere", "-n", "20000", "-o", path("sphere.ply"), "-q"});
    run({"shape", "sphere", "-n", "600", "-o", path("small.ply"), "-q"});
    std::ofstream(path("viewer.html")) << "<html>\n<!-- brushfire view: the mesh -->\n</html>\n";
    setenv("BRUSHFIRE_VIEWER", path("viewer.html").c_str(), 1);
    write_labels();
    write_pairs();
    write_heights();
    for (const char* shard : {"1/2", "2/2"}) {
      run({"matrix", path("sphere.ply"), "--rows", "0:2000", "-m", "dijkstra", "-r", "0.05", "--dtype", "float64",
           "--shard", shard, "-o", path("shard.npy"), "-q"});
    }
    mkfifo(path("pipe").c_str(), 0600);
    mkfifo(path("pipe.csv").c_str(), 0600);
    std::ofstream fan(path("fan.obj"));
    constexpr int kFaces = 1'000'000;
    fan << "v 0 0 0\n";
    for (int i = 0; i < kFaces; ++i)
      fan << "v " << std::cos(6.28 * i / kFaces) << ' ' << std::sin(6.28 * i / kFaces) << " 0\n";
    for (int i = 0; i < kFaces; ++i) fan << "f 1 " << 2 + i << ' ' << 2 + (i + 1) % kFaces << '\n';
  }

  std::string path(const std::string& name) const { return folder_ / name; }

 private:
  // Of the sphere's vertices.
  void write_labels() const {
    std::ofstream labels(path("labels.txt"));
    for (int i = 0; i < 10242; ++i) labels << i / 300 << '\n';
  }
  void write_pairs() const {
    std::ofstream pairs(path("pairs.txt"));
    for (int i = 0; i < 10242; ++i) pairs << i << ' ' << (i + 5000) % 10242 << '\n';
  }
  void write_heights() const {
    std::ofstream grid(path("grid.asc"));
    constexpr int kSide = 2000;
    grid << "ncols " << kSide << "\nnrows " << kSide << "\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    for (int i = 0; i < kSide * kSide; ++i) grid << i % 7 << (i % kSide + 1 < kSide ? ' ' : '\n');
  }
  static void run(const std::vector<std::string>& arguments) {
    std::string command = BRUSHFIRE_PROGRAM;
    for (const std::string& a : arguments) command += " '" + a + "'";
    if (std::system(command.c_str()) != 0) std::abort();
  }

  TemporaryDirectory folder_;
};

// One run of the program, from its start to its end.
class Program {
 public:
  explicit Program(const Case& c) {
    std::array<int, 2> in{}, out{};
    if (pipe2(in.data(), O_CLOEXEC) != 0 || pipe2(out.data(), O_CLOEXEC) != 0) std::abort();
    child_ = fork();
    if (child_ == 0) {
      for (const int s : {SIGINT, SIGTERM, SIGPIPE}) std::signal(s, SIG_DFL);
      const int nothing = open("/dev/null", O_RDWR);
      dup2(c.input == Input::None ? nothing : in[0], STDIN_FILENO);
      dup2(c.output == Output::Dropped ? nothing : out[1], STDOUT_FILENO);
      dup2(nothing, STDERR_FILENO);
      std::vector<std::string> words{BRUSHFIRE_PROGRAM};
      words.insert(words.end(), c.arguments.begin(), c.arguments.end());
      std::vector<char*> argv;
      for (std::string& w : words) argv.push_back(w.data());
      argv.push_back(nullptr);
      execv(argv[0], argv.data());
      _exit(127);
    }
    close(in[0]);
    to_child_ = in[1];
    from_child_ = out[0];
    close(out[1]);
    fcntl(to_child_, F_SETFL, O_NONBLOCK);
    endless_ = c.input == Input::Endless;
  }
  ~Program() {
    if (!ended_) {
      kill(child_, SIGKILL);
      waitpid(child_, &status_, 0);
    }
    close(to_child_);
    close(from_child_);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void feed_until(Clock::time_point end) {
    static const std::string zeros = [] {
      std::string text;
      for (int i = 0; i < 20000; ++i) text += "0\n";
      return text;
    }();
    while (Clock::now() < end) {
      const bool sent = endless_ && write(to_child_, zeros.data(), zeros.size()) > 0;
      if (!sent) std::this_thread::sleep_for(milliseconds(1));
    }
  }
  bool has_ended() {
    ended_ = ended_ || waitpid(child_, &status_, WNOHANG) == child_;
    return ended_;
  }
  void send(int signal) const { kill(child_, signal); }
  // As a shell would see it; -1 where a signal ended it.
  int exit_code() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }
  bool was_killed() const { return WIFSIGNALED(status_); }

 private:
  pid_t child_ = -1;
  int to_child_ = -1, from_child_ = -1, status_ = 0;
  bool ended_ = false, endless_ = false;
};

std::vector<std::string> many_waypoints(const std::string& mesh) {
  std::vector<std::string> arguments{"path", mesh, "--from", "0", "--to", "1", "--tighten"};
  for (int i = 0; i < 2000; ++i) {
    arguments.emplace_back("--via");
    arguments.push_back(std::to_string(7919 * i % 10000));
  }
  return arguments;
}

std::vector<Case> cases(const Folder& f) {
  const std::string terrain = f.path("terrain.ply"), sphere = f.path("sphere.ply"), small = f.path("small.ply");
  const std::string fan = f.path("fan.obj"), pipe = f.path("pipe"), out = f.path("out"), field = f.path("field.npy");
  std::vector<Case> all{
      {"mesh from a pipe that says nothing", {"info", "-"}, milliseconds(200), Input::Silent},
      {"mesh from a pipe without end", {"info", "-"}, milliseconds(200), Input::Endless},
      {"reading text", {"info", fan}, milliseconds(100)},
      {"counting", {"info", terrain}, milliseconds(300)},
      {"sources from a pipe that nobody opens", {"distance", small, "--sources", pipe}},
      {"sources that say nothing", {"distance", small, "--sources", "-"}, milliseconds(200), Input::Silent},
      {"sources without end", {"distance", small, "--sources", "-"}, milliseconds(200), Input::Endless},
      {"exact, set-up of a fan", {"distance", fan, "-s", "0", "-m", "exact"}, milliseconds(900)},
      {"novotni-klein, set-up of a fan", {"distance", fan, "-s", "0", "-m", "novotni-klein"}, milliseconds(900)},
      {"exact, one thread", {"distance", terrain, "-s", "0", "-m", "exact", "--threads", "1"}, milliseconds(900)},
      {"exact, two threads", {"distance", terrain, "-s", "0", "-m", "exact", "--threads", "2"}, milliseconds(900)},
      {"output to a pipe that nobody opens", {"distance", small, "-s", "0", "-o", f.path("pipe.csv")}},
      {"output to a pipe that nobody reads",
       {"distance", terrain, "-s", "0", "-m", "dijkstra", "-o", "-"},
       milliseconds(1500),
       Input::None,
       Output::NobodyReads},
      {"nearest points", {"path", fan, "--from", "at:0,0,1", "--to", "5"}, milliseconds(1000)},
      {"paths", many_waypoints(sphere), milliseconds(300)},
      {"straight curves",
       {"isolines", terrain, "-s", "0", "-m", "novotni-klein", "--count", "20000", "-o", out + ".json"},
       milliseconds(900)},
      {"curved curves",
       {"isolines", small, "-s", "0", "--count", "300", "--chord-error", "1e-13", "-o", out + ".json"},
       milliseconds(500)},
      {"rows", {"matrix", sphere, "-o", out + ".npy", "-m", "exact"}, milliseconds(500)},
      {"pairs", {"pairs", sphere, f.path("pairs.txt"), "-m", "exact", "-o", out + ".npy"}, milliseconds(500)},
      {"shards",
       {"merge", f.path("shard.1-of-2.npy"), f.path("shard.2-of-2.npy"), "-o", out + "-merged.npy"},
       milliseconds(60)},
      {"rows within a radius", {"matrix", sphere, "-r", "1", "-m", "exact", "-o", out + ".npz"}, milliseconds(500)},
      {"painting",
       {"render", terrain, "-s", "0", "-m", "dijkstra", "--size", "16384x16384", "-o", out + ".png"},
       milliseconds(1500)},
      {"an animation", {"render", sphere, "-s", "0", "--wave", "500", "-o", out + ".webp"}, milliseconds(500)},
      {"reading a field", {"compare", "-", "-"}, milliseconds(200), Input::Silent},
      {"measuring", {"bench", sphere, "-m", "exact", "--repeat", "1000"}, milliseconds(500)},
      {"regions", {"isochrones", terrain, field, "--levels", "1,2,3", "-o", out + ".json"}, milliseconds(300)},
      {"directions", {"log-map", terrain, "-s", "0", "-o", out + ".csv"}, milliseconds(300)},
      {"landmarks", {"flatten", terrain, "-m", "exact", "-o", out + ".obj"}, milliseconds(300)},
      {"slopes", {"gradient", terrain, "-s", "0", "-m", "exact", "-o", out + ".vtk"}, milliseconds(300)},
      {"cells", {"voronoi", terrain, "-s", "0,500,12000", "-m", "exact"}, milliseconds(300)},
      {"places", {"sample", terrain, "--count", "100", "-m", "exact"}, milliseconds(300)},
      {"bounds on the diameter", {"measure", terrain}, milliseconds(200)},
      {"from label to label",
       {"parcels", sphere, f.path("labels.txt"), "--distance", "mean", "-m", "exact"},
       milliseconds(200)},
      {"means", {"smooth", terrain, field, "--sigma", "0.5", "-o", out + ".npy"}, milliseconds(300)},
      {"proofs", {"certify", terrain, field, "-s", "0"}, milliseconds(300)},
      {"packing a page", {"view", terrain, "-s", "0", "-o", out + ".html"}, milliseconds(200)},
      {"writing text", {"convert", terrain, out + ".obj"}, milliseconds(200)},
      {"reading heights", {"terrain", f.path("grid.asc"), "-o", out + ".ply"}, milliseconds(200)},
  };
  for (const char* shape : {"terrain", "sphere", "cube", "torus", "folded-sphere", "delaunay-square"}) {
    all.push_back({shape, {"shape", shape, "-n", "2e7", "-o", out + ".ply"}, milliseconds(300)});
  }
  return all;
}

// Those that `brushfire --help` lists.
std::vector<std::string> verbs() {
  FILE* const help = popen(BRUSHFIRE_PROGRAM " --help", "r");
  if (help == nullptr) std::abort();
  std::vector<std::string> found;
  bool listed = false;
  for (std::array<char, 400> line{}; std::fgets(line.data(), line.size(), help) != nullptr;) {
    const std::string text = line.data();
    if (listed && text.rfind("  ", 0) != 0) break;
    if (listed) found.push_back(text.substr(2, text.find(' ', 2) - 2));
    listed = listed || text == "Verbs:\n";
  }
  pclose(help);
  return found;
}

struct Met {
  double ms = 0;  // from the signal to the end; infinity: none
  int exit_code = 0;
  milliseconds most{0};
  bool ended_by_signal = false;
};

// Runs the case and sends the signal after so long; nothing where the run was over before that.
std::optional<Met> meet(const Case& c, milliseconds delay, int signal) {
  Program run(c);
  run.feed_until(Clock::now() + delay);
  if (run.has_ended()) return std::nullopt;
  const milliseconds most = limit();
  const auto begin = Clock::now();
  run.send(signal);
  while (!run.has_ended() && Clock::now() - begin < most + kLoadedSlack) run.feed_until(Clock::now() + milliseconds(1));
  if (!run.has_ended()) return Met{INFINITY, -1, most, false};
  return Met{std::chrono::duration<double, std::milli>(Clock::now() - begin).count(), run.exit_code(), most,
             run.was_killed()};
}

// On a quick machine the phase may be over when its signal is due, or so nearly that the run is done before it hears:
// then it is asked again, in half the time. Whoever does not listen is never met. On a loaded one the program may not
// have begun, and the signal ends it as it ends any process: then it gets twice the time.
std::optional<Met> meet_in_time(const Case& c, int signal) {
  milliseconds delay = c.delay;
  for (int later = 0; delay >= milliseconds(5);) {
    const std::optional<Met> met = meet(c, delay, signal);
    const bool had_not_begun = met && met->ended_by_signal && later++ < 4;
    if (met && met->exit_code != 0 && !had_not_begun) return met;
    if (had_not_begun) {
      delay *= 2;
    } else {
      delay /= 2;
    }
  }
  return std::nullopt;
}

TEST(Signals, TheTableHasEveryVerb) {
  const Folder folder;
  const std::vector<Case> all = cases(folder);
  const std::vector<std::string> listed = verbs();
  EXPECT_GE(listed.size(), 20u);
  for (const std::string& verb : listed) {
    if (verb == "completion" || verb == "manual") continue;  // what they say is there at once
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Case& c) { return c.arguments[0] == verb; })) << verb;
  }
}

TEST(Signals, EveryVerbInEveryPhaseEndsWithin300Milliseconds) {
  const Folder folder;
  folder.fill();
  std::printf("%-10s %-38s %-8s %8s\n", "verb", "phase", "signal", "ms");
  for (const Case& c : cases(folder)) {
    for (const int signal : {SIGINT, SIGTERM}) {
      const std::optional<Met> met = meet_in_time(c, signal);
      ASSERT_TRUE(met) << c.arguments[0] << ", " << c.phase << ": ended as if there had been no signal";
      std::printf("%-10s %-38s %-8s %8.0f%s\n", c.arguments[0].c_str(), c.phase,
                  signal == SIGINT ? "SIGINT" : "SIGTERM", met->ms, met->most > kPromise ? "  (loaded machine)" : "");
      std::fflush(stdout);
      EXPECT_LE(met->ms, static_cast<double>(met->most.count())) << c.arguments[0] << ", " << c.phase;
      EXPECT_EQ(met->exit_code, 128 + signal) << c.arguments[0] << ", " << c.phase;
    }
  }
}

}  // namespace
}  // namespace brushfire::test
