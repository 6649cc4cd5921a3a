// fork, exec, and files for the three streams.
#include "program.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

namespace brushfire::test {
namespace {

// A file without a name, gone when it is closed.
class ScratchFile {
 public:
  ScratchFile() : file_(std::tmpfile(), &std::fclose) {
    if (!file_) throw std::system_error(errno, std::generic_category(), "no temporary file");
  }

  int descriptor() const { return fileno(file_.get()); }
  // From its beginning on, wherever the program that has the descriptor is writing.
  std::string content() const {
    std::string all;
    std::array<char, 4096> some;
    for (ssize_t got; (got = pread(descriptor(), some.data(), some.size(), static_cast<off_t>(all.size()))) > 0;) {
      all.append(some.data(), static_cast<std::size_t>(got));
    }
    return all;
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

void send(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = write(descriptor, text.data(), text.size());
    if (sent < 0) return;  // the reader is gone
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
}

bool runs(pid_t child) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
}

// Sends the first half, waits until it has been taken (so that the program is past its first steps), interrupts.
void send_half_and_interrupt(int descriptor, std::string_view& text, pid_t child) {
  send(descriptor, text.substr(0, text.size() / 2));
  text.remove_prefix(text.size() / 2);
  int waiting = 1;
  while (waiting > 0 && runs(child)) {
    usleep(1000);
    ioctl(descriptor, FIONREAD, &waiting);
  }
  kill(child, SIGINT);
}

}  // namespace

Ended run_program(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  std::signal(SIGPIPE, SIG_IGN);
  ScratchFile out, err;
  std::array<int, 2> in{};
  if (pipe2(in.data(), O_CLOEXEC) != 0) return {};
  std::vector<std::string> words{BRUSHFIRE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGPIPE, SIG_DFL);
    dup2(in[0], STDIN_FILENO);
    dup2(err.descriptor(), STDERR_FILENO);
    if (surroundings.close_stdout) {
      close(STDOUT_FILENO);
    } else if (surroundings.broken_pipe) {
      std::array<int, 2> broken{};
      if (pipe(broken.data()) != 0) _exit(126);
      close(broken[0]);
      dup2(broken[1], STDOUT_FILENO);
    } else if (!surroundings.stdout_path.empty()) {
      dup2(open(surroundings.stdout_path.c_str(), O_WRONLY), STDOUT_FILENO);
    } else {
      dup2(out.descriptor(), STDOUT_FILENO);
    }
    execv(argv[0], argv.data());
    _exit(127);
  }
  close(in[0]);
  std::string_view input = surroundings.input;
  if (surroundings.interrupt) send_half_and_interrupt(in[1], input, child);
  send(in[1], input);
  close(in[1]);
  int status = 0;
  waitpid(child, &status, 0);
  const bool killed = WIFSIGNALED(status);
  return {killed ? WTERMSIG(status) : WEXITSTATUS(status), killed, out.content(), err.content()};
}

}  // namespace brushfire::test
