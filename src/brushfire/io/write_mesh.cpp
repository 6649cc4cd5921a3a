// Which writer a name asks for, and the formats that hold a mesh and no values.
#include <brushfire/core/detail/decimal.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/names.h>
#include <brushfire/io/formats.h>
#include <brushfire/io/write_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brushfire {

namespace detail {

namespace {

constexpr std::endian kLittle = std::endian::little, kBig = std::endian::big;

void write_point(Output& out, const Vec3& p) { out.numbers({p.x, p.y, p.z}, ' '); }

void write_corners(Output& out, const Face& f, std::int64_t counts_from) {
  for (const Index v : f) {
    out.number(v + counts_from);
    out.write(' ');
  }
}

void write_float_point(Output& out, const Vec3& p, std::endian order) {
  for (const double x : {p.x, p.y, p.z}) out.value(static_cast<float>(x), order);
}

Vec3 normal_of(const Mesh& mesh, const Face& f) {
  const auto p = mesh.positions();
  const Vec3 n = cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]);
  const double length = norm(n);
  return length > 0 ? (1 / length) * n : Vec3{0, 0, 0};
}

// The header must not start with "solid", which is for text.
void write_stl(Output& out, const Mesh& mesh) {
  std::string header = "binary STL by brushfire";
  header.resize(80, ' ');
  out.write(header);
  out.value(mesh.face_count(), kLittle);
  for (const Face& f : mesh.faces()) {
    write_float_point(out, normal_of(mesh, f), kLittle);
    for (const Index v : f) write_float_point(out, mesh.positions()[v], kLittle);
    out.value(std::uint16_t{0}, kLittle);
  }
}

void write_off(Output& out, const Mesh& mesh) {
  out.write("OFF\n" + std::to_string(mesh.vertex_count()) + " " + std::to_string(mesh.face_count()) + " 0\n");
  for (const Vec3& p : mesh.positions()) {
    write_point(out, p);
    out.write('\n');
  }
  for (const Face& f : mesh.faces()) {
    out.write("3 ");
    write_corners(out, f, 0);
    out.write('\n');
  }
}

void write_gmsh(Output& out, const Mesh& mesh) {
  out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(mesh.vertex_count()) + "\n");
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    out.number(std::int64_t{v} + 1);
    out.write(' ');
    write_point(out, mesh.positions()[v]);
    out.write('\n');
  }
  out.write("$EndNodes\n$Elements\n" + std::to_string(mesh.face_count()) + "\n");
  for (Index f = 0; f < mesh.face_count(); ++f) {
    out.number(std::int64_t{f} + 1);
    out.write(" 2 2 0 1 ");  // a triangle with two tags
    write_corners(out, mesh.faces()[f], 1);
    out.write('\n');
  }
  out.write("$EndElements\n");
}

void write_medit(Output& out, const Mesh& mesh) {
  out.write("MeshVersionFormatted 2\nDimension 3\nVertices\n" + std::to_string(mesh.vertex_count()) + "\n");
  for (const Vec3& p : mesh.positions()) {
    write_point(out, p);
    out.write(" 0\n");
  }
  out.write("Triangles\n" + std::to_string(mesh.face_count()) + "\n");
  for (const Face& f : mesh.faces()) {
    write_corners(out, f, 1);
    out.write("0\n");
  }
  out.write("End\n");
}

