#include "datasets/plan/grip_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/hand/tactile.h"
#include "core/trial/grip/grip_statics.h"
#include "core/trial/touch_sensors.h"
#include "datasets/plan/grasp_choice.h"

namespace graspbench {

namespace {

StrategyConfig MakeFirmStrategy() {
  StrategyConfig strategy;
  strategy.grip = RowOf(kGripModes, GripMode::kPosture).name;
  strategy.drive_law = RowOf(kDriveLaws, DriveLaw::kHold).name;
  strategy.touch_speed = 1.0;
  strategy.closure_lead = 0.0;
  return strategy;
}

std::vector<const Grasp*> ListUsed(const SessionConfig& config, const SessionInputs& inputs,
                                   const SessionHand& hand) {
  std::vector<const Grasp*> used;
  for (const auto& object : inputs.objects) {
    for (const Grasp* grasp : FindGrasps(config, inputs, hand, object)) {
      if (std::find(used.begin(), used.end(), grasp) == used.end()) used.push_back(grasp);
    }
  }
  return used;
}

/** A hand's grasp with the least of these forces; null: the session does not regulate them. */
std::pair<const Grasp*, double> FindLeast(const SessionConfig& config, const SessionInputs& inputs,
                                          const SessionHand& hand,
                                          double (*calc)(const Hand&, const Grasp&)) {
  std::pair<const Grasp*, double> least = {nullptr, HUGE_VAL};
  if (RowFromName(kGripModes, FindUsedStrategy(config).grip, "grip").value == GripMode::kPosture) {
    return least;
  }
  for (const Grasp* grasp : ListUsed(config, inputs, hand)) {
    const double force = calc(*hand.hand, *grasp);
    if (force < least.second) least = {grasp, force};
  }
  return least;
}

/** Whether forces are asked of a hand that goes by what its elements feel. */
bool GoesByFeeling(const SessionConfig& config) {
  return config.touch == RowOf(kTouchSenses, TouchSense::kSensed).name &&
         FindUsedStrategy(config).grip != RowOf(kGripModes, GripMode::kPosture).name;
}

/** What an element must bear to be felt. @pre the hand has a skin. */
double CalcFeltFrom(const SessionConfig& config, const Hand& hand) {
  return CalcForce(hand.skin->response, config.sensors, config.sensors.threshold);
}

int CountElements(const Hand& hand, const std::string& digit) {
  const auto& elements = hand.skin->elements;
  return static_cast<int>(
      std::count_if(elements.begin(), elements.end(), [&](const TactileElement& element) {
        const int of = hand.FindDigitOfLink(element.link);
        return of >= 0 && hand.digits[static_cast<size_t>(of)].id == digit;
      }));
}

void CheckRange(const SessionConfig& config, const SessionInputs& inputs, const SessionHand& hand) {
  for (const Grasp* grasp : ListUsed(config, inputs, hand)) {
    for (const std::string& digit : grasp->digits) {
      const int num = CountElements(*hand.hand, digit);
      const double most = num * config.sensors.saturation;
      if (num == 0 || config.strategy.grip_force <= most) continue;
      throw Error(
          ErrorKind::kRange,
          fmt::format("strategy.grip_force_n: the setpoint of each digit is {:.2f} N, but the {} "
                      "elements of {} of the hand \"{}\" measure at most {:.2f} N together "
                      "(sensors.saturation_n each); lower the setpoint or raise the saturation",
                      config.strategy.grip_force, num, digit, hand.hand->id, most));
    }
  }
}

void WarnOfFeeling(const SessionConfig& config, const Hand& hand,
                   std::vector<std::string>& warnings) {
  const double asked = config.strategy.grip_force, felt_from = CalcFeltFrom(config, hand);
  if (asked > config.sensors.saturation) {
    warnings.push_back(
        fmt::format("strategy.grip_force_n is {:.2f} N, but an element of the hand \"{}\" measures "
                    "at most {:.2f} N (sensors.saturation_n): if few elements are pressed, only "
                    "drive torques measure the rest",
                    asked, hand.id, config.sensors.saturation));
  }
  if (asked > 0.0 && asked <= felt_from) {
    warnings.push_back(fmt::format(
        "the detection threshold of an element of the hand \"{}\" is {:.2f} N (sensors.threshold), "
        "but the minimum setpoint of a digit is {:.2f} N (strategy.grip_force_n)",
        hand.id, felt_from, asked));
  }
}

}  // namespace

Json StrategyToJson(const StrategyConfig& strategy) {
  Json json = ConfigToJson(strategy);
  const StrategyConfig firm = MakeFirmStrategy();
  if (strategy.touch_speed == firm.touch_speed) json.erase("touch_speed");
  if (strategy.closure_lead == firm.closure_lead) json.erase("closure_lead_s");
  if (strategy.drive_law == firm.drive_law) json.erase("drive_law");
  if (strategy.grip != firm.grip) return json;
  for (const char* key : {"grip", "grip_force_n", "grip_margin"}) json.erase(key);
  return json;
}

bool CanMatter(const std::string& key, const StrategyConfig& strategy) {
  const GripMode mode = RowFromName(kGripModes, strategy.grip, "grip").value;
  if (key == "strategy.grip_force_n") return mode != GripMode::kPosture;
  if (key == "strategy.grip_margin") return mode == GripMode::kMargin;
  return true;
}

std::string DescribeUnusedGrip(const StrategyConfig& strategy) {
  return "has no effect if strategy.grip is " + strategy.grip +
         "; leave it out, or set strategy.grip";
}

void RefuseUnusedGrip(const std::string& assignment, const StrategyConfig& strategy) {
  if (CanMatter(assignment.substr(0, assignment.find('=')), strategy)) return;
  throw Error(ErrorKind::kUsage, assignment + " " + DescribeUnusedGrip(strategy));
}

StrategyConfig FindUsedStrategy(const SessionConfig& config) {
  StrategyConfig strategy = config.strategy;
  if (config.policy.command.empty()) return strategy;
  // Until it touches: then its grip is regulated.
  if (config.policy.moves == RowOf(kPolicyMoves, PolicyMoves::kUntilTouch).name) return strategy;
  const StrategyConfig firm = MakeFirmStrategy();
  if (config.policy.moves == RowOf(kPolicyMoves, PolicyMoves::kHandAndDigits).name) {
    strategy.closure_lead = firm.closure_lead;  // it begins when the hand stands
  }
  strategy.grip = firm.grip;
  strategy.drive_law = firm.drive_law;
  strategy.touch_speed = firm.touch_speed;
  DropUnusedGrip(strategy);
  return strategy;
}

void DropUnusedGrip(StrategyConfig& strategy) {
  const StrategyConfig firm = MakeFirmStrategy();
  if (strategy.grip != firm.grip) return;
  strategy.grip_force = firm.grip_force;
  strategy.grip_margin = firm.grip_margin;
}

void AddFirmGrip(Json& conditions) {
  if (!conditions.is_object() || !conditions.contains("strategy")) return;
  Json& strategy = conditions["strategy"];
  if (!strategy.is_object()) return;
  const Json firm = ConfigToJson(MakeFirmStrategy());
  for (const char* key :
       {"grip", "grip_force_n", "grip_margin", "touch_speed", "drive_law", "closure_lead_s"}) {
    if (!strategy.contains(key)) strategy[key] = firm.at(key);
  }
}

void CheckGripForces(const SessionConfig& config, const SessionInputs& inputs) {
  for (const SessionHand& hand : inputs.hands) {
    const auto [grasp, bound] = FindLeast(config, inputs, hand, &CalcGripBound);
    if (config.strategy.grip_force <= bound) continue;
    throw Error(
        ErrorKind::kRange,
        fmt::format("strategy.grip_force_n: a digit of the hand \"{}\" cannot press with {:.2f} N "
                    "in the grasp {}: the torque limits of its drives allow at most {:.2f} N at "
                    "the shortest lever, about {:.2f} N at its pads; lower the setpoint",
                    hand.hand->id, config.strategy.grip_force, grasp->id, bound,
                    CalcPadGrip(*hand.hand, *grasp)));
  }
}

void CheckFeltForces(const SessionConfig& config, const SessionInputs& inputs) {
  if (!GoesByFeeling(config)) return;
  const StrategyConfig& strategy = config.strategy;
  for (const SessionHand& hand : inputs.hands) {
    CheckRange(config, inputs, hand);
    const double felt_from = CalcFeltFrom(config, *hand.hand);
    const bool is_all = strategy.grip == RowOf(kGripModes, GripMode::kForce).name;
    if (!is_all || strategy.grip_force > felt_from) continue;
    throw Error(ErrorKind::kRange,
                fmt::format("sensors.threshold: the detection threshold of an element of the hand "
                            "\"{}\" is {:.2f} N, but the setpoint of each digit is {:.2f} N "
                            "(strategy.grip_force_n); lower the threshold or raise the setpoint",
                            hand.hand->id, felt_from, strategy.grip_force));
  }
}

std::vector<std::string> ListGripWarnings(const SessionConfig& config,
                                          const SessionInputs& inputs) {
  std::vector<std::string> warnings;
  if (GoesByFeeling(config)) {
    for (const SessionHand& hand : inputs.hands) WarnOfFeeling(config, *hand.hand, warnings);
  }
  for (const SessionHand& hand : inputs.hands) {
    const auto [grasp, estimate] = FindLeast(config, inputs, hand, &CalcPadGrip);
    if (config.strategy.grip_force <= estimate) continue;
    warnings.push_back(
        fmt::format("strategy.grip_force_n is {:.2f} N, but the drives of the hand \"{}\" give "
                    "about {:.2f} N at its pads in the grasp {} (more at contacts nearer to the "
                    "palm): digits may not reach the setpoint",
                    config.strategy.grip_force, hand.hand->id, estimate, grasp->id));
  }
  return warnings;
}

void CheckGripMargins(const SessionConfig& config, const SessionInputs& inputs) {
  const GripMode mode = RowFromName(kGripModes, FindUsedStrategy(config).grip, "grip").value;
  if (mode != GripMode::kMargin) return;
  for (const auto& object : inputs.objects) {
    if (object->surface.friction_dynamic > 0.0) continue;
    throw Error(
        ErrorKind::kRange,
        "strategy.grip: a margin needs friction, and the object \"" + object->id +
            "\" has none; set its friction (object.yaml, model.friction_scale) or use force");
  }
}

}  // namespace graspbench
