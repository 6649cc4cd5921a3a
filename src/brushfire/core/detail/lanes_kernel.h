// Lanes and masks out of registers: one, or two halves.
namespace brushfire::lanes::BRUSHFIRE_TARGET {

// Whether N numbers of type T fit into a register.
template <class T, int N>
inline constexpr bool kFits = N * sizeof(T) <= BRUSHFIRE_REGISTER;

template <class T, int N, bool kOne = kFits<T, N>>
struct Lanes;

// What masks are made of: all bits of a lane, or none; or a bit for each.
template <std::size_t kBytes, int N>
struct FactsOf {
  using Type = Lanes<MaskNumber<kBytes>, N>;
};
#ifdef BRUSHFIRE_TARGET_IS_AVX512
struct BitFacts;
template <>
struct FactsOf<4, 16> {
  using Type = BitFacts;
};
#endif

// For each of N numbers of so many bytes, whether something is true of it.
template <std::size_t kBytes, int N>
struct Mask {
  using Facts = typename FactsOf<kBytes, N>::Type;
  Facts v;

  BRUSHFIRE_INLINE friend Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
  BRUSHFIRE_INLINE friend Mask operator|(Mask a, Mask b) { return {a.v | b.v}; }
  BRUSHFIRE_INLINE friend Mask operator^(Mask a, Mask b) { return {a.v ^ b.v}; }
  BRUSHFIRE_INLINE friend Mask operator~(Mask a) { return {~a.v}; }
};

// N numbers: a register ...
template <class T, int N>
struct Lanes<T, N, true> {
  using Number = T;
  using M = Mask<sizeof(T), N>;
  static constexpr int kCount = N;
  Register<T, N> v;

  Lanes() = default;
  BRUSHFIRE_INLINE Lanes(T x) : v(x - Register<T, N>{}) {}  // NOLINT(google-explicit-constructor): a number is lanes
  BRUSHFIRE_INLINE explicit Lanes(Register<T, N> r) : v(r) {}

  BRUSHFIRE_INLINE friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.v + b.v); }
  BRUSHFIRE_INLINE friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.v - b.v); }
  BRUSHFIRE_INLINE friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.v * b.v); }
  BRUSHFIRE_INLINE friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.v / b.v); }
  BRUSHFIRE_INLINE friend Lanes operator-(Lanes a) { return Lanes(-a.v); }
  BRUSHFIRE_INLINE friend Lanes operator~(Lanes a) { return Lanes(~a.v); }
  BRUSHFIRE_INLINE friend Lanes operator&(Lanes a, Lanes b) { return Lanes(a.v & b.v); }
  BRUSHFIRE_INLINE friend Lanes operator|(Lanes a, Lanes b) { return Lanes(a.v | b.v); }
  BRUSHFIRE_INLINE friend Lanes operator^(Lanes a, Lanes b) { return Lanes(a.v ^ b.v); }
  BRUSHFIRE_INLINE friend Lanes operator<<(Lanes a, int by) { return Lanes(a.v << by); }
  BRUSHFIRE_INLINE friend Lanes operator>>(Lanes a, int by) { return Lanes(a.v >> by); }
  BRUSHFIRE_INLINE friend M operator<(Lanes a, Lanes b) { return facts(less_of(a.v, b.v)); }
  BRUSHFIRE_INLINE friend M operator<=(Lanes a, Lanes b) { return facts(not_greater_of(a.v, b.v)); }
  BRUSHFIRE_INLINE friend M operator==(Lanes a, Lanes b) { return facts(equal_of(a.v, b.v)); }
  BRUSHFIRE_INLINE friend M share_bits(Lanes a, Lanes b) { return facts(share_bits_of(a.v, b.v)); }

 private:
  template <class R>
  BRUSHFIRE_INLINE static M facts(R compared) {
    return {typename M::Facts(compared)};
  }
};

// ... or two halves.
template <class T, int N>
struct Lanes<T, N, false> {
  using Number = T;
  using M = Mask<sizeof(T), N>;
  using Half = Lanes<T, N / 2>;
  static constexpr int kCount = N;
  Half low, high;

