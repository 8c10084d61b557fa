#pragma once
/** @file
Building blocks of the catalogue's shapes. Every length in objects/generate is in millimetres;
FitTo() converts the finished shape to metres. */

#include <vector>

#include "core/shape/primitives.h"

namespace graspbench {

/** A closed polygon in a plane, counter-clockwise. */
using Outline = std::vector<Eigen::Vector2d>;

/** An ellipse with `num_points` corners, or a regular polygon. If num_points is a multiple of four,
a flat side, not a corner, faces each axis. */
Outline MakeEllipse(double size_x, double size_y, int num_points);
/** Always has 4 (num_arc + 1) points, so that rectangles of any size and radius can be lofted. */
Outline MakeRoundedRectangle(double size_x, double size_y, double radius, int num_arc = 4);
/** Distance from the origin to the outline along the ray at `angle`. @pre star-shaped about the
origin. */
double CalcRadius(const Outline& outline, double angle);
Outline MakeTurned(const Outline& outline, double angle);

/** The outline as a ring in the plane at height z. */
Ring MakeRing(const Outline& outline, double z);

struct Layer {
  Outline outline;  ///< star-shaped about the origin
  double z = 0.0;
};
/** Lofts through outlines with any number of corners and keeps every corner. Two layers at the same
height make a step, even where the outlines cross. */
TriMesh MakeStack(const std::vector<Layer>& layers);

/** Maps z to x, x to y and y to z: for shapes that are built upright and lie on the table. */
TriMesh MakeLying(TriMesh mesh);

/** A ball of nearly equal triangles: an icosahedron with every edge cut into `frequency` pieces. */
TriMesh MakeGeodesicSphere(double radius, int frequency);

/** Flattens the lowest `depth`, so that a round object rests flat instead of rolling on an edge. */
void FlattenBottom(TriMesh& mesh, double depth);

/** Scales to the size [m] and centres the bounding box at the origin. */
void FitTo(const Eigen::Vector3d& size, TriMesh& mesh);

}  // namespace graspbench
