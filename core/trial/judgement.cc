#include "core/trial/judgement.h"

namespace graspbench {

Json ToJson(const Judgement& judgement) {
  Json loads = Json::array(), epsilons = Json::array(), verdicts = Json::array();
  for (const BreakingLoad& load : judgement.loads) {
    loads.push_back({{"direction", load.direction},
                     {load.direction[0] == 'f' ? "load_n" : "load_nm", JsonNumber(load.load)},
                     {"is_broken", load.is_broken}});
  }
  for (const ConventionEpsilon& epsilon : judgement.epsilons) {
    epsilons.push_back(
        {{"convention", epsilon.convention}, {"epsilon", JsonNumber(epsilon.epsilon)}});
  }
  for (const Verdict& verdict : judgement.verdicts) {
    verdicts.push_back(
        {{"rule", verdict.rule}, {"passed", verdict.passed}, {"score", JsonNumber(verdict.score)}});
  }
  return Json{{"loads", loads},
              {"breaking_force_n", JsonNumber(judgement.breaking_force)},
              {"breaking_moment_nm", JsonNumber(judgement.breaking_moment)},
              {"epsilons", epsilons},
              {"volume", JsonNumber(judgement.volume)},
              {"verdicts", verdicts}};
}

Judgement JudgementFromJson(const Json& json) {
  Judgement judgement;
  for (const Json& load : json.at("loads")) {
    const auto direction = load.at("direction").get<std::string>();
    const char* key = direction.substr(0, 1) == "f" ? "load_n" : "load_nm";
    judgement.loads.push_back(
        {direction, NumberFrom(load.at(key)), load.at("is_broken").get<bool>()});
  }
  judgement.breaking_force = NumberFrom(json.at("breaking_force_n"));
  judgement.breaking_moment = NumberFrom(json.at("breaking_moment_nm"));
  for (const Json& epsilon : json.at("epsilons")) {
    judgement.epsilons.push_back(
        {epsilon.at("convention").get<std::string>(), NumberFrom(epsilon.at("epsilon"))});
  }
  judgement.volume = NumberFrom(json.at("volume"));
  for (const Json& verdict : json.at("verdicts")) {
    judgement.verdicts.push_back({verdict.at("rule").get<std::string>(),
                                  verdict.at("passed").get<bool>(),
                                  NumberFrom(verdict.at("score"))});
  }
  return judgement;
}

}  // namespace graspbench
