// The corpus: complexes at random, awkward in every way that is known, each solver on them, and who was right.
#include "corpus/check.h"

#include <brushfire/core/error.h>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>
#include <thread>

namespace brushfire::corpus {
namespace {

constexpr std::size_t kStarts = 2;

struct Settings {
  std::vector<std::string> families, methods;
  std::vector<double> tolerances{1e-2, 1e-3, 1e-5};
  std::uint64_t seed = 1, count = 60, first = 0;
  std::string dump;
  unsigned lanes = 1;
  std::size_t shown = 3;
};

// What became of a family.
struct Tally {
  std::uint64_t exact_compared = 0, exact_beyond = 0, unbound = 0, hung = 0, crashed = 0, refused = 0;
  std::uint64_t paths = 0, lost = 0, path_beyond = 0, window_violations = 0, side_violations = 0, other_beyond = 0;
  std::uint64_t no_truth = 0, unsure = 0;
  double worst = 0, path_worst = 0;

  std::uint64_t wrong() const {
    return exact_beyond + unbound + hung + crashed + refused + lost + path_beyond + window_violations +
           side_violations + other_beyond;
  }

  void add(const Task& task, const Outcome& o) {
    using Kind = Task::Kind;
    unsure += o.unsure;
    if (task.kind == Kind::Truth) {
      no_truth += o.ending != Ending::Done;
      return;
    }
    hung += o.ending == Ending::Hung;
    crashed += o.ending == Ending::Crashed;
    refused += o.ending == Ending::Refused;
    if (task.kind == Kind::Paths) {
      paths += o.compared;
      lost += o.lost;
      path_beyond += o.beyond;
      path_worst = std::max(path_worst, o.worst);
    } else if (task.kind == Kind::Windows) {
      window_violations += o.beyond + o.unbound;
    } else if (task.of_windows()) {
      side_violations += o.beyond;
    } else if (task.kind == Kind::Other) {
      other_beyond += o.beyond;
    } else {
      exact_compared += o.compared;
      exact_beyond += o.beyond;
      unbound += o.unbound;
      worst = std::max(worst, o.worst);
    }
  }