  Lanes() = default;
  BRUSHFIRE_INLINE Lanes(T x) : low(x), high(x) {}  // NOLINT(google-explicit-constructor): as above
  BRUSHFIRE_INLINE Lanes(Half l, Half h) : low(l), high(h) {}

  BRUSHFIRE_INLINE friend Lanes operator+(Lanes a, Lanes b) { return {a.low + b.low, a.high + b.high}; }
  BRUSHFIRE_INLINE friend Lanes operator-(Lanes a, Lanes b) { return {a.low - b.low, a.high - b.high}; }
  BRUSHFIRE_INLINE friend Lanes operator*(Lanes a, Lanes b) { return {a.low * b.low, a.high * b.high}; }
  BRUSHFIRE_INLINE friend Lanes operator/(Lanes a, Lanes b) { return {a.low / b.low, a.high / b.high}; }
  BRUSHFIRE_INLINE friend Lanes operator-(Lanes a) { return {-a.low, -a.high}; }
  BRUSHFIRE_INLINE friend Lanes operator~(Lanes a) { return {~a.low, ~a.high}; }
  BRUSHFIRE_INLINE friend Lanes operator&(Lanes a, Lanes b) { return {a.low & b.low, a.high & b.high}; }
  BRUSHFIRE_INLINE friend Lanes operator|(Lanes a, Lanes b) { return {a.low | b.low, a.high | b.high}; }
  BRUSHFIRE_INLINE friend Lanes operator^(Lanes a, Lanes b) { return {a.low ^ b.low, a.high ^ b.high}; }
  BRUSHFIRE_INLINE friend Lanes operator<<(Lanes a, int by) { return {a.low << by, a.high << by}; }
  BRUSHFIRE_INLINE friend Lanes operator>>(Lanes a, int by) { return {a.low >> by, a.high >> by}; }
  BRUSHFIRE_INLINE friend M operator<(Lanes a, Lanes b) { return both(a.low < b.low, a.high < b.high); }
  BRUSHFIRE_INLINE friend M operator<=(Lanes a, Lanes b) { return both(a.low <= b.low, a.high <= b.high); }
  BRUSHFIRE_INLINE friend M operator==(Lanes a, Lanes b) { return both(a.low == b.low, a.high == b.high); }
  BRUSHFIRE_INLINE friend M share_bits(Lanes a, Lanes b) {
    return both(share_bits(a.low, b.low), share_bits(a.high, b.high));
  }

 private:
  BRUSHFIRE_INLINE static M both(typename Half::M l, typename Half::M h) { return {{l.v, h.v}}; }
};

#ifdef BRUSHFIRE_TARGET_IS_AVX512
struct BitFacts {
  __mmask16 v;

  BitFacts() = default;
  BRUSHFIRE_INLINE explicit BitFacts(__mmask16 bits) : v(bits) {}
  BRUSHFIRE_INLINE BitFacts(Lanes<std::int32_t, 16> all_bits_or_none)  // NOLINT(google-explicit-constructor)
      : v(mask_of(all_bits_or_none.v)) {}

  BRUSHFIRE_INLINE friend BitFacts operator&(BitFacts a, BitFacts b) { return BitFacts(_kand_mask16(a.v, b.v)); }
  BRUSHFIRE_INLINE friend BitFacts operator|(BitFacts a, BitFacts b) { return BitFacts(_kor_mask16(a.v, b.v)); }
  BRUSHFIRE_INLINE friend BitFacts operator^(BitFacts a, BitFacts b) { return BitFacts(_kxor_mask16(a.v, b.v)); }
  BRUSHFIRE_INLINE friend BitFacts operator~(BitFacts a) { return BitFacts(_knot_mask16(a.v)); }
};
#endif

// The type of one of them, and what comparisons give: of lanes, or of single numbers.
template <class V>
struct TraitsOf {
  using Number = typename V::Number;
  using M = typename V::M;
};
template <>
struct TraitsOf<float> {
  using Number = float;
  using M = bool;
};
template <>
struct TraitsOf<double> {
  using Number = double;
  using M = bool;
};
template <class V>
using NumberIn = typename TraitsOf<V>::Number;
template <class V>
using MaskFor = typename TraitsOf<V>::M;
template <class T>
using IfNumber = std::enable_if_t<std::is_arithmetic_v<T>, T>;

