// The corpus: complexes at random, awkward in every way that is known, each solver on them, and who was right.
#include "corpus/check.h"
#include "corpus/curves.h"
#include "corpus/laws.h"
#include "corpus/tally.h"

#include <brushfire/core/error.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <thread>

namespace brushfire::corpus {
namespace {

namespace fs = std::filesystem;
using Count = unsigned long long;

constexpr std::size_t kStarts = 2;  // of every case

struct Settings {
  std::vector<std::string> parts, families, methods, meshes, folders;
  std::vector<double> tolerances{1e-2, 1e-3, 1e-5};
  std::uint64_t seed = 1, count = 0, first = 0;
  std::string dump;
  unsigned lanes = 1;
  std::size_t shown = 3;
  bool night = false;

  bool wants(const std::string& part) const {
    return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
  }
  std::uint64_t count_or(std::uint64_t by_day, std::uint64_t by_night) const {
    return count > 0 ? count : night ? by_night : by_day;
  }
};

// ---- beside the oracle

std::string sources_text(const std::vector<Source>& sources) {
  std::string text;
  for (const Source& s : sources) {
    if (s.curve != nullptr) {
      text += " --source curve(" + text_of(*s.curve) + ")@" + std::to_string(s.offset);
      continue;
    }
    char offset[40] = "";
    if (s.offset != 0) std::snprintf(offset, sizeof offset, "@%.17g", s.offset);
    text += " --source " + place_text(s.point) + offset;
  }
  return text;
}

std::string first_word(const std::string& text) { return text.substr(0, text.find(' ')); }

void dump(const Settings& settings, const Family& family, std::uint64_t index, std::size_t start, const Task& task,
          const Outcome& outcome) {
  const Case c = make_case(family, settings.seed, index);
  const std::string name = family.name + "-" + std::to_string(settings.seed) + "-" + std::to_string(index) + ".obj";
  if (!c.mesh.has_positions()) {
    std::fprintf(stderr, "  (lengths only: no OBJ)\n");
    return;
  }
  fs::create_directories(settings.dump);
  write_obj((fs::path(settings.dump) / name).string(), c.mesh,
            {task.name() + sources_text(c.starts[start]), outcome.text});
}

void report(const Settings& settings, const Family& family, std::uint64_t index, std::size_t start, const Task& task,
            const Outcome& outcome) {
  std::fprintf(stderr, "%s: %s: %s\n  again: ./run corpus --family %s --seed %llu --index %llu --method %s --dump .\n",
               family.name.c_str(), task.name().c_str(), outcome.text, family.name.c_str(), Count{settings.seed},
               Count{index}, first_word(task.name()).c_str());
  if (!settings.dump.empty()) dump(settings, family, index, start, task, outcome);
}

Tally run_family(const Settings& settings, const Family& family, const std::vector<Task>& tasks, std::uint64_t count) {
  Tally tally;
  Examination examination(family, settings.seed);
  std::map<std::string, std::size_t> shown;  // by task
  Steps steps;
  steps.blocks = count;
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

std::vector<Family> chosen_families(const Settings& settings) {
  std::vector<Family> all(small_families().begin(), small_families().end());
  for (int decades = 3; decades <= 12; ++decades) all.push_back(family_of_ratio(decades));
  for (const Family& f : small_families()) all.push_back(with_curves(f));
  if (settings.families.empty()) return {small_families().begin(), small_families().end()};
  std::vector<Family> chosen;
  for (const std::string& name : settings.families) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Family& f) { return f.name == name; });
    if (found == all.end()) {
      throw Error(ErrorCode::InvalidArgument, "there is no family '" + name + "' (--list tells which there are)");
    }
    chosen.push_back(*found);
  }
  return chosen;
}

std::uint64_t beside_the_oracle(const Settings& settings, const std::vector<Family>& families, std::uint64_t count) {
  const std::vector<Task> tasks = tasks_of(settings.methods, settings.tolerances);
  print_head_of_families();
  Tally all;
  std::uint64_t cases = 0;
  for (const Family& family : families) {
    const Tally tally = run_family(settings, family, tasks, count);
    print_row(family.name, count, tally);
    all.add(tally);
    cases += count;
  }
  print_row("all", cases, all);
  return all.wrong();
}

std::uint64_t families_part(const Settings& settings) {
  std::printf("\nRandom families beside the oracle, seed %llu\n\n", Count{settings.seed});
  return beside_the_oracle(settings, chosen_families(settings), settings.count_or(20, 1000));
}

