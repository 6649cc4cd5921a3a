// Meshes named on a command line, or found in folders.
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

namespace brushfire::benchmark {

// The file itself; those of a folder and of the folders in it, in order of their names.
inline std::vector<std::filesystem::path> files_of(const std::filesystem::path& argument) {
  namespace fs = std::filesystem;
  if (!fs::is_directory(argument)) return {argument};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(argument)) {
    const fs::path extension = entry.path().extension();
    for (const char* known : {".off", ".ply", ".stl", ".obj"}) {
      if (extension == known) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace brushfire::benchmark
