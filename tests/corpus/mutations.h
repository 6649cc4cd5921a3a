// What is done to a good mesh to make it a bad one.
#pragma once

#include "corpus/dice.h"

#include <brushfire/mesh/shapes.h>

namespace brushfire::corpus {

// Every vertex gets a length of its own from 10^-decades to 10^decades of what it had, about vertex 0 or the origin.
void mix_scales(Shape& s, Dice& dice, double decades);
// The neighbours of some vertices are pulled to within 10^-14 .. 10^-3 of them: clusters of tiny faces.
void pull_clusters(Shape& s, Dice& dice);
// One vertex goes to 10^6 .. 10^17.
void send_one_far(Shape& s, Dice& dice);
// x += shear * y, and the like on other axes; shear up to 10^9.
void shear(Shape& s, Dice& dice);
// One axis is scaled by 10^-12 .. 10^12.
void stretch(Shape& s, Dice& dice);
// Coordinates are rounded to a grid of few steps: ties, flat faces, vertices on edges.
void snap_to_grid(Shape& s, Dice& dice);
// All vertices move by up to 10^-16 .. 10^-3 of the size.
void jitter(Shape& s, Dice& dice);
// Some vertices move onto others, or onto the lines through others.
void make_collinear(Shape& s, Dice& dice);
// Faces with a vertex twice or three times, vertices without a face.
void repeat_vertices(Shape& s, Dice& dice);
// Faces are turned round and start at any corner.
void shuffle_faces(Shape& s, Dice& dice);

// One of them, whichever.
void mutilate(Shape& s, Dice& dice);

}  // namespace brushfire::corpus
