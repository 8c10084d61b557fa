#pragma once
/** @file
One reach to grasp, as the analysis takes it: fingertips, wrist, object and force sensors on one
clock. Whoever makes it from a recording has cut it out, named the digits, made frozen samples
invalid, filled gaps up to a stated limit and resampled uneven times. It is *not* filtered: each
event needs a cut-off of its own.

Everything is in the laboratory's frame L (metres, seconds, newtons) or, where it says so, in O, the
frame of the object. */

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/shape/signed_distance_field.h"
#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

/** How far a point is from the surface of the object, for objects that a study describes in a line
and for those of the catalogue.

All are in frame O [m], positive outside, negative inside. O is the centre of the solid; z is up as
the object rests (core/base/pose.h). */
using SurfaceDistance = std::function<double(const Eigen::Vector3d& p_O)>;

/** @pre radius > 0. */
SurfaceDistance MakeSphereDistance(double radius);
/** Axis z. @pre both > 0. */
SurfaceDistance MakeCylinderDistance(double radius, double height);
/** @param size  length, width, height, each > 0. */
SurfaceDistance MakeBoxDistance(const Eigen::Vector3d& size);
/** Any closed mesh. Farther than SignedDistanceField::kMargin away it is a lower bound, which no
rule here minds. */
SurfaceDistance MakeFieldDistance(std::shared_ptr<const SignedDistanceField> field);

/** A sensor's samples on the trial's clock, at its own rate; empty when there is none. */
struct ForceChannel {
  std::vector<double> times;   ///< [s], increasing
  std::vector<double> values;  ///< [N] or any unit: the rules are relative
};

struct DigitTrack {
  std::string digit;      ///< "TH", "FF", "MF", "RF", "LF"
  bool is_thumb = false;  ///< at most one of a trial
  Trajectory tip;         ///< marker on the fingertip, in L
  /** Distance of the marker from the object's surface while the pad touches it [m]. NaN: taken from
  this trial's hold, which presumes that the digit touches. */
  double pad_offset = std::numeric_limits<double>::quiet_NaN();
  ForceChannel force;  ///< of this digit's force or tactile sensor
  /** Landmarks of its joints in L, from the palm to the last; empty: not recorded. No event depends
  on them. */
  std::vector<Trajectory> joints;
};

struct ObjectTrack {
  std::vector<Pose> X_LO;           ///< one a sample; empty: the object was not recorded
  std::vector<SampleState> states;  ///< as many
  SurfaceDistance distance;         ///< empty: the shape is not known
  /** Middle of the markers, the point of the object that is known best. */
  Eigen::Vector3d p_OC = Eigen::Vector3d::Zero();
  /** Square root of J = sum (|r|^2 1 - r r^T) over the markers' places r about C [m]: noise of SD s
  in every coordinate of every marker makes a rotation vector w of covariance s^2 J^-1, so that
  turn_lever * w has noise s in each coordinate. Zero: fewer than three markers, no turn is known.
*/
  Eigen::Matrix3d turn_lever = Eigen::Matrix3d::Zero();
  /** SD of a coordinate of C that a filter has left; 0 for an unfiltered track [m]. */
  double smooth_noise = 0.0;

  bool IsRecorded() const { return !X_LO.empty(); }
};

struct ReachTrial {
  std::vector<double> times;       ///< [s], even; all tracks have exactly these
  std::vector<DigitTrack> digits;  ///< thumb first, then from radial to ulnar
  Trajectory wrist;                ///< empty: the centroid of the tips stands in for it
  ObjectTrack object;
  /** Cut-off of a low-pass before the export (FindLowPassTrace) [Hz]; NaN: none seen. */
  double low_pass = std::numeric_limits<double>::quiet_NaN();
};

/** @throws Error(kRange) when tracks differ in length or times, the times are not even, there are
fewer than two digits or more than one thumb, or fewer than ten samples; it names the track. */
void CheckTrial(const ReachTrial& trial);

/** Orientation of an object at rest whose height points along `up_L`: z is up, x as nearly along L's
x as that allows. The identity where L's z is up. */
Eigen::Matrix3d MakeUprightOrientation(const Eigen::Vector3d& up_L);

/** Where an object's markers lie in O, from where they lie while it rests: the mean of each over
the samples before `until` [s]. O then has the orientation `R_LO`, and its origin lies at the
markers' centroid plus `p_MO_L`.
@throws Error(kFormat) when a marker has no valid sample before `until`. */
std::vector<Eigen::Vector3d> FindMarkerPlaces(
    const std::vector<Trajectory>& markers, double until, const Eigen::Vector3d& p_MO_L,
    const Eigen::Matrix3d& R_LO = Eigen::Matrix3d::Identity());

/** Poses of the object from its markers. Three and more: least-squares rigid fit (Umeyama 1991)
over those seen, at least three. One or two: their mean displacement, all must be seen, the
orientation stays `R_LO`. A pose is filled when a filled marker took part.
@param p_OM  places of the markers in O, as many as markers.
@throws Error(kRange) when three or more markers lie on one line. */
ObjectTrack MakeObjectTrack(const std::vector<Trajectory>& markers,
                            const std::vector<Eigen::Vector3d>& p_OM,
                            const Eigen::Matrix3d& R_LO = Eigen::Matrix3d::Identity());

/** Path of the middle of the object's markers, which no turn moves. */
Trajectory TakeObjectPath(const ReachTrial& trial);

/** Mean over the known poses of the trial's first tenth, or the first pose known. */
Eigen::Matrix3d FindRestingOrientation(const ObjectTrack& object);

/** The object's path behind a zero-phase low-pass: each coordinate of the middle of its markers and
of its axes, the axes then made orthonormal. A thing on a table moves slowly: filter its turn harder
than the tips.

Noise of the markers turns the object, and a turn moves the far tips more than the markers. So the
object is turned away from how it rested only as far as that exceeds its own noise: with
u = turn_lever * w of the smooth rotation vector w, and s the SD of the noise in each coordinate of
u behind the filter, the part of u along each principal axis of u within 0.1 s is multiplied by
max(0, 1 - (4 s / |part|)^2) (the non-negative garrote of Breiman 1995): a thing that is turned about
one axis does not tilt by noise about the others. Noise alone exceeds 4 s in 1 of 1,000 samples; a
turn ten times as large as that is found to 1 %. With one marker nothing turns; with three nothing
is worse than with one.
Rest is the mean orientation over the first tenth of the trial. Near the ends of the trial the
filter leaves more noise, and turns may show there.
@param cutoff  of the middle, `turn_cutoff` of the axes [Hz].
@pre the object was recorded. @throws Error(kRange) when a cut-off does not fit the rate. */
ObjectTrack SmoothObject(const ReachTrial& trial, double cutoff, double turn_cutoff);

}  // namespace graspbench
