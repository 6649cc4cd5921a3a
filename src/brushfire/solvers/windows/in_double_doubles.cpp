// This room once more, with windows made of DoubleDouble: see algebra/real.h. Without what takes whole lists at a time.
#define BRUSHFIRE_WIDE_NUMBERS

// Floor by floor: what is below comes first.
#include "algebra/envelope.cpp"
#include "algebra/face_shape.cpp"
#include "algebra/merge.cpp"
#include "algebra/rays.cpp"
#include "algebra/tie_point.cpp"

#include "store/exact_lists.cpp"

#include "propagation/arrivals.cpp"
#include "propagation/circled_faces.cpp"
#include "propagation/links.cpp"
#include "propagation/own_vertices.cpp"
#include "propagation/part.cpp"
#include "propagation/pseudo_sources.cpp"
#include "propagation/single_windows.cpp"
#include "propagation/sink.cpp"
#include "propagation/structure.cpp"
#include "propagation/targets.cpp"
#include "propagation/wheels.cpp"

#include "paths/keep_plain.cpp"
#include "paths/kept_fronts.cpp"
#include "paths/point_values.cpp"
#include "paths/results.cpp"

#include "window_engine.cpp"
