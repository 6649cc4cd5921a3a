// The readers and writers, a file of its own for each format. Readers turn bytes into MeshParts or throw
// Error(FileMalformed); writers are given what fits the mesh.
#pragma once

#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/mesh_parts.h>
#include <brushfire/io/detail/output.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/read_lines.h>
#include <brushfire/io/write_field.h>

#include <span>

namespace brushfire::detail {

MeshParts read_3mf(const Input& input);
MeshParts read_freesurfer(const Input& input);
MeshParts read_freesurfer_text(const Input& input);
MeshParts read_gifti(const Input& input);
MeshParts read_gltf(const Input& input);
MeshParts read_gmsh(const Input& input);
MeshParts read_medit(const Input& input);
MeshParts read_medit_binary(const Input& input);
MeshParts read_obj(const Input& input);
MeshParts read_off(const Input& input);
MeshParts read_ply(const Input& input);
MeshParts read_stl(const Input& input);
MeshParts read_vtk(const Input& input);
MeshParts read_vtp(const Input& input);  // and .vtu

// Does the content say itself that it is of this format?
bool is_3mf(std::string_view bytes);
bool is_gltf(std::string_view bytes);
bool is_medit_binary(std::string_view bytes);
bool is_stl(std::string_view bytes);
bool is_binary_stl(std::string_view bytes);

// Which values of a mesh's file.
enum class ValuesOn : std::uint8_t { Vertices, Faces };

// Scalars on vertices; `name` chooses the array, "" takes the first.
LoadedField read_csv_field(const Input& input, const std::string& name);
LoadedField read_freesurfer_annot(const Input& input, const std::string& name);
LoadedField read_freesurfer_curv(const Input& input, const std::string& name);
LoadedField read_freesurfer_label(const Input& input, const std::string& name);
LoadedField read_gifti_field(const Input& input, const std::string& name);
inline constexpr const char* kNotVisited = "not_visited";  // the list in JSON that is not values
LoadedField read_json_field(const Input& input, const std::string& name);
LoadedField read_npy_field(const Input& input, const std::string& name);
LoadedField read_ply_field(const Input& input, const std::string& name);
LoadedField read_text_field(const Input& input, const std::string& name);
LoadedField read_vtk_field(const Input& input, const std::string& name);
LoadedField read_vtp_field(const Input& input, const std::string& name);

// Scalars on faces.
LoadedField read_ply_face_field(const Input& input, const std::string& name);
LoadedField read_vtk_face_field(const Input& input, const std::string& name);
LoadedField read_vtp_face_field(const Input& input, const std::string& name);

// Curves.
LoadedLines read_csv_lines(const Input& input);
LoadedLines read_json_lines(const Input& input);
LoadedLines read_obj_lines(const Input& input);
LoadedLines read_ply_lines(const Input& input);
LoadedLines read_vtp_lines(const Input& input);

// Vectors; of numbers, kNoIndex reads -1.
void write_npy_to(const Destination& to, std::span<const double> values);
void write_npy_to(const Destination& to, std::span<const Index> values);

void write_csv(Output& out, const Mesh& mesh, const FieldView& field);
void write_freesurfer_curv(Output& out, const Mesh& mesh, const FieldView& field);
void write_gifti(Output& out, const Mesh& mesh, const FieldView& field);
void write_gifti_surface(Output& out, const Mesh& mesh, const std::string& structure);
void write_json(Output& out, const Mesh& mesh, const FieldView& field);
void write_obj(Output& out, const Mesh& mesh, const FieldView& field);
void write_ply(Output& out, const Mesh& mesh, const FieldView& field);
void write_vtk(Output& out, const Mesh& mesh, const FieldView& field);
void write_vtp(Output& out, const Mesh& mesh, const FieldView& field);

}  // namespace brushfire::detail
