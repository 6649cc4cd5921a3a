// Distance matrices: into numpy's memory, as CSR arrays, into a file.
#include "options.h"
#include "solver.h"

#include <brushfire/core/detail/memory.h>
#include <brushfire/core/error.h>
#include <brushfire/queries/distance_matrix.h>
#include <brushfire/queries/matrix_job.h>
#include <brushfire/queries/pair_distances.h>

#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace brushfire::python {
namespace {

using OptionalIndex = std::optional<Vector<std::int64_t>>;
using OptionalWeights = std::optional<Triples<double>>;

// Rows or columns: all vertices where there is no index.
std::optional<std::vector<Place>> places_or_all(const OptionalIndex& index, const OptionalWeights& weights) {
  if (!index) return std::nullopt;
  return places_from({*index, weights});
}
Places view(const std::optional<std::vector<Place>>& places) {
  if (!places) return std::nullopt;
  return std::span<const Place>(*places);
}

struct Call {
  Call(const OptionalIndex& row_index, const OptionalWeights& row_weights, const OptionalIndex& column_index,
       const OptionalWeights& column_weights, const nb::dict& given, unsigned threads, nb::object progress)
      : computation(std::move(progress)),
        rows(places_or_all(row_index, row_weights)),
        columns(places_or_all(column_index, column_weights)) {
    options.distance = options_from(given, computation);
    options.threads = threads;
  }

  Computation computation;
  std::optional<std::vector<Place>> rows, columns;
  MatrixOptions options;
};

template <class T>
void fill_matrix(const Domain& domain, const nb::ndarray<T, nb::ndim<2>, nb::c_contig, nb::device::cpu>& out,
                 const OptionalIndex& row_index, const OptionalWeights& row_weights, const OptionalIndex& column_index,
                 const OptionalWeights& column_weights, const nb::dict& given, unsigned threads, nb::object progress) {
  Call call(row_index, row_weights, column_index, column_weights, given, threads, std::move(progress));
  call.computation.run(false, [&] {
    distance_matrix<T>(domain, view(call.rows), view(call.columns), std::span<T>(out.data(), out.size()), call.options);
    return true;
  });
}

// From one vertex to another, each.
Result<double> of_pairs(const Domain& domain, const Vector<std::int64_t>& start, const Vector<std::int64_t>& end,
                        const nb::dict& given, unsigned threads, nb::object progress) {
  Call call(start, {}, end, {}, given, threads, std::move(progress));
  std::vector<std::array<Index, 2>> pairs;
  for (std::size_t i = 0; i < call.rows->size(); ++i) {
    pairs.push_back({std::get<Index>((*call.rows)[i]), std::get<Index>((*call.columns)[i])});
  }
  return to_numpy(call.computation.run(false, [&] { return pair_distances(domain, pairs, call.options); }));
}

template <class T>
nb::tuple sparse(const Domain& domain, double radius, const OptionalIndex& row_index,
                 const OptionalWeights& row_weights, const nb::dict& given, unsigned threads,
                 std::uint64_t memory_limit, nb::object progress) {
  Call call(row_index, row_weights, {}, {}, given, threads, std::move(progress));
  call.options.memory_limit = memory_limit;
  SparseMatrix<T> matrix =
      call.computation.run(false, [&] { return distances_within<T>(domain, radius, view(call.rows), call.options); });
  std::vector<std::int64_t> starts(matrix.row_start.begin(), matrix.row_start.end());
  return nb::make_tuple(to_numpy(std::move(matrix.value)), to_numpy_signed(std::move(matrix.column)),
                        to_numpy(std::move(starts)));
}

// The same rows one after the other with one solver, whose workspace is there already: (distance, vertex, row starts).
nb::tuple sparse_rows(Solver& solver, double radius, const Vector<std::int64_t>& index, const OptionalWeights& weights,
                      const nb::dict& given, nb::object progress) {
  if (!std::isfinite(radius) || radius < 0) {
    throw Error(ErrorCode::InvalidArgument, "radius " + std::to_string(radius) + " is not a finite number >= 0");
  }
  const Mesh& mesh = solver.mesh();
  Computation computation(std::move(progress));
  DistanceOptions options = options_from(given, computation);
  options.max_distance = radius;
  const Progress report = std::exchange(options.progress, {});
  std::vector<double> values;
  std::vector<Index> vertices;
  std::vector<std::int64_t> starts{0};
  computation.run(false, [&] {
    const std::vector<Place> rows = places_from({index, weights});
    SparseField field;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Index* vertex = std::get_if<Index>(&rows[i]);
      // A vertex in no face is a legal place, from which nothing is reached.
      if (!vertex || *vertex >= mesh.vertex_count() || solver.domain().is_open(*vertex)) {
        const Source source{vertex ? vertex_point(mesh, *vertex) : std::get<SurfacePoint>(rows[i])};
        solver.with([&](DistanceSolver& s) { s.distance_sparse(std::span(&source, 1), options, field); });
        values.insert(values.end(), field.distance.begin(), field.distance.end());
        vertices.insert(vertices.end(), field.vertex.begin(), field.vertex.end());
      }
      starts.push_back(static_cast<std::int64_t>(values.size()));
      if (options.cancel->cancelled()) throw Error(ErrorCode::Cancelled, "cancelled");
      if (report) report(static_cast<double>(i + 1) / static_cast<double>(rows.size()));
    }
    return true;
  });
  return nb::make_tuple(to_numpy(std::move(values)), to_numpy_signed(std::move(vertices)), to_numpy(std::move(starts)));
}

