// What lanes_test.cpp does on each target.
namespace brushfire::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

template <class T, int N, class Number>
void expect_lanes(Lanes<T, N> lanes, const char* what, const Number& number) {
  T got[N];
  store(got, lanes);
  for (int k = 0; k < N; ++k) EXPECT_TRUE(same_bits(got[k], number(k))) << what << ", lane " << k << ": " << got[k];
}

template <std::size_t kBytes, int N, class Fact>
void expect_mask(Mask<kBytes, N> mask, const char* what, const Fact& fact) {
  std::uint32_t expected = 0;
  for (int k = 0; k < N; ++k) expected |= (fact(k) ? 1u : 0u) << k;
  EXPECT_EQ(bits(mask), expected) << what;
  EXPECT_EQ(any(mask), expected != 0) << what;
  EXPECT_EQ(all(mask), expected == (1u << N) - 1) << what;
}

template <class T, int N>
void calculate() {
  using V = Lanes<T, N>;
  constexpr std::size_t kRounds = 500;
  const std::vector<T> a = awkward_numbers<T>(kRounds * N + 1), b(a.rbegin(), a.rend());
  for (std::size_t i = 0; i < kRounds; ++i) {
    const T *const p = a.data() + i * N, *const q = b.data() + i * N + 1;  // from any place in memory
    const V x = load<V>(p), y = load<V>(q);
    expect_lanes(x + y, "+", [&](int k) { return p[k] + q[k]; });
    expect_lanes(x - y, "-", [&](int k) { return p[k] - q[k]; });
    expect_lanes(x * y, "*", [&](int k) { return p[k] * q[k]; });
    expect_lanes(x / y, "/", [&](int k) { return p[k] / q[k]; });
    expect_lanes(x * y + 1, "* +, rounded twice", [&](int k) {
      const volatile T product = p[k] * q[k];
      return product + 1;
    });
    expect_lanes(-x, "-", [&](int k) { return -p[k]; });
    expect_lanes(1 / x, "1 /", [&](int k) { return 1 / p[k]; });
    expect_lanes(square_root(x), "square root", [&](int k) { return std::sqrt(p[k]); });
    expect_lanes(magnitude(x), "magnitude", [&](int k) { return std::abs(p[k]); });
    expect_lanes(lesser(x, y), "lesser", [&](int k) { return p[k] < q[k] ? p[k] : q[k]; });
    expect_lanes(greater(x, y), "greater", [&](int k) { return p[k] > q[k] ? p[k] : q[k]; });
    expect_lanes(select((x < y) | (y == V(0)), x, y), "select",
                 [&](int k) { return p[k] < q[k] || q[k] == 0 ? p[k] : q[k]; });
    expect_mask(x < y, "<", [&](int k) { return p[k] < q[k]; });
    expect_mask(x <= y, "<=", [&](int k) { return p[k] <= q[k]; });
    expect_mask(~(x == y) & (x <= x), "~ &", [&](int k) { return p[k] != q[k] && p[k] <= p[k]; });
    expect_mask((x < y) ^ (x <= y), "^", [&](int k) { return p[k] == q[k]; });
    expect_mask(without(x < y, x <= y), "without", [&](int k) { return p[k] == q[k]; });
    T halves[N];
    std::copy(p, p + N, halves);
    for (int n = N / 2; n > 0; n /= 2) {
      for (int k = 0; k < n; ++k) halves[k] += halves[k + n];
    }
    EXPECT_TRUE(same_bits(sum(x), halves[0]));
    if (testing::Test::HasFailure()) return;
  }
}

template <int N>
void count() {
  using V = Lanes<std::uint32_t, N>;
  std::uint32_t a[N], b[N];
  for (std::uint32_t k = 0; k < N; ++k) a[k] = 0x90000001u * (k + 1), b[k] = k % 2 == 0 ? a[k] : ~0u / (k + 1);
  const V x = load<V>(a), y = load<V>(b);
  expect_lanes(x + y, "+", [&](int k) { return a[k] + b[k]; });
  expect_lanes(x - y, "-", [&](int k) { return a[k] - b[k]; });
  expect_lanes(x & 0xff00ffu, "&", [&](int k) { return a[k] & 0xff00ffu; });
  expect_lanes(x | y, "|", [&](int k) { return a[k] | b[k]; });
  expect_lanes(x ^ y, "^", [&](int k) { return a[k] ^ b[k]; });
  expect_mask(share_bits(x, V(0x30u)), "share bits", [&](int k) { return (a[k] & 0x30u) != 0; });
  expect_lanes(x << 5, "<<", [&](int k) { return a[k] << 5; });
  expect_lanes(x >> 3, ">>", [&](int k) { return a[k] >> 3; });
  expect_lanes(quotient<3>(x), "/ 3", [&](int k) { return a[k] / 3; });
  expect_lanes(lane_numbers<V>(), "number", [](int k) { return static_cast<std::uint32_t>(k); });
  expect_lanes(select(x == y, x, V(7)), "select", [&](int k) { return a[k] == b[k] ? a[k] : 7u; });
  expect_mask(x < y, "<", [&](int k) { return a[k] < b[k]; });
  for (std::uint32_t n = 0; n <= N; ++n) {
    expect_mask(first_lanes<N>(n), "first lanes", [n](int k) { return static_cast<std::uint32_t>(k) < n; });
    expect_mask(mask_cast<double>(first_lanes<N>(n)), "wide", [n](int k) { return static_cast<std::uint32_t>(k) < n; });
  }
}

