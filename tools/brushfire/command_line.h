// The command line: verbs, their options and help. The parser behind it is known to command_line.cpp only.
#pragma once

#include "numbers.h"
#include "talk.h"

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::tool {

// How the program ends. Scripts rely on these numbers.
inline constexpr int kOk = 0;
inline constexpr int kInternal = 1;     // a bug, no memory, an output that cannot be written
inline constexpr int kUsage = 2;        // an argument that is not understood or names something that is not in the mesh
inline constexpr int kBadInput = 3;     // an input file that cannot be read or is not a mesh
inline constexpr int kUnreachable = 4;  // a target that no source reaches
inline constexpr int kProvenWrong = 5;  // a field that is proven wrong, or farther from another than was allowed
// Interrupted: 128 and the signal, see interrupt.h: 130 after Ctrl-C, 143 after SIGTERM.

// Thrown by a verb whose answer is that there is no way: what() says to where, and whether one was cut off by --radius.
class Unreachable : public std::runtime_error {
 public:
  explicit Unreachable(const std::string& where, bool within_radius = false)
      : std::runtime_error("no source reaches '" + where + "'" + (within_radius ? " within the radius" : "")) {}
};

// An argument that is not understood: the program ends with `what` on stderr and kUsage.
[[noreturn]] void refuse(const std::string& what);
// For options that count threads.
inline constexpr int kMostThreads = 4096;

// One verb, while it is being described: its arguments are bound to variables that its body then reads.
class Verb {
 public:
  struct Parser;
  explicit Verb(Parser& parser) : parser_(parser) {}

  // A required argument without a dash.
  void argument(const char* name, std::string& value, const char* help);
  // Further ones behind it, as many as there are.
  void arguments(const char* name, std::vector<std::string>& values, const char* help);
  // `names`: "-o,--output". `placeholder` is what the help shows for the value.
  void required_option(const char* names, std::string& value, const char* placeholder, const char* help);
  void option(const char* names, std::string& value, const char* placeholder, const char* help);
  // Refuses what is not in the range, while parsing.
  void option(const char* names, std::optional<double>& value, const char* placeholder, const Range& range,
              const char* help);
  void option(const char* names, std::optional<int>& value, const char* placeholder, const Range& range,
              const char* help);
  // May be given several times.
  void option(const char* names, std::vector<std::string>& values, const char* placeholder, const char* help);
  // One of `choices`, which the help and the completion list.
  void choice(const char* names, std::string& value, const std::vector<std::string>& choices, const char* help);
  // The same, given several times; what follows a colon is left to the body ("windows:1e-4").
  void choice(const char* names, std::vector<std::string>& values, const std::vector<std::string>& choices,
              const char* help);
  void flag(const char* names, bool& value, const char* help);
  // An option that other verbs have and this one has not: whoever gives it is told why. Not in the help.
  void refused(const char* names, bool takes_value, const std::string& reason);
  // Where the options that are added next stand in the help; "" is the usual place.
  void group(const char* title);
  // --json and --quiet, which the body finds in its Talk.
  void talks();
  // Shown at the end of --help.
  void examples(const char* text);
  // What the verb does; called after parsing, returns the exit code.
  void run(std::function<int(Talk&)> body);

 private:
  Parser& parser_;
};

// What shell completion and manual pages need to know about one option or argument.
struct OptionNames {
  std::vector<std::string> names;    // "-o", "--output"; of an argument its name
  std::vector<std::string> choices;  // where the value is one of a few words
  bool takes_value = false;
  bool is_number = false;
  std::string placeholder;  // for the value
  std::string help;
};

struct VerbNames {
  std::string name, help;
  std::vector<OptionNames> arguments, options;
  std::vector<OptionNames> refused;  // options of other verbs; `help` is the reason
  std::string footer;                // the examples, as in --help
};

class CommandLine {
 public:
  CommandLine();
  ~CommandLine();

  // `describe` binds the verb's arguments; what it binds them to must outlive run().
  void add(const char* name, const char* help, const std::function<void(Verb&)>& describe);

  // Parses and runs the verb. Never throws: every failure is one line on stderr and its exit code.
  int run(int argc, const char* const* argv);

  // All verbs with their options, for shell completion and manual pages.
  std::vector<VerbNames> names() const;
  // What stands under the program's own --help.
  std::string footer() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// All of them.
void add_verbs(CommandLine& command_line);
// One function per verb, each in the file of that name.
void add_info(CommandLine& command_line);
void add_distance(CommandLine& command_line);
void add_matrix(CommandLine& command_line);
void add_pairs(CommandLine& command_line);
void add_merge(CommandLine& command_line);
void add_path(CommandLine& command_line);
void add_isolines(CommandLine& command_line);
void add_log_map(CommandLine& command_line);
void add_flatten(CommandLine& command_line);
void add_gradient(CommandLine& command_line);
void add_render(CommandLine& command_line);
void add_compare(CommandLine& command_line);
void add_certify(CommandLine& command_line);
void add_voronoi(CommandLine& command_line);
void add_sample(CommandLine& command_line);
void add_measure(CommandLine& command_line);
void add_parcels(CommandLine& command_line);
void add_smooth(CommandLine& command_line);
void add_view(CommandLine& command_line);
void add_bench(CommandLine& command_line);
void add_convert(CommandLine& command_line);
void add_shape(CommandLine& command_line);
void add_terrain(CommandLine& command_line);
void add_isochrones(CommandLine& command_line);
void add_completion(CommandLine& command_line);
void add_manual(CommandLine& command_line);

}  // namespace brushfire::tool
