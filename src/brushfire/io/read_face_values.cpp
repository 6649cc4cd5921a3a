// The formats whose faces have values.
#include <brushfire/io/read_face_values.h>

#include <brushfire/core/error.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/text.h>

#include <string_view>

namespace brushfire {

std::vector<double> read_face_values(const std::string& path, const std::string& name) {
  detail::Input input = detail::Input::from_file(path);
  input.drop_byte_order_mark();
  const std::string_view bytes = input.bytes();
  if (bytes.starts_with("ply")) return detail::read_ply_face_field(input, name).values;
  if (bytes.starts_with("# vtk DataFile")) return detail::read_vtk_face_field(input, name).values;
  if (bytes.substr(0, 1024).find("<VTKFile") != std::string_view::npos) {
    return detail::read_vtp_face_field(input, name).values;
  }
  throw Error(ErrorCode::UnknownFormat,
              detail::printable(path) + ": values of faces are read from .ply, .vtk, .vtp and .vtu");
}

}  // namespace brushfire
