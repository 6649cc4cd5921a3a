// Fields that have to fit.
#include "fields.h"

#include <brushfire/io/write_field.h>

namespace brushfire::tool {

std::vector<double> values_of(const LoadedField& loaded, const std::string& path, std::size_t count,
                              const std::string& beside) {
  if (loaded.vertices.empty() && loaded.values.size() != count) {
    refuse(path + ": " + counted(loaded.values.size(), "value", "values") + ", but " + beside + " has " +
           std::to_string(count));
  }
  return values_on_vertices(loaded, static_cast<Index>(count), kInfinity);
}

std::vector<double> values_on(const Surface& surface, const std::string& path, const std::string& name) {
  const Index count = surface.file().mesh.vertex_count();
  return surface.on_mesh(values_of(read_field(path, name), path, count, "the mesh"), path);
}

void check_scalar_or_source(const SharedArguments& a) {
  const char* const source = given(a, {Shared::Source, Shared::Sources});
  if (a.scalar_file.empty()) {
    if (!source) refuse("give --source or --sources (distances from there), or --scalar (values)");
    if (!a.array_name.empty()) refuse("--name is for the values of --scalar");
    return;
  }
  if (source) refuse("--scalar and " + std::string(source) + " both say what to show: give one");
  const char* const computing = given(a, kComputing);
  if (computing) refuse("--scalar has the values: there is nothing for " + std::string(computing) + " to compute");
}

void write_values(const Surface& surface, const std::string& output, const Values& v) {
  const std::vector<std::uint8_t> open =
      output.ends_with(".gii") ? surface.open_vertices() : std::vector<std::uint8_t>{};
  write_field(output, surface.file().mesh,
              {.values = v.values,
               .labels = v.labels,
               .name = v.name,
               .label_name = v.label_name,
               .mask = open,
               .structure = surface.file().structure,
               .not_visited = v.not_visited},
              output == "-" ? "csv" : "");
}

}  // namespace brushfire::tool
