// Fields from files: those that are judged, and those of --scalar. And to files.
#pragma once

#include "surface.h"

#include <brushfire/io/read_field.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::tool {

// One value for each of `count` vertices; infinity where the file names vertices and leaves this one out. A field and
// its mesh, or another field, come from different runs: Error(InvalidArgument) says which file does not fit `beside`,
// and how.
std::vector<double> values_of(const LoadedField& loaded, const std::string& path, std::size_t count,
                              const std::string& beside);

// The values of a file (the array `name`), on the vertices of surface.mesh().
std::vector<double> values_on(const Surface& surface, const std::string& path, const std::string& name);

// "precentral,7": the keys of these labels of the field, by name or number. Throws Error(InvalidArgument) that begins
// with `option` for what is neither.
std::vector<double> keys_named(const LoadedField& field, std::string_view labels, const std::string& file,
                               const std::string& option);

// What a verb shows: the values of --scalar, or distances. Throws Error(InvalidArgument) where both are asked for, or
// neither is.
void check_scalar_or_source(const SharedArguments& arguments);

// What is written beside the file's mesh, on its vertices.
struct Values {
  std::vector<double> values{};
  std::vector<Index> labels{};
  std::string name = "distance";
  std::string label_name = "source";
  std::vector<std::uint8_t> not_visited{};  // FieldView::not_visited
};

// In the format that the extension names, "-" is CSV on standard output. What lies behind walls is no number in GIFTI,
// and out of reach elsewhere.
void write_values(const Surface& surface, const std::string& output, const Values& values);

}  // namespace brushfire::tool
