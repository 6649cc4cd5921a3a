// Rates and the time that is left.
#include "job_progress.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>

namespace brushfire::tool {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Rate {
  std::uint64_t rows = 0, found = 0;
  Clock::time_point start = Clock::now();

  std::uint64_t done(double share) const {
    return static_cast<std::uint64_t>(std::llround(share * static_cast<double>(rows)));
  }
  // Rows a second since this process began; 0: not known yet.
  double now(double share) const {
    const double computed = static_cast<double>(done(share)) - static_cast<double>(found), time = seconds_since(start);
    return computed > 0 && time > 0 ? computed / time : 0;
  }
  std::string left(double share) const {
    const double rate = now(share);
    return rate > 0 ? time_left(static_cast<double>(rows - done(share)) / rate) + " left" : "";
  }
};

Progress bar(const Rate& rate) {
  return [rate, shown = Clock::time_point()](double share) mutable {
    constexpr double kRedrawn = 0.2;  // s
    if (seconds_since(shown) < kRedrawn) return;
    shown = Clock::now();
    constexpr int kWidth = 40;
    const std::string filled(static_cast<std::size_t>(kWidth * share), '#');
    std::fprintf(stderr, "\rmatrix [%-*s] %3d %%  %-20s", kWidth, filled.c_str(), static_cast<int>(100 * share),
                 rate.left(share).c_str());
  };
}

Progress lines(const Rate& rate, double first, double between) {
  return [rate, next = first, between](double share) mutable {
    if (seconds_since(rate.start) < next) return;
    next = seconds_since(rate.start) + between;
    std::fprintf(stderr, "matrix: %d %% (%llu of %llu rows), %.3g rows/s, %s\n", static_cast<int>(100 * share),
                 static_cast<unsigned long long>(rate.done(share)), static_cast<unsigned long long>(rate.rows),
                 rate.now(share), rate.left(share).c_str());
  };
}

}  // namespace

std::string time_left(double seconds) {
  constexpr double kMinute = 60, kHour = 3600;
  if (seconds < 1.5 * kMinute) return std::to_string(std::llround(seconds)) + " s";
  if (seconds < 1.5 * kHour) return std::to_string(std::llround(seconds / kMinute)) + " min";
  const long long minutes = std::llround(seconds / kMinute);
  return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

Progress log_lines(std::uint64_t rows, std::uint64_t found, double first, double between) {
  return lines({rows, found}, first, between);
}

Progress job_progress(const Talk& talk, std::uint64_t rows, std::uint64_t found) {
  if (talk.quiet || talk.json) return {};
  constexpr double kFirst = 10, kBetween = 60;  // s
  return isatty(STDERR_FILENO) != 0 ? bar({rows, found}) : log_lines(rows, found, kFirst, kBetween);
}

}  // namespace brushfire::tool
