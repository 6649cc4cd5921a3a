// Numbers in sentences.
#pragma once

#include <string>

namespace brushfire {

// Six significant digits, as few as it takes: "1e-09", "0.25", "inf", "nan". For messages: a number that is wrong
// because it is small must not read 0.
std::string number_as_text(double value);

}  // namespace brushfire
