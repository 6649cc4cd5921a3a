// What every measurement here shares: the clock, the memory of the process, medians, raw arrays, errors.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/solvers/distance.h>

#include <span>
#include <string>
#include <vector>

#include "process.h"

namespace brushfire::benchmark {

// The clock and the median of `brushfire bench`.
using tool::cpu_seconds;
using tool::median;

// Resident memory in MiB: now, and the most there has been.
double memory_mib();
double peak_memory_mib();

// Raw little-endian arrays without a header: what numpy's tofile() and fromfile() write and read.
// Throws Error(FileNotReadable), Error(FileMalformed) where the size does not divide.
std::vector<Vec3> read_positions(const std::string& path);
std::vector<Face> read_faces(const std::string& path);
void write_positions(const std::string& path, std::span<const Vec3> positions);
void write_faces(const std::string& path, std::span<const Face> faces);
void write_doubles(const std::string& path, std::span<const double> values);

// Relative errors |d - t| / t over the vertices with 0 < t < inf.
struct RelativeError {
  double mean = 0, maximum = 0;
  Index worst = kNoIndex;      // the vertex of the maximum
  double shortest = 0;         // the most negative (d - t) / t: how far below the true distance it falls
  std::size_t not_finite = 0;  // vertices whose d is infinite or NaN where t is not: left out above
};
RelativeError relative_error(std::span<const double> distance, std::span<const double> truth);

// A method, followed by :float32, :float64 or a tolerance (windows:1e-3) where one is wanted.
DistanceOptions options_named(const std::string& name);

// What main() returns: what run() does, or 1 after an exception, which is told on stderr under the program's name.
int guarded(const char* program, int (*run)(int count, char** arguments), int count, char** arguments);

}  // namespace brushfire::benchmark
