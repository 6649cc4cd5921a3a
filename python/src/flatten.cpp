// Surfaces laid flat.
#include "bind.h"
#include "interrupt.h"
#include "options.h"

#include <brushfire/io/write_columns.h>
#include <brushfire/queries/flatten.h>

namespace brushfire::python {
namespace {

std::vector<double> flat_numbers(std::span<const std::array<double, 2>> uv) {
  std::vector<double> numbers;
  for (const auto& [u, v] : uv) numbers.insert(numbers.end(), {u, v});
  return numbers;
}

std::vector<std::array<double, 2>> pairs_from(const Vector<double>& flat) {
  std::vector<std::array<double, 2>> uv(flat.shape(0) / 2);
  for (std::size_t i = 0; i < uv.size(); ++i) uv[i] = {flat.data()[2 * i], flat.data()[2 * i + 1]};
  return uv;
}

nb::dict as_dict(const Distortion& d) {
  nb::dict result;
  result["stress"] = d.stress;
  result["stretch"] = d.stretch;
  result["max_stretch"] = d.max_stretch;
  result["min_stretch"] = d.min_stretch;
  result["angle"] = d.angle;
  result["flipped"] = d.flipped;
  return result;
}

// (mesh, original vertex, original face, landmarks, uv, distortion). With walls these are the seams.
nb::tuple flattened(const Domain& domain, Index landmarks, bool cut, const nb::dict& given, nb::object progress) {
  Computation computation(std::move(progress));
  FlattenOptions options;
  options.distance = options_from(given, computation);
  options.landmarks = landmarks;
  options.cut = cut;
  Flattening flat = computation.run(
      false, [&] { return domain.has_walls() ? flatten(domain, options) : flatten(domain.mesh(), options); });
  const std::size_t count = flat.uv.size();
  return nb::make_tuple(flat.mesh, to_numpy_signed(std::move(flat.original_vertex)),
                        to_numpy_signed(std::move(flat.original_face)), to_numpy_signed(std::move(flat.landmarks)),
                        to_numpy(flat_numbers(flat.uv), {count, 2}), as_dict(flat.distortion));
}

nb::dict distortion(const Mesh& mesh, const Vector<double>& uv) { return as_dict(distortion_of(mesh, pairs_from(uv))); }

Result<double> unit_square(const Vector<double>& uv) {
  const std::vector<std::array<double, 2>> fitted = in_unit_square(pairs_from(uv));
  return to_numpy(flat_numbers(fitted), {fitted.size(), 2});
}

void write_texture(const std::string& path, const Mesh& mesh, const Vector<double>& uv) {
  const nb::gil_scoped_release release;
  write_columns(
      path, mesh,
      {.names = {"u", "v"}, .values = {uv.data(), uv.shape(0)}, .kind = Columns::Kind::Texture, .name = "flattening"});
}

nb::list disc_cuts(const Mesh& mesh, std::int64_t base) {
  if (base < 0 || base >= std::int64_t{mesh.vertex_count()}) base = std::int64_t{mesh.vertex_count()};
  nb::list edges;
  for (const auto& [a, b] : cut_to_disc(mesh, static_cast<Index>(base))) edges.append(nb::make_tuple(a, b));
  return edges;
}

}  // namespace

void bind_flatten(nb::module_& m) {
  m.def("flatten", flattened, nb::arg("domain"), nb::arg("landmarks"), nb::arg("cut"), nb::arg("options"),
        nb::arg("progress").none());
  m.def("distortion", distortion, nb::arg("mesh"), nb::arg("uv").noconvert());
  m.def("in_unit_square", unit_square, nb::arg("uv").noconvert());
  m.def("write_texture", write_texture, nb::arg("path"), nb::arg("mesh"), nb::arg("uv").noconvert());
  m.def("cut_to_disc", disc_cuts, nb::arg("mesh"), nb::arg("base"));
}

}  // namespace brushfire::python
