#pragma once
/** @file
Where a camera with a real lens shows a point: pinhole and distortion after Brown (1966), as OpenCV
and most calibration programs have it. With x = X / Z, y = Y / Z in the camera's frame K and
r^2 = x^2 + y^2,

    s   = 1 + k1 r^2 + k2 r^4
    x_d = s x + 2 p1 x y + p2 (r^2 + 2 x^2)
    y_d = s y + p1 (r^2 + 2 y^2) + 2 p2 x y
    u = focal_x x_d + centre_x,   v = focal_y y_d + centre_y   [pixel]

from the picture's left and upper edge, so that the first pixel's middle is at (0.5, 0.5). (OpenCV
puts it at (0, 0): its principal point is half a pixel less.) */

#include <Eigen/Core>

namespace graspbench {

struct Lens {
  int width = 640;                            ///< [pixel]
  int height = 480;                           ///< [pixel]
  double focal_x = 580.0, focal_y = 580.0;    ///< [pixel]
  double centre_x = 320.0, centre_y = 240.0;  ///< [pixel]
  double k1 = 0.0, k2 = 0.0;                  ///< radial
  double p1 = 0.0, p2 = 0.0;                  ///< tangential

  bool is_distorted() const { return k1 != 0.0 || k2 != 0.0 || p1 != 0.0 || p2 != 0.0; }
};

/** [pixel] @pre p_K.z() > 0. */
Eigen::Vector2d Project(const Lens& lens, const Eigen::Vector3d& p_K);
/** The ray through a point of the picture, in K, with z = 1; by fixed-point iteration, which
converges within the picture for any lens that shows each direction once. */
Eigen::Vector3d CalcRay(const Lens& lens, const Eigen::Vector2d& pixel);

}  // namespace graspbench
