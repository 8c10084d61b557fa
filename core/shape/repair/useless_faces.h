#pragma once
/** @file
Takes off a mesh what encloses nothing: faces on each other, sheets that hang on the surface or
stand across its inside, loose sheets. What it encloses stays as it is. */

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Of the triangles on the same three corners, as many as face opposite ways cancel each other; of
those that are left one stays, or all where only then the surface is whole: bodies that share a
face. Where little would be left, the file has every face twice for the sake of pictures, and the
first of each stays. @returns how many were dropped. */
int DropDoubledFaces(TriMesh& mesh);

/** Drops patches between edges of more than two triangles: those with an open rim, and walls whose
removal leaves every edge of their rim whole; the smallest first, for that may make another one
whole, and none of half the surface or more. A wall across a body is smaller than either side.
@returns how many triangles were dropped. */
int DropFins(TriMesh& mesh);

/** Drops open shells of at most this share of the surface. @returns how many triangles. */
int DropLooseSheets(double max_share, TriMesh& mesh);

/** Drops vertices that no triangle uses: they would count for the size. The order is kept. */
void DropUnusedVertices(TriMesh& mesh);

}  // namespace graspbench
