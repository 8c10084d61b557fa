#include "core/trial/trial_result.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {

ContactOrder FindContactOrder(const TrialResult& result) {
  // Standard deviation of a uniform error within a step. Two of them explain 0.8 steps.
  const double uncertainty = result.simulated_time / result.num_steps / std::sqrt(12.0);
  return FindContactOrder(result.contacts,
                          std::vector<double>(result.contacts.size(), uncertainty));
}

namespace {

Json JsonVectorX(const Eigen::VectorXd& values) {
  Json json = Json::array();
  for (double value : values) json.push_back(value);
  return json;
}

Eigen::VectorXd VectorXFrom(const Json& json) {
  const auto values = json.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Json ToJson(const SceneSnapshot& snapshot) {
  return Json{{"name", snapshot.name},
              {"time_s", snapshot.time},
              {"X_WH", JsonPose(snapshot.X_WH)},
              {"X_WO", JsonPose(snapshot.X_WO)},
              {"q_rad", JsonVectorX(snapshot.q)}};
}

SceneSnapshot SnapshotFromJson(const Json& json) {
  SceneSnapshot snapshot;
  snapshot.name = json.at("name").get<std::string>();
  snapshot.time = json.at("time_s").get<double>();
  snapshot.X_WH = PoseFrom(json.at("X_WH"));
  snapshot.X_WO = PoseFrom(json.at("X_WO"));
  snapshot.q = VectorXFrom(json.at("q_rad"));
  return snapshot;
}

}  // namespace

Json ToJson(const TrialResult& result) {
  Json contacts = Json::array();
  for (size_t i = 0; i < result.contacts.size(); ++i) {
    const DigitContact& contact = result.contacts[i];
    const DigitTouch& touch = result.touches[i];
    contacts.push_back({{"digit", contact.digit},
                        {"is_thumb", contact.is_thumb},
                        {"time_s", JsonNumber(contact.time)},
                        {"closing", JsonNumber(touch.closing)},
                        {"q_rad", JsonVectorX(touch.q)},
                        {"smallest_gap_m", JsonNumber(touch.smallest_gap)}});
  }
  Json phases = Json::array(), events = Json::array();
  for (const PhaseStart& phase : result.phases) {
    phases.push_back({{"name", phase.name}, {"time_s", JsonNumber(phase.time)}});
  }
  for (const ContactEvent& event : result.contact_events) events.push_back(ToJson(event));
  Json snapshots = Json::array();
  for (const SceneSnapshot& snapshot : result.snapshots) snapshots.push_back(ToJson(snapshot));
  return Json{{"outcome", NameOf(result.outcome)},
              {"reason", result.reason},
              {"contacts", contacts},
              {"lift_height_m", JsonNumber(result.lift_height)},
              {"hold_slip_m", JsonNumber(result.hold_slip)},
              {"hold_creep_m", JsonNumber(result.hold_creep)},
              {"end_speed_m_per_s", JsonNumber(result.end_speed)},
              {"grip_force_n", JsonNumber(result.grip_force)},
              {"worst_penetration_m", JsonNumber(result.worst_penetration)},
              {"steady_penetration_m", JsonNumber(result.steady_penetration)},
              {"stability", ToJson(result.stability)},
              {"phases", phases},
              {"contact_events", events},
              {"energy_residual_j", JsonNumber(result.energy_residual)},
              {"num_steps", result.num_steps},
              {"num_unconverged", result.num_unconverged},
              {"simulated_time_s", JsonNumber(result.simulated_time)},
              {"snapshots", snapshots}};
}

TrialResult TrialResultFromJson(const Json& json) {
  TrialResult result;
  result.outcome = OutcomeFromName(json.at("outcome").get<std::string>());
  result.reason = json.at("reason").get<std::string>();
  for (const Json& contact : json.at("contacts")) {
    result.contacts.push_back({contact.at("digit").get<std::string>(),
                               contact.at("is_thumb").get<bool>(),
                               NumberFrom(contact.at("time_s"))});
    result.touches.push_back({NumberFrom(contact.at("closing")), VectorXFrom(contact.at("q_rad")),
                              NumberFrom(contact.at("smallest_gap_m"))});
  }
  if (std::count_if(result.contacts.begin(), result.contacts.end(),
                    [](const DigitContact& contact) { return contact.is_thumb; }) > 1) {
    throw Error(ErrorKind::kFormat, "contacts: more than one thumb");
  }
  result.timing = CalcContactTiming(result.contacts, 0.0);
  result.lift_height = NumberFrom(json.at("lift_height_m"));
  result.hold_slip = NumberFrom(json.at("hold_slip_m"));
  result.hold_creep = NumberFrom(json.at("hold_creep_m"));
  result.end_speed = NumberFrom(json.at("end_speed_m_per_s"));
  result.grip_force = NumberFrom(json.at("grip_force_n"));
  result.worst_penetration = NumberFrom(json.at("worst_penetration_m"));
  result.steady_penetration = NumberFrom(json.at("steady_penetration_m"));
  result.stability = StabilityFromJson(json.at("stability"));
  for (const Json& phase : json.at("phases")) {
    result.phases.push_back({phase.at("name").get<std::string>(), NumberFrom(phase.at("time_s"))});
  }
  for (const Json& event : json.at("contact_events")) {
    result.contact_events.push_back(ContactEventFromJson(event));
  }
  result.energy_residual = NumberFrom(json.at("energy_residual_j"));
  result.num_steps = IntFrom(json.at("num_steps"));
  result.num_unconverged = IntFrom(json.at("num_unconverged"));
  result.simulated_time = NumberFrom(json.at("simulated_time_s"));
  for (const Json& snapshot : json.at("snapshots")) {
    result.snapshots.push_back(SnapshotFromJson(snapshot));
  }
  return result;
}

}  // namespace graspbench
