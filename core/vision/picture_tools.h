#pragma once
/** @file
What OpenCV does for us, behind a table of functions. It lives in a module of its own
(picture_module.cc) that is opened at first use, as OSMesa is, because a program linked with OpenCV
would load it and what hangs on it for every command. */

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/render/scene.h"

namespace graspbench {

/** What a camera does to the picture that a perfect pinhole would give. */
struct PictureFaults {
  /** Where each pixel of the result lies in the picture that is given [pixel], middles at half
  integers; empty: at the same place. */
  std::vector<float> from_x, from_y;
  int width = 0, height = 0;  ///< of the result
  double blur = 0.0;          ///< standard deviation of a Gaussian [pixel]
  double exposure = 1.0;      ///< factor on the light, before it is encoded and clipped
  double noise = 0.0;         ///< standard deviation, of each channel by itself [grey level]
  uint64_t noise_seed = 0;
};

/** Of a difference, in grey levels of 255. A shadow makes all channels darker by one factor: that
is no difference as long as the factor is above `darkest_shadow`. */
struct DifferenceRule {
  double threshold = 25.0;
  double darkest_shadow = 0.5;  ///< as a share of the reference
  double brightest = 1.1;       ///< likewise
};

/** A connected region that differs. */
struct SeenRegion {
  std::vector<Eigen::Vector2d> contour;  ///< middles of its outermost pixels [pixel]
  double area = 0.0;                     ///< with its holes [pixel^2]
};

/** A rectangle in the plane. */
struct Rectangle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double length = 0.0;  ///< the longer side
  double width = 0.0;
  double direction = 0.0;  ///< of the length, from x towards y [rad]
};

struct PictureTools {
  Image (*apply_faults)(const Image& picture, const PictureFaults& faults);
  /** What differs from the reference, largest first. @pre pictures of one size. */
  std::vector<SeenRegion> (*find_regions)(const Image& picture, const Image& reference,
                                          const DifferenceRule& rule);
  /** The smallest around the points. @pre there are points. */
  Rectangle (*find_smallest_rectangle)(const std::vector<Eigen::Vector2d>& points);
};

/** @throws Error(kEnvironment) when the module or OpenCV cannot be loaded. */
const PictureTools& LoadPictureTools();

}  // namespace graspbench
