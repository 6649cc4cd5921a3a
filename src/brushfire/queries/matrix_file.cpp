// A distance matrix on disk, row by row, that survives being interrupted.
//
// PATH.part is the .npy file with holes; PATH.part.rows holds what the matrix is of (a fingerprint) and the numbers of
// the rows that are in place, each written after its row. A row that was cut off is simply not in the list.
#include <brushfire/core/detail/memory.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/temporary_file.h>
#include <brushfire/queries/detail/rows.h>
#include <brushfire/queries/distance_matrix.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>

namespace brushfire {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_not_writable(const fs::path& path, const std::string& why) {
  throw Error(ErrorCode::FileNotWritable, path.string() + ": " + why);
}

// FNV-1a, 64 bits: tells apart what was begun from what is asked for now; no defence against forgery.
class Fingerprint {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash_ = (hash_ ^ bytes[i]) * 0x100000001b3;
  }
  void add(double value) { add(&value, sizeof value); }
  void add(std::uint64_t value) { add(&value, sizeof value); }
  void add(std::string_view text) { add(text.data(), text.size()); }
  void add(const Place& place) {
    if (const Index* v = std::get_if<Index>(&place)) return add(std::uint64_t{*v});
    const SurfacePoint& p = std::get<SurfacePoint>(place);
    add(std::uint64_t{p.face} | std::uint64_t{1} << 63);
    add(p.weights.data(), sizeof p.weights);
  }
  void add(const Places& places) {
    add(std::uint64_t{places.has_value()});
    if (!places) return;
    add(std::uint64_t{places->size()});
    for (const Place& p : *places) add(p);
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

std::uint64_t fingerprint_of(const Domain& domain, const Places& rows, const Places& columns, ValueType type,
                             const DistanceOptions& options) {
  const Mesh& mesh = domain.open();
  Fingerprint f;
  f.add(std::uint64_t{mesh.vertex_count()});
  f.add(mesh.faces().data(), mesh.faces().size_bytes());
  f.add(mesh.lengths().data(), mesh.lengths().size_bytes());
  f.add(mesh.unit());
  if (const CutMesh* cut = domain.cut()) {
    f.add(cut->original_vertex.data(), cut->original_vertex.size() * sizeof(Index));
    f.add(cut->original_face.data(), cut->original_face.size() * sizeof(Index));
  }
  f.add(rows);
  f.add(columns);
  f.add(static_cast<std::uint64_t>(type));
  f.add(name_of(options.method));
  f.add(options.tolerance);
  f.add(static_cast<std::uint64_t>(options.bound));
  f.add(static_cast<std::uint64_t>(options.precision));
  f.add(options.max_distance);
  return f.value();
}

// Magic, version 1.0, length and text, padded so that the data start at a multiple of 64 bytes.
std::string npy_header(std::size_t rows, std::size_t columns, ValueType type) {
  std::string text = std::string("{'descr': '<f") + (type == ValueType::Float32 ? "4" : "8") +
                     "', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", " + std::to_string(columns) +
                     "), }";
  constexpr std::size_t kPreamble = 10, kAlignment = 64;
  while ((kPreamble + text.size() + 1) % kAlignment != 0) text += ' ';
  text += '\n';
  std::string header = "\x93NUMPY";
  header += {'\x01', '\x00', static_cast<char>(text.size() & 0xff), static_cast<char>(text.size() >> 8)};
  return header + text;
}

// The bytes of a row.
template <class T>
void as_little_endian(std::span<const T> values, std::vector<char>& bytes) {
  bytes.resize(values.size_bytes());
  if constexpr (std::endian::native == std::endian::little) {
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  } else {
    auto to = bytes.begin();
    for (const T& value : values) {
      const char* const from = reinterpret_cast<const char*>(&value);
      to = std::reverse_copy(from, from + sizeof value, to);
    }
  }
}

// The two files of a matrix that is being written.
class MatrixFile {
 public:
  MatrixFile(const fs::path& path, std::string header, std::size_t rows, std::size_t row_bytes,
             std::uint64_t fingerprint)
      : path_(detail::followed(path.string())),
        part_(path_.string() + ".part"),
        list_(path_.string() + ".part.rows"),
        header_(std::move(header)),
        row_bytes_(row_bytes),
        lock_(list_.string()) {
    if (lock_.is_taken()) throw_not_writable(path_, "another process is writing this matrix");
    done_.assign(rows, false);
    if (!resume(fingerprint)) begin(fingerprint);
  }

  std::vector<std::size_t> missing() const {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < done_.size(); ++i) {
      if (!done_[i]) numbers.push_back(i);
    }
    return numbers;
  }

  // From any thread.
  void write(std::size_t row, const std::vector<char>& bytes) {
    const std::lock_guard lock(mutex_);
    data_.seekp(static_cast<std::streamoff>(header_.size() + row * row_bytes_));
    data_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    data_.flush();
    const std::uint64_t number = row;
    if (data_) rows_.write(reinterpret_cast<const char*>(&number), sizeof number).flush();
    if (!data_ || !rows_) throw_not_writable(part_, "writing row " + std::to_string(row) + " failed (disk full?)");
  }

  void finish() {
    data_.close();
    rows_.close();
    std::error_code error;
    fs::rename(part_, path_, error);
    if (error) throw_not_writable(path_, error.message());
    fs::remove(list_, error);
  }

 private:
  std::uint64_t size() const { return header_.size() + std::uint64_t{done_.size()} * row_bytes_; }

  // Reads which rows are there, if the files are of this matrix.
  bool resume(std::uint64_t fingerprint) {
    std::error_code error;
    if (fs::file_size(part_, error) != size() || error) return false;
    std::ifstream list(list_, std::ios::binary);
    std::uint64_t number = 0;
    if (!list.read(reinterpret_cast<char*>(&number), sizeof number) || number != fingerprint) return false;
    std::uintmax_t read = sizeof number;
    while (list.read(reinterpret_cast<char*>(&number), sizeof number) && number < done_.size()) {
      done_[static_cast<std::size_t>(number)] = true;
      read += sizeof number;
    }
    list.close();
    fs::resize_file(list_, read, error);  // a number that was cut off
    open(std::ios::app);
    return true;
  }

  void begin(std::uint64_t fingerprint) {
    std::error_code error;
    fs::path folder = path_.parent_path();
    const fs::space_info space = fs::space(folder.empty() ? "." : folder, error);
    if (!error && space.available < size()) {
      throw_not_writable(path_, "the matrix takes " + bytes_as_text(size()) + ", but " +
                                    bytes_as_text(space.available) + " are free there");
    }
    std::ofstream(part_, std::ios::binary | std::ios::trunc)
        .write(header_.data(), static_cast<std::streamsize>(header_.size()));
    fs::resize_file(part_, size(), error);
    if (error) throw_not_writable(part_, error.message());
    open(std::ios::trunc);
    rows_.write(reinterpret_cast<const char*>(&fingerprint), sizeof fingerprint).flush();
  }

  void open(std::ios::openmode mode) {
    data_.open(part_, std::ios::binary | std::ios::in | std::ios::out);
    rows_.open(list_, std::ios::binary | std::ios::out | mode);
    if (!data_ || !rows_) throw_not_writable(part_, "cannot be opened for writing");
  }

  fs::path path_, part_, list_;
  std::string header_;
  std::size_t row_bytes_;
  std::vector<bool> done_;
  detail::FileLock lock_;  // on the list: two processes would write over each other
  std::mutex mutex_;
  std::fstream data_;
  std::ofstream rows_;
};

template <class T>
void write_rows(detail::Rows& all, const Progress& progress, MatrixFile& file) {
  all.run_dense<T>(file.missing(), progress, [&](unsigned, std::size_t i, std::span<const T> values) {
    std::vector<char> bytes;
    as_little_endian(values, bytes);
    file.write(i, bytes);
  });
}

}  // namespace

void write_distance_matrix(const std::filesystem::path& path, const Domain& domain, Places rows, Places columns,
                           ValueType type, const MatrixOptions& options) {
  detail::Rows all(domain, rows, columns, options);
  const bool is_float = type == ValueType::Float32;
  MatrixFile file(path, npy_header(all.count(), all.columns(), type), all.count(),
                  all.columns() * (is_float ? sizeof(float) : sizeof(double)),
                  fingerprint_of(domain, rows, columns, type, options.distance));
  if (is_float) {
    write_rows<float>(all, options.distance.progress, file);
  } else {
    write_rows<double>(all, options.distance.progress, file);
  }
  file.finish();
}

}  // namespace brushfire