std::uint64_t curves_part(const Settings& settings) {
  std::printf("\nCurves on these families beside the oracle, seed %llu\n\n", Count{settings.seed});
  std::vector<Family> families;
  for (const Family& f : small_families()) families.push_back(with_curves(f));
  return beside_the_oracle(settings, families, settings.count_or(5, 500));
}

// The error of exact against the ratio of the largest length to the shortest.
std::uint64_t ratios_part(const Settings& settings) {
  const std::vector<Task> tasks = tasks_of({"exact"}, {});
  const std::uint64_t count = settings.count_or(20, 500);
  std::printf("\nExact, by the ratio of the largest length to the shortest, seed %llu\n\n", Count{settings.seed});
  std::printf("| ratio | cases | compared | largest relative error | beyond | bound broken | hangs |\n");
  std::printf("|---|--:|--:|--:|--:|--:|--:|\n");
  std::uint64_t wrong = 0;
  for (int decades = 3; decades <= 12; ++decades) {
    const Tally t = run_family(settings, family_of_ratio(decades), tasks, count);
    std::printf("| 1e%d | %llu | %llu | %.1e | %llu | %llu | %llu |\n", decades, Count{count}, Count{t.compared},
                t.worst, Count{t.beyond}, Count{t.unbound}, Count{t.hung});
    std::fflush(stdout);
    wrong += t.wrong();
  }
  return wrong;
}

// ---- laws

// Those that were asked for: a part of the name is enough.
std::vector<Subject> chosen_subjects(const Settings& settings, std::vector<Subject> all) {
  if (settings.meshes.empty()) return all;
  std::vector<Subject> chosen;
  for (Subject& s : all) {
    const auto is_part = [&](const std::string& word) { return s.name.find(word) != std::string::npos; };
    if (std::any_of(settings.meshes.begin(), settings.meshes.end(), is_part)) chosen.push_back(std::move(s));
  }
  return chosen;
}

// Exact, which the others are compared with, and those of --method.
std::vector<Law> chosen_laws(const Settings& settings) {
  std::vector<Law> laws;
  for (std::size_t k = 0; k < kLaws; ++k) {
    const auto law = static_cast<Law>(k);
    const bool named = std::find(settings.methods.begin(), settings.methods.end(), first_word(name_of_law(law))) !=
                       settings.methods.end();
    if (law == Law::Exact || settings.methods.empty() || named) laws.push_back(law);
  }
  return laws;
}

void report(const Settings& settings, const char* part, const std::string& name, const std::string& law,
            const Outcome& outcome) {
  std::fprintf(stderr, "%s: %s: %s\n  again: ./run corpus %s%s --mesh '%s' --seed %llu --method %s\n", name.c_str(),
               law.c_str(), outcome.text, part, settings.night ? " --night" : "", name.c_str(), Count{settings.seed},
               first_word(law).c_str());
}

LawTally hold_to_laws(const Settings& settings, const char* part, const std::vector<Subject>& every, double seconds,
                      bool row_each) {
  const std::vector<Subject> subjects = chosen_subjects(settings, every);
  const std::vector<Law> laws = chosen_laws(settings);
  std::vector<LawTally> each(subjects.size());
  for (LawTally& t : each) t.meshes = 1;
  LawTally all;
  Trial trial(subjects, settings.seed, seconds);
  Steps steps;
  steps.blocks = subjects.size();
  steps.block_size = laws.size();
  steps.lanes = settings.lanes;
  steps.run = [&](std::size_t block, std::size_t step) { return trial.run(block, laws[step]); };
  steps.seconds = [&](std::size_t) { return seconds; };
  steps.resume = [&](std::size_t step) {
    return step == 0 ? laws.size() : step + 1;
  };  // without exact, nothing to compare
  steps.done = [&](std::size_t block, std::size_t step, const Outcome& outcome) {
    const std::string law = name_of_law(laws[step]);
    each[block].add(law, outcome);
    all.add(subjects[block].name + ", " + law, outcome);
    if (!outcome.good()) report(settings, part, subjects[block].name, law, outcome);
    const bool died = outcome.ending == Ending::Hung || outcome.ending == Ending::Crashed;
    const std::size_t next = died ? steps.resume(step) : step + 1;
    if (row_each && next >= laws.size()) print_row(subjects[block].name, each[block]);
  };
  if (!subjects.empty()) run_in_children(steps);
  all.meshes = subjects.size();
  return all;
}

std::uint64_t laws_part(const Settings& settings) {
  std::printf("\nLarge meshes, held to laws, seed %llu\n\n", Count{settings.seed});
  print_head_of_laws();
  const LawTally all = hold_to_laws(settings, "laws", large_subjects(settings.seed, settings.night ? 1 : 0.01),
                                    settings.night ? 60 : 5, true);
  print_row("all", all);
  return all.wrong();
}

