#include "human_study/events/object_surface.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/error.h"

namespace graspbench {

SurfaceDistance MakeSphereDistance(double radius) {
  GRASPBENCH_DEMAND(radius > 0.0, std::to_string(radius));
  return [radius](const Eigen::Vector3d& p_O) { return p_O.norm() - radius; };
}

SurfaceDistance MakeCylinderDistance(double radius, double height) {
  GRASPBENCH_DEMAND(radius > 0.0 && height > 0.0, std::to_string(radius));
  return [radius, height](const Eigen::Vector3d& p_O) {
    const Eigen::Vector2d beyond(p_O.head<2>().norm() - radius, std::abs(p_O.z()) - height / 2);
    return std::min(beyond.maxCoeff(), 0.0) + beyond.cwiseMax(0.0).norm();
  };
}

SurfaceDistance MakeBoxDistance(const Eigen::Vector3d& size) {
  GRASPBENCH_DEMAND(size.minCoeff() > 0.0, std::to_string(size.minCoeff()));
  return [size](const Eigen::Vector3d& p_O) {
    const Eigen::Vector3d beyond = p_O.cwiseAbs() - size / 2;
    return std::min(beyond.maxCoeff(), 0.0) + beyond.cwiseMax(0.0).norm();
  };
}

SurfaceDistance MakeFieldDistance(std::shared_ptr<const SignedDistanceField> field) {
  return
      [field = std::move(field)](const Eigen::Vector3d& p_O) { return field->Query(p_O).distance; };
}

}  // namespace graspbench
