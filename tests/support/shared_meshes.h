// The meshes and exact distances of the shared data directory, for tests that use them.
#pragma once

#include <brushfire/io/npy.h>
#include <brushfire/io/read_mesh.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace brushfire::test {

inline std::filesystem::path shared_directory() { return BRUSHFIRE_SHARED_DIR; }

inline bool has_shared_data() { return std::filesystem::is_directory(shared_directory() / "meshes"); }

// First line of a test (in the test's own body) that needs the shared data directory.
#define BRUSHFIRE_NEEDS_SHARED_DATA() \
  if (!::brushfire::test::has_shared_data()) GTEST_SKIP() << "no shared data directory at " << BRUSHFIRE_SHARED_DIR

// Every mesh there is as PLY, by name.
inline const std::vector<std::string>& shared_mesh_names() {
  static const std::vector<std::string> names{
      "3holes",         "armadillo", "beetle",        "camelhead",      "cheburashka", "cow",
      "degen-sliver",   "fandisk",   "fertility",     "fertility-x10",  "grid100",     "grid100-shear",
      "homer",          "horse",     "mountain",      "nm-bowtie",      "nm-fin",      "rocker-arm",
      "rocker-arm-x10", "square604", "square604-x10", "stanford-bunny", "teapot",      "two-comp"};
  return names;
}

// A mesh with known exact distances from vertex `source`.
struct SharedTruth {
  std::string name;
  Index source;
};

inline const std::vector<SharedTruth>& shared_truths() {
  static const std::vector<SharedTruth> truths{
      {"armadillo", 0},      {"armadillo", 21621},     {"fandisk", 0},        {"fandisk", 3237},
      {"fertility", 0},      {"fertility", 2247},      {"fertility-x10", 0},  {"fertility-x10", 2247},
      {"grid100", 0},        {"grid100", 5000},        {"grid100-shear", 0},  {"grid100-shear", 5000},
      {"horse", 0},          {"horse", 24242},         {"rocker-arm", 0},     {"rocker-arm", 5022},
      {"rocker-arm-x10", 0}, {"rocker-arm-x10", 5022}, {"square604", 0},      {"square604", 302},
      {"square604-x10", 0},  {"square604-x10", 302},   {"stanford-bunny", 0}, {"stanford-bunny", 17417}};
  return truths;
}

inline Mesh shared_mesh(const std::string& name) {
  return read_mesh((shared_directory() / "meshes" / (name + ".ply")).string()).mesh;
}

// Exact distances of all vertices from `source`; infinity where unreachable.
inline std::vector<double> shared_truth(const std::string& name, Index source) {
  return read_npy((shared_directory() / "truth" / (name + "." + std::to_string(source) + ".npy")).string()).values;
}

}  // namespace brushfire::test
