// Steps in child processes: one that hangs or crashes is one outcome, and the rest go on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

namespace brushfire::corpus {

enum class Ending : std::uint8_t {
  Done,
  Refused,  // an exception
  Hung,     // the limit of processor time (or thirty times that of time on the wall)
  Crashed,
};

// What a step comes to. Goes through a pipe as it is.
struct Outcome {
  Ending ending = Ending::Done;
  std::uint32_t compared = 0;
  std::uint32_t beyond = 0;   // farther from the truth than the promise allows
  std::uint32_t unbound = 0;  // farther from the truth than the bound that came with the value
  std::uint32_t lost = 0;     // paths that are not there, or are not paths
  std::uint32_t unsure = 0;   // where the oracle needed more digits than it had
  double worst = 0;           // relative
  double seconds = 0;         // of processor time, where somebody asks
  char text[320] = {};        // of the first thing that is wrong

  void complain(std::string_view what);  // the first one stays
  bool good() const { return ending == Ending::Done && beyond == 0 && unbound == 0 && lost == 0; }
};

struct Steps {
  std::size_t blocks = 0, block_size = 0;  // step k of block b is done by the process that did the steps before it
  unsigned lanes = 1;                      // processes at a time
  std::function<Outcome(std::size_t block, std::size_t step)> run;
  std::function<double(std::size_t step)> seconds;      // its limit of processor time
  std::function<std::size_t(std::size_t step)> resume;  // where to go on in a block where this step died
  std::function<void(std::size_t block, std::size_t step, const Outcome&)> done;  // called in this process
};

void run_in_children(const Steps& steps);

// Another limit for the step that is running.
void limit_processor_time(double seconds);

}  // namespace brushfire::corpus
