#include "datasets/plan/firm_grip.h"

#include "core/base/config.h"
#include "core/base/error.h"

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
  return "has no use where strategy.grip is " + strategy.grip +
         "; leave it out, or set strategy.grip";
}

void RefuseUnusedGrip(const std::string& assignment, const StrategyConfig& strategy) {
  if (CanMatter(assignment.substr(0, assignment.find('=')), strategy)) return;
  throw Error(ErrorKind::kUsage, assignment + " " + DescribeUnusedGrip(strategy));
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

}  // namespace graspbench
