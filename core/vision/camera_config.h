#pragma once
/** @file
A session's settings of the wrist camera: what it does to pictures, and where it looks from. Lens and
mount belong to the hand (core/hand/hand.h). All values are proposals of graspbench. */

#include <Eigen/Core>
#include <optional>
#include <string>

namespace graspbench {

struct CameraConfig {
  double look_height = 0.4;  ///< of the camera above the table, looking straight down [m]
  double noise = 3.0;        ///< standard deviation, each channel [grey level]
  double blur = 0.7;         ///< standard deviation [pixel]
  double exposure = 1.0;     ///< factor on the light
  bool has_shadows = false;  ///< pictures in full quality; without, they are fast
  /** Magenta: nothing of the 21 objects has that hue, and shadows do not change it. */
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

/** "#b4509b" as sRGB from 0 to 1; unset: it is no such text. */
std::optional<Eigen::Vector3f> ParseColour(const std::string& text);

}  // namespace graspbench
