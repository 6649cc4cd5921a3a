// Numbers as they are typed.
#include "numbers.h"

#include <brushfire/core/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace brushfire::tool {
namespace {

std::string refusal(const Range& range, std::string_view text) {
  try {
    number_in(range, "--number", text);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::InvalidArgument);
    return e.what();
  }
  ADD_FAILURE() << text << " was taken";
  return {};
}

TEST(Numbers, ADecimalNumberIsReadWhole) {
  for (const auto& [text, value] :
       {std::pair{"1.5", 1.5}, {" 2 ", 2}, {"+3", 3}, {"-1e-3", -1e-3}, {".5", .5}, {"5.", 5}}) {
    EXPECT_EQ(decimal(text), value) << text;
  }
  for (const char* text :
       {"", " ", "nan", "inf", "-inf", "0x10", "1e400", "1e-400", "1.5mm", "1 2", "+-1", "++1", "1,5"}) {
    EXPECT_FALSE(decimal(text)) << text;
  }
}

TEST(Numbers, ZeroHasNoSign) {
  for (const char* text : {"-0", "-0.0", "-0e5", "+0"}) EXPECT_FALSE(std::signbit(decimal(text).value())) << text;
}

TEST(Numbers, WhatIsNotInTheRangeIsRefusedWithTheRange) {
  EXPECT_EQ(refusal(kLimit, "-1"), "--number takes a number >= 0 or inf, not '-1'");
  EXPECT_EQ(refusal(kLength, "inf"), "--number takes a number >= 0, not 'inf'");
  EXPECT_EQ(refusal(kPositive, "0"), "--number takes a number > 0, not '0'");
  EXPECT_EQ(refusal(kAnyNumber, "x"), "--number takes a number, not 'x'");
  EXPECT_EQ(refusal(whole_from(0, 4096), "1.5"), "--number takes a whole number from 0 to 4096, not '1.5'");
  EXPECT_EQ(refusal({.low = 0, .high = .1}, "0.2"), "--number takes a number from 0 to 0.1, not '0.2'");
  EXPECT_EQ(refusal(kAnyNumber, std::string("\x1b\0", 2)), "--number takes a number, not '\\x1b\\x00'");
}

TEST(Numbers, InfIsALimitThatIsNone) {
  EXPECT_EQ(number_in(kLimit, "--radius", "inf"), kInfinity);
  EXPECT_EQ(number_in(whole_from(0, 4096), "--threads", "1e3"), 1000);
}

TEST(Numbers, AListHasNumbersBetweenItsCommas) {
  EXPECT_EQ(decimals("1, 2.5,-3"), (std::vector<double>{1, 2.5, -3}));
  for (const char* text : {"", "1,", ",1", "1,,2", "1;2", "1,nan"}) EXPECT_FALSE(decimals(text)) << text;
  EXPECT_EQ(decimals("64x48", 'x'), (std::vector<double>{64, 48}));
}

}  // namespace
}  // namespace brushfire::tool
