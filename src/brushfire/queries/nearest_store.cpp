// Selecting, sorting, and the radii that spare a row the rest of the mesh.
#include <brushfire/queries/detail/nearest_store.h>

#include <brushfire/core/error.h>
#include <brushfire/core/types.h>
#include <brushfire/queries/detail/little_endian.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace brushfire::detail {
namespace {

template <class T>
using SortedRow = std::pair<std::vector<T>, std::vector<std::uint32_t>>;

template <class T>
SortedRow<T> nearest_of(std::span<const char> bytes, std::size_t count) {
  const std::size_t columns = bytes.size() / sizeof(T);
  std::vector<std::pair<T, std::uint32_t>> row(columns);
  for (std::size_t j = 0; j < columns; ++j) {
    row[j] = {load<T>(bytes.data() + j * sizeof(T), std::endian::little), static_cast<std::uint32_t>(j)};
  }
  const auto last = row.begin() + static_cast<std::ptrdiff_t>(count);
  if (last != row.end()) std::nth_element(row.begin(), last, row.end());
  std::sort(row.begin(), last);
  SortedRow<T> sorted;
  for (auto entry = row.begin(); entry != last; ++entry) {
    sorted.first.push_back(entry->first);
    sorted.second.push_back(entry->second);
  }
  return sorted;
}

class NearestStore : public MatrixStore {
 public:
  NearestStore(std::unique_ptr<MatrixStore> values, std::unique_ptr<MatrixStore> indices, std::filesystem::path path,
               const StoredMatrix& whole, std::uint64_t count)
      : values_(std::move(values)),
        indices_(std::move(indices)),
        path_(std::move(path)),
        rows_(whole.rows),
        is_float_(whole.type == ValueType::Float32),
        count_(static_cast<std::size_t>(count)) {}

  void begin() override {
    require_disk(path_, rows_, count_ * ((is_float_ ? sizeof(float) : sizeof(double)) + sizeof(std::uint32_t)));
    values_->begin();
    indices_->begin();
  }
  bool is_there() const override { return values_->is_there() && indices_->is_there(); }
  void write(std::uint64_t row, std::uint64_t /*from*/, std::span<const char> bytes) const override {
    is_float_ ? write_as<float>(row, bytes) : write_as<double>(row, bytes);
  }
  void read(std::uint64_t row, std::uint64_t from, std::span<char> bytes) const override {
    values_->read(row, from, bytes);
  }
  void finish() const override {
    indices_->finish();
    values_->finish();
  }
  bool is_finished() const override { return values_->is_finished() && indices_->is_finished(); }

 private:
  template <class T>
  void write_as(std::uint64_t row, std::span<const char> bytes) const {
    const auto [value, column] = nearest_of<T>(bytes, count_);
    values_->write(row, 0, std::span<const char>(as_little_endian(std::span<const T>(value))));
    indices_->write(row, 0, std::span<const char>(as_little_endian(std::span<const std::uint32_t>(column))));
  }

  std::unique_ptr<MatrixStore> values_, indices_;
  std::filesystem::path path_;
  std::uint64_t rows_;
  bool is_float_;
  std::size_t count_;
};

}  // namespace

std::unique_ptr<MatrixStore> nearest_store(std::unique_ptr<MatrixStore> values, std::unique_ptr<MatrixStore> indices,
                                           std::filesystem::path path, const StoredMatrix& whole, std::uint64_t count) {
  return std::make_unique<NearestStore>(std::move(values), std::move(indices), std::move(path), whole, count);
}

void require_columns(std::uint64_t nearest, std::uint64_t columns) {
  if (nearest <= columns) return;
  throw Error(ErrorCode::InvalidArgument,
              "the nearest " + std::to_string(nearest) + " of " + std::to_string(columns) + " columns: ask for fewer");
}

template <class T>
bool has_finite(std::span<const T> values, std::size_t count) {
  for (const T value : values) {
    if (count == 0) break;
    if (std::isfinite(value)) --count;
  }
  return count == 0;
}
template bool has_finite(std::span<const float>, std::size_t);
template bool has_finite(std::span<const double>, std::size_t);

std::filesystem::path index_path(const std::filesystem::path& path) {
  std::filesystem::path name = path;
  return name.replace_extension(".index" + path.extension().string());
}

std::vector<double> radii_for_nearest(const Mesh& mesh, std::uint64_t count, double limit) {
  // A row that reaches a good part of the mesh costs little less than one that reaches all of it.
  constexpr std::uint64_t kPart = 8;
  const std::span<const double> lengths = mesh.lengths();
  if (lengths.empty() || count > mesh.vertex_count() / kPart) return {limit};
  const double edge =
      std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size()) * mesh.unit();
  // Of equilateral triangles with this edge every vertex has edge^2 sqrt(3)/2 of the surface; half as much again for
  // places where vertices are sparse.
  constexpr double kRoom = 1.5;
  const double first = edge * std::sqrt(kRoom * static_cast<double>(count) * std::sqrt(3.0) / 2 / kPi);
  std::vector<double> radii;
  for (const double times : {1.0, 2.0, 4.0}) {
    if (times * first < limit) radii.push_back(times * first);
  }
  radii.push_back(limit);
  return radii;
}

}  // namespace brushfire::detail
