// Which format a file has, and the way from its reader to a mesh.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/read_mesh.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace brushfire {

namespace detail {

namespace {

bool starts_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

bool is_ply(std::string_view b) { return starts_with(b, "ply\n") || starts_with(b, "ply\r") || starts_with(b, "ply "); }
bool is_off(std::string_view b) {
  return starts_with(b, "OFF") || starts_with(b, "COFF") || starts_with(b, "NOFF") || starts_with(b, "CNOFF") ||
         starts_with(b, "STOFF");
}
bool is_vtk(std::string_view b) { return starts_with(b, "# vtk DataFile"); }
bool is_gmsh(std::string_view b) { return starts_with(b, "$MeshFormat"); }
bool is_medit(std::string_view b) { return starts_with(b, "MeshVersionFormatted"); }
bool is_freesurfer(std::string_view b) { return starts_with(b, "\xff\xff\xfe") || starts_with(b, "\xff\xff\xfd"); }
// XML says what it is within its first lines.
std::string_view xml_head(std::string_view b) { return starts_with(b, "<") ? b.substr(0, 1024) : std::string_view(); }
bool is_vtp(std::string_view b) { return xml_head(b).find("<VTKFile") != std::string_view::npos; }
bool is_gifti(std::string_view b) { return xml_head(b).find("<GIFTI") != std::string_view::npos; }
// OBJ has no mark: a first statement of its own is taken for one where there is no name, as on standard input.
bool looks_like_obj(std::string_view b) {
  while (!b.empty() && (b[0] == '#' || b[0] == '\n' || b[0] == '\r')) {
    b.remove_prefix(b[0] == '#' ? std::min(b.find('\n'), b.size()) : 1);
  }
  for (const std::string_view keyword : {"v", "vn", "vt", "o", "g", "s", "mtllib", "usemtl"}) {
    const bool is_it = starts_with(b, keyword) && b.size() > keyword.size();
    if (is_it && (b[keyword.size()] == ' ' || b[keyword.size()] == '\t')) return true;
  }
  return false;
}
bool is_unmarked(std::string_view) { return false; }

struct Format {
  const char* name;
  std::initializer_list<std::string_view> extensions;
  bool (*is_marked)(std::string_view bytes);  // the content says so itself
  MeshParts (*read)(const Input& input);
};

// A new reader is one line here.
const Format kFormats[]{
    {"PLY", {"ply"}, is_ply, read_ply},
    {"OBJ", {"obj"}, is_unmarked, read_obj},
    {"OFF", {"off", "coff", "noff", "cnoff"}, is_off, read_off},
    {"VTK", {"vtk"}, is_vtk, read_vtk},
    {"VTP", {"vtp"}, is_vtp, read_vtp},
    {"GIFTI", {"gii"}, is_gifti, read_gifti},
    {"FreeSurfer", {"white", "pial", "inflated", "sphere", "orig", "smoothwm"}, is_freesurfer, read_freesurfer},
    {"glTF", {"gltf", "glb"}, is_gltf, read_gltf},
    {"Gmsh", {"msh"}, is_gmsh, read_gmsh},
    {"MEDIT", {"mesh"}, is_medit, read_medit},
    {"STL", {"stl"}, is_stl, read_stl},
};

const Format& format_of(const Input& input, std::vector<std::string>& remarks) {
  const std::string extension = input.extension();
  const Format* by_name = nullptr;
  const Format* by_content = nullptr;
  for (const Format& f : kFormats) {
    if (std::find(f.extensions.begin(), f.extensions.end(), extension) != f.extensions.end()) by_name = &f;
    if (by_content == nullptr && f.is_marked(input.bytes())) by_content = &f;
  }
  if (by_content != nullptr) {
    if (by_name != nullptr && by_name != by_content) {
      remarks.push_back("the name says " + std::string(by_name->name) + ", but the content is " + by_content->name);
    }
    return *by_content;
  }
  if (by_name != nullptr) return *by_name;
  if (looks_like_obj(input.bytes())) {
    return *std::find_if(std::begin(kFormats), std::end(kFormats), [](const Format& f) { return f.read == read_obj; });
  }
  std::string known;
  for (const Format& f : kFormats) known += std::string(known.empty() ? "" : ", ") + f.name;
  throw Error(ErrorCode::UnknownFormat,
              printable(input.name()) + ": neither name nor content tell the format (known: " + known + ")");
}

LoadedMesh read(const Input& input) {
  if (input.size() == 0) input.fail("the file is empty");
  std::vector<std::string> remarks;
  const Format& format = format_of(input, remarks);
  LoadedMesh loaded = finish(input, format.read(input), format.name);
  loaded.remarks.insert(loaded.remarks.begin(), remarks.begin(), remarks.end());
  return loaded;
}

}  // namespace

}  // namespace detail

LoadedMesh read_mesh(const std::string& path) { return detail::read(detail::Input::from_file(path)); }

LoadedMesh read_mesh(std::span<const std::byte> content, const std::string& name) {
  return detail::read(
      detail::Input::from_memory({reinterpret_cast<const char*>(content.data()), content.size()}, name));
}

}  // namespace brushfire
