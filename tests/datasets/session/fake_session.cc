#include "tests/datasets/session/fake_session.h"

#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/shape/primitives.h"

namespace graspbench {

SessionHand MakeFakeHand(const std::string& id, int num_joints, double joint_accuracy,
                         const std::vector<std::string>& grasps) {
  auto hand = std::make_shared<Hand>();
  hand->id = id;
  hand->content_hash = "content of " + id;
  hand->joint_accuracy = joint_accuracy;
  hand->joints.resize(static_cast<size_t>(num_joints));
  HandLink link;
  link.mass = 0.1;
  link.I_LLcm = 1e-4 * Eigen::Matrix3d::Identity();
  hand->links.push_back(link);
  link.parent = 0;
  for (link.joint = 0; link.joint < num_joints; ++link.joint) {
    hand->joints[static_cast<size_t>(link.joint)].link = static_cast<int>(hand->links.size());
    hand->links.push_back(link);
  }
  for (const double x : {-0.05, 0.05}) {  // pads 100 mm apart
    Digit digit;
    digit.id = x < 0.0 ? "TH" : "FF";
    digit.is_thumb = x < 0.0;
    digit.links = {0};
    digit.distal_link = 0;
    digit.p_LPad = Eigen::Vector3d(x, 0.0, 0.0);
    hand->digits.push_back(digit);
  }
  SessionHand session_hand;
  session_hand.hand = hand;
  for (const std::string& grasp_id : grasps) {
    Grasp grasp;
    grasp.id = grasp_id;
    grasp.digits = {"TH", "FF"};
    grasp.q_pre = Eigen::VectorXd::Zero(num_joints);
    grasp.q_target = Eigen::VectorXd::Ones(num_joints);
    session_hand.grasps.push_back(grasp);
  }
  return session_hand;
}

std::shared_ptr<GraspObject> MakeFakeObject(const std::string& id) {
  auto object = std::make_shared<GraspObject>();
  object->id = id;
  object->content_hash = "content of " + id;
  object->size = {0.08, 0.04, 0.1};
  object->mesh = MakeRoundedBox(object->size, 0.0);
  object->surface.friction_static = 0.6;
  object->surface.friction_dynamic = 0.5;
  return object;
}

SessionInputs MakeFakeInputs() {
  SessionInputs inputs;
  auto tum = MakeFakeHand("tum", 2, 0.0349, {"g1", "g2"});
  auto coupled = std::make_shared<Hand>(*tum.hand);
  coupled->joints[1].coupled_to = 0;
  tum.hand = coupled;
  inputs.hands = {tum, MakeFakeHand("shadow", 3, 0.0, {"g1", "g2", "g3", "g4", "g5"})};
  auto mug = MakeFakeObject("mug");
  mug->best_grasp = {{"tum", "g2"}, {"shadow", "g3"}};
  auto pencil = MakeFakeObject("pencil");
  pencil->best_grasp = {{"tum", "g2"}};
  inputs.objects = {mug, pencil};
  return inputs;
}

TrialRecord MakeFakeRecord(const PlannedTrial& planned) {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  RandomStream random(planned.id, "fake");
  TrialRecord record;
  record.plan = planned;
  TrialResult& result = record.result;
  std::vector<Outcome> outcomes = ListOutcomes();  // of trials without an arm
  outcomes.erase(std::find(outcomes.begin(), outcomes.end(), Outcome::kArmOutOfReach),
                 std::find(outcomes.begin(), outcomes.end(), Outcome::kNotSeen));
  result.outcome =
      outcomes[static_cast<size_t>(random.NextIndex(static_cast<int>(outcomes.size())))];
  if (result.outcome != Outcome::kSuccess) {
    result.reason = "ended \"so\", after 1\u202f\u03bcs,\nsaid the solver";
  }
  result.contacts = {
      {"FF", false, random.NextUniform(-0.2, 1.0)},  // some before closure began
      {"MF", false, result.outcome == Outcome::kNoContact ? kMissing : random.NextUnit()},
      {"TH", true, random.NextUnit()}};
  for (const DigitContact& contact : result.contacts) {
    DigitTouch& touch = result.touches.emplace_back();
    touch.smallest_gap = random.NextUnit() * 1e-2;
    if (std::isnan(contact.time)) continue;
    touch = {random.NextUnit(), Eigen::Vector2d(random.NextNormal(), 0.1), 0.0};
  }
  result.timing = CalcContactTiming(result.contacts, 0.0);
  result.lift_height = random.NextUniform(-0.001, 0.1);
  result.hold_slip = result.outcome == Outcome::kSuccess ? random.NextUnit() * 1e-3 : kMissing;
  result.end_speed = random.NextUnit() * 1e-7;
  result.grip_force = random.NextUniform(0.0, 20.0);
  result.worst_penetration = random.NextUnit() * 1e-3;
  result.steady_penetration = random.NextUnit() * 1e-3;
  result.hold_creep = result.outcome == Outcome::kSuccess ? random.NextUnit() * 1e-9 : kMissing;
  result.stability.sigma = random.NextUnit();
  result.stability.stabilisation = {
      random.NextUnit(), random.NextUnit(), random.NextUnit(), 4.0, 1e-3, 0.5, 20};
  result.phases = {{"closure", 0.0}, {"stabilisation", random.NextUnit()}};
  result.contact_events = {
      {random.NextUnit(), ContactEventKind::kTouch, "TH", "distal", kUnset},
      {1.0 + random.NextUnit(), ContactEventKind::kLost, "TH", "distal", random.NextUnit()}};
  result.energy_residual = random.NextNormal() * 1e-5;
  result.num_steps = random.NextIndex(3000);
  result.num_unconverged = random.NextIndex(3);
  result.simulated_time = random.NextUniform(3.0, 6.0);
  SceneSnapshot snapshot;
  snapshot.moment = Moment::kClosed;
  snapshot.time = random.NextUnit();
  snapshot.X_WO = MakePose(MakeRotationRpy(0.1, 0.2, random.NextUnit()), {0.1, 0.2, 0.3});
  snapshot.q = Eigen::Vector3d(random.NextUnit(), 0.0, -1.5);
  result.snapshots = {snapshot};
  return record;
}

std::vector<PlannedTrial> CreateFakeSession(const std::filesystem::path& folder, int trials) {
  SessionConfig config;
  config.trials = trials;
  const std::vector<PlannedTrial> plan = MakePlan(config, MakeFakeInputs());
  CreateSession(folder, config, plan);
  return plan;
}

}  // namespace graspbench
