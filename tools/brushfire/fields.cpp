// Fields that have to fit.
#include "fields.h"

#include "command_line.h"

namespace brushfire::tool {

std::vector<double> values_of(const LoadedField& loaded, const std::string& path, std::size_t count,
                              const std::string& beside) {
  if (loaded.vertices.empty() && loaded.values.size() != count) {
    refuse(path + ": " + counted(loaded.values.size(), "value", "values") + ", but " + beside + " has " +
           std::to_string(count));
  }
  return values_on_vertices(loaded, static_cast<Index>(count), kInfinity);
}

}  // namespace brushfire::tool
