#pragma once
/** @file
Conditions of a session: named lists of settings under which its draws are simulated again. The base
is the session as configured. A setting is

    KEY=VALUE            a session setting that keeps the draws: model.mass_scale=0.5;
                         half-widths of the variation scale the same unit variates
    grasp=ID             another grasp: best (of the base), g1, ..
    delay.last=SECONDS   delays the digit that touches last, or first, in the trial without
    delay.first=SECONDS  delay (core/trial/digit_delays.h)
    backend=NAME         implicit, or compliant (core/physics/simbody/compliant_world.h)
    best=again           chooses grasps under the condition, not at the base (ChooseAgain)

A factor is a key in which conditions differ. Its levels are the values, the base's first. */

#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "core/grasp/strategy.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** Returns the setting with its value as JSON writes it, so that each setting has one spelling.
@throws Error(kUsage) for an unknown key, a value of the wrong type, or a setting that has no effect
or changes the draws; Error(kRange) for a value out of range. */
std::string NormaliseSetting(const std::string& assignment, const SessionConfig& config);

/** Returns the configuration of the condition's trials, with their delay and backend but without
inputs.
@throws as NormaliseSetting. */
ConditionInputs ApplyCondition(const Condition& condition, const SessionConfig& config);

/** Whether a condition delays a digit. If so, all trials record how far closure moved the
object. */
bool HasDelays(const SessionConfig& config);

/** Adds best=again to each condition. @throws Error(kUsage) where there is no grasp to choose: none
of the session's is best, predicted or rehearsed, or the conditions differ in their grasp. */
std::vector<Condition> ChooseAgain(std::vector<Condition> conditions, const SessionConfig& config);
bool ChoosesGraspAgain(const Condition& condition);

struct SweepFactor {
  std::string key;
  std::vector<std::string> levels;  ///< values, the base's first
};

/** The factors in the order in which the conditions first name them. */
std::vector<SweepFactor> ListFactors(const SessionConfig& config);

/** Returns the base's value of a key: "1.0"; "0" for a delay. */
std::string FindBaseLevel(const SessionConfig& config, const std::string& key);

/** Returns the value of a factor's key under the condition of this name; none: the base. */
std::string FindLevel(const SessionConfig& config, const std::optional<std::string>& condition,
                      const std::string& key);

inline constexpr int kMostGripPlace = 16;  ///< the grips of a scale have indices 0 .. 16

/** The quantity that the bisection for a grip threshold varies. */
struct ThresholdScale {
  GripMode mode;
  const char* name;  ///< for display
  const char* key;   ///< of the setting
  const char* unit;
  double least, most;
};
inline constexpr ThresholdScale kThresholdScales[] = {
    {GripMode::kMargin, "margin", "strategy.grip_margin", "", 1.0, 16.0},
    {GripMode::kForce, "force", "strategy.grip_force_n", "N", 0.1, 12.8}};

/** Returns the scale whose grips the conditions are; null if they are not grips of a scale. */
const ThresholdScale* FindThresholdScale(const SessionConfig& config);

/** A sweep: a session whose conditions are the points of a design over factors (conditions.h). All
conditions use the same draws, so that they are compared pair by pair.

    full            every combination of levels
    one-at-a-time   the base, and each level of each factor alone
    latin:N         the base and N points of a Latin hypercube (M. D. McKay, R. J. Beckman and W. J.
                    Conover, Technometrics 21, 1979): the levels of a factor occur equally often,
                    within one, in an order shuffled by the session's seed

The first level of each factor is the base's. */
struct SweepConfig : SessionConfig {
  std::vector<std::string> factors;  ///< "model.mass_scale=1,0.5,2"
  std::string design = "full";
  bool judge = false;                ///< also measure the breaking force of held objects
  std::string threshold;             ///< scale for bisecting each draw's grip; empty: none
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

/** As LoadSessionConfig and ParseSessionConfig, for sweep.yaml. */
SweepConfig LoadSweepConfig(const std::string& path);
SweepConfig ParseSweepConfig(const std::string& text, const std::string& file);
const FileKeys& ListSweepKeys();

/** Returns the session with its conditions.
@throws Error(kUsage) for no factor, a factor given twice or with fewer than two levels, a level
given twice, an unknown design, more than 10,000 conditions or a first level that no base can have;
as NormaliseSetting and CheckSessionConfig. */
SessionConfig MakeSweep(const SweepConfig& sweep);

}  // namespace graspbench