  void add(const Tally& t) {
    exact_compared += t.exact_compared, exact_beyond += t.exact_beyond, unbound += t.unbound, hung += t.hung;
    crashed += t.crashed, refused += t.refused, paths += t.paths, lost += t.lost, path_beyond += t.path_beyond;
    window_violations += t.window_violations, side_violations += t.side_violations, other_beyond += t.other_beyond;
    no_truth += t.no_truth, unsure += t.unsure;
    worst = std::max(worst, t.worst), path_worst = std::max(path_worst, t.path_worst);
  }
};

void print_head() {
  std::printf(
      "| family | cases | compared | beyond | worst | bound broken | hangs | crashes | errors | paths | lost | "
      "off the field | worst | windows | lower, upper | others | no truth | oracle unsure |\n");
  std::printf("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
}

void print_row(const std::string& name, std::uint64_t cases, const Tally& t) {
  const auto n = [](std::uint64_t x) { return static_cast<unsigned long long>(x); };
  std::printf(
      "| %s | %llu | %llu | %llu | %.1e | %llu | %llu | %llu | %llu | %llu | %llu | %llu | %.1e | %llu | %llu | "
      "%llu | %llu | %llu |\n",
      name.c_str(), n(cases), n(t.exact_compared), n(t.exact_beyond), t.worst, n(t.unbound), n(t.hung), n(t.crashed),
      n(t.refused), n(t.paths), n(t.lost), n(t.path_beyond), t.path_worst, n(t.window_violations), n(t.side_violations),
      n(t.other_beyond), n(t.no_truth), n(t.unsure));
  std::fflush(stdout);
}

std::string starts_text(const std::vector<Source>& sources) {
  std::string text;
  for (const Source& s : sources) {
    char offset[40] = "";
    if (s.offset != 0) std::snprintf(offset, sizeof offset, "@%.17g", s.offset);
    text += " --source " + place_text(s.point) + offset;
  }
  return text;
}

void dump(const Settings& settings, const Family& family, std::uint64_t index, std::size_t start, const Task& task,
          const Outcome& outcome) {
  const Case c = make_case(family, settings.seed, index);
  const std::string name = family.name + "-" + std::to_string(settings.seed) + "-" + std::to_string(index) + ".obj";
  if (!c.mesh.has_positions()) {
    std::fprintf(stderr, "  %s has lengths only: no OBJ\n", name.c_str());
    return;
  }
  std::filesystem::create_directories(settings.dump);
  write_obj(settings.dump + "/" + name, c.mesh, {task.name() + starts_text(c.starts[start]), outcome.text});
}

void report(const Settings& settings, const Family& family, std::uint64_t index, std::size_t start, const Task& task,
            const Outcome& outcome) {
  std::fprintf(stderr, "%s: %s: %s\n  again: ./run corpus --family %s --seed %llu --index %llu --method %s --dump .\n",
               family.name.c_str(), task.name().c_str(), outcome.text, family.name.c_str(),
               static_cast<unsigned long long>(settings.seed), static_cast<unsigned long long>(index),
               task.name().substr(0, task.name().find(' ')).c_str());
  if (!settings.dump.empty()) dump(settings, family, index, start, task, outcome);
}

Tally run_family(const Settings& settings, const Family& family, const std::vector<Task>& tasks) {
  Tally tally;
  Examination examination(family, settings.seed);
  std::map<std::string, std::size_t> shown;  // by task
  Steps steps;
  steps.blocks = settings.count;
  steps.block_size = kStarts * tasks.size();
  steps.lanes = settings.lanes;
  steps.run = [&](std::size_t block, std::size_t step) {
    return examination.run(settings.first + block, step / tasks.size(), tasks[step % tasks.size()]);
  };
  steps.seconds = [&](std::size_t step) { return seconds_for(tasks[step % tasks.size()]); };
  steps.resume = [&](std::size_t step) {  // without the truth there is nothing to ask
    return step % tasks.size() == 0 ? step + tasks.size() : step + 1;
  };
  steps.done = [&](std::size_t block, std::size_t step, const Outcome& outcome) {
    const Task& task = tasks[step % tasks.size()];
    tally.add(task, outcome);
    const bool bad = !outcome.good() && task.kind != Task::Kind::Truth;
    if (bad && (shown[task.name()]++ < settings.shown || !settings.dump.empty())) {
      report(settings, family, settings.first + block, step / tasks.size(), task, outcome);
    }
  };
  run_in_children(steps);
  return tally;
}

bool is_wanted(const Settings& settings, const std::string& name) {
  return settings.families.empty() ||
         std::find(settings.families.begin(), settings.families.end(), name) != settings.families.end();
}

int run(const Settings& settings) {
  for (const std::string& name : settings.families) {
    const auto all = small_families();
    if (std::none_of(all.begin(), all.end(), [&](const Family& f) { return f.name == name; })) {
      throw Error(ErrorCode::InvalidArgument, "there is no family '" + name + "' (--list tells which there are)");
    }
  }
  const std::vector<Task> tasks = tasks_of(settings.methods, settings.tolerances);
  std::printf("seed %llu\n\n", static_cast<unsigned long long>(settings.seed));
  print_head();
  Tally all;
  std::uint64_t cases = 0;
  for (const Family& family : small_families()) {
    if (!is_wanted(settings, family.name)) continue;
    const Tally tally = run_family(settings, family, tasks);
    print_row(family.name, settings.count, tally);
    all.add(tally);
    cases += settings.count;
  }
  print_row("all", cases, all);
  return all.wrong() > 0 ? 1 : 0;
}

int main(int argc, char** argv) {
  CLI::App app{"Complexes at random, awkward in every way that is known, each solver on them, and who was right.",
               "./run corpus"};
  Settings settings;
  bool list = false;
  std::optional<std::uint64_t> index;
  settings.lanes = std::max(1u, std::thread::hardware_concurrency());
  app.add_option("--family", settings.families, "Only these families")->delimiter(',');
  app.add_option("--method", settings.methods, "Only these: exact, paths, windows, lower, novotni-klein, ...")
      ->delimiter(',');
  app.add_option("--tolerance", settings.tolerances, "Of windows, lower and upper")->delimiter(',');
  app.add_option("--count", settings.count, "Cases of each family");
  app.add_option("--seed", settings.seed, "Another seed, other cases");
  app.add_option("--index", index, "One case only");
  app.add_option("--dump", settings.dump, "A folder for the meshes of all failures, as OBJ");
  app.add_option("--jobs", settings.lanes, "Processes at a time")->check(CLI::PositiveNumber);
  app.add_option("--shown", settings.shown, "How many failures of each family and method are told");
  app.add_flag("--list", list, "Tell the families");
  CLI11_PARSE(app, argc, argv);
  if (list) {
    for (const Family& f : small_families()) std::printf("%-14s %s\n", f.name.c_str(), f.what.c_str());
    return 0;
  }
  if (index) settings.first = *index, settings.count = 1;
  return run(settings);
}

}  // namespace
}  // namespace brushfire::corpus

int main(int argc, char** argv) {
  try {
    return brushfire::corpus::main(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "corpus: %s\n", e.what());
    return 2;
  }
}
