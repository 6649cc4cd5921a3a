// Where a verb's -o goes.
#pragma once

#include "shared.h"

#include <brushfire/io/formats.h>
#include <brushfire/io/write_columns.h>
#include <brushfire/io/write_lines.h>

#include <string>
#include <vector>

namespace brushfire::tool {

// Say, before anything is computed, that no field (no such columns, no curves) can be written under such a name. Throw
// Error(InvalidArgument).
void check_output(const std::string& path);
void check_output(const std::string& path, Columns::Kind kind);

// For help texts: "PLY, OBJ, OFF", and ".ply .vtk .vtp".
std::string names_of(const std::vector<FileFormat>& formats);
std::string extensions_of(const std::vector<FileFormat>& formats);

// How curves are drawn.
struct DrawingArguments {
  std::string view;
  bool outline = false;
};

// Binds --view and --outline.
void add_drawing(Verb& verb, DrawingArguments& drawing);
// Binds -o for curves, --view and --outline.
void add_lines_output(Verb& verb, std::string& output, DrawingArguments& drawing);
// The options that they and --unit stand for. Throws Error(InvalidArgument), also where no curves can be written to
// such a name.
LinesOptions lines_options(const std::string& output, const DrawingArguments& drawing, const SharedArguments& shared);

}  // namespace brushfire::tool
