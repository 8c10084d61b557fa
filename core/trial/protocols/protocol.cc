#include "core/trial/protocols/protocol.h"

#include "core/base/error.h"

namespace graspbench {

TrialResult TrialCourse::Run(const std::function<void(TrialCourse&)>& observe) {
  Begin();
  do {
    if (observe) observe(*this);
  } while (Advance());
  return End();
}

const std::vector<const Protocol*>& ListProtocols() {
  static const std::vector<const Protocol*> protocols = {
#define GRASPBENCH_PROTOCOL(Name) &Get##Name(),
#include "core/trial/protocols/protocol_list.inc"
#undef GRASPBENCH_PROTOCOL
  };
  return protocols;
}

const Protocol& FindProtocol(const std::string& id) {
  std::vector<std::string> known;
  for (const Protocol* protocol : ListProtocols()) {
    if (protocol->id == id) return *protocol;
    known.emplace_back(protocol->id);
  }
  throw Error(ErrorKind::kUsage, "no protocol \"" + id + "\"" + SuggestNames(id, known));
}

}  // namespace graspbench
