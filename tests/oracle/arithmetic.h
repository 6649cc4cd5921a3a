// Numbers with more digits than a double, for the oracle's eyes only: the headers of the tests know long double.
#pragma once

#include "oracle/complex.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#ifdef BRUSHFIRE_HAS_QUADMATH
#include <boost/multiprecision/float128.hpp>
#endif

#include <cmath>
#include <limits>

namespace brushfire::oracle {

// 113 bits: 34 digits.
#ifdef BRUSHFIRE_HAS_QUADMATH
using Quad = boost::multiprecision::float128;
#else
using Quad = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                           boost::multiprecision::et_off>;
#endif
// 237 bits: 71 digits.
using Octuple = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_oct::backend_type,
                                              boost::multiprecision::et_off>;

using std::abs;
using std::atan2;
using std::cos;
using std::sin;

template <class R>
const R& half_turn() {
  static const R value = atan2(R(0), R(-1));
  return value;
}

template <class R>
R far() {
  return std::numeric_limits<R>::infinity();
}

template <class R>
R epsilon() {
  return std::numeric_limits<R>::epsilon();
}

}  // namespace brushfire::oracle
