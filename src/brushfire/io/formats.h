// Which file formats there are: for help texts and dialogues. Each list is made from the table that its reader or
// writer dispatches on.
#pragma once

#include <string>
#include <vector>

namespace brushfire {

struct FileFormat {
  std::string name;                     // "PLY"
  std::vector<std::string> extensions;  // lower case, without dot; the first is the usual one
};

std::vector<FileFormat> meshes_read();     // by read_mesh()
std::vector<FileFormat> meshes_written();  // by write_mesh()
std::vector<FileFormat> fields_read();     // by read_field()
std::vector<FileFormat> fields_written();  // by write_field()
std::vector<FileFormat> lines_read();      // by read_lines()
std::vector<FileFormat> lines_written();   // by write_lines()

}  // namespace brushfire
