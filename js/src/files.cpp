// Files as bytes: meshes and fields in; meshes, fields and curves out.
#include "curves.h"

#include <brushfire/core/error.h>
#include <brushfire/io/formats.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/io/write_field.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/io/write_mesh.h>

#include <cstddef>

namespace brushfire::js {
namespace {

std::span<const std::byte> bytes_of(const std::uint8_t* data, std::size_t size) {
  return std::as_bytes(std::span(data, size));
}

std::string listed(const std::vector<FileFormat>& formats) {
  std::string text;
  for (const FileFormat& f : formats) {
    text += f.name;
    for (const std::string& e : f.extensions) text += "\t" + e;
    text += "\n";
  }
  return text;
}

}  // namespace

// Of meshes read and written, fields read and written, curves written: a line per format, its name and extensions.
BRUSHFIRE_EXPORT(formats)
Reply* formats() {
  return answer([](Reply& reply) {
    for (const auto& list : {meshes_read(), meshes_written(), fields_read(), fields_written(), lines_written()}) {
      reply.add(listed(list));
    }
  });
}

// [mesh; format, structure; face origin, vertex map; remarks]
BRUSHFIRE_EXPORT(mesh_read)
Reply* mesh_read(const std::uint8_t* content, std::size_t size, const char* name, std::size_t name_size) {
  return answer([&](Reply& reply) {
    const Computation listening;
    LoadedMesh loaded = read_mesh(bytes_of(content, size), std::string(name, name_size));
    reply.add_numbers({handle_of(new Surface(std::move(loaded.mesh)))});
    reply.add(std::move(loaded.format));
    reply.add(std::move(loaded.structure));
    reply.add(std::move(loaded.face_origin));
    reply.add(std::move(loaded.vertex_map));
    for (std::string& remark : loaded.remarks) reply.add(std::move(remark));
  });
}

// [values; vertices; name, format]
BRUSHFIRE_EXPORT(field_read)
Reply* field_read(const std::uint8_t* content, std::size_t size, const char* file, std::size_t file_size,
                  const char* name, std::size_t name_size) {
  return answer([&](Reply& reply) {
    const Computation listening;
    LoadedField f = read_field(bytes_of(content, size), std::string(file, file_size), std::string(name, name_size));
    reply.add(std::move(f.values));
    reply.add(std::move(f.vertices));
    reply.add(std::move(f.name));
    reply.add(std::move(f.format));
  });
}

// The mesh alone where there are neither values nor labels, and the format is one of meshes.
BRUSHFIRE_EXPORT(mesh_write)
Reply* mesh_write(const Surface* surface, const char* format, std::size_t format_size, const double* values,
                  std::size_t value_count, const std::int32_t* labels, std::size_t label_count, const char* name,
                  std::size_t name_size, const char* label_name, std::size_t label_name_size) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const std::string extension(format, format_size);
    if (value_count == 0 && label_count == 0) return reply.add(encode_mesh(surface->mesh(), extension));
    FieldView field{.values = {values, value_count}, .labels = {reinterpret_cast<const Index*>(labels), label_count}};
    if (name_size != 0) field.name = std::string(name, name_size);
    if (label_name_size != 0) field.label_name = std::string(label_name, label_name_size);
    reply.add(encode_field(surface->mesh(), field, extension));
  });
}

// Curves as add_curves() gives them, and a value of each.
BRUSHFIRE_EXPORT(curves_write)
Reply* curves_write(const Surface* surface, const char* format, std::size_t format_size, const std::uint32_t* starts,
                    std::size_t start_count, const std::uint8_t* closed, std::size_t closed_count, const double* values,
                    std::size_t value_count, const std::uint32_t* faces, std::size_t face_count, const double* weights,
                    std::size_t weight_count, const char* value_name, std::size_t value_name_size, double millimetres,
                    const char* view, std::size_t view_size, int outline) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const std::vector<SurfacePoint> points = curve_from({faces, face_count}, {weights, weight_count});
    if (start_count == 0 || closed_count + 1 != start_count || value_count + 1 != start_count) {
      throw Error(ErrorCode::InvalidArgument, "one value per curve is needed");
    }
    std::vector<SurfacePath> lines;
    for (std::size_t k = 0; k + 1 < start_count; ++k) {
      if (starts[k] > starts[k + 1] || starts[k + 1] > points.size()) {
        throw Error(ErrorCode::InvalidArgument, "curves begin where the one before ends");
      }
      lines.push_back({{points.begin() + starts[k], points.begin() + starts[k + 1]}, values[k], closed[k] != 0});
    }
    LinesOptions options{millimetres, std::string(view, view_size), outline != 0, {values, value_count}};
    reply.add(encode_lines(surface->mesh(), lines, std::string(value_name, value_name_size),
                           std::string(format, format_size), options));
  });
}

}  // namespace brushfire::js
