// Any bytes as a set of contacts: refused with an Error, or a quality within its bounds. The hull
// is left to the replay: it is too slow for a fuzzer.

#include "core/quality/contacts_json.h"
#include "core/quality/epsilon_fast.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  try {
    const QualityRequest request = ParseQualityRequest(bytes, "fuzz");
    WrenchSpace space;
    space.torque_scale = request.torque_scale.value_or(1.0);
    space.p_OR = request.p_OR;
    const EpsilonBounds bounds =
        CalcEpsilonBounds(CalcConeWrenches(request.contacts, space).wrenches);
    GRASPBENCH_DEMAND(bounds.lower >= 0.0 && bounds.lower <= bounds.upper,
                      std::to_string(bounds.lower) + " to " + std::to_string(bounds.upper));
  } catch (const Error&) {
  }
}

}  // namespace graspbench
