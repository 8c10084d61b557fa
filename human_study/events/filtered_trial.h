#pragma once
/** @file
A reach behind the filters that its rules ask for. Every rule names a cut-off of its own and many
name the same one: a path is filtered once for each cut-off and kept, so that the family of hand
openings or a multiverse costs little more than one analysis. */

#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "human_study/events/reach_trial.h"
#include "human_study/events/scalar_curve.h"
#include "human_study/events/touch_fit.h"

namespace graspbench {

struct HandCourse;
struct Hold;

/** A fingertip in the frame of the object; in the laboratory's when the object was not recorded. */
struct TipAgainstObject {
  Trajectory p_O;        ///< the tip is unfiltered, the object's pose is filtered
  SmoothPath smooth;     ///< the same, filtered
  ScalarCurve speed;     ///< filtered [m/s]
  ScalarCurve distance;  ///< of the marker from the surface, filtered [m]; empty: shape not known
  /** SD of a coordinate of p_O [m]: the tip's and what the filter has left of the object's. */
  double noise = 0.0;
  double smooth_noise = 0.0;  ///< the same of `smooth` [m]
};

/** What the unfiltered path of a fingertip says of its touch. */
struct TouchFits {
  TouchFit surface;  ///< of the clearance from the surface
  TouchFit path;     ///< of the way to the place in the hold
};

class FilteredTrial {
 public:
  /** Refers to the trial, which must outlive it. @throws Error as CheckTrial. */
  explicit FilteredTrial(const ReachTrial& trial);

  const ReachTrial& trial() const { return *trial_; }

  /** Tips in L, in the order of the digits. The reference stays valid, as that of all below.
  @throws Error(kRange), as all below, when a cut-off [Hz] does not fit the rate. */
  const std::vector<SmoothPath>& FilterTips(double cutoff);
  /** Of tips and wrist, by CalcHandCourse. */
  std::shared_ptr<const HandCourse> FollowHand(double cutoff);
  /** @param object_cutoff  of the object's pose. */
  const std::vector<TipAgainstObject>& FilterTipsAgainstObject(double cutoff, double object_cutoff);
  /** In the order of the digits. No cut-off of the tips matters.
  @param tips  of any cut-off against that object. */
  const std::vector<TouchFits>& FitTouches(const std::vector<TipAgainstObject>& tips,
                                           const Hold& hold, double object_cutoff);

 private:
  const ObjectTrack& FilterObject(double cutoff);

  const ReachTrial* trial_;
  std::map<double, std::vector<SmoothPath>> tips_;
  std::map<double, std::shared_ptr<const HandCourse>> hands_;
  std::map<double, ObjectTrack> objects_;
  std::map<std::pair<double, double>, std::vector<TipAgainstObject>> tips_against_object_;
  std::map<std::array<double, 4>, std::vector<TouchFits>> touch_fits_;  // by hold and cut-off
};

}  // namespace graspbench
