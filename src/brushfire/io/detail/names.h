// What a file's name says about its format.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace brushfire::detail {

// `format` where it is given; otherwise the extension of `path`, lower case and without its dot ("" for "-").
inline std::string extension_or(const std::string& format, const std::string& path) {
  if (!format.empty() || path == "-") return format;
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension;
}

}  // namespace brushfire::detail
