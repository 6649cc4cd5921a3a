// Which format a file has, and the way from its reader to a mesh.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/text.h>
#include <brushfire/io/formats.h>
#include <brushfire/io/read_mesh.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace brushfire {

namespace detail {

namespace {

bool starts_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

// Marks of text formats: `t` starts at the first character that is no white space.
bool is_ply(std::string_view t) { return starts_with(t, "ply\n") || starts_with(t, "ply\r") || starts_with(t, "ply "); }
bool is_off(std::string_view t) {
  return starts_with(t, "OFF") || starts_with(t, "COFF") || starts_with(t, "NOFF") || starts_with(t, "CNOFF") ||
         starts_with(t, "STOFF");
}
bool is_vtk(std::string_view t) { return starts_with(t, "# vtk DataFile"); }
bool is_gmsh(std::string_view t) { return starts_with(t, "$MeshFormat"); }
bool is_medit(std::string_view t) { return starts_with(t, "MeshVersionFormatted"); }
bool is_freesurfer_text(std::string_view t) { return starts_with(t, "#!ascii") && !starts_with(t, "#!ascii label"); }
// XML says what it is within its first lines.
std::string_view xml_head(std::string_view t) { return starts_with(t, "<") ? t.substr(0, 1024) : std::string_view(); }
bool is_vtu(std::string_view t) {
  const std::string_view head = xml_head(t);
  return head.find("<VTKFile") != std::string_view::npos && head.find("\"UnstructuredGrid\"") != std::string_view::npos;
}
bool is_vtp(std::string_view t) { return xml_head(t).find("<VTKFile") != std::string_view::npos && !is_vtu(t); }
bool is_gifti(std::string_view t) { return xml_head(t).find("<GIFTI") != std::string_view::npos; }
// Marks of binary formats: `b` is the content as it is.
bool is_freesurfer(std::string_view b) { return starts_with(b, "\xff\xff\xfe") || starts_with(b, "\xff\xff\xfd"); }
bool is_unmarked(std::string_view) { return false; }

// OBJ has no mark: a first statement of its own is taken for one where there is no name, as on standard input.
bool looks_like_obj(std::string_view t) {
  while (!t.empty() && (t[0] == '#' || TextCursor::is_line_end(t[0]))) {
    t.remove_prefix(t[0] == '#' ? std::min(t.find_first_of("\r\n"), t.size()) : 1);
  }
  for (const std::string_view keyword : {"v", "vn", "vt", "o", "g", "s", "mtllib", "usemtl"}) {
    const bool is_it = starts_with(t, keyword) && t.size() > keyword.size();
    if (is_it && TextCursor::is_blank(t[keyword.size()])) return true;
  }
  return false;
}

enum class Content : std::uint8_t { Text, Binary };

struct Format {
  const char* name;
  std::initializer_list<std::string_view> extensions;
  Content marked_as;
  bool (*is_marked)(std::string_view content);  // the content says so itself
  MeshParts (*read)(const Input& input);
};

// A new reader is one line here.
const Format kFormats[]{
    {"PLY", {"ply"}, Content::Text, is_ply, read_ply},
    {"OBJ", {"obj"}, Content::Text, is_unmarked, read_obj},
    {"OFF", {"off", "coff", "noff", "cnoff"}, Content::Text, is_off, read_off},
    {"VTK", {"vtk"}, Content::Text, is_vtk, read_vtk},
    {"VTP", {"vtp"}, Content::Text, is_vtp, read_vtp},
    {"VTU", {"vtu"}, Content::Text, is_vtu, read_vtp},
    {"GIFTI", {"gii"}, Content::Text, is_gifti, read_gifti},
    {"FreeSurfer",
     {"white", "pial", "inflated", "sphere", "orig", "smoothwm"},
     Content::Binary,
     is_freesurfer,
     read_freesurfer},
    {"FreeSurfer text", {"asc"}, Content::Text, is_freesurfer_text, read_freesurfer_text},
    {"glTF", {"gltf", "glb"}, Content::Binary, is_gltf, read_gltf},
    {"Gmsh", {"msh"}, Content::Text, is_gmsh, read_gmsh},
    {"MEDIT", {"mesh"}, Content::Text, is_medit, read_medit},
    {"MEDIT binary", {"meshb"}, Content::Binary, is_medit_binary, read_medit_binary},
    {"STL", {"stl"}, Content::Binary, is_stl, read_stl},
    {"3MF", {"3mf"}, Content::Binary, is_3mf, read_3mf},
};

const Format& format_of(const Input& input, std::vector<std::string>& remarks) {
  const std::string extension = input.extension();
  const Format* by_name = nullptr;
  const Format* by_content = nullptr;
  for (const Format& f : kFormats) {
    if (std::find(f.extensions.begin(), f.extensions.end(), extension) != f.extensions.end()) by_name = &f;
    const std::string_view content = f.marked_as == Content::Text ? text_start(input.bytes()) : input.bytes();
    if (by_content == nullptr && f.is_marked(content)) by_content = &f;
  }
  if (by_content != nullptr) {
    if (by_name != nullptr && by_name != by_content) {
      remarks.push_back("the name says " + std::string(by_name->name) + ", but the content is " + by_content->name);
    }
    return *by_content;
  }
  if (by_name != nullptr) return *by_name;
  if (looks_like_obj(text_start(input.bytes()))) {
    return *std::find_if(std::begin(kFormats), std::end(kFormats), [](const Format& f) { return f.read == read_obj; });
  }
  std::string known;
  for (const Format& f : kFormats) known += std::string(known.empty() ? "" : ", ") + f.name;
  throw Error(ErrorCode::UnknownFormat,
              printable(input.name()) + ": neither name nor content tell the format (known: " + known + ")");
}

LoadedMesh read(Input input) {
  if (!is_binary_stl(input.bytes())) input.drop_byte_order_mark();
  if (input.size() == 0) input.fail("the file is empty");
  std::vector<std::string> remarks;
  const Format& format = format_of(input, remarks);
  LoadedMesh loaded = finish(input, format.read(input), format.name);
  loaded.remarks.insert(loaded.remarks.begin(), remarks.begin(), remarks.end());
  return loaded;
}

}  // namespace

}  // namespace detail

std::vector<FileFormat> meshes_read() {
  std::vector<FileFormat> formats;
  for (const detail::Format& f : detail::kFormats)
    formats.push_back({f.name, {f.extensions.begin(), f.extensions.end()}});
  return formats;
}

LoadedMesh read_mesh(const std::string& path) { return detail::read(detail::Input::from_file(path)); }

LoadedMesh read_mesh(std::span<const std::byte> content, const std::string& name) {
  return detail::read(
      detail::Input::from_memory({reinterpret_cast<const char*>(content.data()), content.size()}, name));
}

}  // namespace brushfire
