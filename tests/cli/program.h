// Runs the program `brushfire` as a user would, and catches what it says.
#pragma once

#include <string>
#include <vector>

namespace brushfire::test {

struct Ended {
  int code = -1;        // the exit code, or the number of the signal that ended it
  bool killed = false;  // by a signal
  std::string out, err;
};

// What the program finds when it starts.
struct Surroundings {
  std::string input{};        // its standard input
  bool interrupt = false;     // Ctrl-C after it has read the first half of its input
  std::string stdout_path{};  // where its standard output goes instead of Ended::out
  bool close_stdout = false;  // started without a standard output
  bool broken_pipe = false;   // standard output is a pipe that nobody reads any more
};

Ended run_program(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});

}  // namespace brushfire::test
