// Fields that have to fit.
#include "fields.h"

#include <brushfire/io/write_field.h>

#include <algorithm>

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

std::vector<double> keys_named(const LoadedField& field, std::string_view labels, const std::string& file,
                               const std::string& option) {
  std::vector<double> keys;
  for (std::size_t begin = 0; begin <= labels.size();) {
    const std::size_t end = std::min(labels.find(',', begin), labels.size());
    const std::string_view label = labels.substr(begin, end - begin);
    const auto named = std::find_if(field.label_names.begin(), field.label_names.end(),
                                    [&](const LoadedField::Label& l) { return l.name == label; });
    if (named != field.label_names.end()) {
      keys.push_back(static_cast<double>(named->key));
    } else if (const std::optional<double> number = decimal(label)) {
      keys.push_back(*number);
    } else {
      refuse(option + ": " + in_quotes(label) + " is no label of " + file +
             (field.label_names.empty() ? " (it has no names: give numbers)" : ""));
    }
    begin = end + 1;
  }
  return keys;
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
