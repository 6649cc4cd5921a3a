// From everything that a row depends on to one number.
#include <brushfire/queries/detail/fingerprint.h>

#include <brushfire/solvers/weighted/weighting.h>
#include <brushfire/version.h>

namespace brushfire::detail {

void Fingerprint::add(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) hash_ = (hash_ ^ bytes[i]) * 0x100000001b3;
}

void Fingerprint::add(const Place& place) {
  if (const Index* v = std::get_if<Index>(&place)) return add(std::uint64_t{*v});
  const SurfacePoint& p = std::get<SurfacePoint>(place);
  add(std::uint64_t{p.face} | std::uint64_t{1} << 63);
  add(p.weights.data(), sizeof p.weights);
}

void Fingerprint::add(const Places& places) {
  add(std::uint64_t{places.has_value()});
  if (!places) return;
  add(std::uint64_t{places->size()});
  for (const Place& p : *places) add(p);
}

void Fingerprint::add(const Weighting& weighting) {
  add(weighting.options().tolerance);
  add(std::uint64_t{weighting.options().towards});
  if (weighting.options().marching) add(static_cast<std::uint64_t>(*weighting.options().marching));
  const Weights& weights = weighting.weights();
  add(weights.face.data(), weights.face.size() * sizeof(double));
  for (const EdgeCost& e : weights.edges) {
    add(std::uint64_t{e.vertices[0]} << 32 | e.vertices[1]);
    add(e.along);
    add(e.crossing);
  }
  for (const Grain& g : weights.grain) {
    for (const double x : {g.direction.x, g.direction.y, g.direction.z, g.across}) add(x);
  }
  if (!weights.pace) return;
  constexpr int kSamples = 1000;  // on each side of the flat, up to 45 degrees and beyond
  for (int i = -kSamples; i <= kSamples; ++i) add((*weights.pace)(i * (1.5 / kSamples)));
}

std::uint64_t fingerprint_of(const Domain& domain, const Places& rows, const Places& columns, ValueType type,
                             const DistanceOptions& options, double unit) {
  const Mesh& mesh = domain.open();
  Fingerprint f;
  f.add(std::string_view(kVersion));
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
  if (options.weighting) f.add(*options.weighting);
  if (unit != 1) f.add(unit);
  return f.value();
}

}  // namespace brushfire::detail
