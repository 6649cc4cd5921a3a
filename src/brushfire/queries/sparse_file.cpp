// Sparse matrices as files: what scipy.sparse.load_npz() reads, and MatrixMarket.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/output.h>
#include <brushfire/queries/distance_matrix.h>

#include <array>
#include <bit>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace brushfire {
namespace {

// The checksum of zip archives: CRC-32 of IEEE 802.3, reflected.
class Crc32 {
 public:
  Crc32() {
    for (std::uint32_t i = 0; i < table_.size(); ++i) {
      std::uint32_t c = i;
      for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ (c & 1 ? 0xEDB88320u : 0u);
      table_[i] = c;
    }
  }
  std::uint32_t of(std::string_view bytes) const {
    std::uint32_t c = ~0u;
    for (const char b : bytes) c = (c >> 8) ^ table_[(c ^ static_cast<unsigned char>(b)) & 0xff];
    return ~c;
  }

 private:
  std::array<std::uint32_t, 256> table_{};
};

template <class T>
void append(std::string& bytes, T value) {
  for (std::size_t k = 0; k < sizeof(T); ++k) bytes += static_cast<char>((value >> (8 * k)) & 0xff);
}

// A zip archive of stored members. All sizes are in zip64 records, so that there is one case for any size.
//
// Based on: PKWARE, "APPNOTE.TXT - .ZIP File Format Specification", 6.3.10, sections 4.3 to 4.5.
class Zip {
 public:
  explicit Zip(const std::string& path) : output_(path) {}

  void add(const std::string& name, const std::string& content) {
    const std::uint32_t crc = crc_.of(content);
    std::string sizes;
    append(sizes, std::uint64_t{content.size()});
    append(sizes, std::uint64_t{content.size()});

    std::string local = "PK\x03\x04";
    append_common(local, crc, name.size(), 4 + sizes.size());
    local += name;
    append_extra(local, sizes);
    output_.write(local);
    output_.write(content);

    append(sizes, offset_);
    directory_ += "PK\x01\x02";
    append(directory_, kVersion);
    append_common(directory_, crc, name.size(), 4 + sizes.size());
    append(directory_, std::uint16_t{0});  // comment
    append(directory_, std::uint16_t{0});  // disk
    append(directory_, std::uint16_t{0});  // internal attributes
    append(directory_, std::uint32_t{0});  // external attributes
    append(directory_, kInZip64);
    directory_ += name;
    append_extra(directory_, sizes);
    offset_ += local.size() + content.size();
    ++count_;
  }

  void finish() {
    const std::uint64_t end = offset_ + directory_.size();
    std::string tail = std::string("PK\x06\x06");
    append(tail, std::uint64_t{44});  // bytes of this record that follow
    append(tail, kVersion);
    append(tail, kVersion);
    append(tail, std::uint32_t{0});  // this disk
    append(tail, std::uint32_t{0});  // the directory's disk
    append(tail, count_);
    append(tail, count_);
    append(tail, std::uint64_t{directory_.size()});
    append(tail, offset_);
    tail += "PK\x06\x07";
    append(tail, std::uint32_t{0});
    append(tail, end);
    append(tail, std::uint32_t{1});
    tail += "PK\x05\x06";
    append(tail, std::uint32_t{0});  // disks
    append(tail, static_cast<std::uint16_t>(count_));
    append(tail, static_cast<std::uint16_t>(count_));
    append(tail, kInZip64);
    append(tail, kInZip64);
    append(tail, std::uint16_t{0});  // comment
    output_.write(directory_);
    output_.write(tail);
    output_.commit();
  }

 private:
  static constexpr std::uint16_t kVersion = 45;            // zip64
  static constexpr std::uint32_t kInZip64 = 0xffffffff;    // "see the zip64 record"
  static constexpr std::uint16_t kDate = (0 << 9) | 0x21;  // 1980-01-01, so that equal matrices make equal files

