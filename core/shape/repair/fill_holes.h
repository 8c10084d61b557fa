#pragma once
/** @file
Closes what a surface is open at, where there is no doubt how. */

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Joins vertices of open edges that lie within `tolerance` [m] of each other: the two sides of a
seam. @returns how many were joined. */
int SewSeams(double tolerance, TriMesh& mesh);

/** Closes each hole with a fan about its middle, if its area is at most this share of the whole
surface, and kMaxOwnShare of the shell around the hole: a loose sheet is all rim, a slit of any
length has no area. A rim that touches itself is taken as several holes. @returns how many holes. */
inline constexpr double kMaxOwnShare = 0.2;
int FillHoles(double max_share, TriMesh& mesh);

}  // namespace graspbench
