// Pairs of blocks, and the journal that makes each of them all or nothing.
#include <brushfire/queries/detail/symmetrize.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/binary.h>
#include <brushfire/io/detail/output.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

namespace brushfire::detail {
namespace {

constexpr std::uint64_t kSide = 512;

// The same bits for (a, b) and (b, a).
template <class T>
T either_way(T a, T b, Symmetry symmetry) {
  const T mean = a / 2 + b / 2;
  return symmetry == Symmetry::Mean && std::isfinite(mean) ? mean : std::fmin(a, b);
}

// Rows [row, row + rows) of columns [column, column + columns), one after the other.
struct Block {
  std::uint64_t row = 0, column = 0, rows = 0, columns = 0;
  std::string bytes;
};

template <class T>
class Pair {
 public:
  Pair(const MatrixStore& store, std::uint64_t size, std::uint64_t i, std::uint64_t j) : store_(store) {
    const std::uint64_t a = i * kSide, b = j * kSide;
    const std::uint64_t rows = std::min(kSide, size - a), columns = std::min(kSide, size - b);
    below_ = {a, b, rows, columns, std::string(static_cast<std::size_t>(rows * columns * sizeof(T)), '\0')};
    above_ = {b, a, columns, rows, below_.bytes};
  }

  void read() {
    for (Block* block : {&below_, &above_}) {
      each_row(*block,
               [&](std::uint64_t row, std::span<char> bytes) { store_.read(row, block->column * sizeof(T), bytes); });
    }
  }
  void write() {
    for (Block* block : {&below_, &above_}) {
      each_row(*block,
               [&](std::uint64_t row, std::span<char> bytes) { store_.write(row, block->column * sizeof(T), bytes); });
    }
  }
  void make_equal(Symmetry symmetry) {
    for (std::uint64_t r = 0; r < below_.rows; ++r) {
      for (std::uint64_t c = 0; c < below_.columns; ++c) {
        char* const a = &below_.bytes[static_cast<std::size_t>((r * below_.columns + c) * sizeof(T))];
        char* const b = &above_.bytes[static_cast<std::size_t>((c * above_.columns + r) * sizeof(T))];
        const T value = either_way(load<T>(a, std::endian::little), load<T>(b, std::endian::little), symmetry);
        store(value, a, std::endian::little);
        store(value, b, std::endian::little);
      }
    }
  }
  std::string bytes() const { return below_.bytes + above_.bytes; }
  bool take_bytes(std::string_view bytes) {
    if (bytes.size() != below_.bytes.size() + above_.bytes.size()) return false;
    below_.bytes = bytes.substr(0, below_.bytes.size());
    above_.bytes = bytes.substr(below_.bytes.size());
    return true;
  }

 private:
  template <class Body>
  static void each_row(Block& block, const Body& body) {
    const std::uint64_t length = block.columns * sizeof(T);
    for (std::uint64_t r = 0; r < block.rows; ++r) {
      body(block.row + r,
           std::span(block.bytes).subspan(static_cast<std::size_t>(r * length), static_cast<std::size_t>(length)));
    }
  }

  const MatrixStore& store_;
  Block below_, above_;
};

// The number of a pair and its bytes as they were.
void keep(const std::string& journal, std::uint64_t number, const std::string& bytes) {
  Output output(journal);
  output.value(number, std::endian::little);
  output.write(bytes);
  output.commit();
}

template <class T>
void symmetrize_as(const MatrixStore& store, std::uint64_t size, Symmetry symmetry, const std::string& journal) {
  std::ifstream file(journal, std::ios::binary);
  const std::string kept{std::istreambuf_iterator<char>(file), {}};
  std::uint64_t next = 0;  // pairs before it are equal
  if (kept.size() >= sizeof next) next = load<std::uint64_t>(kept.data(), std::endian::little);
  const std::uint64_t blocks = (size + kSide - 1) / kSide;
  std::uint64_t number = 0;
  for (std::uint64_t i = 0; i < blocks; ++i) {
    for (std::uint64_t j = 0; j <= i; ++j, ++number) {
      if (number < next) continue;
      stop_if_cancelled();
      Pair<T> pair(store, size, i, j);
      if (number == next && !kept.empty()) {
        if (!pair.take_bytes(std::string_view(kept).substr(sizeof next))) {
          throw Error(ErrorCode::FileNotWritable, journal + ": was cut short");
        }
      } else {
        pair.read();
        keep(journal, number, pair.bytes());
      }
      pair.make_equal(symmetry);
      pair.write();
    }
  }
}

}  // namespace

void symmetrize(const MatrixStore& store, std::uint64_t size, ValueType type, Symmetry symmetry,
                const std::string& journal) {
  type == ValueType::Float32 ? symmetrize_as<float>(store, size, symmetry, journal)
                             : symmetrize_as<double>(store, size, symmetry, journal);
}

}  // namespace brushfire::detail
