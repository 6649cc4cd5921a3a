// This room once more, with windows made of DoubleDouble: see algebra/real.h.
#define BRUSHFIRE_WIDE_NUMBERS

// Floor by floor: what is below comes first.
#include "algebra/envelope.cpp"
#include "algebra/exact_cross.cpp"
#include "algebra/face_shape.cpp"
#include "algebra/merge.cpp"
#include "algebra/rays.cpp"
#include "algebra/ridge.cpp"

#include "store/exact_lists.cpp"

#include "propagation/exact_trim.cpp"
#include "propagation/links.cpp"
#include "propagation/part.cpp"
#include "propagation/part_lists.cpp"
#include "propagation/part_windows.cpp"
#include "propagation/propagation.cpp"
#include "propagation/results.cpp"
#include "propagation/structure.cpp"
#include "propagation/targets.cpp"

#include "paths/keep_plain.cpp"
