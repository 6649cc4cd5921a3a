// A file of one triangle, (0 0 0, 3 0 0, 3 4 0), however it is written.
#pragma once

#include <brushfire/core/error.h>

#include "io_support.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace brushfire::test {

struct Text {
  const char* name;
  std::string content;
};

// One triangle (0 0 0, 3 0 0, 3 4 0) in every text format, lines ended by LF.
inline std::vector<Text> triangle_texts() {
  return {
      {"a.obj", "# made by hand\n\nv 0 0 0\nv 3 0 0\nv 3 4 0\nf 1 2 3\n"},
      {"a.off", "OFF\n3 1 0\n\n0 0 0\n3 0 0\n3 4 0\n3 0 1 2\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
       "property list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0\n\n3 4 0\n3 0 1 2\n"},
      {"a.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 3 0 0\nvertex 3 4 "
       "0\nendloop\nendfacet\nendsolid\n"},
      {"a.vtk",
       "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0\n3 0 0\n3 4 0\nPOLYGONS 1 4\n3 0 "
       "1 2\n"},
      {"a.mesh",
       "MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 0\n3 0 0 0\n3 4 0 0\nTriangles\n1\n1 2 3 0\nEnd\n"},
      {"a.msh",
       "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nnone\n$EndComments\n$Nodes\n3\n1 0 0 0\n2 3 0 0\n3 3 4 "
       "0\n$EndNodes\n"
       "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n"},
      {"lh.asc", "#!ascii version of lh.white\n3 1\n0 0 0 0\n3 0 0 0\n3 4 0 0\n0 1 2 0\n"},
      {"a.vtp",
       "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" "
       "NumberOfPolys=\"1\">\n"
       "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0\n3 0 0\n3 4 0\n</DataArray>"
       "</Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray><DataArray "
       "type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece></PolyData></VTKFile>\n"},
  };
}

inline void expect_triangle(const std::string& content, const std::string& name, const std::string& what) {
  try {
    const LoadedMesh loaded = read_text(content, name);
    EXPECT_EQ(positions_of(loaded.mesh), (std::vector<Vec3>{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}})) << name << ", " << what;
    EXPECT_EQ(faces_of(loaded.mesh), (std::vector<Face>{{0, 1, 2}})) << name << ", " << what;
  } catch (const Error& e) {
    ADD_FAILURE() << what << ": " << e.what();
  }
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

}  // namespace brushfire::test