std::uint64_t files_part(const Settings& settings) {
  std::printf("\nMeshes from files, held to laws, seed %llu\n\n", Count{settings.seed});
  if (settings.folders.empty()) std::printf("(no folder of meshes at hand: left out)\n");
  std::uint64_t wrong = 0;
  std::vector<std::pair<std::string, LawTally>> rows;
  const double seconds = settings.night ? 120 : 5;
  const std::uint64_t most_bytes = settings.night ? std::uint64_t{1} << 40 : 100'000;
  for (const std::string& folder : settings.folders) {
    rows.emplace_back(folder, hold_to_laws(settings, "files", file_subjects(folder, most_bytes), seconds, false));
    wrong += rows.back().second.wrong();
  }
  if (!rows.empty()) print_head_of_laws();
  for (const auto& [name, tally] : rows) print_row(name, tally);
  return wrong;
}

std::uint64_t run(const Settings& settings) {
  std::uint64_t wrong = 0;
  if (settings.wants("families")) wrong += families_part(settings);
  if (settings.wants("curves")) wrong += curves_part(settings);
  if (settings.wants("ratios")) wrong += ratios_part(settings);
  if (settings.wants("laws")) wrong += laws_part(settings);
  if (settings.wants("files")) wrong += files_part(settings);
  std::printf("\n%llu wrong\n", Count{wrong});
  return wrong;
}

// Days since 1970: every night other cases.
std::uint64_t today() { return static_cast<std::uint64_t>(std::time(nullptr)) / 86400; }

constexpr const char* kFooter =
    R"(A case is named by its family, a seed and an index, and is the same anywhere. Every failure prints the command
that makes it again. Exit code 1 where a promise is broken: any of the columns but the last two.

  beyond         farther from the truth than max(1e-12 of the value, its error_bound): exact, at vertices and targets
  bound broken   farther than half of error_bound: an early warning
  off the field  paths whose length is off the field's value, or the truth, by more than 1e-11 of it and the error_bound
  windows        bounds that do not hold, or are wider than the tolerance
  lower, upper   on the wrong side of the truth, to the last bit
  others         marching and Dijkstra: reached wrongly; Dijkstra: below the truth by more than its first step rounds
  no truth       starts on which the oracle does not end
  oracle unsure  solves on which the oracle changed its mind with twice the digits)";

int main(int argc, char** argv) {
  CLI::App app{"Complexes at random, awkward in every way that is known, each solver on them, and who was right.",
               "./run corpus"};
  Settings settings;
  bool list = false;
  std::optional<std::uint64_t> index, seed;
  settings.lanes = std::max(1u, std::thread::hardware_concurrency());
  app.add_option("part", settings.parts, "families, curves, ratios, laws, files; all of them if none is named")
      ->check(CLI::IsMember({"families", "curves", "ratios", "laws", "files"}));
  app.add_flag("--night", settings.night, "Hours instead of two minutes; a new seed every day");
  app.add_option("--family", settings.families,
                 "Only these families (implies the part families); curves-NAME: curves on them")
      ->delimiter(',');
  app.add_option("--method", settings.methods,
                 "Only these: exact, paths, targets, radius, windows, lower, upper, symmetry, ...")
      ->delimiter(',');
  app.add_option("--tolerance", settings.tolerances, "Of windows, lower and upper")->delimiter(',');
  app.add_option("--mesh", settings.meshes, "Of laws and files: those whose name has this in it")->delimiter(',');
  app.add_option("--count", settings.count, "Cases of each family");
  app.add_option("--seed", seed, "Another seed, other cases (default 1; at night the day)");
  app.add_option("--index", index, "One case only");
  app.add_option("--dump", settings.dump, "A folder for the meshes of all failures, as OBJ");
  app.add_option("--meshes", settings.folders, "A folder of meshes for the part files; may be given several times")
      ->allow_extra_args(false);
  app.add_option("--jobs", settings.lanes, "Processes at a time")->check(CLI::PositiveNumber);
  app.add_option("--shown", settings.shown, "How many failures of each family and method are told (default 3)");
  app.add_flag("--list", list, "Tell the families");
  app.footer(kFooter);
  CLI11_PARSE(app, argc, argv);
  if (list) {
    for (const Family& f : small_families()) std::printf("%-14s %s\n", f.name.c_str(), f.what.c_str());
    return 0;
  }
  settings.seed = seed.value_or(settings.night ? today() : 1);
  if (index) settings.first = *index, settings.count = 1;
  if (!settings.families.empty()) settings.parts = {"families"};
  return run(settings) > 0 ? 1 : 0;
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
