// Feeds arbitrary bytes to one reader: a result or an Error of one line is fine, anything else is a finding.
//
// FUZZ_MESH, FUZZ_FIELD, FUZZ_FACES, FUZZ_LINES and FUZZ_GRID name the functions of io/detail/formats.h and
// ascii_grid.h that this program is for.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/ascii_grid.h>
#include <brushfire/io/detail/formats.h>

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

using namespace brushfire;

void check(const Error& e) {
  const std::string_view what = e.what();
  if (what.empty() || what.find('\n') != std::string_view::npos) std::abort();
}

void read_once(const detail::Input& input) {
#ifdef FUZZ_MESH
  try {
    const LoadedMesh loaded = detail::finish(input, detail::FUZZ_MESH(input), "");
    const Index faces = loaded.mesh.face_count();
    if (!loaded.face_origin.empty() && loaded.face_origin.size() != faces) std::abort();
    if (!loaded.vertex_map.empty() && loaded.vertex_map.size() != loaded.mesh.halfedge_count()) std::abort();
  } catch (const Error& e) {
    check(e);
  }
#endif
#ifdef FUZZ_FIELD
  try {
    const LoadedField field = detail::FUZZ_FIELD(input, "");
    if (!field.vertices.empty() && field.vertices.size() != field.values.size()) std::abort();
  } catch (const Error& e) {
    check(e);
  }
#endif
#ifdef FUZZ_FACES
  try {
    if (!detail::FUZZ_FACES(input, "").vertices.empty()) std::abort();
  } catch (const Error& e) {
    check(e);
  }
#endif
#ifdef FUZZ_GRID
  try {
    const Grid grid = detail::FUZZ_GRID(input);
    if (grid.heights.size() != std::size_t{grid.columns} * grid.rows) std::abort();
    // As one of few heights is used; what a mesh of them does is no reader's.
    if (grid.heights.size() <= 10000) grid.terrain();
  } catch (const Error& e) {
    check(e);
  }
#endif
#ifdef FUZZ_LINES
  try {
    for (const LoadedLine& line : detail::FUZZ_LINES(input).lines) {
      const std::size_t positions = line.positions.size(), points = line.points.size();
      if (positions != points && positions != 0 && points != 0) std::abort();
    }
  } catch (const Error& e) {
    check(e);
  }
#endif
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    auto input = detail::Input::from_memory({reinterpret_cast<const char*>(data), size}, "input");
    input.drop_byte_order_mark();
    read_once(input);
  } catch (const Error& e) {
    check(e);  // of the decompression
  }
  return 0;
}
