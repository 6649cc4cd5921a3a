// The table of verbs and the options that they share, held against what every verb says and does.
#include "shared.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace brushfire::tool {
namespace {

// Verbs that neither read nor compute anything on a mesh.
const std::set<std::string> kElsewhere{"shape", "terrain", "merge", "completion", "manual"};

std::vector<VerbNames> verbs() {
  CommandLine command_line;
  add_verbs(command_line);
  return command_line.names();
}

struct Said {
  int code;
  std::string err;
};

Said run(std::vector<std::string> words) {
  CommandLine command_line;
  add_verbs(command_line);
  words.insert(words.begin(), "brushfire");
  std::vector<const char*> argv;
  for (const std::string& w : words) argv.push_back(w.c_str());
  testing::internal::CaptureStderr();
  const int code = command_line.run(static_cast<int>(argv.size()), argv.data());
  return {code, testing::internal::GetCapturedStderr()};
}

// A verb with a file that is not there for each of its arguments: what is wrong with an option is said before that.
std::vector<std::string> call(const VerbNames& verb) {
  std::vector<std::string> words{verb.name};
  for (const OptionNames& a : verb.arguments) words.push_back(a.choices.empty() ? "missing.ply" : a.choices.front());
  return words;
}

bool is_named(const OptionNames& option, const std::string& name) {
  return std::find(option.names.begin(), option.names.end(), name) != option.names.end();
}

// The first that has two dashes: "--radius" of "-r,--radius".
std::string long_name(const OptionNames& option) {
  return *std::find_if(option.names.begin(), option.names.end(), [](const std::string& n) { return n[1] == '-'; });
}

std::vector<OptionNames> named(const std::vector<OptionNames>& options, const std::string& name) {
  std::vector<OptionNames> found;
  std::copy_if(options.begin(), options.end(), std::back_inserter(found),
               [&](const OptionNames& o) { return is_named(o, name); });
  return found;
}

// Without what stands in brackets: a verb's own default.
std::string without_brackets(std::string text) {
  for (std::size_t at; (at = text.find('(')) != std::string::npos;) text.erase(at, text.find(')', at) - at + 1);
  return text;
}

TEST(SharedOptions, EveryVerbTakesEachOrRefusesIt) {
  for (const VerbNames& verb : verbs()) {
    for (const std::string& name : shared_names()) {
      const std::size_t taken = named(verb.options, name).size(), refused = named(verb.refused, name).size();
      EXPECT_EQ(taken + refused, kElsewhere.count(verb.name) ? 0u : 1u) << verb.name << " " << name;
    }
  }
}

TEST(SharedOptions, AreSpelledAndExplainedTheSameEverywhere) {
  for (const std::string& name : shared_names()) {
    std::set<std::string> placeholders, helps, first_names;
    for (const VerbNames& verb : verbs()) {
      for (const OptionNames& option : named(verb.options, name)) {
        placeholders.insert(option.placeholder);
        helps.insert(without_brackets(option.help));
        first_names.insert(option.names.front());
      }
    }
    EXPECT_EQ(placeholders.size(), 1u) << name;
    EXPECT_EQ(helps.size(), 1u) << testing::PrintToString(helps);
    EXPECT_EQ(first_names.size(), 1u) << name;
  }
}

TEST(SharedOptions, WhatIsRefusedIsRefusedByNameWithTheReason) {
  int count = 0;
  for (const VerbNames& verb : verbs()) {
    for (const OptionNames& option : verb.refused) {
      for (const std::string& name : option.names) {
        std::vector<std::string> words = call(verb);
        words.insert(words.end(), {name, "1"});
        const Said said = run(words);
        EXPECT_EQ(said.code, kUsage) << verb.name << " " << name;
        EXPECT_EQ(said.err, "brushfire: " + long_name(option) + ": " + option.help + "\n") << verb.name;
        EXPECT_GT(option.help.size(), 20u) << verb.name << " " << name;
        ++count;
      }
    }
  }
  EXPECT_GT(count, 30);
}

// Two verbs of ours do not give one name to two things, shared or not, but for these.
TEST(SharedOptions, AnOptionsNameMeansOneThing) {
  const std::set<std::string> several{"-t,--target", "--labels"};
  std::map<std::string, std::set<bool>> takes_value;
  std::map<std::string, std::set<bool>> is_number;
  for (const VerbNames& verb : verbs()) {
    for (const OptionNames& option : verb.options) {
      for (const std::string& name : option.names) {
        takes_value[name].insert(option.takes_value);
        is_number[name].insert(option.is_number);
      }
    }
  }
  for (const auto& [name, kinds] : takes_value) EXPECT_EQ(kinds.size(), 1u) << name;
  for (const auto& [name, kinds] : is_number) EXPECT_EQ(kinds.size(), 1u) << name;
}

TEST(SharedOptions, AnEmptyValueOfAnyOptionOfAnyVerbIsAnErrorThatNamesIt) {
  for (const VerbNames& verb : verbs()) {
    for (const OptionNames& option : verb.options) {
      if (!option.takes_value) continue;
      for (const std::string& name : option.names) {
        std::vector<std::string> words = call(verb);
        words.insert(words.end(), {name, ""});
        const Said said = run(words);
        EXPECT_EQ(said.code, kUsage) << verb.name << " " << name << ": " << said.err;
        EXPECT_NE(said.err.find("--"), std::string::npos) << said.err;
        EXPECT_TRUE(std::any_of(option.names.begin(), option.names.end(),
                                [&](const std::string& n) { return said.err.find(n) != std::string::npos; }))
            << verb.name << " " << name << ": " << said.err;
      }
    }
  }
}

TEST(SharedOptions, EveryNumberIsReadByOneParserWithOneMessage) {
  int count = 0;
  for (const VerbNames& verb : verbs()) {
    for (const OptionNames& option : verb.options) {
      if (!option.is_number) continue;
      for (const char* value : {"nan", "-nan", "1e400", "-1e400", "0x10", "1e", "1,5", "1.5mm", "infinity", "--5"}) {
        std::vector<std::string> words = call(verb);
        words.push_back(option.names.back() + "=" + value);
        const Said said = run(words);
        EXPECT_EQ(said.code, kUsage) << verb.name << " " << words.back() << said.err;
        EXPECT_NE(said.err.find(" takes a "), std::string::npos) << said.err;
        EXPECT_NE(said.err.find(", not '" + std::string(value) + "'\n"), std::string::npos) << said.err;
        ++count;
      }
    }
  }
  EXPECT_GT(count, 300);
}

}  // namespace
}  // namespace brushfire::tool
