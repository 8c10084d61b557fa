#include "core/trial/policy/policy_record.h"

namespace graspbench {
namespace {

bool AreEqual(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() && a == b;
}

Json WriteRow(const PolicyRow& row, const PolicyRow& before) {
  Json json = Json::object();
  if (!AreEqual(row.targets, before.targets)) json["targets_rad"] = JsonAngles(row.targets);
  if (!row.begins) json["begins"] = false;
  if (row.hand) json["X_WH"] = JsonPose(*row.hand);
  if (!AreEqual(row.stiffness, before.stiffness)) json["stiffness"] = JsonAngles(row.stiffness);
  if (row.hold) json["hold"] = *row.hold;
  return json;
}

}  // namespace

Json ToJson(const PolicyRows& rows) {
  Json json = Json::array();
  PolicyRow before;
  for (const PolicyRow& row : rows) {
    json.push_back(WriteRow(row, before));
    before = row;
  }
  return json;
}

void ReadJson(const Json& json, PolicyRows& rows) {
  rows.clear();
  for (const Json& item : json) {
    PolicyRow row;
    row.begins = true;
    if (!rows.empty()) {
      row.targets = rows.back().targets;
      row.stiffness = rows.back().stiffness;
    }
    if (const Json* targets = item.find("targets_rad")) row.targets = AnglesFrom(*targets);
    if (const Json* begins = item.find("begins")) row.begins = begins->get<bool>();
    if (const Json* hand = item.find("X_WH")) row.hand = PoseFrom(*hand);
    if (const Json* stiffness = item.find("stiffness")) row.stiffness = AnglesFrom(*stiffness);
    if (const Json* hold = item.find("hold")) row.hold = hold->get<std::string>();
    rows.push_back(std::move(row));
  }
}

}  // namespace graspbench
