#pragma once
/** @file
Whether a changed grasp is kept: old and new are tried on the same draws, which nothing else has
seen, until paired_decision.h decides. Only these trials may be told as what the grasp can do: those
by which it was chosen flatter it. */

#include <functional>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/optimise/learning_trial.h"
#include "core/optimise/methods/search.h"
#include "core/optimise/optimise_config.h"
#include "core/statistics/paired_decision.h"

namespace graspbench {

/** What the simulation is asked: one grasp on some learning draws. */
struct LearningRequest {
  LearningStage stage = LearningStage::kStandard;
  Grasp grasp;
  std::vector<int> draws;       ///< 0: without variation
  bool full_hold = true;        ///< else a hold of 0.5 s: enough to take the fitness from
  bool keep_postures = false;   ///< of the digits' first touches: the lesson of step 1
  bool finds_strength = false;  ///< what the grasp stands, by pulling
  Individual individual;        ///< of the stages that have one
};
/** The trials of each request, in the order of the requests. */
using RunLearningTrials =
    std::function<std::vector<std::vector<LearningTrial>>(const std::vector<LearningRequest>&)>;

struct GraspCheck {
  std::vector<LearningTrial> before, after;  ///< of the same draws; `after` empty: no new grasp
  PairedDecision decision = PairedDecision::kGoOn;

  /** Shown to be better; not by trials of which none holds. */
  bool is_taken() const { return decision == PairedDecision::kTaken && CountSuccesses(after) > 0; }
};

struct CheckPlan {
  int first_draw = 0;
  int most_pairs = kPairsPerLook * kMostLooks;  ///< a multiple of kPairsPerLook
  /** What a trial is worth; larger is better. */
  std::function<double(const LearningTrial&)> goal;
  bool finds_strength = false;  ///< the goal needs it
};

GraspCheck CheckGrasp(const Grasp& before, const Grasp& after, const CheckPlan& plan,
                      const RunLearningTrials& run);

/** The old grasp alone, when there is no new one: as many trials as one look has. */
GraspCheck CheckOldGrasp(const Grasp& before, const CheckPlan& plan, const RunLearningTrials& run);

/** "start kept: the new target succeeded less often"; empty when it is taken.
@param kept  what is kept.  @param changed  what was tried.  @param missed  why not, when it is not
better by the goal. */
std::string DescribeRefusal(const GraspCheck& check, const std::string& kept,
                            const std::string& changed, const std::string& missed);

/** So many draws from the first. */
std::vector<int> ListDraws(int first, int count);

}  // namespace graspbench
