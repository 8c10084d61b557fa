#pragma once
/** @file
The outline of a thing as a camera above the table sees it, and how one outline is laid onto another.

An outline is thrown from the camera onto the level plane through the middle of the object. Of what
lies there only its convex hull counts, as its support function: how far it reaches in each of
kNumDirections directions. The object's own outline (of its mesh, at a supposed pose) is thrown in
the same way, so that near and far parts, high ones and low ones fall where the camera sees them:
nothing is left to correct for tall things, and no height of the outline need be guessed.

    h(theta) = max over the outline's points p of p . (cos theta, sin theta)

An outline that is shifted by d, turned by delta and thicker by b has

    h'(theta) = h(theta - delta) + d . (cos theta, sin theta) + b,

which is fitted by least squares: first over all turns, then by Gauss-Newton steps with the outline
thrown again. b takes up that blur and threshold move the edge of the picture outwards.

An outline that fits nearly as well after another turn does not tell which it is; the fit weighs the
third moment of the outline, in which the ends of a long thing differ, with all its other parts. */

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/base/pose.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

inline constexpr int kNumDirections = 180;

struct Silhouette {
  std::array<double, kNumDirections> reach{};             ///< h [m]
  std::array<Eigen::Vector2d, kNumDirections> extreme{};  ///< the point that reaches so far [m]
};
/** Unit; direction `i` of kNumDirections, from x towards y. */
Eigen::Vector2d SilhouetteDirection(int i);
/** Corners of the convex hull, counter-clockwise (Andrew 1979). @pre there are points. */
std::vector<Eigen::Vector2d> FindHull(std::vector<Eigen::Vector2d> points);
/** Of a polygon that does not cross itself, whichever way round [m^2]. */
double CalcArea(const std::vector<Eigen::Vector2d>& polygon);
/** @pre there are points. */
Silhouette MakeSilhouette(const std::vector<Eigen::Vector2d>& points);

/** Where an object lies on the table. */
struct PlanarPose {
  double x = 0.0, y = 0.0;  ///< of O [m]
  double yaw = 0.0;         ///< [rad]
};

/** A resting object, as its outline needs it. */
class OutlineModel {
 public:
  /** @param mesh  in frame O, as it rests. @pre it has vertices. */
  explicit OutlineModel(const TriMesh& mesh);
  double middle() const { return middle_; }  ///< height of O above the table [m]
  double height() const { return height_; }  ///< [m]
  /** Thrown from the eye onto the plane at the height of O. @pre the eye is above the object. */
  Silhouette Throw(const PlanarPose& pose, const Eigen::Vector3d& p_WEye) const;

 private:
  std::vector<Eigen::Vector3d> points_;  // of the convex hull, p_OP, to some 0.02 mm
  double middle_, height_;
};

/** Which turns of the object give the outline that is seen. */
enum class KnownDirection {
  kFull,       ///< one
  kHalfTurns,  ///< two, half a turn apart: not which end is which
  kSeveral,    ///< more: a square, or another shape that is like itself
  kNone        ///< any: it is round
};

struct OutlineFit {
  PlanarPose pose;
  KnownDirection direction = KnownDirection::kNone;
  double residual = 0.0;   ///< root mean square of what the fit leaves [m]
  double thickness = 0.0;  ///< b [m]
};

/** Of turns that fit alike, the nearest to the supposed one is taken; with no direction at all, the
supposed one. Where the ends are not distinguished, O is midway between what the two half-turns say.
@param tolerance  root mean square by which a worse fit is clearly worse [m]. */
OutlineFit FitOutline(const Silhouette& seen, const OutlineModel& model,
                      const Eigen::Vector3d& p_WEye, const PlanarPose& supposed, double tolerance);

}  // namespace graspbench
