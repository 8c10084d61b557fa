// Any bytes as a set of contacts: refused with an Error, or a quality within its bounds. The hull
// is left to the replay: it is too slow for a fuzzer.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/error.h"
#include "core/quality/contacts_json.h"
#include "core/quality/epsilon_fast.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace graspbench;
  try {
    const QualityRequest request =
        ParseQualityRequest({reinterpret_cast<const char*>(data), size}, "fuzz");
    WrenchSpace space;
    space.torque_scale = request.torque_scale.value_or(1.0);
    space.p_OR = request.p_OR;
    const EpsilonBounds bounds =
        CalcEpsilonBounds(CalcConeWrenches(request.contacts, space).wrenches);
    GRASPBENCH_DEMAND(bounds.lower >= 0.0 && bounds.lower <= bounds.upper,
                      std::to_string(bounds.lower) + " to " + std::to_string(bounds.upper));
  } catch (const Error&) {
  }
  return 0;
}
