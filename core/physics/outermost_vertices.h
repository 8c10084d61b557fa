#pragma once
/** @file
The vertex farthest out in each of many directions, v(d) = argmax d . v, the first of equals.

Vertices that follow each other in a mesh lie near each other, so that most blocks of them are
passed over: the extent of the corner of a block's bounding box that lies farthest out is, rounding
included, not below that of any vertex in it. The answer is that of trying every vertex. */

#include <Eigen/Core>
#include <vector>

namespace graspbench {

/** By direction. The directions' order is free; neighbours that follow each other `stride` apart
make it fast.
@pre vertices is not empty, all of them are finite, stride > 0. */
std::vector<size_t> FindOutermostVertices(const std::vector<Eigen::Vector3d>& vertices,
                                          const std::vector<Eigen::Vector3d>& directions,
                                          size_t stride);

}  // namespace graspbench
