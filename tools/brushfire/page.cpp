// The viewer's page, found beside the program, filled with meshes and shown.
#include "page.h"

#include <brushfire/core/detail/base64.h>
#include <brushfire/core/error.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <vector>

#if defined(_WIN32)
#include <windows.h>

#include <shellapi.h>
#elif defined(__APPLE__)
#include <mach-o/dyld.h>
#endif
#if !defined(_WIN32)
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

extern char** environ;  // NOLINT: POSIX's own name
#endif

namespace brushfire::tool {
namespace {

// Where the page's source has it: web/index.html.
constexpr std::string_view kPlace = "<!-- brushfire view: the mesh -->";

std::filesystem::path program_path() {
#if defined(_WIN32)
  std::array<wchar_t, 32768> path{};
  const DWORD length = GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size()));
  return std::filesystem::path(path.data(), path.data() + length);
#elif defined(__APPLE__)
  std::uint32_t size = 0;
  _NSGetExecutablePath(nullptr, &size);
  std::string path(size, '\0');
  if (_NSGetExecutablePath(path.data(), &size) != 0) return {};
  return path.c_str();
#else
  std::error_code none;
  return std::filesystem::read_symlink("/proc/self/exe", none);
#endif
}

std::vector<std::filesystem::path> places_of_page() {
  if (const char* named = std::getenv("BRUSHFIRE_VIEWER"); named != nullptr && *named != '\0') return {named};
  const std::filesystem::path folder = program_path().parent_path();
  return {folder.parent_path() / "share" / "brushfire" / "viewer.html", folder / "viewer.html"};
}

std::optional<std::string> contents_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace

std::string empty_page() {
  const std::vector<std::filesystem::path> places = places_of_page();
  for (const std::filesystem::path& path : places) {
    std::optional<std::string> page = contents_of(path);
    if (!page) continue;
    if (page->find(kPlace) != std::string::npos) return std::move(*page);
    throw Error(ErrorCode::FileNotReadable, path.string() + " is not the viewer's page: it has no place for a mesh");
  }
  throw Error(ErrorCode::FileNotReadable, places.front().string() +
                                              ": the viewer's page is not installed; './run web' in the sources builds "
                                              "it, and BRUSHFIRE_VIEWER names one that lies elsewhere");
}

std::string page_with(std::string page, const PageContent& content) {
  // "</script>" in a name would end the element; in JSON a letter may be written by its number.
  std::string state;
  for (const char c : content.state) c == '<' ? state += "\\u003c" : state += c;
  std::string held = "<script type=\"application/json\" id=\"held-state\">" + state + "</script>\n";
  held += "<script type=\"application/octet-stream\" id=\"held-mesh\">" + detail::encode_base64(content.mesh) +
          "</script>\n";
  page.replace(page.find(kPlace), kPlace.size(), held);
  return page;
}

#if defined(_WIN32)

bool open_in_browser(const std::string& path) {
  const std::filesystem::path file(path);
  const HINSTANCE opened = ShellExecuteW(nullptr, L"open", file.c_str(), nullptr, nullptr, SW_SHOWNORMAL);
  return reinterpret_cast<std::intptr_t>(opened) > 32;  // as its documentation says
}

#else

bool open_in_browser(const std::string& path) {
#if defined(__APPLE__)
  std::string program = "open";
#else
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return false;
  std::string program = "xdg-open";
#endif
  std::string file = path;
  const std::array<char*, 3> words{program.data(), file.data(), nullptr};
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  for (const int stream : {1, 2}) posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const bool started = posix_spawnp(&child, program.c_str(), &silent, nullptr, words.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&silent);
  int status = 0;
  return started && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

#endif

}  // namespace brushfire::tool
