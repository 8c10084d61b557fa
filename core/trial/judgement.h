#pragma once
/** @file
What the judge (judge.h) found about a held grasp, and its form as JSON. */

#include <string>
#include <vector>

#include "core/base/json.h"
#include "core/base/units.h"

namespace graspbench {

/** Counts changes of the judge that change what it finds; stored with every judgement. */
inline constexpr int kJudgeVersion = 1;

struct BreakingLoad {
  std::string direction;  ///< "force +x", ..., "moment -z", in the palm's frame
  double load = kUnset;   ///< [N], of moments [N m]; the range's end if it did not break
  bool is_broken = false;
};

struct Verdict {
  std::string rule;  ///< id, see verdicts.h
  bool passed = false;
  double score = kUnset;  ///< in the rule's unit
};

/** Epsilon of the contacts at the end of the hold, after one convention. */
struct ConventionEpsilon {
  std::string convention;  ///< id, see quality_convention.h
  double epsilon = kUnset;
};

struct Judgement {
  std::vector<BreakingLoad> loads;  ///< six forces, six moments
  double breaking_force = kUnset;   ///< the smallest of the forces [N]
  double breaking_moment = kUnset;  ///< the smallest of the moments [N m]
  std::vector<ConventionEpsilon>
      epsilons;                   ///< of all conventions; empty with fewer than 2 contacts
  double volume = kUnset;         ///< of the hull, convention "ferrari-canny" [N^6]
  std::vector<Verdict> verdicts;  ///< of all rules, in their order
};

Json ToJson(const Judgement& judgement);
/** @throws Json::exception when a key is missing or of another type. */
Judgement JudgementFromJson(const Json& json);

}  // namespace graspbench
