// Rows in a .npy file with holes, and in chunks of a Zarr store.
#include <brushfire/queries/detail/matrix_store.h>

#include <brushfire/core/detail/memory.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/output.h>
#include <brushfire/io/detail/shared_file.h>
#include <brushfire/io/detail/zarr.h>
#include <brushfire/queries/detail/fingerprint.h>
#include <brushfire/queries/detail/nearest_store.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace brushfire::detail {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_not_writable(const fs::path& path, const std::string& why) {
  throw Error(ErrorCode::FileNotWritable, path.string() + ": " + why);
}

// Done already is as good; on systems without links to files the name is simply given.
void put_under_name(const fs::path& part, const fs::path& path) {
  std::error_code error;
  fs::rename(part, path, error);
  if (error && !fs::exists(path)) throw_not_writable(path, error.message());
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Magic, version 1.0, length and text, padded so that the data start at a multiple of 64 bytes.
std::string npy_header(const StoredMatrix& m) {
  std::string text = std::string("{'descr': '<") + (m.whole_numbers ? 'i' : 'f') + std::to_string(m.value_bytes()) +
                     "', 'fortran_order': False, 'shape': (" + std::to_string(m.rows) + ", " +
                     std::to_string(m.columns) + "), }";
  constexpr std::size_t kPreamble = 10, kAlignment = 64;
  while ((kPreamble + text.size() + 1) % kAlignment != 0) text += ' ';
  text += '\n';
  std::string header = "\x93NUMPY";
  header += {'\x01', '\x00', static_cast<char>(text.size() & 0xff), static_cast<char>(text.size() >> 8)};
  return header + text;
}

// PATH.part until it is complete.
class NpyStore : public MatrixStore {
 public:
  NpyStore(fs::path path, StoredMatrix matrix)
      : path_(std::move(path)),
        part_(path_.string() + ".part"),
        matrix_(std::move(matrix)),
        header_(npy_header(matrix_)) {}

  void begin() override {
    if (fs::is_directory(path_)) throw_not_writable(path_, "is a folder");
    std::error_code error;
    fs::remove(part_, error);
    require_disk(path_, matrix_.rows, matrix_.row_bytes());
    const SharedFile file(part_, SharedFile::Missing::Created);
    file.write(0, header_);
    file.resize(size());
  }
  bool is_there() const override {
    std::error_code error;
    if (fs::file_size(part_, error) == size() && !error) return true;
    return fs::file_size(path_, error) == size() && !error;
  }
  void write(std::uint64_t row, std::uint64_t from, std::span<const char> bytes) const override {
    SharedFile(part_, SharedFile::Missing::Refused).write(place(row, from), bytes);
  }
  void read(std::uint64_t row, std::uint64_t from, std::span<char> bytes) const override {
    const std::string there = fs::exists(part_) ? part_ : path_.string();
    if (!SharedFile(there, SharedFile::Missing::Refused).read(place(row, from), bytes)) {
      throw_not_writable(there, "was cut short");
    }
  }
  void finish() const override {
    if (fs::exists(part_)) put_under_name(part_, path_);
  }
  bool is_finished() const override { return !fs::exists(part_); }

 private:
  std::uint64_t size() const { return header_.size() + matrix_.rows * matrix_.row_bytes(); }
  std::uint64_t place(std::uint64_t row, std::uint64_t from) const {
    return header_.size() + row * matrix_.row_bytes() + from;
  }

  fs::path path_;
  std::string part_;
  StoredMatrix matrix_;
  std::string header_;
};

std::uint64_t chunk_rows_of(const StoredMatrix& m, const MatrixFileOptions& options) {
  constexpr std::uint64_t kChunkBytes = 16'000'000;
  const std::uint64_t most = std::max<std::uint64_t>(1, m.rows);
  if (options.chunk_rows > 0) return std::min(options.chunk_rows, most);
  return std::clamp<std::uint64_t>(kChunkBytes / std::max<std::uint64_t>(1, m.row_bytes()), 1, most);
}

ZarrGroup zarr_group(const StoredMatrix& m, const MatrixFileOptions& options) {
  const std::uint64_t columns = std::max<std::uint64_t>(1, m.columns);
  std::vector<ZarrArray> arrays{{.name = "distance",
                                 .type = m.type == ValueType::Float32 ? "float32" : "float64",
                                 .shape = {m.rows, m.columns},
                                 .chunk = {chunk_rows_of(m, options), columns},
                                 .dimensions = {"row", "column"}}};
  const auto add_numbers = [&](const char* name, const std::vector<std::int64_t>& vertices) {
    if (vertices.empty()) return;
    const std::uint64_t count = vertices.size();
    arrays.push_back({.name = name, .type = "int64", .shape = {count}, .chunk = {count}, .dimensions = {name}});
  };
  add_numbers("row", m.row_vertices);
  add_numbers("column", m.column_vertices);
  return {options.zarr_format, std::move(arrays), m.attributes};
}

// Chunks are CHUNK.part until all their rows are there; the texts and coordinates are there from the beginning.
class ZarrStore : public MatrixStore {
 public:
  ZarrStore(fs::path path, StoredMatrix matrix, const MatrixFileOptions& options)
      : path_(std::move(path)),
        matrix_(std::move(matrix)),
        group_(zarr_group(matrix_, options)),
        by_chunks_(!options.symmetry) {}

  void begin() override {
    if (is_there()) return;
    std::error_code error;
    if (fs::exists(path_) && !(fs::is_directory(path_) && fs::is_empty(path_, error))) {
      throw_not_writable(path_, "is there already, and is not this matrix: remove it, or choose another name");
    }
    require_disk(path_, matrix_.rows, matrix_.row_bytes());
    // Under another name first: what is killed in its midst leaves no half of a store.
    const fs::path draft = path_.string() + ".part";
    fs::remove_all(draft, error);
    for (const ZarrArray& a : group_.arrays()) {
      const std::vector<std::int64_t>* numbers = a.name == "row"      ? &matrix_.row_vertices
                                                 : a.name == "column" ? &matrix_.column_vertices
                                                                      : nullptr;
      const fs::path first = draft / group_.chunk_path(a, 0);
      fs::create_directories(first.parent_path(), error);
      if (error) throw_not_writable(draft, error.message());
      if (numbers == nullptr) continue;
      Output output(first.string());
      output.values(std::span<const std::int64_t>(*numbers), std::endian::little);
      output.commit();
    }
    for (const auto& [name, text] : group_.texts()) {
      Output output((draft / name).string());
      output.write(text);
      output.commit();
    }
    fs::rename(draft, path_, error);
    if (error) throw_not_writable(path_, error.message());
  }
  bool is_there() const override { return is_complete_store(path_, matrix_.attributes); }
  void write(std::uint64_t row, std::uint64_t from, std::span<const char> bytes) const override {
    const fs::path chunk = chunk_of(row), part = chunk.string() + ".part";
    // Where there are no locks, another process may have been quicker: then these bytes are there.
    if (fs::exists(chunk)) return;
    if (group_.format() == 3) fs::create_directories(part.parent_path());
    const SharedFile file(part.string(), SharedFile::Missing::Created);
    if (file.size() != chunk_bytes()) file.resize(chunk_bytes());
    file.write(place(row, from), bytes);
  }
  void read(std::uint64_t row, std::uint64_t from, std::span<char> bytes) const override {
    const fs::path chunk = chunk_of(row), part = chunk.string() + ".part";
    const SharedFile file((fs::exists(part) ? part : chunk).string(), SharedFile::Missing::Refused);
    if (!file.read(place(row, from), bytes)) throw_not_writable(part, "was cut short");
  }
  std::uint64_t rows_of_unit() const override { return by_chunks_ ? rows_of_chunk() : 0; }
  void complete(std::uint64_t row) const override {
    const fs::path chunk = chunk_of(row), part = chunk.string() + ".part";
    if (!fs::exists(chunk)) put_under_name(part, chunk);
  }
  void finish() const override {
    if (matrix_.columns == 0) return;
    for (std::uint64_t row = 0; row < matrix_.rows; row += rows_of_chunk()) complete(row);
  }
  bool is_finished() const override {
    return matrix_.rows * matrix_.columns == 0 || fs::exists(chunk_of(matrix_.rows - 1));
  }

 private:
  const ZarrArray& array() const { return group_.arrays().front(); }
  std::uint64_t rows_of_chunk() const { return array().chunk[0]; }
  std::uint64_t chunk_bytes() const { return rows_of_chunk() * matrix_.row_bytes(); }
  fs::path chunk_of(std::uint64_t row) const { return path_ / group_.chunk_path(array(), row / rows_of_chunk()); }
  std::uint64_t place(std::uint64_t row, std::uint64_t from) const {
    return row % rows_of_chunk() * matrix_.row_bytes() + from;
  }

  fs::path path_;
  StoredMatrix matrix_;
  ZarrGroup group_;
  bool by_chunks_;
};

}  // namespace

