// Any bytes as a controller's answer: refused with an Error, or an action of finite numbers.

#include "core/trial/policy/policy_messages.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  try {
    const PolicyAction action = ReadPolicyAction(ParsePolicyAnswer(bytes), 3);
    GRASPBENCH_DEMAND(action.rows.allFinite() && action.rows.rows() <= 1000, "an action");
    GRASPBENCH_DEMAND(action.is_done || action.rows.cols() == 3, "an action without rows");
  } catch (const Error&) {
  }
  try {
    const PackedValue answer = ParsePolicyAnswer(bytes);
    ReadPolicyAnswerNumber(answer);
    CheckPolicyReset(answer);
  } catch (const Error&) {
  }
}

}  // namespace graspbench
