#pragma once
/** @file
Develops one grasp of a hand: geometry proposes, simulation on training shapes decides.

    race      the best proposals grasp half of the shapes, the better ones the others, the best
              ones all of them again with other draws
    search    CMA-ES among small changes of the winner's postures (posture_changes.h), mean score of
              half of the shapes, of other ones with other draws in every generation
    finals    the best of the search's later half and the winner as it was, the start, on draws that
              neither has seen; the best third of them once more, the start among them, so that
              nothing is chosen that scores lower on the same trials
    check     the chosen one on shapes that nothing has seen

How it scores stands at DevelopTrial, the shapes in core/shape/synthetic_shapes.h. The simulation is
asked, so that the caller runs the trials on its threads and keeps a journal; the same answers lead
to the same questions. */

#include <functional>
#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/develop/propose_grasps.h"
#include "core/grasp/standard_grasp.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_result.h"

namespace graspbench {

/** What the development keeps of a simulated trial, and how it scores it, larger is better:

    success    1 + 0.3 x / (1 + x),  x = sigma / (m g + 0.2 N): how firmly it is held
               + 0.2 (digits that touched) / (all)
               + 0.6 when the opposition is that of its name (core/trial/measures/grasp_types.h)
               - 0.3 when a digit touched before the hand closed
    else       0.3 (digits that touched) / (all) + 0.2 (height reached) / (height of the lift),
               0 of a numerical failure

so that a failure leads towards success, and among successes the firm ones win. */
struct DevelopTrial {
  Outcome outcome = Outcome::kNotRun;
  double score = 0.0;
  bool is_as_called = false;  ///< it was held by the opposition of its name

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
int CountAsCalled(const std::vector<DevelopTrial>& trials);  ///< of the successes

struct DevelopConfig {
  int budget = 15000;  ///< trials of all grasps together, about
  int seed = 1;
  /** Of coupled joints (core/hand/hand.h): the hand's own rule, or that and all others in turn,
  for a hand whose rule is not known. */
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
    int shape = 0;  ///< index into the shapes; those for the check follow those for training
    int draw = 0;   ///< of the variation between trials
  };
  std::string stage;  ///< "race", "search", "finals", "check"
  Grasp grasp;
  std::vector<Trial> trials;
};
/** The trials of each request, in the order of the requests. */
using RunDevelopTrials =
    std::function<std::vector<std::vector<DevelopTrial>>(const std::vector<DevelopRequest>&)>;

/** Shapes of a grasp: so many to train on, then as many to check with. */
inline constexpr int kNumTrainingShapes = 24;

struct DevelopedGrasp {
  ProposedGrasp proposed;           ///< what geometry gave, and the race chose
  Grasp grasp;                      ///< what came of it
  double proposed_score = 0.0;      ///< in the finals
  double score = 0.0;               ///< in the finals
  int num_trials = 0;               ///< in all
  int num_numerical_failures = 0;   ///< of these; they score 0
  std::vector<DevelopTrial> check;  ///< a trial of each shape
};

/** About how many trials DevelopGrasp asks for. */
int CountDevelopTrials(int budget);

/** @param budget  of trials of this grasp.  @pre `proposals` is not empty, best first. */
DevelopedGrasp DevelopGrasp(const Hand& hand, const std::vector<ProposedGrasp>& proposals,
                            int budget, int seed, const RunDevelopTrials& run);

}  // namespace graspbench