std::unique_ptr<MatrixStore> open_store(const fs::path& path, StoredMatrix matrix, const MatrixFileOptions& options) {
  if (path.extension() == ".npy" && options.nearest > 0) {
    StoredMatrix values = matrix;
    values.columns = options.nearest;
    StoredMatrix indices = values;
    indices.whole_numbers = true;
    return nearest_store(std::make_unique<NpyStore>(path, values),
                         std::make_unique<NpyStore>(index_path(path), indices), path, matrix, options.nearest);
  }
  if (path.extension() == ".npy") return std::make_unique<NpyStore>(path, std::move(matrix));
  if (path.extension() == ".zarr") return std::make_unique<ZarrStore>(path, std::move(matrix), options);
  throw Error(ErrorCode::UnknownFormat, path.string() + ": a dense matrix is written as .npy or .zarr");
}

std::uint64_t layout_of(const fs::path& path, const StoredMatrix& matrix, const MatrixFileOptions& options) {
  Fingerprint f;
  f.add(std::string_view(path.extension() == ".zarr" ? "zarr" : "npy"));
  if (path.extension() == ".zarr") {
    f.add(static_cast<std::uint64_t>(options.zarr_format));
    f.add(chunk_rows_of(matrix, options));
  }
  f.add(options.nearest);
  f.add(options.symmetry ? 1 + static_cast<std::uint64_t>(*options.symmetry) : std::uint64_t{0});
  return f.value();
}

bool is_complete_store(const fs::path& path, const std::string& attributes) {
  for (const char* text : {"zarr.json", ".zattrs"}) {
    if (content_of(path / text).find("{" + attributes + "}") != std::string::npos) return true;
  }
  return false;
}

void require_disk(const fs::path& path, std::uint64_t rows, std::uint64_t row_bytes) {
  std::error_code error;
  const fs::path folder = path.parent_path();
  const fs::space_info space = fs::space(folder.empty() ? "." : folder, error);
  const double bytes = static_cast<double>(rows) * static_cast<double>(row_bytes);
  if (error || static_cast<double>(space.available) >= bytes) return;
  const std::uint64_t fit = space.available / std::max<std::uint64_t>(1, row_bytes);
  throw_not_writable(path, "the matrix takes " + bytes_as_text(static_cast<std::uint64_t>(std::min(bytes, 0x1p63))) +
                               ", but " + bytes_as_text(space.available) + " are free there: " + std::to_string(fit) +
                               " of its " + std::to_string(rows) + " rows would fit");
}

}  // namespace brushfire::detail
