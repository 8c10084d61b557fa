#include "core/base/interned_name.h"

#include <mutex>
#include <unordered_set>

namespace graspbench {

InternedName::InternedName(const std::string& text) {
  static auto& mutex = *new std::mutex;
  static auto& texts = *new std::unordered_set<std::string>;  // its nodes never move
  const std::lock_guard<std::mutex> lock(mutex);
  text_ = &*texts.insert(text).first;
}

Json ToJson(InternedName name) { return name.str(); }

void ReadJson(const Json& json, InternedName& name) { name = json.get<std::string>(); }

}  // namespace graspbench
