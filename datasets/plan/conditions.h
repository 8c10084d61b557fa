#pragma once
/** @file
Conditions of a session: named lists of settings under which its draws are tried again. The base is
the session as it is configured. A setting is

    KEY=VALUE            any of a session that leaves the draws of its trials: model.mass_scale=0.5;
                         half-widths of the variation scale the same unit variates
    grasp=ID             another grasp: best (of the base), g1, ..
    delay.last=SECONDS   the digit that touches last, or first, without delay closes later
    delay.first=SECONDS  (core/trial/delayed_digit.h)
    backend=NAME         implicit, or compliant (core/trial/compliant_trial.h)

A factor is a key that conditions differ in; its levels are the values, that of the base first. */

#include <string>
#include <vector>

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

}  // namespace graspbench
