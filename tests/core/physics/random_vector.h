#pragma once
/** @file
Arguments of the oracles: vectors of independent normal values. */

#include <Eigen/Core>

#include "core/base/random.h"

namespace graspbench {

inline Eigen::VectorXd MakeRandomVector(int size, double scale, RandomStream& random) {
  Eigen::VectorXd v(size);
  for (double& value : v) value = scale * random.NextNormal();
  return v;
}

}  // namespace graspbench
