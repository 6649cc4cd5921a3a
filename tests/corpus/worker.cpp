// Lanes of forked children; timers end what hangs.
#include "corpus/worker.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace brushfire::corpus {
namespace {

constexpr double kWallShare = 30;  // a process that waits uses no processor time
constexpr rlim_t kMemory = rlim_t{3} << 30;

struct Record {
  std::uint64_t block = 0, step = 0;
  Outcome outcome;
};
static_assert(sizeof(Record) <= 512, "written to a pipe at once");

// The step that a lane is at, seen by the lane and its child.
struct Place {
  std::atomic<std::uint64_t> block, step;
};

void die_with_parent() {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
}

void send(int pipe_end, const Record& record) {
  if (write(pipe_end, &record, sizeof record) != static_cast<ssize_t>(sizeof record)) _exit(1);
}

Outcome run_one(const Steps& steps, std::size_t block, std::size_t step) {
  limit_processor_time(steps.seconds(step));
  Outcome outcome;
  try {
    outcome = steps.run(block, step);
  } catch (const std::bad_alloc&) {
    outcome.ending = Ending::Refused;
    outcome.complain("not enough memory");
  } catch (const std::exception& e) {
    outcome.ending = Ending::Refused;
    outcome.complain(e.what());
  }
  return outcome;
}

[[noreturn]] void child(const Steps& steps, Place& place, unsigned lanes, int pipe_end) {
  die_with_parent();
#ifndef __SANITIZE_ADDRESS__
  const rlimit memory{kMemory, kMemory};
  setrlimit(RLIMIT_AS, &memory);
#endif
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  std::size_t step = place.step;
  for (std::size_t block = place.block; block < steps.blocks; block += lanes, step = 0) {
    for (; step < steps.block_size; ++step) {
      place.block = block;
      place.step = step;
      send(pipe_end, {block, step, run_one(steps, block, step)});
    }
  }
  _exit(0);
}

Outcome death(int status) {
  Outcome outcome;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const bool hung = signal == SIGPROF || signal == SIGALRM;
  outcome.ending = hung ? Ending::Hung : Ending::Crashed;
  outcome.complain(hung ? "has not ended in time" : signal ? strsignal(signal) : "the process ended");
  return outcome;
}

[[noreturn]] void lane(const Steps& steps, std::size_t first, int pipe_end) {
  die_with_parent();
  void* memory = mmap(nullptr, sizeof(Place), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) _exit(1);
  Place& place = *new (memory) Place{first, 0};
  for (;;) {
    const pid_t pid = fork();
    if (pid == 0) child(steps, place, steps.lanes, pipe_end);
    int status = 0;
    if (pid < 0 || waitpid(pid, &status, 0) != pid) _exit(1);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) _exit(0);
    send(pipe_end, {place.block, place.step, death(status)});
    place.step = steps.resume(place.step);
    if (place.step >= steps.block_size) {
      place.step = 0;
      place.block += steps.lanes;
      if (place.block >= steps.blocks) _exit(0);
    }
  }
}

}  // namespace

void Outcome::complain(std::string_view what) {
  if (text[0] != 0) return;
  const std::size_t length = std::min(what.size(), sizeof text - 1);
  std::memcpy(text, what.data(), length);
}

void limit_processor_time(double seconds) {
  const auto timer = [](double s) {
    itimerval value{};
    value.it_value.tv_sec = static_cast<time_t>(s);
    value.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (s - static_cast<double>(value.it_value.tv_sec)));
    return value;
  };
  const itimerval processor = timer(seconds), wall = timer(kWallShare * seconds);
  setitimer(ITIMER_PROF, &processor, nullptr);
  setitimer(ITIMER_REAL, &wall, nullptr);
}

void run_in_children(const Steps& steps) {
  std::fflush(nullptr);
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const unsigned lanes = static_cast<unsigned>(std::min<std::size_t>(steps.lanes, steps.blocks));
  Steps shared = steps;
  shared.lanes = lanes;
  std::vector<pid_t> pids;
  for (unsigned k = 0; k < lanes; ++k) {
    const pid_t pid = fork();
    if (pid < 0) throw std::runtime_error("no child process");
    if (pid == 0) {
      close(ends[0]);
      lane(shared, k, ends[1]);
    }
    pids.push_back(pid);
  }
  close(ends[1]);
  FILE* in = fdopen(ends[0], "rb");
  for (Record record; std::fread(&record, sizeof record, 1, in) == 1;) {
    steps.done(record.block, record.step, record.outcome);
  }
  std::fclose(in);
  bool all = true;
  for (const pid_t pid : pids) {
    int status = 0;
    all = waitpid(pid, &status, 0) == pid && WIFEXITED(status) && WEXITSTATUS(status) == 0 && all;
  }
  if (!all) throw std::runtime_error("a lane of the corpus broke off");
}

}  // namespace brushfire::corpus
