#pragma once
/** @file
A session's settings of the wrist camera: image degradation and viewpoint. Lens and mount belong to
the hand (core/hand/hand.h). All values are proposed by graspbench. */

#include <Eigen/Core>
#include <optional>
#include <string>

namespace graspbench {

struct CameraConfig {
  double look_height = 0.4;  ///< height of the camera above the table, looking straight down [m]
  double noise = 3.0;        ///< standard deviation in each channel [grey levels]
  double blur = 0.7;         ///< standard deviation [pixel]
  double exposure = 1.0;     ///< factor on the light
  bool has_shadows = false;  ///< full quality with shadows; otherwise the fast quality
  /** Magenta: none of the 21 objects has that hue, and shadows do not change it. */
  std::string table_colour = "#b4509b";

  template <class V>
  void Visit(V&& v) {
    v("look_height_m", look_height,
      {"height of the camera above the table while it takes its picture", 0.25, 2});
    v("noise_grey_levels", noise,
      {"standard deviation of the noise of each colour channel", 0, 100});
    v("blur_px", blur, {"standard deviation of the blur", 0, 20});
    v("exposure", exposure, {"factor on the light of the camera's picture", 0.01, 100});
    v("shadows", has_shadows,
      "whether the camera's pictures show shadows; such pictures take six times as long");
    v("table_colour", table_colour, "colour of the table in the camera's pictures, as #rrggbb");
  }
};

/** Parses "#b4509b" as sRGB from 0 to 1; nullopt for any other form of text. */
std::optional<Eigen::Vector3f> ParseColour(const std::string& text);

/** A real lens: pinhole projection with distortion after Brown (1966), as in OpenCV and most
calibration programs. With x = X / Z, y = Y / Z in the camera's frame K and r^2 = x^2 + y^2,

    s   = 1 + k1 r^2 + k2 r^4
    x_d = s x + 2 p1 x y + p2 (r^2 + 2 x^2)
    y_d = s y + p1 (r^2 + 2 y^2) + 2 p2 x y
    u = focal_x x_d + centre_x,   v = focal_y y_d + centre_y   [pixel]

from the picture's left and upper edge, so that the centre of the first pixel is at (0.5, 0.5).
(OpenCV places it at (0, 0), so its principal point is half a pixel less.) */
struct Lens {
  int width = 640;                            ///< [pixel]
  int height = 480;                           ///< [pixel]
  double focal_x = 580.0, focal_y = 580.0;    ///< [pixel]
  double centre_x = 320.0, centre_y = 240.0;  ///< [pixel]
  double k1 = 0.0, k2 = 0.0;                  ///< radial
  double p1 = 0.0, p2 = 0.0;                  ///< tangential

  bool is_distorted() const { return k1 != 0.0 || k2 != 0.0 || p1 != 0.0 || p2 != 0.0; }
};

/** Projects a point into the picture [pixel]. @pre p_K.z() > 0. */
Eigen::Vector2d Project(const Lens& lens, const Eigen::Vector3d& p_K);
/** Returns the ray through a point of the picture, in K, with z = 1. It uses fixed-point iteration,
which converges within the picture for any lens that shows each direction once. */
Eigen::Vector3d CalcRay(const Lens& lens, const Eigen::Vector2d& pixel);

}  // namespace graspbench
