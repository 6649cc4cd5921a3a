// Numbers as they are typed: one way to read them, and one message where they are not what an option takes.
#pragma once

#include <brushfire/core/types.h>

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace brushfire::tool {

// A word that stands for a number.
using NumberWord = std::pair<std::string_view, double>;

// Which numbers an option takes.
struct Range {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();  // kInfinity: "inf" is taken too, and sets no limit
  bool whole = false;
  bool above_low = false;                  // low itself is not taken
  std::span<const NumberWord> words = {};  // taken too
};

inline constexpr Range kAnyNumber{};
inline constexpr Range kLength{.low = 0};                    // how long, or how large; finite
inline constexpr Range kLimit{.low = 0, .high = kInfinity};  // how far at most
inline constexpr Range kPositive{.low = 0, .above_low = true};
constexpr Range whole_from(double low, double high) { return {.low = low, .high = high, .whole = true}; }

// The whole text as a decimal number that a double holds, blanks around it aside: nullopt for anything else ("", "nan",
// "inf", "0x10", "1e400", "1e-400", "1.5mm"). Zero has no sign.
std::optional<double> decimal(std::string_view text);

// What `option` was given. Throws Error(InvalidArgument): "--radius takes a number >= 0 or inf, not 'nan'".
double number_in(const Range& range, std::string_view option, std::string_view text);

// "1,2.5,3": decimal() numbers between commas; nullopt where one of them is none, or there is none.
std::optional<std::vector<double>> decimals(std::string_view text, char between = ',');

// In quotes; at most forty characters, and of these no raw bytes: what was given may be a binary file.
std::string in_quotes(std::string_view text);

// Without the blanks at its ends.
std::string_view trimmed(std::string_view text);

}  // namespace brushfire::tool
