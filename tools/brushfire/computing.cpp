// From what was typed to DistanceOptions.
#include "computing.h"

#include "interrupt.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace brushfire::tool {
namespace {

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

Precision precision_named(std::string_view name) { return name == "float64" ? Precision::Double : Precision::Float; }

// What holds for all methods.
DistanceOptions common(const SharedArguments& a) {
  DistanceOptions options;
  if (a.tolerance) options.tolerance = *a.tolerance;
  if (!a.bound.empty()) options.bound = value_named(kBounds, a.bound);
  options.precision = precision_named(a.precision);
  options.max_distance = a.radius.value_or(kInfinity);
  options.threads = static_cast<unsigned>(a.threads.value_or(0));
  options.cancel = &cancel_token();
  return options;
}

constexpr std::array<std::pair<std::string_view, HeatBoundary>, 3> kBoundaries{
    {{"neumann", HeatBoundary::Neumann}, {"dirichlet", HeatBoundary::Dirichlet}, {"averaged", HeatBoundary::Averaged}}};
constexpr Range kTimeFactors{.low = 0, .high = 1e6, .above_low = true};

// "4", "averaged", "4,averaged".
void set_heat(const std::string& text, HeatOptions& heat) {
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, comma - begin);
    const auto named = [&](const auto& entry) { return entry.first == word; };
    const auto found = std::find_if(kBoundaries.begin(), kBoundaries.end(), named);
    if (found != kBoundaries.end()) {
      heat.boundary = found->second;
    } else {
      heat.time_factor = number_in(kTimeFactors, "heat: a time factor (or neumann, dirichlet, averaged)", word);
    }
    begin = comma + 1;
  }
}

// "windows:1e-4", "novotni-klein:float64", "heat:4", "exact".
void set_method(const std::string& text, DistanceOptions& options) {
  const std::size_t colon = text.find(':');
  options.method = method_named(text.substr(0, colon));
  if (colon == std::string::npos) return;
  const std::string detail = text.substr(colon + 1);
  const bool marches = has_precision(options.method);
  if (marches && (detail == "float32" || detail == "float64")) {
    options.precision = precision_named(detail);
  } else if (options.method == Method::Heat) {
    set_heat(detail, options.heat);
  } else if (options.method == Method::Windows) {
    options.tolerance = number_in(kTolerances, in_quotes(text) + ": a tolerance", detail);
  } else {
    refuse(in_quotes(text) + ": " +
           (marches ? "after the colon goes float32 or float64" : "this method has nothing to choose"));
  }
}

}  // namespace

std::vector<std::string> bound_names() { return names(kBounds); }

std::string name_of(Bound bound) {
  return std::string(
      std::find_if(kBounds.begin(), kBounds.end(), [&](const auto& entry) { return entry.second == bound; })->first);
}

bool has_precision(Method method) {
  return method == Method::CarriedSource || method == Method::NovotniKlein || method == Method::KimmelSethian;
}

std::vector<DistanceOptions> computations(const SharedArguments& a, const std::vector<Method>& otherwise) {
  const DistanceOptions all = common(a);
  std::vector<DistanceOptions> list;
  for (const std::string& text : a.methods) set_method(text, list.emplace_back(all));
  if (list.empty()) {
    for (const Method m : otherwise) list.emplace_back(all).method = m;
  }
  const char* const asked = given(a, {Shared::Tolerance, Shared::Bound});
  const auto keeps = [](const DistanceOptions& o) { return o.method == Method::Windows; };
  if (asked && std::none_of(list.begin(), list.end(), keeps)) {
    refuse(std::string(asked) + ": " + std::string(brushfire::name_of(list.front().method)) +
           " has no tolerance to set; --method windows has");
  }
  return list;
}

DistanceOptions computation(const SharedArguments& a, Method otherwise) {
  if (a.methods.size() > 1) refuse("--method: one at a time; brushfire render and bench compare several");
  const bool asked = given(a, {Shared::Tolerance, Shared::Bound}) != nullptr;
  return computations(a, {asked ? Method::Windows : otherwise}).front();
}

void check_signed(const SharedArguments& a) {
  if (given(a, kWeights)) refuse("--signed: not with weights: costs have no sides");
  if (const char* accuracy = given(a, kAccuracy)) refuse("--signed is exact: not with " + std::string(accuracy));
  for (const std::string& method : a.methods) {
    if (method != "exact") refuse("--signed is exact: not with --method " + method);
  }
}

std::optional<double> promised_error(const DistanceOptions& options) {
  if (options.method == Method::Windows) return options.tolerance;
  if (options.method == Method::Exact) return 0;
  return std::nullopt;
}

Record::Value tolerance_of(const DistanceOptions& options) {
  const std::optional<double> promised = promised_error(options);
  return promised ? Record::Value(*promised) : Record::Value(nullptr);
}

Record::Value precision_of(const DistanceOptions& options) {
  if (!has_precision(options.method)) return nullptr;
  return std::string(options.precision == Precision::Float ? "float32" : "float64");
}

}  // namespace brushfire::tool
