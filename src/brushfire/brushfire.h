// Everything public, in one include.
#pragma once

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/core/parallel.h>
#include <brushfire/core/progress.h>
#include <brushfire/core/types.h>
#include <brushfire/io/formats.h>
#include <brushfire/io/npy.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/read_lines.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/io/write_field.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/io/write_mesh.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/mesh/weld.h>
#include <brushfire/queries/distance_matrix.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/version.h>