MatrixFileOptions file_options_from(const std::string& symmetric, std::uint64_t chunk_rows, int zarr_format,
                                    std::uint64_t shard, std::uint64_t shards, std::uint64_t nearest) {
  MatrixFileOptions options;
  options.chunk_rows = chunk_rows;
  options.zarr_format = zarr_format;
  options.shard = shard;
  options.shards = shards;
  options.nearest = nearest;
  if (!symmetric.empty()) options.symmetry = symmetric == "mean" ? Symmetry::Mean : Symmetry::Minimum;
  return options;
}

// Returns where the matrix, or this shard of it, is.
std::string write(const Domain& domain, const std::string& path, bool float32, const OptionalIndex& row_index,
                  const OptionalWeights& row_weights, const OptionalIndex& column_index,
                  const OptionalWeights& column_weights, const nb::dict& given, unsigned threads,
                  const std::string& symmetric, std::uint64_t chunk_rows, int zarr_format, std::uint64_t shard,
                  std::uint64_t shards, std::uint64_t nearest, nb::object progress) {
  Call call(row_index, row_weights, column_index, column_weights, given, threads, std::move(progress));
  const MatrixFileOptions file = file_options_from(symmetric, chunk_rows, zarr_format, shard, shards, nearest);
  return call.computation.run(false, [&] {
    MatrixJob job(path, domain, view(call.rows), view(call.columns), float32 ? ValueType::Float32 : ValueType::Float64,
                  call.options, file);
    job.run();
    return job.output().string();
  });
}

// A job that is joined for one block of rows after the other. One call at a time.
class Job {
 public:
  Job(const Domain& domain, const std::string& path, bool float32, const OptionalIndex& row_index,
      const OptionalWeights& row_weights, const OptionalIndex& column_index, const OptionalWeights& column_weights,
      const nb::dict& given, unsigned threads, const std::string& symmetric, std::uint64_t chunk_rows, int zarr_format)
      : call_(row_index, row_weights, column_index, column_weights, given, threads, nb::none()) {
    const nb::gil_scoped_release release;
    job_.emplace(path, domain, view(call_.rows), view(call_.columns), float32 ? ValueType::Float32 : ValueType::Float64,
                 call_.options, file_options_from(symmetric, chunk_rows, zarr_format, 1, 1, 0));
  }

  std::size_t rows() const { return job_->rows(); }
  std::size_t done() const { return job_->done(); }
  std::size_t run_block(std::size_t block, std::size_t blocks) {
    return call_.computation.run(false, [&] { return job_->run_block(block, blocks); });
  }
  void run() {
    call_.computation.run(false, [&] {
      job_->run();
      return true;
    });
  }