template <class T, int N>
BRUSHFIRE_INLINE Lanes<T, N> select(Mask<sizeof(T), N> mask, Lanes<T, N> yes, Lanes<T, N> no) {
  if constexpr (kFits<T, N>) {
    return Lanes<T, N>(selected(mask.v.v, yes.v, no.v));
  } else {
    return {select(Mask<sizeof(T), N / 2>{mask.v.low}, yes.low, no.low),
            select(Mask<sizeof(T), N / 2>{mask.v.high}, yes.high, no.high)};
  }
}
// a < b ? a : b, lane by lane.
template <class T, int N>
BRUSHFIRE_INLINE Lanes<T, N> lesser(Lanes<T, N> a, Lanes<T, N> b) {
  if constexpr (kFits<T, N>) {
    return Lanes<T, N>(lesser_of(a.v, b.v));
  } else {
    return {lesser(a.low, b.low), lesser(a.high, b.high)};
  }
}
// a > b ? a : b
template <class T, int N>
BRUSHFIRE_INLINE Lanes<T, N> greater(Lanes<T, N> a, Lanes<T, N> b) {
  if constexpr (kFits<T, N>) {
    return Lanes<T, N>(greater_of(a.v, b.v));
  } else {
    return {greater(a.low, b.low), greater(a.high, b.high)};
  }
}
template <class T, int N>
BRUSHFIRE_INLINE Lanes<T, N> square_root(Lanes<T, N> a) {
  if constexpr (kFits<T, N>) {
    return Lanes<T, N>(root_of(a.v));
  } else {
    return {square_root(a.low), square_root(a.high)};
  }
}
template <class T, int N>
BRUSHFIRE_INLINE Lanes<T, N> magnitude(Lanes<T, N> a) {
  if constexpr (kFits<T, N>) {
    using Bits = Register<MaskNumber<sizeof(T)>, N>;
    const auto sign = same_bits<Bits>(Lanes<T, N>(T(-0.0)).v);
    return Lanes<T, N>(same_bits<Register<T, N>>(same_bits<Bits>(a.v) & ~sign));
  } else {
    return {magnitude(a.low), magnitude(a.high)};
  }
}

// The same of single numbers.
template <class T>
BRUSHFIRE_INLINE IfNumber<T> select(bool mask, T yes, T no) {
  return mask ? yes : no;
}
template <class T>
BRUSHFIRE_INLINE IfNumber<T> lesser(T a, T b) {
  return a < b ? a : b;
}
template <class T>
BRUSHFIRE_INLINE IfNumber<T> greater(T a, T b) {
  return a > b ? a : b;
}
template <class T>
BRUSHFIRE_INLINE IfNumber<T> square_root(T a) {
  return std::sqrt(a);
}
template <class T>
BRUSHFIRE_INLINE IfNumber<T> magnitude(T a) {
  return std::abs(a);
}

// Bit k: of lane k.
template <std::size_t kBytes, int N>
BRUSHFIRE_INLINE std::uint32_t bits(Mask<kBytes, N> mask) {
  if constexpr (kFits<MaskNumber<kBytes>, N>) {
    return bits_of(mask.v.v);
  } else {
    return bits(Mask<kBytes, N / 2>{mask.v.low}) | bits(Mask<kBytes, N / 2>{mask.v.high}) << N / 2;
  }
}
template <std::size_t kBytes, int N>
BRUSHFIRE_INLINE bool any(Mask<kBytes, N> mask) {
  return bits(mask) != 0;
}
template <std::size_t kBytes, int N>
BRUSHFIRE_INLINE bool all(Mask<kBytes, N> mask) {
  return bits(mask) == (1u << N) - 1;
}

template <std::size_t kBytes, int N>
BRUSHFIRE_INLINE Mask<kBytes, N> without(Mask<kBytes, N> a, Mask<kBytes, N> b) {
  return ~a & b;
}
BRUSHFIRE_INLINE bool without(bool a, bool b) { return !a && b; }
BRUSHFIRE_INLINE bool any(bool mask) { return mask; }

