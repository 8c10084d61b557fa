// Any bytes as sweep.yaml, and as a line of the plan of such a session: refused with an Error, or
// conditions that differ in each of its factors and can be run.

#include <string>

#include "datasets/plan/conditions.h"
#include "datasets/plan/session_plan.h"
#include "datasets/records/trial_record.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  try {
    const SweepConfig sweep = ParseSweepConfig(bytes, "fuzz.yaml");
    const SessionConfig session = MakeSweep(sweep);
    for (const SweepFactor& factor : ListFactors(session)) {
      GRASPBENCH_DEMAND(factor.levels.size() > 1, factor.key);
    }
    for (const Condition& condition : session.conditions) ApplyCondition(condition, session);
  } catch (const Error&) {
  }
  try {
    const Json written = ToJson(ParsePlannedTrial(bytes));
    GRASPBENCH_DEMAND(ToJson(PlannedTrialFromJson(written)) == written, FormatJson(written));
  } catch (const Error&) {
  } catch (const Json::exception&) {
  }
}

}  // namespace graspbench
