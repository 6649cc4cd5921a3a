// Meshes named on a command line, or found in folders.
#pragma once

#include <brushfire/core/types.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
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

// [--limit VERTICES] FILE | FOLDER ...
struct MeshArguments {
  Index limit;
  std::vector<std::filesystem::path> files;

  MeshArguments(int count, char** arguments, Index most) : limit(most) {
    for (int i = 1; i < count; ++i) {
      if (std::string(arguments[i]) == "--limit" && i + 1 < count) {
        limit = static_cast<Index>(std::stoul(arguments[++i]));
        continue;
      }
      for (std::filesystem::path& file : files_of(arguments[i])) files.push_back(std::move(file));
    }
  }
};

}  // namespace brushfire::benchmark
