// Text, JSON and the progress bar.
#include "talk.h"

#include <brushfire/core/error.h>
#include <brushfire/version.h>

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

namespace brushfire::tool {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Record& record);

struct ToJson {
  Json operator()(double value) const { return std::isfinite(value) ? Json(value) : Json(nullptr); }
  Json operator()(const std::vector<Record>& records) const {
    Json list = Json::array();
    for (const Record& r : records) list.push_back(to_json(r));
    return list;
  }
  Json operator()(const auto& value) const { return Json(value); }
};

Json to_json(const Record& record) {
  Json object = Json::object();
  for (const auto& [key, value] : record.entries()) object[key] = std::visit(ToJson{}, value);
  return object;
}

std::string printed(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

Record& Record::add(std::string key, Value value) {
  entries_.emplace_back(std::move(key), std::move(value));
  return *this;
}

std::string Record::json() const {
  Record headed;
  headed.add("schema", std::int64_t{1}).add("brushfire", std::string(kVersion));
  headed.entries_.insert(headed.entries_.end(), entries_.begin(), entries_.end());
  // A file name need not be UTF-8; JSON has to be.
  return to_json(headed).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void Talk::say(std::string_view line) const {
  if (!quiet) std::fprintf(stderr, "%.*s\n", static_cast<int>(line.size()), line.data());
}

Progress Talk::progress(const char* what) const {
  if (quiet || json || isatty(STDERR_FILENO) == 0) return {};
  return [what, last = -1](double share) mutable {
    const int percent = static_cast<int>(100 * share);
    if (percent == last) return;
    last = percent;
    constexpr int kWidth = 40;
    const std::string bar(static_cast<std::size_t>(kWidth * share), '#');
    std::fprintf(stderr, "\r%s [%-*s] %3d %%", what, kWidth, bar.c_str(), percent);
  };
}

void Talk::end_progress() const {
  if (!quiet && !json && isatty(STDERR_FILENO) != 0) std::fputs("\r\033[K", stderr);
}

void write_stdout(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Error(ErrorCode::FileNotWritable, std::string("standard output: ") + std::strerror(errno));
  }
}

std::string readable(double value) { return printed("%.6g", value); }

std::string exact(double value) {
  for (int digits = 15; digits < 17; ++digits) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) return text;
  }
  return printed("%.17g", value);
}

std::string counted(std::uint64_t n, const char* singular, const char* plural) {
  return std::to_string(n) + " " + (n == 1 ? singular : plural);
}

std::string duration(double seconds) {
  return seconds < 1 ? printed("%.3g ms", 1e3 * seconds) : printed("%.3g s", seconds);
}

}  // namespace brushfire::tool
