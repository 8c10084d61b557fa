#pragma once
/** @file
Positions of a person's digits relative to the object at two instants of a trial: at the widest hand
opening (the study's start of closure), and after the last digit's contact; also on their way
there. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "human_study/events/trial_analysis.h"

namespace graspbench {

/** Positions of a digit's marker, in the object's frame O [m]. */
struct DigitPlaces {
  std::string digit;  ///< "TH", "FF", ..
  Eigen::Vector3d p_OContact = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_OOpen = Eigen::Vector3d::Zero();
  /** Landmarks of the digit's joints at contact, from the palm to the last; empty: not recorded. */
  std::vector<Eigen::Vector3d> p_OJoints = {};
  std::vector<Eigen::Vector3d> p_OOpenJoints = {};  ///< at the widest opening
  double lag = 0.0;  ///< contact time after the first contact [s]; NaN: unresolved
  /** At contact, then every kCoursePeriod before, back to the onset of movement as far as all
  digits are visible. */
  std::vector<Eigen::Vector3d> p_OCourse = {};
};

inline constexpr double kCoursePeriod = 0.02;  ///< [s]

struct HandPlaces {
  std::vector<DigitPlaces> digits;          ///< those that touched, in the trial's order
  std::optional<Eigen::Vector3d> p_OWrist;  ///< at contact; none: not recorded
  /** Unit vector from the fingertips' centroid at the widest opening to that at contact; zero for a
  distance below 10 mm. */
  Eigen::Vector3d approach_O = Eigen::Vector3d::Zero();
  double from_widest = 0.0;  ///< time from the widest opening to the instant of contact [s]
};

/** Computes the positions from data filtered as for contacts, except for wrist and joints, which
are unfiltered. A position at contact is the median over 50 ms from the last contact on; at the
widest opening it is that of the instant. No answer when the object was not recorded, or an instant
is missing.
@param options  those of the analysis; default cut-offs are adapted to the trial's rate. */
Answer<HandPlaces> FindHandPlaces(const TrialAnalysis& analysis, const ReachTrial& reach,
                                  const AnalysisOptions& options);

/** Computes, over trials on one object, the median of each coordinate, for the digits that touched
in at least half of them. @pre `trials` is not empty. */
HandPlaces CalcMedianPlaces(const std::vector<HandPlaces>& trials);

}  // namespace graspbench
