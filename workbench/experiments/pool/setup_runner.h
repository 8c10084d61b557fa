#pragma once
/** @file
Runs trials of changing hands and objects in one thread. The simulated world of the last hand and
object is kept: a plan has all trials of a pair in a row. An object that comes without its distance
field gets it here, and it is dropped with the world. */

#include <memory>

#include "core/trial/trial_runner.h"
#include "core/trial/trial_setup.h"
#include "core/trial/trial_trace.h"
#include "objects/catalogue.h"

namespace graspbench {

class SetupRunner {
 public:
  /** What Run and Judge would do first: it may build a distance field and the world's points. */
  void Prepare(TrialSetup setup) { Find(setup).Prepare(setup.sim); }
  TrialResult Run(TrialSetup setup) { return Find(setup).Run(setup); }
  TracedTrial Trace(TrialSetup setup, double interval) {
    return TraceTrial(Find(setup), setup, interval);
  }
  JudgedTrial Judge(TrialSetup setup) { return Find(setup).Judge(setup); }

 private:
  /** Completes the setup's object. */
  TrialRunner& Find(TrialSetup& setup) {
    if (setup.hand != hand_ || setup.object != object_) {
      hand_ = setup.hand;
      object_ = setup.object;
      complete_object_.reset();  // two fields at a time would be one too many
      runner_.reset();
      complete_object_ = CompleteObject(object_);
      runner_ = std::make_unique<TrialRunner>(hand_, complete_object_);
    }
    setup.object = complete_object_;
    return *runner_;
  }

  std::shared_ptr<const Hand> hand_;
  std::shared_ptr<const GraspObject> object_;  ///< as it came
  std::shared_ptr<const GraspObject> complete_object_;
  std::unique_ptr<TrialRunner> runner_;
};

}  // namespace graspbench
