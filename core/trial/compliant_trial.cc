#include "core/trial/compliant_trial.h"

#include <new>

#include "core/physics/simbody/compliant_world.h"
#include "core/trial/protocols/table_lift.h"

namespace graspbench {

TrialResult RunCompliantTrial(const TrialSetup& setup) {
  try {
    return TableLift(MakeCompliantWorld(*setup.hand, *setup.object, setup.sim), setup).Run();
  } catch (const std::bad_alloc&) {  // of the machine, not of the trial
    throw;
  } catch (const std::exception& e) {
    // Simbody reports impossible states and steps that become too short this way.
    TrialResult result;
    result.outcome = Outcome::kNumericalFailure;
    result.reason = e.what();
    return result;
  }
}

}  // namespace graspbench
