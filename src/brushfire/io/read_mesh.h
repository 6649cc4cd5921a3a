// read_mesh(): a triangle mesh from a file of any common format, with the file's vertex order, indices and precision.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace brushfire {

// What a file held. Vertex v of the mesh is the v-th vertex of the file (stored formats that have no shared vertices,
// STL, are welded: see vertex_map); triangles stand in the order of the file's faces. Coordinates are the doubles
// nearest to what the file says.
struct LoadedMesh {
  Mesh mesh;

  // face_origin[face_count]: which face of the file each triangle comes from, counted from 0. Polygons are split and
  // points and lines among the faces are left out, so the two numberings differ then; empty where they do not.
  std::vector<Index> face_origin;

  // vertex_map[corner]: the vertex that the file's corner (three per face, in order) became where the reader welded
  // corners of exactly equal coordinates; empty where the file has vertices of its own.
  std::vector<Index> vertex_map;

  // The name of the format that was read: "PLY", "OBJ", ...
  std::string format;

  // What GIFTI calls AnatomicalStructurePrimary ("CortexLeft"); empty where the file does not say.
  std::string structure;

  // Sentences about what was left out or is worth knowing ("3 faces of fewer than three corners left out").
  std::vector<std::string> remarks;
};

// Reads the file at `path`; "-" is standard input. The content decides about the format where it names one, the
// extension otherwise. gzip-compressed content is inflated. Files that the file refers to (glTF buffers, external GIFTI
// data) are read from its own folder and below only.
//
// Throws Error(FileNotReadable) where there is no such file, or a directory, a named pipe or a device in its place;
// Error(UnknownFormat); Error(FileMalformed) with one line "FILE:LINE: cause" or "FILE: byte N: cause";
// Error(TooLarge) beyond 32-bit indices. Memory: a small multiple of the file's size, whatever its headers promise;
// compressed content may inflate to 64 MiB plus 100 times its size.
LoadedMesh read_mesh(const std::string& path);

// The same from memory; `name` gives the extension and stands in messages. Other files are not looked at.
LoadedMesh read_mesh(std::span<const std::byte> content, const std::string& name);

}  // namespace brushfire
