#pragma once
/** @file
Makes a standard grasp object-specific in simulation, in two steps (Roethling 2007):

1. the new pre-grasp, learned in one or two shots (pregrasp_learning.h): shot 1 learns from the
   standard grasp's trial without variation, shot 2 from that of the best of shot 1, because fingers
   hold each other back in another way when they close in another order; so it expects the mean of
   what both lessons showed. Each shot is tried in three widths. What no pre-grasp reaches digits
   wait for (LearnDelays), from the best of them and from the standard pre-grasp;
2. the new target grasp: the opposing digit's (the thumb's) target angles, evolved from there within
   the joint limits and +-25 deg, or another search space (grasp_space.h); fitness sigma
   (learning_trial.h).

The hand stays where the standard grasp puts it, unless its pose is what is searched.

A search finds what is best on the few trials of its fitness, and sigma is rugged: single points
stand out that hold on these trials only, the more of them the longer the search. So the hundred
fittest individuals that differ by 2 deg or more are screened on three other draws each, the ten
that come out best, the finalists, are tried on more, and the best of these is the found target.
Best is what succeeds most often; among equals the higher mean fitness counts.

What holds best by squeezing harder is not a better target: fitness counts sigma as far as the hand
may grip (learning_trial.h), by default as much as the search's start does.

No step makes a grasp worse; this rule is proposed by graspbench. The best new pre-grasp and the
found target are each tried beside the old one on up to a hundred draws that nothing has seen, and
taken when it is shown that they succeed at most 5 points less often and are better by the goal in
most pairs (grasp_check.h): a lower GFT% (a trial in which a digit never touches counts as
infinite), a higher fitness. Where the best pre-grasp is refused, the best of the other kind is
checked, too: one whose digits do not wait, or do; so one that is no better is taken in up to a
tenth of scenes, not a twentieth. Otherwise the old one is kept, and the verdict says why. The
check's draws come from streams that no benchmark uses. */

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
  LearnedPreGrasp learned;       ///< of one whose digits wait that from which they were delayed
  bool adds_delays = false;      ///< digits wait longer than in the start's closing
  bool was_pushed_away = false;  ///< the trial it learned from ended with the object out of reach
  Grasp grasp;                   ///< with the new pre-grasp and closing schedules
  std::vector<LearningTrial> trials;  ///< of the choice; the first one is without variation
};

struct PreGraspStep {
  std::vector<LearningTrial> standard_trials;  ///< on the draws of the shots
  std::vector<PreGraspShot> shots;             ///< none, when there was nothing to learn
  int best = -1;                               ///< index into shots; -1: none looked better
  GraspCheck check;
  int chosen = -1;  ///< index into shots; -1: the standard pre-grasp is kept
  /** What the one-/two-shot learning of the pre-grasp reaches alone: the best shot that adds no
  delay, and its trials on the draws of the check's first look. -1: nothing was checked, or there is
  none. */
  int alone = -1;
  std::vector<LearningTrial> alone_trials;
  std::string verdict;

  /** The trials of the check's first look with the old pre-grasp, beside alone_trials. */
  std::vector<LearningTrial> ListBeforeAlone() const;
};

/** "pre-grasp", "closing delays", "pre-grasp and closing delays". */
std::string NameWhatChanged(const PreGraspShot& shot);

struct TargetStep {
  std::vector<GraspCoordinate> coordinates;
  SearchSpace space;             ///< of them [rad]
  double grip_limit = kAnyGrip;  ///< that holds for the search [N]
  SearchResult search;
  std::vector<int> simulated;  ///< numbers of the individuals that were, rising: of a race not all
  std::vector<Finalist> finalists;  ///< the best first
  int found = 0;                    ///< number of the best finalist; 0: the start
  GraspCheck check;
  std::string verdict;
};

struct OptimisedGrasp {
  Grasp new_pregrasp;  ///< its id is its variant's; the standard postures when step 1 kept them
  Grasp new_target;    ///< the same; those of new_pregrasp when step 2 kept them
  PreGraspStep pregrasp_step;  ///< empty when it was not asked for
  TargetStep target_step;      ///< the same
};

/** @throws Error of the space or method, before anything is asked; what `run` throws. Deterministic:
the same answers of `run` lead to the same requests. */
OptimisedGrasp OptimiseGrasp(const Hand& hand, const GraspObject& object, const Grasp& standard,
                             const OptimiseConfig& config, const RunLearningTrials& run);

/** Step 2's search alone, without screening, finalists and check. */
TargetStep SearchTarget(const Hand& hand, const GraspObject& object, const Grasp& start,
                        const OptimiseConfig& config, const RunLearningTrials& run);

/** A standard grasp as it becomes when it is made for one object: with this id, at its place;
angles rounded as in a grasp file, so that a file holds the very grasp that was tried. */
Grasp MakeObjectGrasp(const Hand& hand, const GraspObject& object, const Grasp& standard,
                      const std::string& id);

/** About how many trials OptimiseGrasp will run: how soon a check is decided is not known. */
int CountLearningTrials(const OptimiseConfig& config);

/** Infinite when half of the trials or more lack a contact; NaN without trials. */
double CalcMedianGftRatio(const std::vector<LearningTrial>& trials);
/** Its floor (core/grasp/contact_timing.h) over the same trials. */
Answer<double> CalcGftFloor(const std::vector<LearningTrial>& trials);
double CalcMeanSigma(const std::vector<LearningTrial>& trials);  ///< NaN without trials

}  // namespace graspbench
