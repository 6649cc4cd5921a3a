// How the program talks: results to stdout, everything else to stderr, one object of JSON where that is asked for.
#pragma once

#include <brushfire/core/progress.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace brushfire::tool {

// Named values in order. In JSON a number that is not finite is null.
class Record {
 public:
  using Value = std::variant<std::nullptr_t, bool, std::int64_t, double, std::string, std::vector<std::string>,
                             std::vector<Record>>;

  Record& add(std::string key, Value value);
  const std::vector<std::pair<std::string, Value>>& entries() const { return entries_; }

  // {"schema": 1, "brushfire": version, entries...} on several lines.
  std::string json() const;

 private:
  std::vector<std::pair<std::string, Value>> entries_;
};

struct Talk {
  bool json = false;
  bool quiet = false;

  // A remark to the user, on stderr, unless quiet.
  void say(std::string_view line) const;

  // A bar on stderr that redraws itself, where stderr is a terminal and neither quiet nor json was asked for; empty
  // otherwise. `what` is the word in front of it.
  Progress progress(const char* what) const;
  // Wipes the bar.
  void end_progress() const;
};

// Writes results to stdout. Throws Error(FileNotWritable) where stdout is closed or full.
void write_stdout(std::string_view text);

// Six significant digits; "inf" for infinity: for people.
std::string readable(double value);
// As many digits as it takes to read the same double back; "inf" for infinity: for programs.
std::string exact(double value);
// "1 vertex", "2 vertices".
std::string counted(std::uint64_t n, const char* singular, const char* plural);
// "1.23 s", "45.6 ms".
std::string duration(double seconds);

}  // namespace brushfire::tool
