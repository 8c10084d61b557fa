#pragma once
/** @file
What the shapes of the catalogue are put together from. Every length in objects/generate is in
millimetres, as on a drawing; FitTo() brings the finished shape into metres. */

#include <vector>

#include "core/shape/primitives.h"

namespace graspbench {

/** A closed polygon in a plane, counter-clockwise. */
using Outline = std::vector<Eigen::Vector2d>;

/** Ellipse with `num_points`, or a regular polygon; a flat side, not a corner, faces each axis when
num_points is a multiple of four. */
Outline MakeEllipse(double size_x, double size_y, int num_points);
/** Always 4 (num_arc + 1) points, so that rectangles of any size and radius can be lofted. */
Outline MakeRoundedRectangle(double size_x, double size_y, double radius, int num_arc = 4);
/** Where the ray from the origin at `angle` leaves the outline. @pre star-shaped about the origin.
 */
double CalcRadius(const Outline& outline, double angle);
Outline MakeTurned(const Outline& outline, double angle);

/** Outline in the plane z. */
Ring MakeRing(const Outline& outline, double z);

struct Layer {
  Outline outline;  ///< star-shaped about the origin
  double z = 0.0;
};
/** Loft through outlines with any number of corners; every corner is kept. Two layers at one height
make a step, even where the outlines cross. */
TriMesh MakeStack(const std::vector<Layer>& layers);

/** Turns z into x, x into y, y into z: for things that are made upright and lie on the table. */
TriMesh MakeLying(TriMesh mesh);

/** Icosahedron with every edge cut into `frequency` pieces: a ball of equal triangles. */
TriMesh MakeGeodesicSphere(double radius, int frequency);

/** Flattens the lowest `depth`, so that a round thing rests instead of rolling about a corner. */
void FlattenBottom(TriMesh& mesh, double depth);

/** Scales to the size [m] and centres the bounding box at the origin. */
void FitTo(const Eigen::Vector3d& size, TriMesh& mesh);

}  // namespace graspbench
