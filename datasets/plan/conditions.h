#pragma once
/** @file
Conditions of a session: named lists of settings under which its draws are tried again. The base is
the session as it is configured. A setting is

    KEY=VALUE            any of a session that leaves the draws of its trials: model.mass_scale=0.5;
                         half-widths of the variation scale the same unit variates
    grasp=ID             another grasp: best (of the base), g1, ..
    delay.last=SECONDS   the digit that touches last, or first, without delay closes later
    delay.first=SECONDS  (core/trial/digit_delays.h)
    backend=NAME         implicit, or compliant (core/physics/simbody/compliant_world.h)
    best=again           grasps are chosen under the condition, not at the base (ChooseAgain)

A factor is a key that conditions differ in; its levels are the values, that of the base first. */

#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "core/grasp/strategy.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** A setting with its value as in JSON, so that one setting has one name.
@throws Error(kUsage) for an unknown key, a value of another type, a setting that changes which
draws there are; Error(kRange) for a value out of range. */
std::string NormaliseSetting(const std::string& assignment, const SessionConfig& config);

/** The configuration of a condition's trials and what happens in them; without inputs.
@throws as NormaliseSetting. */
ConditionInputs ApplyCondition(const Condition& condition, const SessionConfig& config);

/** Whether a condition delays a digit: then all trials say how far closing moved the object. */
bool HasDelays(const SessionConfig& config);

/** Each condition with best=again. @throws Error(kUsage) where no grasp is chosen: none is named
best, predicted or rehearsed, or grasps are what differs. */
std::vector<Condition> ChooseAgain(std::vector<Condition> conditions, const SessionConfig& config);
bool ChoosesGraspAgain(const Condition& condition);

struct SweepFactor {
  std::string key;
  std::vector<std::string> levels;  ///< values, that of the base first
};

/** In the order in which the conditions name them. */
std::vector<SweepFactor> ListFactors(const SessionConfig& config);

/** The value of a key of the session as it is configured: "1.0"; "0" for a delay. */
std::string FindBaseLevel(const SessionConfig& config, const std::string& key);

/** The value of a factor's key under a condition of this name; none: the base. */
std::string FindLevel(const SessionConfig& config, const std::optional<std::string>& condition,
                      const std::string& key);

inline constexpr int kMostGripPlace = 16;  ///< the grips of a scale are 0 .. 16

/** What the bisections of grip thresholds vary. */
struct ThresholdScale {
  GripMode mode;
  const char* name;  ///< for people
  const char* key;   ///< of the setting
  const char* unit;
  double least, most;
};
inline constexpr ThresholdScale kThresholdScales[] = {
    {GripMode::kMargin, "margin", "strategy.grip_margin", "", 1.0, 16.0},
    {GripMode::kForce, "force", "strategy.grip_force_n", "N", 0.1, 12.8}};

/** The scale of grip thresholds whose grips the conditions are; null: they are none. */
const ThresholdScale* FindThresholdScale(const SessionConfig& config);

/** A sweep: a session whose conditions are the points of a design over factors (conditions.h). Every
condition meets the same draws, so that they are compared pair by pair.

    full            every combination of levels
    one-at-a-time   the base, and each level of each factor alone
    latin:N         the base and N points of a Latin hypercube (M. D. McKay, R. J. Beckman and W. J.
                    Conover, Technometrics 21, 1979): each level of a factor in as many points as
                    any other, give or take one, dealt by the session's seed

The first level of each factor is the base's. */
struct SweepConfig : SessionConfig {
  std::vector<std::string> factors;  ///< "model.mass_scale=1,0.5,2"
  std::string design = "full";
  bool judge = false;     ///< break what is held
  std::string threshold;  ///< of kThresholdScales: bisect each draw's grip on it; empty: do not
  bool grasp_per_condition = false;  ///< best grasps are chosen under each condition

  template <class V>
  void Visit(V&& v) {
    v("factors", factors,
      {"list of KEY=VALUE,VALUE,..: a session's setting, grasp, delay.last, delay.first or "
       "backend; the base's level first",
       KeyType::kList});
    v("design", design, "full, one-at-a-time or latin:N (the base and up to N combinations)");
    v("judge", judge, "also break what is held; some five times as long");
    v("threshold", threshold,
      "margin or force: also find the smallest with which each draw succeeds, under every "
      "condition; at most six more trials each");
    v("grasp_per_condition", grasp_per_condition,
      "choose best grasps under each condition, not at the base");
    SessionConfig::Visit(v);
  }
};

/** As LoadSessionConfig and ParseSessionConfig, of sweep.yaml. */
SweepConfig LoadSweepConfig(const std::string& path);
SweepConfig ParseSweepConfig(const std::string& text, const std::string& file);
const FileKeys& ListSweepKeys();

/** The session with its conditions.
@throws Error(kUsage) without factors, for one named twice or with fewer than two levels, a level
given twice, an unknown design, more than 10,000 conditions, a first level that no base can have;
as NormaliseSetting and CheckSessionConfig. */
SessionConfig MakeSweep(const SweepConfig& sweep);

}  // namespace graspbench
