// Where a verb's -o goes.
#pragma once

#include "command_line.h"

#include <brushfire/io/formats.h>
#include <brushfire/io/write_lines.h>

#include <string>
#include <vector>

namespace brushfire::tool {

// Say, before anything is computed, that no field (no curves) can be written under such a name. Throw
// Error(InvalidArgument).
void check_output(const std::string& path);

// For help texts: "PLY, OBJ, OFF", and ".ply .vtk .vtp".
std::string names_of(const std::vector<FileFormat>& formats);
std::string extensions_of(const std::vector<FileFormat>& formats);

// How curves are drawn.
struct DrawingArguments {
  std::string unit = "mm", view;
  bool outline = false;
};

// Binds -o for curves, --unit, --view and --outline.
void add_lines_output(Verb& verb, std::string& output, DrawingArguments& drawing);
// The options that they stand for. Throws Error(InvalidArgument), also where no curves can be written to such a name.
LinesOptions lines_options(const std::string& output, const DrawingArguments& drawing);

}  // namespace brushfire::tool
