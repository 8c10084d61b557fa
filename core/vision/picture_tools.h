#pragma once
/** @file
OpenCV's functions behind a table of function pointers. They are in a separate module
(picture_module.cc) that is opened at first use, like OSMesa. A program linked with OpenCV would
load it and its dependencies for every command. */

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/render/scene.h"

namespace graspbench {

/** Degradation that a camera applies to the picture of an ideal pinhole camera. */
struct PictureFaults {
  /** Position in the given picture of each pixel of the result [pixel], pixel centres at half
  integers; empty: identity. */
  std::vector<float> from_x, from_y;
  int width = 0, height = 0;  ///< size of the result
  double blur = 0.0;          ///< standard deviation of a Gaussian [pixel]
  double exposure = 1.0;      ///< factor on the light, before encoding and clipping
  double noise = 0.0;         ///< standard deviation, independent in each channel [grey levels]
  uint64_t noise_seed = 0;
};

/** Criterion for a difference, in grey levels of 255. A shadow darkens all channels by one factor;
it does not count as a difference if the factor is above `darkest_shadow`. */
struct DifferenceRule {
  double threshold = 25.0;
  double darkest_shadow = 0.5;  ///< ratio to the reference
  double brightest = 1.1;       ///< likewise
};

/** A connected region that differs. */
struct SeenRegion {
  std::vector<Eigen::Vector2d> contour;  ///< centres of its outermost pixels [pixel]
  double area = 0.0;                     ///< including its holes [pixel^2]
};

/** A rectangle in the plane. */
struct Rectangle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double length = 0.0;  ///< the longer side
  double width = 0.0;
  double direction = 0.0;  ///< direction of the length, from x towards y [rad]
};

struct PictureTools {
  Image (*apply_faults)(const Image& picture, const PictureFaults& faults);
  /** Regions that differ from the reference, largest first. @pre pictures of one size. */
  std::vector<SeenRegion> (*find_regions)(const Image& picture, const Image& reference,
                                          const DifferenceRule& rule);
  /** Smallest rectangle around the points. @pre at least one point. */
  Rectangle (*find_smallest_rectangle)(const std::vector<Eigen::Vector2d>& points);
};

/** @throws Error(kEnvironment) if the module or OpenCV cannot be loaded. */
const PictureTools& LoadPictureTools();

}  // namespace graspbench
