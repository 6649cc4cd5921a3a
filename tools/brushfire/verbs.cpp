// All verbs, in the order of the help.
#include "command_line.h"

namespace brushfire::tool {

void add_verbs(CommandLine& command_line) {
  add_info(command_line);
  add_distance(command_line);
  add_path(command_line);
  add_isolines(command_line);
  add_isochrones(command_line);
  add_log_map(command_line);
  add_flatten(command_line);
  add_gradient(command_line);
  add_matrix(command_line);
  add_pairs(command_line);
  add_merge(command_line);
  add_voronoi(command_line);
  add_sample(command_line);
  add_measure(command_line);
  add_parcels(command_line);
  add_smooth(command_line);
  add_compare(command_line);
  add_certify(command_line);
  add_render(command_line);
  add_view(command_line);
  add_bench(command_line);
  add_convert(command_line);
  add_shape(command_line);
  add_terrain(command_line);
  add_completion(command_line);
  add_manual(command_line);
}

}  // namespace brushfire::tool
