#pragma once
/** @file
Result of the judge (judge.h) for a held grasp, and its JSON form. */

#include <string>
#include <vector>

#include "core/base/interned_name.h"
#include "core/base/text/json.h"
#include "core/base/text/record_fields.h"
#include "core/base/units.h"

namespace graspbench {

/** Incremented when the judge changes its results; stored with every judgement. */
inline constexpr int kJudgeVersion = 1;

struct BreakingLoad {
  std::string direction;  ///< "force +x", ..., "moment -z", in the palm's frame
  double load = kUnset;   ///< [N], for moments [N m]; the end of the range if unbroken
  bool is_broken = false;

  bool is_force() const { return direction.substr(0, 5) == "force"; }
};
inline const char* KeyOfLoad(const BreakingLoad& load) {
  return load.is_force() ? "load_n" : "load_nm";
}
inline Json ToJson(const BreakingLoad& load) {
  return {{"direction", load.direction},
          {KeyOfLoad(load), JsonNumber(load.load)},
          {"is_broken", load.is_broken}};
}
/** @throws Json::exception if a key is missing or has the wrong type. */
inline void ReadJson(const Json& json, BreakingLoad& load) {
  load.direction = json.at("direction").get<std::string>();
  load.load = NumberFrom(json.at(KeyOfLoad(load)));
  load.is_broken = json.at("is_broken").get<bool>();
}

struct Verdict {
  InternedName rule;  ///< id, see judge.h
  bool passed = false;
  double score = kUnset;  ///< in the rule's unit

  template <class V>
  static void ListFields(V&& field) {
    field("rule", &Verdict::rule);
    field("passed", &Verdict::passed);
    field("score", &Verdict::score);
  }
};

/** Epsilon of the contacts at the end of the hold, by one convention. */
struct ConventionEpsilon {
  InternedName convention;  ///< id, see grasp_quality.h
  double epsilon = kUnset;

  template <class V>
  static void ListFields(V&& field) {
    field("convention", &ConventionEpsilon::convention);
    field("epsilon", &ConventionEpsilon::epsilon);
  }
};

struct Judgement {
  std::vector<BreakingLoad> loads;  ///< six forces, six moments
  double breaking_force = kUnset;   ///< smallest of the forces [N]
  double breaking_moment = kUnset;  ///< smallest of the moments [N m]
  /** By convention; empty with fewer than 2 contacts. */
  std::vector<ConventionEpsilon> epsilons;
  double volume = kUnset;         ///< of the wrench hull, convention "ferrari-canny" [N^6]
  std::vector<Verdict> verdicts;  ///< of all rules, in order

  template <class V>
  static void ListFields(V&& field) {
    using J = Judgement;
    field("loads", &J::loads);
    field("breaking_force_n", &J::breaking_force,
          FieldColumn{"N",
                      "smallest of the six pulls along the palm's axes that took the object out, "
                      "on top of its weight; at most 100 N; missing when not judged"});
    field("breaking_moment_nm", &J::breaking_moment,
          FieldColumn{"N m",
                      "smallest of the six twists about the palm's axes that turned the object "
                      "out"});
    field("epsilons", &J::epsilons);
    field("volume", &J::volume,
          FieldColumn{"N^6", "of the wrench hull at the end of the hold, ferrari-canny"});
    field("verdicts", &J::verdicts);
  }
};

}  // namespace graspbench
