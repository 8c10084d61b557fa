#pragma once
/** @file
Decides whether a changed grasp is accepted. Old and new grasp run on the same new draws until
paired_decision.h decides. Only these trials may be reported as the performance of the grasp, since
those by which it was chosen are biased upwards. */

#include <functional>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/optimise/learning_trial.h"
#include "core/optimise/methods/search.h"
#include "core/optimise/optimise_config.h"
#include "core/statistics/paired_decision.h"

namespace graspbench {

/** A request to the simulation: one grasp on some learning draws. */
struct LearningRequest {
  LearningStage stage = LearningStage::kStandard;
  Grasp grasp;
  std::vector<int> draws;       ///< 0: without variation
  bool full_hold = true;        ///< else a hold of 0.5 s, enough for the fitness
  bool keep_postures = false;   ///< store the postures of first touches, for step 1
  bool finds_strength = false;  ///< measure the strength of the grasp by pulling
  Individual individual;        ///< for stages that have one
};
/** Returns the trials of each request, in the order of the requests. */
using RunLearningTrials =
    std::function<std::vector<std::vector<LearningTrial>>(const std::vector<LearningRequest>&)>;

struct GraspCheck {
  std::vector<LearningTrial> before, after;  ///< on the same draws; `after` empty: no new grasp
  PairedDecision decision = PairedDecision::kGoOn;

  /** Whether the new grasp was shown to be better, with at least one success. */
  bool is_taken() const { return decision == PairedDecision::kTaken && CountSuccesses(after) > 0; }
};

struct CheckPlan {
  int first_draw = 0;
  int most_pairs = kPairsPerLook * kMostLooks;  ///< a multiple of kPairsPerLook
  /** Value of a trial; larger is better. */
  std::function<double(const LearningTrial&)> goal;
  bool finds_strength = false;  ///< required by the goal
};

GraspCheck CheckGrasp(const Grasp& before, const Grasp& after, const CheckPlan& plan,
                      const RunLearningTrials& run);

/** Runs the old grasp only, if there is no new one: as many trials as one look has. */
GraspCheck CheckOldGrasp(const Grasp& before, const CheckPlan& plan, const RunLearningTrials& run);

/** Formats a refusal: "start kept: the new target succeeded less often"; empty if accepted.
@param kept  name of what is kept.  @param changed  name of what was tested.  @param missed  reason
if the goal is not better. */
std::string DescribeRefusal(const GraspCheck& check, const std::string& kept,
                            const std::string& changed, const std::string& missed);

/** Returns `count` draws from the first. */
std::vector<int> ListDraws(int first, int count);

}  // namespace graspbench
