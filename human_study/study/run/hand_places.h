#pragma once
/** @file
Where a person's digits were against the object at two instants of a trial: when the hand was widest
(the study's start of closure), and when the last digit had touched. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "human_study/events/trial_analysis.h"

namespace graspbench {

/** Of the marker, in the object's frame O [m]. */
struct DigitPlaces {
  std::string digit;  ///< "TH", "FF", ..
  Eigen::Vector3d p_OContact = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_OOpen = Eigen::Vector3d::Zero();
  /** Landmarks of its joints at contact, from the palm to the last; empty: not recorded. */
  std::vector<Eigen::Vector3d> p_OJoints = {};
  std::vector<Eigen::Vector3d> p_OOpenJoints = {};  ///< the same at the widest opening
  double lag = 0.0;  ///< of its contact after the first [s]; NaN: unresolved
};

struct HandPlaces {
  std::vector<DigitPlaces> digits;          ///< those that touched, in the trial's order
  std::optional<Eigen::Vector3d> p_OWrist;  ///< at contact; none: not recorded
  /** Unit: from where the fingertips' middle was at the widest opening to where it is at contact;
  zero where that is less than 10 mm. */
  Eigen::Vector3d approach_O = Eigen::Vector3d::Zero();
};

/** Behind the study's filters of contacts, but for wrist and joints, which are not filtered. A place
at contact is the median over 50 ms from the last contact on, at the widest opening that of the
instant.
@param options  those of the analysis; cut-offs that are not stated are fitted to the trial's rate.
The reason where there is none: the object was not recorded, or an instant is missing. */
Answer<HandPlaces> FindHandPlaces(const TrialAnalysis& analysis, const ReachTrial& reach,
                                  const AnalysisOptions& options);

/** Of trials on one object: the median of each coordinate, of the digits that touched in half of
them or more. @pre one at least. */
HandPlaces CalcMedianPlaces(const std::vector<HandPlaces>& trials);

}  // namespace graspbench
