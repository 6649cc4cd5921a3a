// Points and curves as engines see them.
#include <brushfire/core/error.h>
#include <brushfire/solvers/detail/engine.h>

#include <string>
#include <utility>

namespace brushfire::detail {
namespace {

// As engines see it: in mesh.unit(), offsets from the least one on.
std::shared_ptr<const LocatedCurve> for_engines(const Mesh& mesh, LocatedCurve curve) {
  const double unit = mesh.unit(), least = curve.least_offset;
  for (CurvePlace& p : curve.places) p.offset = (p.offset - least) / unit;
  for (CurveSegment& s : curve.segments) {
    s.from_offset = (s.from_offset - least) / unit;
    s.to_offset = (s.to_offset - least) / unit;
    s.length /= unit;
  }
  curve.least_offset = 0;
  return std::make_shared<const LocatedCurve>(std::move(curve));
}

}  // namespace

LocatedSource located(const Mesh& mesh, const Source& source, Index label) {
  if (!source.curve) return {locate(mesh, source.point), source.offset, label};
  LocatedCurve curve;
  try {
    curve = locate(mesh, *source.curve);
  } catch (const Error& e) {
    throw Error(e.code(), "source " + std::to_string(label) + ": " + e.what());
  }
  const double offset = source.offset + curve.least_offset;
  return {curve.places.front().at, offset, label, for_engines(mesh, std::move(curve))};
}

}  // namespace brushfire::detail