  // What a member's local header and its directory entry have in common.
  static void append_common(std::string& bytes, std::uint32_t crc, std::size_t name, std::size_t extra) {
    append(bytes, kVersion);
    append(bytes, std::uint16_t{0});  // flags
    append(bytes, std::uint16_t{0});  // stored
    append(bytes, std::uint16_t{0});  // time
    append(bytes, kDate);
    append(bytes, crc);
    append(bytes, kInZip64);
    append(bytes, kInZip64);
    append(bytes, static_cast<std::uint16_t>(name));
    append(bytes, static_cast<std::uint16_t>(extra));
  }
  static void append_extra(std::string& bytes, const std::string& sizes) {
    append(bytes, std::uint16_t{1});  // zip64
    append(bytes, static_cast<std::uint16_t>(sizes.size()));
    bytes += sizes;
  }

  detail::Output output_;
  Crc32 crc_;
  std::string directory_;
  std::uint64_t offset_ = 0, count_ = 0;
};

// A .npy file of version 1.0 for values of a type ("<f4") and a shape ("(7,)").
std::string npy_start(const char* type, const std::string& shape) {
  std::string text = std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
  constexpr std::size_t kPreamble = 10, kAlignment = 64;
  while ((kPreamble + text.size() + 1) % kAlignment != 0) text += ' ';
  text += '\n';
  std::string bytes = std::string("\x93NUMPY\x01", 7) + '\0';
  append(bytes, static_cast<std::uint16_t>(text.size()));
  return bytes + text;
}

template <class As, class T>
std::string npy(const char* type, std::span<const T> values) {
  std::string bytes = npy_start(type, "(" + std::to_string(values.size()) + ",)");
  bytes.reserve(bytes.size() + values.size() * sizeof(As));
  for (const T v : values) append(bytes, static_cast<As>(v));
  return bytes;
}

template <class T>
std::string npy_of_floats(const std::vector<T>& values) {
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  std::string bytes = npy_start(sizeof(T) == 4 ? "<f4" : "<f8", "(" + std::to_string(values.size()) + ",)");
  bytes.reserve(bytes.size() + values.size() * sizeof(T));
  for (const T v : values) append(bytes, std::bit_cast<Bits>(v));
  return bytes;
}

template <class T>
void write_npz(const std::string& path, const SparseMatrix<T>& m) {
  // scipy wants one integer type for both: 32 bits where they do.
  const bool narrow = m.value.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  const std::span<const Index> columns(m.column);
  const std::span<const std::uint64_t> starts(m.row_start);
  const std::array<std::uint64_t, 2> shape{m.row_start.size() - 1, m.columns};
  Zip zip(path);
  zip.add("indices.npy", narrow ? npy<std::uint32_t>("<i4", columns) : npy<std::uint64_t>("<i8", columns));
  zip.add("indptr.npy", narrow ? npy<std::uint32_t>("<i4", starts) : npy<std::uint64_t>("<i8", starts));
  zip.add("format.npy", npy_start("|S3", "()") + "csr");
  zip.add("shape.npy", npy<std::uint64_t>("<i8", std::span<const std::uint64_t>(shape)));
  zip.add("data.npy", npy_of_floats(m.value));
  zip.finish();
}

template <class T>
void write_matrix_market(const std::string& path, const SparseMatrix<T>& m) {
  detail::Output output(path);
  output.write("%%MatrixMarket matrix coordinate real general\n");
  output.write(std::to_string(m.row_start.size() - 1) + " " + std::to_string(m.columns) + " " +
               std::to_string(m.value.size()) + "\n");
  for (std::size_t i = 0; i + 1 < m.row_start.size(); ++i) {
    for (auto k = static_cast<std::size_t>(m.row_start[i]); k < m.row_start[i + 1]; ++k) {
      output.number(static_cast<std::int64_t>(i + 1));
      output.write(' ');
      output.number(std::int64_t{m.column[k]} + 1);
      output.write(' ');
      output.number(m.value[k]);
      output.write('\n');
    }
  }
  output.commit();
}

}  // namespace

template <class T>
void write_sparse_matrix(const std::string& path, const SparseMatrix<T>& matrix) {
  if (path.ends_with(".npz")) return write_npz(path, matrix);
  if (path.ends_with(".mtx")) return write_matrix_market(path, matrix);
  throw Error(ErrorCode::UnknownFormat, path + ": a sparse matrix is written as .npz or .mtx");
}

template void write_sparse_matrix(const std::string&, const SparseMatrix<float>&);
template void write_sparse_matrix(const std::string&, const SparseMatrix<double>&);

}  // namespace brushfire
