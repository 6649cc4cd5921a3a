// Memory, raw arrays and errors for the measurements.
#include "measure.h"

#include <brushfire/core/error.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>

namespace brushfire::benchmark {
namespace {

template <class T>
std::vector<T> read_array(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw Error(ErrorCode::FileNotReadable, path + ": cannot be read");
  const auto size = static_cast<std::size_t>(in.tellg());
  if (size % sizeof(T) != 0) {
    throw Error(ErrorCode::FileMalformed,
                path + ": " + std::to_string(size) + " bytes are no multiple of " + std::to_string(sizeof(T)));
  }
  std::vector<T> values(size / sizeof(T));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(size));
  return values;
}

template <class T>
void write_array(const std::string& path, std::span<const T> values) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
  out.flush();
  if (!out) throw Error(ErrorCode::FileNotWritable, path + ": cannot be written");
}

}  // namespace

double memory_mib() { return static_cast<double>(tool::resident_memory()) / (1 << 20); }
double peak_memory_mib() { return static_cast<double>(tool::peak_memory()) / (1 << 20); }

std::vector<Vec3> read_positions(const std::string& path) { return read_array<Vec3>(path); }
std::vector<Face> read_faces(const std::string& path) { return read_array<Face>(path); }
void write_positions(const std::string& path, std::span<const Vec3> positions) { write_array(path, positions); }
void write_faces(const std::string& path, std::span<const Face> faces) { write_array(path, faces); }
void write_doubles(const std::string& path, std::span<const double> values) { write_array(path, values); }

RelativeError relative_error(std::span<const double> distance, std::span<const double> truth) {
  RelativeError e;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (!(truth[v] > 0) || !std::isfinite(truth[v])) continue;
    if (!std::isfinite(distance[v])) {
      ++e.not_finite;
      continue;
    }
    const double relative = (distance[v] - truth[v]) / truth[v];
    sum += std::abs(relative);
    ++count;
    e.shortest = std::min(e.shortest, relative);
    if (std::abs(relative) > e.maximum) {
      e.maximum = std::abs(relative);
      e.worst = static_cast<Index>(v);
    }
  }
  e.mean = count == 0 ? 0 : sum / static_cast<double>(count);
  return e;
}

DistanceOptions options_named(const std::string& name) {
  DistanceOptions options;
  const std::size_t colon = name.find(':');
  options.method = method_named(name.substr(0, colon));
  if (colon == std::string::npos) return options;
  const std::string option = name.substr(colon + 1);
  if (option == "float64" || option == "float32") {
    options.precision = option == "float32" ? Precision::Float : Precision::Double;
  } else {
    options.tolerance = std::stod(option);
  }
  return options;
}

int guarded(const char* program, int (*run)(int count, char** arguments), int count, char** arguments) {
  try {
    return run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return 1;
  }
}

}  // namespace brushfire::benchmark
