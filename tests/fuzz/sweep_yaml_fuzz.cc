// Any bytes as sweep.yaml, and as a line of the plan of such a session: refused with an Error, or
// conditions that differ in each of its factors and can be run.

#include <cstdint>
#include <string>

#include "core/base/error.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/session_plan.h"
#include "datasets/plan/sweep_design.h"
#include "datasets/records/trial_record.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace graspbench;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
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
  return 0;
}
