#pragma once
/** @file
Runs trials of changing hands and objects in one thread. The simulated world of the last hand and
object is kept: a plan has all trials of a pair in a row. */

#include <memory>

#include "core/trial/trial_runner.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

class SetupRunner {
 public:
  TrialResult Run(const TrialSetup& setup) { return Find(setup).Run(setup); }
  JudgedTrial Judge(const TrialSetup& setup) { return Find(setup).Judge(setup); }

 private:
  TrialRunner& Find(const TrialSetup& setup) {
    if (setup.hand != hand_ || setup.object != object_) {
      runner_ = std::make_unique<TrialRunner>(setup.hand, setup.object);
      hand_ = setup.hand;
      object_ = setup.object;
    }
    return *runner_;
  }

  std::shared_ptr<const Hand> hand_;
  std::shared_ptr<const GraspObject> object_;
  std::unique_ptr<TrialRunner> runner_;
};

}  // namespace graspbench