// Version 3: doubles, 32-bit numbers, 64-bit places of the next section.
void write_medit_binary(Output& out, const Mesh& mesh) {
  constexpr std::int64_t kStart = 8, kHead = 12, kVertex = 28, kFace = 16;
  const auto vertices = static_cast<std::int32_t>(mesh.vertex_count()),
             faces = static_cast<std::int32_t>(mesh.face_count());
  std::int64_t at = kStart;
  const auto section = [&](std::int32_t keyword, std::int64_t size) {
    at += kHead + size;
    out.value(keyword, kLittle);
    out.value(keyword == 54 ? std::int64_t{0} : at, kLittle);
  };
  out.value(std::int32_t{1}, kLittle);
  out.value(std::int32_t{3}, kLittle);
  section(3, 4);
  out.value(std::int32_t{3}, kLittle);
  section(4, 4 + kVertex * vertices);
  out.value(vertices, kLittle);
  for (const Vec3& p : mesh.positions()) {
    for (const double x : {p.x, p.y, p.z}) out.value(x, kLittle);
    out.value(std::int32_t{0}, kLittle);
  }
  section(6, 4 + kFace * faces);
  out.value(faces, kLittle);
  for (const Face& f : mesh.faces()) {
    for (const Index v : f) out.value(v + 1, kLittle);
    out.value(std::int32_t{0}, kLittle);
  }
  section(54, 0);
}

void write_freesurfer(Output& out, const Mesh& mesh) {
  out.write(
      "\xff\xff\xfe"
      "created by brushfire\n\n");
  out.value(mesh.vertex_count(), kBig);
  out.value(mesh.face_count(), kBig);
  for (const Vec3& p : mesh.positions()) write_float_point(out, p, kBig);
  for (const Face& f : mesh.faces()) {
    for (const Index v : f) out.value(v, kBig);
  }
}

void write_freesurfer_text(Output& out, const Mesh& mesh) {
  out.write("#!ascii version of a surface, by brushfire\n" + std::to_string(mesh.vertex_count()) + " " +
            std::to_string(mesh.face_count()) + "\n");
  for (const Vec3& p : mesh.positions()) {
    write_point(out, p);
    out.write(" 0\n");
  }
  for (const Face& f : mesh.faces()) {
    write_corners(out, f, 0);
    out.write("0\n");
  }
}

std::string three_floats(const Vec3& p) {
  const auto text = [](double x) {
    char digits[kLongestDecimal];
    return std::string(digits, write_shortest(digits, static_cast<float>(x)));
  };
  return "[" + text(p.x) + "," + text(p.y) + "," + text(p.z) + "]";
}

void write_glb(Output& out, const Mesh& mesh) {
  const std::uint64_t points = std::uint64_t{12} * mesh.vertex_count(), corners = std::uint64_t{12} * mesh.face_count();
  const auto view = [](std::uint64_t offset, std::uint64_t size, int target) {
    return "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) + ",\"byteLength\":" + std::to_string(size) +
           ",\"target\":" + std::to_string(target) + "}";
  };
  const Box box = mesh.vertex_count() != 0 ? mesh.bounds() : Box{{0, 0, 0}, {0, 0, 0}};
  std::string json =
      "{\"asset\":{\"version\":\"2.0\",\"generator\":\"brushfire\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
      "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
      "\"buffers\":[{\"byteLength\":" +
      std::to_string(points + corners) + "}],\"bufferViews\":[" + view(0, points, 34962) + "," +
      view(points, corners, 34963) +
      "],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":" +
      std::to_string(mesh.vertex_count()) + ",\"min\":" + three_floats(box.low) + ",\"max\":" + three_floats(box.high) +
      "},{\"bufferView\":1,\"componentType\":5125,\"type\":\"SCALAR\",\"count\":" +
      std::to_string(std::uint64_t{3} * mesh.face_count()) + "}]}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::uint64_t size = 28 + json.size() + points + corners;
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::TooLarge, "a mesh of " + std::to_string(size) + " bytes does not fit into a .glb file");
  }
  out.write("glTF");
  out.value(std::uint32_t{2}, kLittle);
  out.value(static_cast<std::uint32_t>(size), kLittle);
  out.value(static_cast<std::uint32_t>(json.size()), kLittle);
  out.write("JSON" + json);
  out.value(static_cast<std::uint32_t>(points + corners), kLittle);
  out.write(std::string_view("BIN\0", 4));
  for (const Vec3& p : mesh.positions()) write_float_point(out, p, kLittle);
  for (const Face& f : mesh.faces()) {
    for (const Index v : f) out.value(v, kLittle);
  }
}

