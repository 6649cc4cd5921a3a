// write_mesh(): a mesh into files that other programs open.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <cstdint>
#include <string>
#include <vector>

namespace brushfire {

// Writes the mesh; the extension decides (or `format`, an extension without dot, for names that have none):
//   ply   binary little-endian, doubles          off   text
//   obj   text, all digits                        stl   binary: floats, and no shared vertices
//   vtk   legacy PolyData, binary, doubles        vtp   VTK XML PolyData, appended raw, doubles
//   gii   GIFTI surface: floats                   msh   Gmsh 2.2, text
//   mesh  MEDIT, text                             meshb MEDIT, binary, doubles
//   glb   glTF 2.0, binary: floats
//   asc   FreeSurfer's text; white pial inflated sphere orig smoothwm: FreeSurfer's triangles, floats
// Vertices and faces keep their order (STL has no vertices). `structure` is what GIFTI calls AnatomicalStructurePrimary
// ("CortexLeft"); other formats have no place for it.
//
// The file appears under its name complete or not at all; "-" is standard output and needs `format`. Throws
// Error(FileNotWritable), Error(UnknownFormat), and Error(InvalidArgument) for a mesh without positions, or one whose
// coordinates are too large for a format of floats.
void write_mesh(const std::string& path, const Mesh& mesh, const std::string& format = "",
                const std::string& structure = "");

// The file's bytes in place of the file; `format` is an extension without dot.
std::vector<std::uint8_t> encode_mesh(const Mesh& mesh, const std::string& format, const std::string& structure = "");

// Throws the Error(UnknownFormat) that write_mesh() would: for finding out before the mesh is made.
void check_mesh_format(const std::string& path, const std::string& format = "");

}  // namespace brushfire
