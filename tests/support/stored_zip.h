// A zip archive of files that are stored as they are, as bytes: for readers of formats that are archives.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace brushfire::test {

inline std::uint32_t crc32_of(const std::string& bytes) {
  std::uint32_t crc = ~0u;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

// `files`: name and content of each.
inline std::string stored_zip(const std::vector<std::pair<std::string, std::string>>& files) {
  const auto number = [](std::uint64_t value, int bytes) {
    std::string out;
    for (int k = 0; k < bytes; ++k, value >>= 8) out += static_cast<char>(value & 255);
    return out;
  };
  std::string out, directory;
  for (const auto& [name, content] : files) {
    // Version, flags, method, time, date, checksum, sizes, lengths of name and extra field.
    const std::string about = number(20, 2) + number(0, 2) + number(0, 2) + number(0, 2) + number(33, 2) +
                              number(crc32_of(content), 4) + number(content.size(), 4) + number(content.size(), 4) +
                              number(name.size(), 2) + number(0, 2);
    directory += "PK\1\2" + number(20, 2) + about + number(0, 10) + number(out.size(), 4) + name;
    out += "PK\3\4" + about + name + content;
  }
  const std::size_t begin = out.size();
  return out + directory + "PK\5\6" + number(0, 4) + number(files.size(), 2) + number(files.size(), 2) +
         number(directory.size(), 4) + number(begin, 4) + number(0, 2);
}

// A 3MF file of one model part.
inline std::string three_mf(const std::string& model) {
  return stored_zip({{"_rels/.rels",
                      "<Relationships><Relationship Target=\"/3D/3dmodel.model\" "
                      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
                     {"3D/3dmodel.model", model}});
}

// A triangle as object 1, and object 2 that names it twice.
inline std::string three_mf_objects() {
  return "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"3\" y=\"0\" z=\"0\"/><vertex "
         "x=\"3\" y=\"4\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh>"
         "</object>\n<object id=\"2\"><components><component objectid=\"1\"/><component objectid=\"1\" "
         "transform=\"0 1 0 -1 0 0 0 0 1 10 0 5\"/></components></object>\n";
}

}  // namespace brushfire::test