 private:
  Call call_;
  std::optional<MatrixJob> job_;
};

void merge(const std::vector<std::string>& shards, const std::string& path, const std::string& symmetric,
           std::uint64_t chunk_rows, int zarr_format, std::uint64_t nearest) {
  const std::vector<std::filesystem::path> paths(shards.begin(), shards.end());
  Computation computation{nb::none()};
  computation.run(false, [&] {
    merge_shards(paths, path, file_options_from(symmetric, chunk_rows, zarr_format, 1, 1, nearest));
    return true;
  });
}

void require_dense(std::size_t rows, std::size_t columns, bool float32, std::uint64_t limit) {
  require_dense_memory(rows, columns, float32 ? ValueType::Float32 : ValueType::Float64, limit);
}

template <class T>
void bind_typed(nb::module_& m) {
  m.def("fill_matrix", fill_matrix<T>, nb::arg("domain"), nb::arg("out").noconvert(), nb::arg("row_index").none(),
        nb::arg("row_weights").none(), nb::arg("column_index").none(), nb::arg("column_weights").none(),
        nb::arg("options"), nb::arg("threads"), nb::arg("progress").none());
}

}  // namespace

void bind_matrix(nb::module_& m) {
  bind_typed<float>(m);
  bind_typed<double>(m);
  for (const bool is_float : {true, false}) {
    m.def(is_float ? "sparse_float32" : "sparse_float64", is_float ? sparse<float> : sparse<double>, nb::arg("domain"),
          nb::arg("radius"), nb::arg("row_index").none(), nb::arg("row_weights").none(), nb::arg("options"),
          nb::arg("threads"), nb::arg("memory_limit"), nb::arg("progress").none());
  }
  m.def("sparse_rows", sparse_rows, nb::arg("solver"), nb::arg("radius"), nb::arg("index").noconvert(),
        nb::arg("weights").noconvert().none(), nb::arg("options"), nb::arg("progress").none());
  m.def("pair_distances", of_pairs, nb::arg("domain"), nb::arg("start").noconvert(), nb::arg("end").noconvert(),
        nb::arg("options"), nb::arg("threads"), nb::arg("progress").none());
  m.def("write_matrix", write, nb::arg("domain"), nb::arg("path"), nb::arg("float32"), nb::arg("row_index").none(),
        nb::arg("row_weights").none(), nb::arg("column_index").none(), nb::arg("column_weights").none(),
        nb::arg("options"), nb::arg("threads"), nb::arg("symmetric"), nb::arg("chunk_rows"), nb::arg("zarr_format"),
        nb::arg("shard"), nb::arg("shards"), nb::arg("nearest"), nb::arg("progress").none());
  nb::class_<Job>(m, "MatrixJob")
      .def(nb::init<const Domain&, const std::string&, bool, const OptionalIndex&, const OptionalWeights&,
                    const OptionalIndex&, const OptionalWeights&, const nb::dict&, unsigned, const std::string&,
                    std::uint64_t, int>(),
           nb::arg("domain"), nb::arg("path"), nb::arg("float32"), nb::arg("row_index").none(),
           nb::arg("row_weights").none(), nb::arg("column_index").none(), nb::arg("column_weights").none(),
           nb::arg("options"), nb::arg("threads"), nb::arg("symmetric"), nb::arg("chunk_rows"), nb::arg("zarr_format"))
      .def_prop_ro("rows", &Job::rows)
      .def_prop_ro("done", &Job::done)
      .def("run_block", &Job::run_block, nb::arg("block"), nb::arg("blocks"))
      .def("run", &Job::run);
  m.def("merge_shards", merge, nb::arg("shards"), nb::arg("path"), nb::arg("symmetric"), nb::arg("chunk_rows"),
        nb::arg("zarr_format"), nb::arg("nearest"));
  m.def("require_dense_memory", require_dense, nb::arg("rows"), nb::arg("columns"), nb::arg("float32"),
        nb::arg("limit"));
}

}  // namespace brushfire::python
