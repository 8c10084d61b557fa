#pragma once
/** @file
How many dimensions a set of wrenches really fills. A flat set (two hard point fingers can make no
moment about the line between them, so their wrenches fill five) has no volume and no ball around
the origin: its quality is exactly zero, and neither a hull nor rounding may say otherwise. */

#include <Eigen/Core>
#include <vector>

namespace graspbench {

/** Lengths below this share of the longest vector count as zero: far above rounding, far below what
a grasp can mean. */
inline constexpr double kNegligibleShare = 1e-9;

/** Indices of affinely independent points (columns), chosen far apart: the longest first, then each
time the one farthest from the flat through those before. Fewer than rows + 1 indices: the set is
flat. */
std::vector<int> FindAffineBasis(const Eigen::Ref<const Eigen::MatrixXd>& points);

}  // namespace graspbench
