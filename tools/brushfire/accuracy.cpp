// The four options, and what they mean together.
#include "accuracy.h"

#include <brushfire/core/error.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace brushfire::tool {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 4> kLevels{
    {{"draft", 1e-2}, {"standard", 1e-3}, {"fine", 1e-5}, {"exact", 0}}};
constexpr std::array<std::pair<std::string_view, Bound>, 3> kBounds{
    {{"estimate", Bound::Estimate}, {"upper", Bound::Upper}, {"lower", Bound::Lower}}};

template <class Table>
std::vector<std::string> names(const Table& table) {
  std::vector<std::string> list;
  for (const auto& entry : table) list.emplace_back(entry.first);
  return list;
}

// The parser has let no other names through.
template <class Table>
auto value_named(const Table& table, std::string_view name) {
  return std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.first == name; })->second;
}

}  // namespace

std::string name_of(Bound bound) {
  return std::string(
      std::find_if(kBounds.begin(), kBounds.end(), [&](const auto& entry) { return entry.second == bound; })->first);
}

void add_accuracy(Verb& verb, Accuracy& accuracy) {
  std::vector<std::string> methods;
  for (const Method m : all_methods()) methods.emplace_back(brushfire::name_of(m));
  const std::string how =
      "How to compute (if not given: " + std::string(brushfire::name_of(DistanceOptions{}.method)) + ")";
  verb.choice("-m,--method", accuracy.method, methods, how.c_str());
  verb.option("--tolerance", accuracy.tolerance, "T",
              "Relative error that windows keeps at every vertex, 0 to 0.1 (1e-3)");
  verb.choice("--accuracy", accuracy.level, names(kLevels), "The same in words, 0.01, 0.001, 0.00001 and 0");
  verb.choice("--bound", accuracy.bound, names(kBounds), "Never shorter (upper), never longer (lower) than the truth");
}

void apply(const Accuracy& accuracy, DistanceOptions& options) {
  const char* const asked = accuracy.tolerance        ? "--tolerance"
                            : !accuracy.level.empty() ? "--accuracy"
                            : !accuracy.bound.empty() ? "--bound"
                                                      : nullptr;
  if (!accuracy.method.empty()) {
    options.method = method_named(accuracy.method);
  } else if (asked) {
    options.method = Method::Windows;
  }
  if (asked && options.method != Method::Windows) {
    throw Error(ErrorCode::InvalidArgument, std::string(asked) + ": " +
                                                std::string(brushfire::name_of(options.method)) +
                                                " has no tolerance to set; --method windows has");
  }
  if (accuracy.tolerance && !accuracy.level.empty()) {
    throw Error(ErrorCode::InvalidArgument, "--tolerance and --accuracy say the same: give one of them");
  }
  if (accuracy.tolerance && !(*accuracy.tolerance >= 0 && *accuracy.tolerance <= kMaxTolerance)) {
    throw Error(ErrorCode::InvalidArgument,
                "--tolerance " + exact(*accuracy.tolerance) + " is not in 0 to " + exact(kMaxTolerance));
  }
  if (accuracy.tolerance) options.tolerance = *accuracy.tolerance;
  if (!accuracy.level.empty()) options.tolerance = value_named(kLevels, accuracy.level);
  if (!accuracy.bound.empty()) options.bound = value_named(kBounds, accuracy.bound);
}

std::optional<double> promised_error(const DistanceOptions& options) {
  if (options.method == Method::Windows) return options.tolerance;
  if (options.method == Method::Exact) return 0;
  return std::nullopt;
}

}  // namespace brushfire::tool
