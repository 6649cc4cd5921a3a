// PLY, written: a mesh with values, their colours and labels.
#include <brushfire/io/detail/binary.h>
#include <brushfire/io/detail/colours.h>
#include <brushfire/io/detail/formats.h>

namespace brushfire::detail {

// Binary, little-endian. MeshLab reads `quality` and the colours.
void write_ply(Output& out, const Mesh& mesh, const FieldView& field) {
  constexpr std::endian kOrder = std::endian::little;
  const bool has_values = !field.values.empty(), has_labels = !field.labels.empty();
  out.write("ply\nformat binary_little_endian 1.0\n");
  if (has_values) out.write("comment quality is " + printable(field.name) + "\n");
  out.write("element vertex " + std::to_string(mesh.vertex_count()) + "\n");
  out.write("property double x\nproperty double y\nproperty double z\n");
  if (has_values) {
    out.write("property double quality\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n");
  }
  if (has_labels) out.write("property int " + field.label_name + "\n");
  out.write("element face " + std::to_string(mesh.face_count()) +
            "\nproperty list uchar int vertex_indices\nend_header\n");
  const ColourScale scale(field.values);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3& p = mesh.positions()[v];
    for (const double x : {p.x, p.y, p.z}) out.value(x, kOrder);
    if (has_values) {
      out.value(field.values[v], kOrder);
      for (const std::uint8_t c : scale(field.values[v])) out.value(c, kOrder);
    }
    if (has_labels) out.value(field.labels[v], kOrder);
  }
  for (const Face& f : mesh.faces()) {
    out.value(std::uint8_t{3}, kOrder);
    for (const Index v : f) out.value(v, kOrder);
  }
}

}  // namespace brushfire::detail
