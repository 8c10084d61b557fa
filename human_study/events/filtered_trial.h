#pragma once
/** @file
A reach behind the filters that its rules ask for. Every rule names a cut-off of its own and many
name the same one: a path is filtered once for each cut-off and kept, so that the family of hand
openings or a multiverse costs little more than one analysis. */

#include <map>
#include <utility>
#include <vector>

#include "human_study/events/reach_trial.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {

/** A fingertip in the frame of the object; in the laboratory's when the object was not recorded. */
struct TipAgainstObject {
  Trajectory p_O;        ///< the tip is unfiltered, the object's pose is filtered
  SmoothPath smooth;     ///< the same, filtered
  ScalarCurve speed;     ///< filtered [m/s]
  ScalarCurve distance;  ///< of the marker from the surface, filtered [m]; empty: shape not known
};

class FilteredTrial {
 public:
  /** Refers to the trial, which must outlive it. @throws Error as CheckTrial. */
  explicit FilteredTrial(const ReachTrial& trial);

  const ReachTrial& trial() const { return *trial_; }

  /** Tips in L, in the order of the digits. The reference stays valid, as that of all below.
  @throws Error(kRange), as all below, when a cut-off [Hz] does not fit the rate. */
  const std::vector<SmoothPath>& FilterTips(double cutoff);
  /** @param object_cutoff  of the object's pose. */
  const std::vector<TipAgainstObject>& FilterTipsAgainstObject(double cutoff, double object_cutoff);

 private:
  const ObjectTrack& FilterObject(double cutoff);

  const ReachTrial* trial_;
  std::map<double, std::vector<SmoothPath>> tips_;
  std::map<double, ObjectTrack> objects_;
  std::map<std::pair<double, double>, std::vector<TipAgainstObject>> tips_against_object_;
};

}  // namespace graspbench
