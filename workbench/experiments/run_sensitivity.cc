#include "workbench/experiments/run_sensitivity.h"

#include <algorithm>

#include "core/base/config.h"
#include "core/base/error.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/firm_grip.h"

namespace graspbench {
namespace {

/** A number and what it is multiplied by. */
struct Factors {
  const char* key;
  std::vector<double> factors;
};
const std::vector<Factors> kFactors = {
    {"variation.offset_m", {0.0, 2.0}},
    {"variation.yaw_rad", {0.0, 2.0}},
    {"model.joint_error_scale", {0.0, 2.0}},
    {"model.pad_torsion_scale", {0.5, 2.0}},
    {"model.pad_stiffness_scale", {0.5, 2.0}},
    {"model.friction_scale", {0.8, 1.25}},
    {"model.mass_scale", {0.5, 2.0}},
    {"model.drive_torque_scale", {0.5, 2.0}},
    {"sim.contact_stiffness_n_per_m", {0.5, 2.0}},
    {"sim.tangential_stiffness_n_per_m", {0.5, 2.0}},
    {"sim.arm_stiffness_n_per_m", {0.5, 2.0}},
};

std::vector<std::string> FindSettings(const SensitivityRequest& request,
                                      const SessionConfig& config) {
  if (request.settings.empty()) return ListDefaultVariations(config);
  std::vector<std::string> settings;
  for (const std::string& assignment : request.settings) {
    const std::string setting = NormaliseSetting(assignment, config);
    if (std::find(settings.begin(), settings.end(), setting) != settings.end()) {
      throw Error(ErrorKind::kUsage, "\"" + setting + "\" is named twice; leave one out");
    }
    RefuseUnusedGrip(setting, config.strategy);
    settings.push_back(setting);
  }
  return settings;
}

}  // namespace

std::vector<std::string> ListDefaultVariations(const SessionConfig& config) {
  std::vector<std::string> settings;
  const auto add = [&](const std::string& assignment) {
    SessionConfig changed = config;
    ApplySetting(assignment, changed);
    if (FindConfigDifferences(config, changed).empty() || !Validate(changed).empty()) return;
    settings.push_back(NormaliseSetting(assignment, config));
  };
  const Json json = ToJson(config);
  for (const Factors& row : kFactors) {
    const std::string key = row.key;
    const size_t dot = key.find('.');
    const double value = json.at(key.substr(0, dot)).at(key.substr(dot + 1)).get<double>();
    for (const double factor : row.factors) add(key + "=" + FormatJson(factor * value));
  }
  for (const std::string& rule : ListModelCouplings()) add("model.coupling_rule=" + rule);
  return settings;
}

PreparedSession PrepareSensitivity(const SensitivityRequest& request) {
  const Session session = LoadSession(request.folder, request.on_damage, RecordParts::kBrief);
  std::vector<Condition> conditions;
  for (const std::string& setting : FindSettings(request, session.config)) {
    conditions.push_back({setting, {setting}});
  }
  return PrepareExperiment(session, "sensitivity", conditions, request);
}

}  // namespace graspbench