template <class T, int N>
void gather_some() {
  using V = Lanes<T, N>;
  constexpr std::uint32_t kItems = 40;
  const auto from = std::make_unique<T[]>(3 * kItems);  // no item more: sanitizers see what is read beyond
  for (std::uint32_t i = 0; i < 3 * kItems; ++i) from[i] = static_cast<T>(i) + T(0.5);
  std::uint32_t index[N];
  for (std::uint32_t k = 0; k < N; ++k) index[k] = k == 1 ? kItems - 1 : 17 * k % kItems;
  expect_lanes(gather<V>(from.get(), index), "gather", [&](int k) { return from[index[k]]; });
  const auto [first, second] = gather_pairs<V>(from.get() + kItems, index);
  expect_lanes(first, "first of a pair", [&](int k) { return from[kItems + 2 * index[k]]; });
  expect_lanes(second, "second of a pair", [&](int k) { return from[kItems + 2 * index[k] + 1]; });
  const auto [x, y, z] = gather_points<V>(from.get(), index);
  expect_lanes(x, "x", [&](int k) { return from[3 * index[k]]; });
  expect_lanes(y, "y", [&](int k) { return from[3 * index[k] + 1]; });
  expect_lanes(z, "z", [&](int k) { return from[3 * index[k] + 2]; });
}

template <class T, int N>
void load_some_fours() {
  const auto from = std::make_unique<T[]>(4 * N);
  for (int i = 0; i < 4 * N; ++i) from[i] = static_cast<T>(i) + T(0.5);
  Lanes<T, N> four[4];
  load_fours(from.get(), four[0], four[1], four[2], four[3]);
  for (int i = 0; i < 4; ++i) expect_lanes(four[i], "of four", [&](int k) { return from[4 * k + i]; });
}

template <class T>
void pack() {
  using V = Lanes<T, 8>;
  const V x = lane_numbers<V>() + V(10);
  for (std::uint32_t set = 0; set < 256; ++set) {
    T to[16]{};
    store_packed(to, set, x);
    int count = 0;
    for (int k = 0; k < 8; ++k) {
      if ((set >> k & 1u) == 0) continue;
      EXPECT_EQ(to[count++], static_cast<T>(10 + k)) << "set " << set;
    }
    const Numbers8 index = (lane_numbers<Numbers8>() + set) | 8;  // what is above the lane's number does not count
    const Permutation<sizeof(T), 8> turned(index);
    expect_lanes(permuted(x, turned), "permuted", [set](int k) { return static_cast<T>(10 + (k + set) % 8); });
    expect_mask(permuted(x == V(12), turned), "permuted mask", [set](int k) { return (k + set) % 8 == 2; });
  }
}

inline void load_only_the_first() {
  for (std::uint32_t n = 0; n <= 8; ++n) {
    const auto from = std::make_unique<std::uint32_t[]>(n);  // sanitizers see what is read beyond
    for (std::uint32_t k = 0; k < n; ++k) from[k] = k + 1;
    expect_lanes(load_first<Numbers8>(from.get(), n), "first",
                 [n](int k) { return static_cast<std::uint32_t>(k) < n ? static_cast<std::uint32_t>(k) + 1 : 0; });
  }
}

inline void store_as_bytes() {
  const std::uint8_t bytes[8]{0, 1, 255, 128, 7, 16, 99, 254};
  const Numbers8 x = load_bytes<Numbers8>(bytes);
  expect_lanes(x, "bytes", [&](int k) { return std::uint32_t{bytes[k]}; });
  std::uint8_t to[8];
  store_bytes(to, x);
  EXPECT_EQ(std::memcmp(bytes, to, sizeof to), 0);
}

template <int N>
void store_words() {
  using V = Lanes<std::uint32_t, N>;
  std::uint16_t words[N], to[N + 1]{};
  for (int k = 0; k < N; ++k) words[k] = static_cast<std::uint16_t>(0x8001u * static_cast<unsigned>(k + 1));
  to[N] = 77;
  const V x = load_words<V>(words);
  expect_lanes(x, "words", [&](int k) { return std::uint32_t{words[k]}; });
  store_words(to, x);
  EXPECT_EQ(std::memcmp(words, to, sizeof words), 0);
  EXPECT_EQ(to[N], 77);
}
inline void store_as_words() {
  store_words<8>();
  store_words<16>();
}

template <int N>
void convert() {
  const std::vector<double> from = awkward_numbers<double>(100 * N);
  for (std::size_t i = 0; i < 100; ++i) {
    const double* const p = from.data() + i * N;
    const auto narrow = converted<float>(load<Lanes<double, N>>(p));
    expect_lanes(narrow, "to float", [&](int k) { return static_cast<float>(p[k]); });
    expect_lanes(converted<double>(narrow), "to double",
                 [&](int k) { return static_cast<double>(static_cast<float>(p[k])); });
  }
}

inline void calculate_all() {
  calculate<double, 2>();
  calculate<double, 4>();
  calculate<double, 8>();
  calculate<float, 4>();
  calculate<float, 8>();
  calculate<float, 16>();
}
inline void count_all() {
  count<4>();
  count<8>();
  count<16>();
}
inline void gather_all() {
  gather_some<double, 4>();
  gather_some<double, 8>();
  gather_some<float, 8>();
  gather_some<float, 16>();
  load_some_fours<float, 4>(), load_some_fours<float, 8>(), load_some_fours<float, 16>();
  load_some_fours<double, 4>(), load_some_fours<double, 8>();
}
inline void pack_all() {
  pack<double>();
  pack<float>();
  pack<std::uint32_t>();
}
inline void convert_all() {
  convert<4>();
  convert<8>();
}

}  // namespace brushfire::BRUSHFIRE_TARGET
