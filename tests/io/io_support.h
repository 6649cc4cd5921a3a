// Helpers of the io tests: texts as files, messages of errors, a directory that goes away.
#pragma once

#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace brushfire::test {

inline std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

inline LoadedMesh read_text(std::string_view text, const std::string& name) { return read_mesh(bytes_of(text), name); }

// The numbers as they stand in memory, or the other way round.
template <class T>
std::string packed(std::initializer_list<T> values, bool big_endian = false) {
  std::string out;
  for (const T v : values) {
    char raw[sizeof(T)];
    std::memcpy(raw, &v, sizeof(T));
    if (big_endian) std::reverse(raw, raw + sizeof(T));
    out.append(raw, sizeof(T));
  }
  return out;
}

// "code: message" of the Error that `run` throws; "" where it throws none.
template <class Run>
std::string error_of(Run&& run) {
  try {
    run();
  } catch (const Error& e) {
    return std::string(name_of(e.code())) + ": " + e.what();
  }
  return "";
}

inline std::string mesh_error(std::string_view text, const std::string& name) {
  return error_of([&] { read_text(text, name); });
}

// An empty directory for one test.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    static std::atomic<int> counter{0};
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string name =
        std::string("brushfire-") + info->test_suite_name() + "-" + info->name() + "-" + std::to_string(counter++);
    for (char& c : name) c = c == '/' ? '-' : c;
    path_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline void write_file(const std::string& path, std::string_view content) {
  std::ofstream(path, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

inline std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<Vec3> positions_of(const Mesh& mesh) { return {mesh.positions().begin(), mesh.positions().end()}; }
inline std::vector<Face> faces_of(const Mesh& mesh) { return {mesh.faces().begin(), mesh.faces().end()}; }

}  // namespace brushfire::test
