// Any bytes as a policy server's answer: refused as a wrong answer, or an action of finite numbers.
// The same bytes as an observation, to be sent on: what is written is MessagePack.

#include "tests/fuzz/fuzz_target.h"
#include "workbench/experiments/policies/policy_server.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  const PackedValue names = {PackedValue::List{{std::string("a")}, {std::string("b")}}};
  const PackedValue facts = {PackedValue::Map{{"driven", names}, {"joints", names}}};
  const PolicyValues observation = {{"targets", {{2}, {0.0, 1.0}}}};
  PolicyServer server;
  for (const bool is_mapped : {false, true}) {
    server.is_mapped = is_mapped;
    if (is_mapped) server.actions.columns = {"b", "done"};
    try {
      const PolicyAction action = ServerExchange(server, facts).ReadAnswer(observation, bytes);
      GRASPBENCH_DEMAND(action.rows.allFinite() && action.rows.rows() <= 1000, "an action");
      GRASPBENCH_DEMAND(action.rows.rows() == 0 || action.rows.cols() == 2, "rows of another hand");
    } catch (const PolicyFault&) {
    }
  }
  try {
    const PolicyValues given = {{"time", ReadPackedArray(ParseMessagePack(bytes), "time")}};
    server.observation = {{"x", "", {"time"}, {}, "", {}, ""},
                          {"y", "m", {"time"}, {"b"}, "uint8", {2, 3}, ""}};
    ParseMessagePack(ServerExchange(server, facts).FormatQuestion(given));
  } catch (const Error&) {
  }
}

}  // namespace graspbench
