// How long a matrix still takes: in the bar of a terminal, or in lines where a log is kept.
#pragma once

#include "talk.h"

#include <cstdint>

namespace brushfire::tool {

// On a terminal a bar with the time that is left; elsewhere a line on stderr after ten seconds and then every minute:
// "matrix: 12 % (4915 of 40962 rows), 300 rows/s, 2 min left". Nothing where quiet or JSON was asked for. `found`: rows
// that were there already; the rate is of what is computed now.
Progress job_progress(const Talk& talk, std::uint64_t rows, std::uint64_t found);

// The lines of a log: the first `first` seconds after this call, then one every `between`.
Progress log_lines(std::uint64_t rows, std::uint64_t found, double first, double between);

// "45 s", "3 min", "2 h 10 min": rounded, for people.
std::string time_left(double seconds);

}  // namespace brushfire::tool
