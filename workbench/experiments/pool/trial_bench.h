#pragma once
/** @file
The simulated world of one thread that runs trials of changing hands and objects. That of the last
hand and object is kept: a plan has all trials of a pair in a row. An object that comes without its
distance field gets it here, and it is dropped with the world. */

#include <memory>

#include "core/trial/trial_runner.h"
#include "core/trial/trial_setup.h"
#include "objects/catalogue.h"

namespace graspbench {

class TrialBench {
 public:
  /** The runner of the setup's hand and object, with all that its trial needs: it may build a
  distance field and the world's points. Completes the setup's object. */
  TrialRunner& Prepare(TrialSetup& setup) {
    if (setup.hand != hand_ || setup.object != object_) {
      hand_ = setup.hand;
      object_ = setup.object;
      complete_object_.reset();  // two fields at a time would be one too many
      runner_.reset();
      complete_object_ = CompleteObject(object_);
      runner_ = std::make_unique<TrialRunner>(hand_, complete_object_);
    }
    setup.object = complete_object_;
    runner_->Prepare(setup.sim);
    return *runner_;
  }

 private:
  std::shared_ptr<const Hand> hand_;
  std::shared_ptr<const GraspObject> object_;  ///< as it came
  std::shared_ptr<const GraspObject> complete_object_;
  std::unique_ptr<TrialRunner> runner_;
};

}  // namespace graspbench
