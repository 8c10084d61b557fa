#include "core/trial/measures/palm_contact.h"

#include <map>
#include <string>

namespace graspbench {

bool TouchesPalmAtEnd(const TrialResult& result) {
  std::map<std::string, bool> touches;  // by link
  for (const ContactEvent& event : result.contact_events) {
    if (event.digit != "palm" || event.kind == ContactEventKind::kSlip) continue;
    touches[event.link] = event.kind != ContactEventKind::kLost;
  }
  for (const auto& [link, is_touching] : touches) {
    if (is_touching) return true;
  }
  return false;
}

}  // namespace graspbench