// Writers of fields write the mesh alone where there is none.
template <void (*write)(Output&, const Mesh&, const FieldView&)>
void without_field(Output& out, const Mesh& mesh) {
  write(out, mesh, {});
}

struct MeshWriter {
  const char* name;
  std::initializer_list<std::string_view> extensions;
  bool in_floats;
  void (*write)(Output& out, const Mesh& mesh);
};

constexpr std::string_view kGifti = "gii";  // the one that takes a structure

// A new writer is one line here.
const MeshWriter kMeshWriters[]{
    {"PLY", {"ply"}, false, without_field<write_ply>},
    {"OBJ", {"obj"}, false, without_field<write_obj>},
    {"OFF", {"off"}, false, write_off},
    {"STL", {"stl"}, true, write_stl},
    {"VTK", {"vtk"}, false, without_field<write_vtk>},
    {"VTP", {"vtp"}, false, without_field<write_vtp>},
    {"GIFTI", {kGifti}, true, nullptr},
    {"FreeSurfer", {"white", "pial", "inflated", "sphere", "orig", "smoothwm"}, true, write_freesurfer},
    {"FreeSurfer text", {"asc"}, false, write_freesurfer_text},
    {"glTF", {"glb"}, true, write_glb},
    {"Gmsh", {"msh"}, false, write_gmsh},
    {"MEDIT", {"mesh"}, false, write_medit},
    {"MEDIT binary", {"meshb"}, false, write_medit_binary},
};

const MeshWriter& mesh_writer_for(const std::string& path, const std::string& format) {
  const std::string extension = extension_or(format, path);
  std::string known;
  for (const MeshWriter& w : kMeshWriters) {
    if (std::find(w.extensions.begin(), w.extensions.end(), extension) != w.extensions.end()) return w;
    known += std::string(known.empty() ? "" : ", ") + std::string(*w.extensions.begin());
  }
  throw Error(ErrorCode::UnknownFormat,
              printable(path) + ": no mesh is written as " + quote(extension) + " (known: " + known + ")");
}

// A float ends at 3.4e38, where a double does not.
void check_range(const Mesh& mesh, const char* name) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  const Box& box = mesh.bounds();
  for (const Vec3& corner : {box.low, box.high}) {
    for (const double x : {corner.x, corner.y, corner.z}) {
      if (mesh.vertex_count() != 0 && std::abs(x) > kLargest) {
        throw Error(ErrorCode::InvalidArgument, std::string(name) + " stores floats, which end before this mesh does");
      }
    }
  }
}

}  // namespace

}  // namespace detail

std::vector<FileFormat> meshes_written() {
  std::vector<FileFormat> formats;
  for (const detail::MeshWriter& w : detail::kMeshWriters) {
    formats.push_back({w.name, {w.extensions.begin(), w.extensions.end()}});
  }
  return formats;
}

void check_mesh_format(const std::string& path, const std::string& format) { detail::mesh_writer_for(path, format); }

namespace detail {
namespace {

void write_mesh_to(const Destination& to, const Mesh& mesh, const std::string& format, const std::string& structure) {
  const MeshWriter& writer = mesh_writer_for(to.name, format);
  if (!mesh.has_positions() && mesh.face_count() != 0) {
    throw Error(ErrorCode::InvalidArgument,
                std::string("a mesh from lengths has no positions to write as ") + writer.name);
  }
  if (writer.in_floats) check_range(mesh, writer.name);
  Output out(to);
  if (writer.write == nullptr) {
    write_gifti_surface(out, mesh, structure);
  } else {
    writer.write(out, mesh);
  }
  out.commit();
}

}  // namespace
}  // namespace detail

void write_mesh(const std::string& path, const Mesh& mesh, const std::string& format, const std::string& structure) {
  detail::write_mesh_to({path}, mesh, format, structure);
}

std::vector<std::uint8_t> encode_mesh(const Mesh& mesh, const std::string& format, const std::string& structure) {
  std::vector<std::uint8_t> bytes;
  detail::write_mesh_to({"mesh." + format, &bytes}, mesh, format, structure);
  return bytes;
}

}  // namespace brushfire
