#pragma once
/** @file
Two digits that carry each other's label through a whole trial: they are where the other is in the
person's other trials.

For two digits a and b of a trial, q is the median over the reach of

    (p_a - p_b, |p_a - p_W| - |p_b - p_W|)   [m], in L; W the wrist's marker, without one 0.

An exchange of the two labels changes the sign of q and nothing else. With m the person's median of
q, the labels are exchanged where |q - m| > 2 |q + m|, and where their exchange brings no other pair
nearer to -m than to m. A hand that is turned round changes the sign of the first three of all its
pairs; its thumb stays as near to the wrist. */

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "human_study/events/doubts/plausibility.h"
#include "human_study/events/trial_analysis.h"
#include "human_study/study/design/study_config.h"

namespace graspbench {

/** Two digits of a trial. */
struct DigitPair {
  std::string one, other;  ///< names
  Eigen::Vector4d place;   ///< q
};

class UsualHands {
 public:
  /** Another trial of its person. */
  void Add(const PlannedReach& planned, const TrialAnalysis& analysis, const ReachTrial& reach);

  /** labels_exchanged: the pair of digits that fits best the other way round. Compared with the
  person's trials of that hand on that object, if three or more were added, else on any. Nothing is
  said of fewer than three, nor where fewer than two thirds of them agree. */
  std::vector<Doubt> FindExchange(const PlannedReach& planned, const TrialAnalysis& analysis,
                                  const ReachTrial& reach) const;

 private:
  /** m; nothing where it cannot be told. */
  std::optional<Eigen::Vector4d> FindUsual(const PlannedReach& planned,
                                           const DigitPair& pair) const;
  /** With these two labels exchanged no pair of the hand is nearer to -m than to m. */
  bool FitsExchanged(const PlannedReach& planned, const std::vector<DigitPair>& pairs,
                     const DigitPair& exchanged) const;

  std::map<std::string, std::vector<Eigen::Vector4d>> places_;  // by person, hand, object, pair
};

}  // namespace graspbench