// The lanes with these numbers, counted over both from kFirst on.
template <int kFirst, class T, int N, int... kLane>
BRUSHFIRE_INLINE auto lanes_from(Lanes<T, N> a, Lanes<T, N> b, std::integer_sequence<int, kLane...>) {
  return Lanes<T, static_cast<int>(sizeof...(kLane))>(shuffled<(kFirst + kLane)...>(a.v, b.v));
}
template <class T, int N>
BRUSHFIRE_INLINE Lanes<T, N / 2> low_half(Lanes<T, N> a) {
  if constexpr (kFits<T, N>) {
    return lanes_from<0>(a, a, std::make_integer_sequence<int, N / 2>());
  } else {
    return a.low;
  }
}
template <class T, int N>
BRUSHFIRE_INLINE Lanes<T, N / 2> high_half(Lanes<T, N> a) {
  if constexpr (kFits<T, N>) {
    return lanes_from<N / 2>(a, a, std::make_integer_sequence<int, N / 2>());
  } else {
    return a.high;
  }
}
template <class T, int N>
BRUSHFIRE_INLINE Lanes<T, 2 * N> joined(Lanes<T, N> low, Lanes<T, N> high) {
  if constexpr (kFits<T, 2 * N>) {
    return lanes_from<0>(low, high, std::make_integer_sequence<int, 2 * N>());
  } else {
    return {low, high};
  }
}

// Halves on halves, the lower one first, so that all targets round alike.
template <class T, int N>
BRUSHFIRE_INLINE T sum(Lanes<T, N> a) {
  if constexpr (N == 2) {
    return a.v[0] + a.v[1];
  } else {
    return sum(low_half(a) + high_half(a));
  }
}

#ifdef BRUSHFIRE_TARGET_IS_AVX512
BRUSHFIRE_INLINE Lanes<std::int64_t, 8> as_lanes(unsigned bits) {
  return Lanes<std::int64_t, 8>(same_bits<Register<std::int64_t, 8>>(_mm512_movm_epi64(static_cast<__mmask8>(bits))));
}
template <class To>
BRUSHFIRE_INLINE auto converted(BitFacts a) {
  if constexpr (sizeof(To) == 4) {
    return a;
  } else {
    return joined(as_lanes(a.v), as_lanes(unsigned{a.v} >> 8));
  }
}
#endif
// The numbers as those of type To, rounded where need be.
template <class To, class T, int N>
BRUSHFIRE_INLINE Lanes<To, N> converted(Lanes<T, N> a) {
  if constexpr (std::is_same_v<To, T>) {
    return a;
  } else if constexpr (kFits<T, N> && kFits<To, N>) {
    return Lanes<To, N>(converted_of<To>(a.v));
  } else {
    return joined(converted<To>(low_half(a)), converted<To>(high_half(a)));
  }
}
// The mask for numbers of type T.
template <class T, std::size_t kBytes, int N>
BRUSHFIRE_INLINE Mask<sizeof(T), N> mask_cast(Mask<kBytes, N> mask) {
  return {converted<MaskNumber<sizeof(T)>>(mask.v)};
}

// a / kBy of whole numbers, which compilers know how to do only where they see by what.
template <std::uint32_t kBy, int N>
BRUSHFIRE_INLINE Lanes<std::uint32_t, N> quotient(Lanes<std::uint32_t, N> a) {
  if constexpr (kFits<std::uint32_t, N>) {
    return Lanes<std::uint32_t, N>(a.v / kBy);
  } else {
    return {quotient<kBy>(a.low), quotient<kBy>(a.high)};
  }
}

// What Vec3 is for one vector.
template <class V>
struct Vector3 {
  V x, y, z;

  BRUSHFIRE_INLINE friend Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  BRUSHFIRE_INLINE friend Vector3 operator*(V s, Vector3 a) { return {s * a.x, s * a.y, s * a.z}; }
};
template <class V>
BRUSHFIRE_INLINE V dot(Vector3<V> a, Vector3<V> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
BRUSHFIRE_INLINE Vector3<V> cross(Vector3<V> a, Vector3<V> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class V>
BRUSHFIRE_INLINE Vector3<V> select(MaskFor<V> mask, Vector3<V> yes, Vector3<V> no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

}  // namespace brushfire::lanes::BRUSHFIRE_TARGET
