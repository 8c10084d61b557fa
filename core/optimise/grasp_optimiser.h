#pragma once
/** @file
Adapts a standard grasp to one object in simulation, in two steps (Roethling 2007):

1. The new pre-grasp is learned in one or two shots (pregrasp_learning.h). Shot 1 learns from the
   standard grasp's trial without variation, shot 2 from that of the best of shot 1. Digits that
   close in another order obstruct each other differently, so shot 2 expects the mean of both
   lessons. Each shot is tested in three widths. Differences that no pre-grasp can remove are
   compensated by delays (LearnDelays), starting from the best shot and from the standard pre-grasp.
2. The new target grasp: the target angles of the opposing digit (the thumb) are evolved from there
   within the joint limits and +-25 deg, or in another search space (grasp_space.h). The fitness is
   sigma (learning_trial.h).

The hand stays where the standard grasp places it, unless its pose is searched.

A search finds the best for the few trials of its fitness, and sigma is rugged: some isolated points
hold on these trials only, the more the longer the search. Therefore the hundred fittest individuals
that differ by 2 deg or more are screened on three other draws each. The ten best, the finalists,
run on more draws, and the best of them is the found target. Individuals are ranked by success rate,
then by mean fitness.

A target that holds better by squeezing harder is not a better target. Sigma therefore counts only
up to the grip that the hand may use (learning_trial.h), by default that of the start of the search.

No step makes a grasp worse; this rule is proposed by graspbench. The best new pre-grasp and the
found target are each compared with the old one on up to a hundred new draws. The new one is
accepted if it is shown to succeed at most 5 points less often and to reach a better goal in most
pairs (grasp_check.h). The goal is a lower GFT% (infinite if a digit never touches), or a higher
fitness. If the best pre-grasp is refused, the best of the other kind, with or without delays, is
also checked. The rate of false acceptances is thus up to a tenth of scenes instead of a twentieth.
Otherwise the old one is kept, and the verdict states the reason. The draws of the check come from
streams that no benchmark uses. */

#include <string>
#include <vector>

#include "core/grasp/contact_timing.h"
#include "core/grasp/standard_grasp.h"
#include "core/optimise/grasp_check.h"
#include "core/optimise/learning_trial.h"
#include "core/optimise/pregrasp_learning.h"
#include "core/optimise/target_search.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

struct PreGraspShot {
  std::string name;              ///< "one-shot, widest", "standard pre-grasp, delayed", ...
  LearnedPreGrasp learned;       ///< for a delayed one, that of the shot before the delays
  bool adds_delays = false;      ///< digits wait longer than in the closing of the start
  bool was_pushed_away = false;  ///< the trial it learned from ended with the object out of reach
  Grasp grasp;                   ///< with the new pre-grasp and closing schedules
  std::vector<LearningTrial> trials;  ///< for the choice; the first is without variation
};

struct PreGraspStep {
  std::vector<LearningTrial> standard_trials;  ///< on the draws of the shots
  std::vector<PreGraspShot> shots;             ///< empty if there was nothing to learn
  int best = -1;                               ///< index into shots; -1: none looked better
  GraspCheck check;
  int chosen = -1;  ///< index into shots; -1: the standard pre-grasp is kept
  /** The best shot without added delays, which shows the effect of one-/two-shot learning alone,
  and its trials on the draws of the check's first look. -1: nothing was checked, or there is
  none. */
  int alone = -1;
  std::vector<LearningTrial> alone_trials;
  std::string verdict;

  /** Trials of the check's first look with the old pre-grasp, for comparison with alone_trials. */
  std::vector<LearningTrial> ListBeforeAlone() const;
};

/** "pre-grasp", "closing delays", "pre-grasp and closing delays". */
std::string NameWhatChanged(const PreGraspShot& shot);

struct TargetStep {
  std::vector<GraspCoordinate> coordinates;
  SearchSpace space;             ///< of these coordinates [rad]
  double grip_limit = kAnyGrip;  ///< grip that the search may use [N]
  SearchResult search;
  std::vector<int> simulated;  ///< numbers of the simulated individuals, ascending; a race skips
                               ///< some
  std::vector<Finalist> finalists;  ///< best first
  int found = 0;                    ///< number of the best finalist; 0: the start
  GraspCheck check;
  std::string verdict;
};

struct OptimisedGrasp {
  Grasp new_pregrasp;          ///< has its variant's id; the standard postures if step 1 kept them
  Grasp new_target;            ///< likewise; the postures of new_pregrasp if step 2 kept them
  PreGraspStep pregrasp_step;  ///< empty if not requested
  TargetStep target_step;      ///< likewise
};

/** @throws Error of the space or method, before any request; errors of `run`. Deterministic: the
same answers of `run` lead to the same requests. */
OptimisedGrasp OptimiseGrasp(const Hand& hand, const GraspObject& object, const Grasp& standard,
                             const OptimiseConfig& config, const RunLearningTrials& run);

/** Runs only the search of step 2, without screening, finalists and check. */
TargetStep SearchTarget(const Hand& hand, const GraspObject& object, const Grasp& start,
                        const OptimiseConfig& config, const RunLearningTrials& run);

/** Makes a standard grasp specific to one object: with this id and its placement. Angles are
rounded as in a grasp file, so that the file contains exactly the grasp that was tested. */
Grasp MakeObjectGrasp(const Hand& hand, const GraspObject& object, const Grasp& standard,
                      const std::string& id);

/** Estimated number of trials of OptimiseGrasp, since the length of a check is not known. */
int CountLearningTrials(const OptimiseConfig& config);

/** Returns infinity if at least half of the trials lack a contact; NaN without trials. */
double CalcMedianGftRatio(const std::vector<LearningTrial>& trials);
/** Floor of GFT% (core/grasp/contact_timing.h) over the same trials. */
Answer<double> CalcGftFloor(const std::vector<LearningTrial>& trials);
double CalcMeanSigma(const std::vector<LearningTrial>& trials);  ///< NaN without trials

}  // namespace graspbench
