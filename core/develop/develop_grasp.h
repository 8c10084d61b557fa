#pragma once
/** @file
Develops one grasp of a hand: geometry proposes candidates, simulation on training shapes selects.

    race      the best proposals run on half of the shapes, the better ones on the other half, the
              best of these on all shapes with other draws
    search    CMA-ES over small changes of the winner's postures (posture_changes.h), by the mean
              score over half of the shapes; shapes and draws change with every generation
    finals    the best of the search's later half and the unchanged winner, the start, on draws that
              neither has seen; the best third of them once more, including the start, so that
              nothing is chosen that scores lower on the same trials
    check     the chosen one on shapes that were never used before

The score is defined at DevelopTrial, the shapes in core/shape/synthetic_shapes.h. Trials are run by
a callback, so that the caller can use its threads and keep a journal. The same answers lead to the
same requests. */

#include <functional>
#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/develop/propose_grasps.h"
#include "core/grasp/standard_grasp.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_result.h"

namespace graspbench {

/** The stored data of a simulated trial in development, and its score, larger is better:

    success    1 + 0.3 x / (1 + x),  x = sigma / (m g + 0.2 N): how firmly it is held
               + 0.2 (digits that touched) / (all)
               + 0.6 if the opposition is that of its type (core/trial/measures/grasp_types.h)
               - 0.3 if a digit touched before the start of closure
    failure    0.3 (digits that touched) / (all) + 0.2 (height reached) / (height of the lift);
               0 for a numerical failure

so that failures are guided towards success, and firm grasps win among successes. */
struct DevelopTrial {
  Outcome outcome = Outcome::kNotRun;
  double score = 0.0;
  bool is_as_called = false;  ///< held by the opposition of its type

  template <class V>
  static void ListFields(V&& field) {
    field("outcome", &DevelopTrial::outcome);
    field("score", &DevelopTrial::score);
    field("as_called", &DevelopTrial::is_as_called);
  }
};

DevelopTrial MakeDevelopTrial(const Grasp& grasp, const GraspObject& object,
                              const TrialResult& result);

double CalcMeanScore(const std::vector<DevelopTrial>& trials);  ///< 0 without trials
int CountSuccesses(const std::vector<DevelopTrial>& trials);
int CountAsCalled(const std::vector<DevelopTrial>& trials);  ///< among the successes

struct DevelopConfig {
  int budget = 15000;  ///< approximate number of trials of all grasps together
  int seed = 1;
  /** For coupled joints (core/hand/hand.h): use the hand's own rule, or all rules in turn for a
  hand whose rule is unknown. */
  bool any_coupling = false;

  template <class V>
  void Visit(V&& v) {
    v("budget", budget, "trials of all grasps together, about");
    v("seed", seed, "random seed of shapes and search");
    v("any_coupling", any_coupling, "the rule of coupled joints is not known: train with all");
  }
};

/** One grasp on some shapes. */
struct DevelopRequest {
  struct Trial {
    int shape = 0;  ///< index into the shapes; those of the check follow those of training
    int draw = 0;   ///< number of the draw of the variation between trials
  };
  std::string stage;  ///< "race", "search", "finals", "check"
  Grasp grasp;
  std::vector<Trial> trials;
};
/** Returns the trials of each request, in the order of the requests. */
using RunDevelopTrials =
    std::function<std::vector<std::vector<DevelopTrial>>(const std::vector<DevelopRequest>&)>;

/** Number of shapes for training a grasp, followed by as many for the check. */
inline constexpr int kNumTrainingShapes = 24;

struct DevelopedGrasp {
  ProposedGrasp proposed;           ///< proposed by geometry and selected by the race
  Grasp grasp;                      ///< the result
  double proposed_score = 0.0;      ///< score of `proposed` in the finals
  double score = 0.0;               ///< score of `grasp` in the finals
  int num_trials = 0;               ///< total
  int num_numerical_failures = 0;   ///< of these; they score 0
  std::vector<DevelopTrial> check;  ///< one trial per shape
};

/** Approximate number of trials that DevelopGrasp requests. */
int CountDevelopTrials(int budget);

/** @param budget  number of trials of this grasp.  @pre `proposals` is not empty, best first. */
DevelopedGrasp DevelopGrasp(const Hand& hand, const std::vector<ProposedGrasp>& proposals,
                            int budget, int seed, const RunDevelopTrials& run);

}  // namespace graspbench
