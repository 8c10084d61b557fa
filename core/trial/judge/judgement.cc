#include "core/trial/judge/judgement.h"

namespace graspbench {
namespace {

const char* KeyOfLoad(const BreakingLoad& load) { return load.is_force() ? "load_n" : "load_nm"; }

}  // namespace

Json ToJson(const BreakingLoad& load) {
  return {{"direction", load.direction},
          {KeyOfLoad(load), JsonNumber(load.load)},
          {"is_broken", load.is_broken}};
}

void ReadJson(const Json& json, BreakingLoad& load) {
  load.direction = json.at("direction").get<std::string>();
  load.load = NumberFrom(json.at(KeyOfLoad(load)));
  load.is_broken = json.at("is_broken").get<bool>();
}

}  // namespace graspbench
