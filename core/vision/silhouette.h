#pragma once
/** @file
The outline of an object as seen by a camera above the table, and the fit of one outline to another.

An outline is projected from the camera onto the horizontal plane through the object's middle. Only
its convex hull is used, as its support function h: its extent in each of kNumDirections directions.
The outline of the object's mesh at a supposed pose is projected in the same way. So near and far
parts, high and low ones appear where the camera sees them. Tall objects need no correction, and no
height of the outline is guessed.

    h(theta) = max over the outline's points p of p . (cos theta, sin theta)

An outline that is shifted by d, rotated by delta and thicker by b has

    h'(theta) = h(theta - delta) + d . (cos theta, sin theta) + b,

which is fitted by least squares: first over all rotations, then by Gauss-Newton steps that project
the outline again. b absorbs the outward shift of the edges by blur and threshold.

If the outline fits nearly as well after another rotation, it does not determine the rotation. The
fit includes the third moment of the outline, in which the ends of a long object differ, along with
all its other moments. */

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/base/pose.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

inline constexpr int kNumDirections = 180;

struct Silhouette {
  std::array<double, kNumDirections> reach{};             ///< h [m]
  std::array<Eigen::Vector2d, kNumDirections> extreme{};  ///< the point with this extent [m]
};
/** Returns the unit vector of direction `i` of kNumDirections, from x towards y. */
Eigen::Vector2d SilhouetteDirection(int i);
/** Returns the corners of the convex hull, counter-clockwise (Andrew 1979). @pre at least one
point. */
std::vector<Eigen::Vector2d> FindHull(std::vector<Eigen::Vector2d> points);
/** Returns the area of a simple polygon in either orientation [m^2]. */
double CalcArea(const std::vector<Eigen::Vector2d>& polygon);
/** @pre at least one point. */
Silhouette MakeSilhouette(const std::vector<Eigen::Vector2d>& points);

/** Pose of an object on the table. */
struct PlanarPose {
  double x = 0.0, y = 0.0;  ///< of O [m]
  double yaw = 0.0;         ///< [rad]
};

/** A resting object, reduced to what its outline needs. */
class OutlineModel {
 public:
  /** @param mesh  in frame O, as it rests. @pre it has vertices. */
  explicit OutlineModel(const TriMesh& mesh);
  double middle() const { return middle_; }  ///< height of O above the table [m]
  double height() const { return height_; }  ///< [m]
  /** Projects the outline from the eye onto the plane at the height of O. @pre the eye is above the
  object. */
  Silhouette Throw(const PlanarPose& pose, const Eigen::Vector3d& p_WEye) const;

 private:
  std::vector<Eigen::Vector3d> points_;  // of the convex hull, p_OP, to some 0.02 mm [m]
  double middle_, height_;
};

/** Rotations of the object that match the observed outline. */
enum class KnownDirection {
  kFull,       ///< one
  kHalfTurns,  ///< two, half a turn apart: the ends are not distinguished
  kSeveral,    ///< several: a square, or another symmetric shape
  kNone        ///< any: the object is round
};

struct OutlineFit {
  PlanarPose pose;
  KnownDirection direction = KnownDirection::kNone;
  double residual = 0.0;   ///< root mean square error of the fit [m]
  double thickness = 0.0;  ///< b [m]
};

/** Fits the outline. Among rotations that fit equally well, the nearest to the supposed one is
chosen; for a round object, the supposed one. If the ends are not distinguished, O is midway between
the positions for the two half turns.
@param tolerance  increase of the root mean square that makes a fit clearly worse [m]. */
OutlineFit FitOutline(const Silhouette& seen, const OutlineModel& model,
                      const Eigen::Vector3d& p_WEye, const PlanarPose& supposed, double tolerance);

}  // namespace graspbench
