#include "datasets/plan/session_plan.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/physics/simbody/compliant_world.h"
#include "core/trial/grip/grip_statics.h"
#include "core/trial/trial_setup.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/grasp_choice.h"
#include "datasets/plan/grip_check.h"
#include "datasets/plan/rehearsed_grasps.h"
#include "datasets/plan/trial_id.h"

namespace graspbench {

namespace {

/** Names stand in tables, journals and file names; what cannot stand there is refused before
anything is written. */
void CheckNamesFit(const std::string& what, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const bool has_control = std::any_of(name.begin(), name.end(),
                                         [](unsigned char c) { return c < 0x20 || c == 0x7f; });
    const char* fault = !IsUtf8(name)                            ? "is not UTF-8"
                        : has_control                            ? "holds a control character"
                        : name.find_first_of(",\"") != name.npos ? "holds a comma or a quote"
                        : name == kBySight                       ? "asks for a choice by the camera"
                                                                 : nullptr;
    if (fault) {
      throw Error(ErrorKind::kUsage, "the " + what + " \"" + name + "\" cannot be used: its name " +
                                         fault + "; rename it");
    }
  }
}

/** A recorded course moves the hand and closes the digits itself. */
void CheckCourses(const SessionConfig& config, const SessionInputs& inputs) {
  for (const SessionHand& hand : inputs.hands) {
    if (!hand.arm && config.policy.command.empty()) continue;
    for (const Grasp& grasp : hand.grasps) {
      if (!grasp.course.is_set()) continue;
      throw Error(ErrorKind::kUsage,
                  "the grasp \"" + grasp.id + "\" follows a recorded course, which " +
                      (hand.arm ? "no robot arm can follow" : "a controller does not") +
                      "; remove \"course\" from its file, or leave out the " +
                      (hand.arm ? "arm" : "controller"));
    }
  }
}

void CheckGraspsExist(const SessionConfig& config, const SessionInputs& inputs) {
  std::vector<std::string> known;
  for (const SessionHand& hand : inputs.hands) {
    for (const Grasp& grasp : hand.grasps) {
      if (std::find(known.begin(), known.end(), grasp.id) == known.end()) known.push_back(grasp.id);
    }
  }
  if (known.empty())
    throw Error(ErrorKind::kUsage,
                "none of the session's hands has a grasp; graspbench hand develop finds grasps");
  for (const std::string& name : config.grasps) {
    if (name == kBestGrasp || name == kPredictedGrasp || name == "all" || name == kBySight)
      continue;
    const std::string id = ResolveGraspName(inputs, name);
    if (std::find(known.begin(), known.end(), id) == known.end()) {
      known.push_back(kBySight);
      known.push_back(NameRehearsed(RehearsalConfig()));
      throw Error(ErrorKind::kNotFound, "none of the session's hands has a grasp \"" + id + "\"" +
                                            SuggestNames(id, known));
    }
  }
}

/** Two files may bring grasps of one name only for different objects. */
void CheckGraspsDiffer(const SessionHand& hand) {
  std::set<std::pair<std::string, std::string>> seen;
  for (const Grasp& grasp : hand.grasps) {
    if (seen.emplace(grasp.id, grasp.object).second) continue;
    throw Error(ErrorKind::kUsage,
                "two grasp files of the session define a grasp \"" + grasp.id +
                    "\" of the hand \"" + hand.hand->id + "\"" +
                    (grasp.object.empty() ? "" : " for \"" + grasp.object + "\"") +
                    "; leave one out or change its id");
  }
}

void CheckNamesDiffer(const char* what, const std::vector<std::string>& names) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!seen.insert(name).second) {
      throw Error(ErrorKind::kUsage, std::string("two ") + what + " of the session are called \"" +
                                         name + "\"; leave one out or rename its folder");
    }
  }
}

void CheckCamerasExist(const SessionConfig& config, const SessionInputs& inputs) {
  if (!NeedsCamera(config) && !ShowsCamera(config.policy)) return;
  const bool is_positioned = config.positioning == RowOf(kPositionings, Positioning::kCamera).name;
  for (const SessionHand& hand : inputs.hands) {
    if (hand.hand->camera) continue;
    throw Error(ErrorKind::kUsage,
                "the hand \"" + hand.hand->id + "\" has no camera to " +
                    (is_positioned         ? "position it; choose another positioning"
                     : NeedsCamera(config) ? "choose its grasp by sight; name a grasp"
                                           : "show to the controller; choose another "
                                             "policy.object_pose, and no policy.picture_px") +
                    ", or add a camera to its hand.yaml (graspbench help hand.yaml)");
  }
}

void CheckSkinsExist(const SessionConfig& config, const SessionInputs& inputs) {
  if (config.touch == SessionConfig().touch) return;
  for (const SessionHand& hand : inputs.hands) {
    if (hand.hand->skin) continue;
    throw Error(ErrorKind::kUsage, "the hand \"" + hand.hand->id +
                                       "\" has no tactile elements; use touch: exact, or add a "
                                       "tactile.yaml (graspbench help tactile.yaml)");
  }
}

/** A stream's name made of parts that may hold any character. */
std::string JoinNames(const Json& parts) { return FormatJson(parts); }

/** Conditions that differ in what happens to one set-up only: tried trial by trial. */
struct ConditionBlock {
  const SessionConfig* config;
  const SessionInputs* inputs;
  std::vector<std::pair<std::optional<std::string>, const ConditionInputs*>> members;
  bool is_base = false;
};

std::vector<ConditionBlock> ListBlocks(const SessionConfig& config, const SessionInputs& inputs) {
  std::vector<ConditionBlock> blocks = {{&config, &inputs, {{std::nullopt, nullptr}}, true}};
  std::map<std::string, size_t> places;  // by configuration, as text
  SessionConfig base = config;
  base.conditions.clear();
  places.emplace(FormatJson(ToJson(base)), 0);
  for (const Condition& condition : config.conditions) {
    const ConditionInputs& made = inputs.conditions.at(condition.name);
    const auto [place, is_new] = places.emplace(FormatJson(ToJson(made.config)), blocks.size());
    if (is_new) blocks.push_back({&made.config, made.inputs.get(), {}, false});
    blocks[place->second].members.emplace_back(condition.name, &made);
  }
  return blocks;
}

/** Of a trial under a condition that is more than settings of a session, or no change at all.
@param again  the name of a condition that only repeats the base; else empty. */
std::string CalcConditionedId(const std::string& id, const ConditionInputs& condition,
                              const std::string& again) {
  Json content = {{"trial", id}};
  if (condition.late != LateDigit::kNone) {
    content["late"] = condition.late == LateDigit::kLast ? "last" : "first";
    content["delay_s"] = condition.delay;
  }
  if (condition.is_compliant) content["backend"] = "compliant";
  if (content.size() == 1 && !again.empty()) content["again"] = again;
  return content.size() == 1 ? id : CalcHashHex(FormatJson(content));
}

/** @param is_threshold  its conditions are grips of a scale: those that no drive gives are left out.
*/
void PlanPair(const ConditionBlock& block, bool is_threshold, size_t hand_index,
              size_t object_index, std::vector<PlannedTrial>& plan) {
  const SessionHand& hand = block.inputs->hands[hand_index];
  const std::shared_ptr<const GraspObject>& object = block.inputs->objects[object_index];
  const bool can_be_compliant = CanMoveCompliantly(*hand.hand) && CanMoveCompliantly(*object);
  for (const GraspEntry& entry : ListGraspEntries(*block.config, *block.inputs, hand, object)) {
    const auto is_too_much = [&](const Grasp* grasp) {
      return block.config->strategy.grip_force > CalcGripBound(*hand.hand, *grasp);
    };
    if (is_threshold && !block.is_base &&
        std::any_of(entry.grasps.begin(), entry.grasps.end(), is_too_much)) {
      continue;
    }
    Json grasps = Json::array();
    for (const Grasp* grasp : entry.grasps) {
      grasps.push_back(ToJson(FindFitted(*block.inputs, hand, *grasp, object)));
    }
    const Json& grasp = entry.id == kBySight ? grasps : grasps.front();
    for (int trial = 0; trial < block.config->trials; ++trial) {
      const std::string id =
          CalcTrialId(*block.config, *hand.hand, *object, grasp, trial, hand.arm.get());
      for (const auto& [name, condition] : block.members) {
        if (condition && condition->is_compliant && !can_be_compliant) continue;
        plan.push_back(
            {condition ? CalcConditionedId(id, *condition, block.is_base ? *name : "") : id,
             hand.hand->id, object->id, entry.id, trial, name});
      }
    }
  }
}

/** Two conditions of one grasp may come to one trial: best and g2. */
void CheckIdsDiffer(const std::vector<PlannedTrial>& plan) {
  std::map<std::string, const PlannedTrial*> known;
  for (const PlannedTrial& planned : plan) {
    const auto [first, is_new] = known.emplace(planned.id, &planned);
    if (is_new) continue;
    throw Error(ErrorKind::kUsage,
                "two conditions give the same trial: " + DescribeTrial(*first->second) + " and " +
                    DescribeTrial(planned) + "; leave out the level without effect");
  }
}

TrialDraw DrawObject(const VariationConfig& variation, RandomStream pose) {
  TrialDraw draw;
  draw.offset_x = pose.NextUniform(-variation.offset, variation.offset);
  draw.offset_y = pose.NextUniform(-variation.offset, variation.offset);
  draw.offset_yaw = pose.NextUniform(-variation.yaw, variation.yaw);
  return draw;
}

RandomStream MakePoseStream(const SessionConfig& config, const std::string& object, int trial) {
  return RandomStream(JoinNames({config.seed, object, trial}), "object pose");
}

/** The digits of `index` in the base, mirrored at the point: in [0, 1). */
double CalcHalton(int index, int base) {
  double value = 0.0, digit = 1.0;
  for (; index > 0; index /= base) {
    digit /= base;
    value += digit * (index % base);
  }
  return value;
}

/** The offset of this number in the box of the variation: none for 0, then the Halton sequence. */
TrialDraw MakeHaltonDraw(const VariationConfig& box, int index) {
  if (index == 0) return {};
  return {box.offset * (2.0 * CalcHalton(index, 2) - 1.0),
          box.offset * (2.0 * CalcHalton(index, 3) - 1.0),
          box.yaw * (2.0 * CalcHalton(index, 5) - 1.0),
          {}};
}

}  // namespace

void CheckInputs(const SessionConfig& config, const SessionInputs& inputs) {
  std::vector<std::string> hand_names, object_names;
  for (const SessionHand& hand : inputs.hands) hand_names.push_back(hand.hand->id);
  for (const auto& object : inputs.objects) object_names.push_back(object->id);
  CheckNamesFit("hand", hand_names);
  CheckNamesFit("object", object_names);
  CheckNamesDiffer("hands", hand_names);
  CheckNamesDiffer("objects", object_names);
  CheckCamerasExist(config, inputs);
  CheckSkinsExist(config, inputs);
}

bool operator==(const PlannedTrial& a, const PlannedTrial& b) {
  return a.id == b.id && a.hand == b.hand && a.object == b.object && a.grasp == b.grasp &&
         a.trial == b.trial && a.condition == b.condition;
}

std::string DescribeTrial(const PlannedTrial& planned) {
  return planned.hand + ", " + planned.object + ", " + planned.grasp + ", number " +
         std::to_string(planned.trial) + (planned.condition ? ", under " + *planned.condition : "");
}

std::string NameDraw(PlannedTrial planned) {
  planned.condition.reset();
  return DescribeTrial(planned);
}

Json ToJson(const Grasp& grasp) {
  Json json{{"id", grasp.id},
            {"type", static_cast<int>(grasp.type)},
            {"approach_distance_m", grasp.approach_distance},
            {"alpha_rad", grasp.alpha},
            {"tilt_rad", grasp.tilt},
            {"q_pre_rad", JsonAngles(grasp.q_pre)},
            {"q_target_rad", JsonAngles(grasp.q_target)},
            {"digits", grasp.digits},
            {"palm_may_touch", grasp.palm_may_touch}};
  // Only what differs from the default, so that the ids of all other trials stay as they were.
  if (grasp.palm_gap != kPalmGap) json["palm_gap_m"] = grasp.palm_gap;
  if (grasp.seeks_palm) json["seeks_palm"] = true;
  if (grasp.approach != Approach::kAutomatic) {
    json["approach"] = RowOf(kApproaches, grasp.approach).name;
  }
  for (const auto& [digit, schedule] : grasp.closing) {
    json["closing"][digit] = {schedule.delay, schedule.speed};
  }
  if (grasp.course.is_set()) {
    Json& course = json["course"] = {{"period_s", grasp.course.period},
                                     {"closure_start_s", grasp.course.closure_start}};
    for (const Eigen::Vector3d& p : grasp.course.p_HAway) course["away_m"].push_back(JsonVector(p));
    course["closing"] = grasp.course.closing;
  }
  if (grasp.placement) {
    json["X_WH"] = JsonPose(grasp.placement->X_WH);
    json["approach_W"] = JsonVector(grasp.placement->approach_W);
  }
  return json;
}

std::vector<PlannedTrial> MakePlan(const SessionConfig& config, const SessionInputs& inputs) {
  CheckSessionConfig(config);
  for (const SessionHand& hand : inputs.hands) {
    CheckGraspsDiffer(hand);
    for (const Grasp& grasp : hand.grasps) CheckNamesFit("grasp", {grasp.id});
  }
  const std::vector<ConditionBlock> blocks = ListBlocks(config, inputs);
  for (const ConditionBlock& block : blocks) CheckInputs(*block.config, *block.inputs);
  for (const ConditionBlock& block : blocks) CheckGraspsExist(*block.config, *block.inputs);
  for (const ConditionBlock& block : blocks) CheckCourses(*block.config, *block.inputs);
  const bool is_threshold = FindThresholdScale(config) != nullptr;
  for (const ConditionBlock& block : blocks) {
    CheckGripMargins(*block.config, *block.inputs);
    const PolicyConfig& policy = block.config->policy;
    if (is_threshold && !policy.command.empty() &&
        policy.moves != RowOf(kPolicyMoves, PolicyMoves::kUntilTouch).name) {
      throw Error(ErrorKind::kUsage, "policy.moves is " + policy.moves +
                                         ": the controller sets the grip, so no threshold can be "
                                         "searched; expected digits-until-touch");
    }
    if (is_threshold && !block.is_base)
      continue;  // a scale goes from less to more than is possible
    CheckGripForces(*block.config, *block.inputs);
    CheckFeltForces(*block.config, *block.inputs);
  }

  std::vector<PlannedTrial> plan;
  for (size_t hand = 0; hand < inputs.hands.size(); ++hand) {
    for (size_t object = 0; object < inputs.objects.size(); ++object) {
      for (const ConditionBlock& block : blocks) PlanPair(block, is_threshold, hand, object, plan);
    }
  }
  if (plan.empty()) {
    throw Error(ErrorKind::kUsage,
                "the session has no trial: none of its grasps is for its hands and objects");
  }
  if (!config.conditions.empty()) CheckIdsDiffer(plan);
  return plan;
}

TrialDraw DrawVariation(const VariationConfig& variation, const Hand& hand, RandomStream pose,
                        RandomStream error) {
  TrialDraw draw = DrawObject(variation, pose);
  draw.joint_error = Eigen::VectorXd::Zero(hand.num_joints());
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    const HandJoint& moved = hand.joints[static_cast<size_t>(joint)];
    if (moved.coupled_to >= 0) continue;
    const double accuracy = moved.is_prismatic ? hand.slide_accuracy : hand.joint_accuracy;
    draw.joint_error[joint] = error.NextUniform(-accuracy, accuracy);
  }
  return draw;
}

TrialDraw MakeTrialDraw(const SessionConfig& config, const Hand& hand, const GraspObject& object,
                        int trial) {
  TrialDraw draw = DrawVariation(
      config.variation, hand, MakePoseStream(config, object.id, trial),
      RandomStream(JoinNames({config.seed, hand.id, object.id, trial}), "joint error"));
  if (config.draws != SessionConfig().draws) {
    const Eigen::VectorXd no_error = Eigen::VectorXd::Zero(draw.joint_error.size());
    draw = MakeHaltonDraw(config.variation, trial);
    draw.joint_error = no_error;
  }
  return draw;
}

TrialDraw MakeObjectDraw(const SessionConfig& config, const std::string& object, int trial) {
  if (config.draws != SessionConfig().draws) {
    return MakeHaltonDraw(config.variation, trial);
  }
  return DrawObject(config.variation, MakePoseStream(config, object, trial));
}

double CalcDrawDistance(const TrialDraw& a, const TrialDraw& b, double radius) {
  const double turn = radius * (a.offset_yaw - b.offset_yaw);
  return Eigen::Vector3d(a.offset_x - b.offset_x, a.offset_y - b.offset_y, turn).norm();
}

TrialSetup MakeTrialSetup(const SessionConfig& config, const SessionInputs& inputs,
                          const PlannedTrial& planned) {
  if (planned.condition) {
    const ConditionInputs& condition = inputs.conditions.at(*planned.condition);
    PlannedTrial plain = planned;
    plain.condition.reset();
    TrialSetup setup = MakeTrialSetup(condition.config, *condition.inputs, plain);
    setup.late = condition.late;
    setup.delay = condition.delay;
    setup.is_compliant = condition.is_compliant;
    setup.keeps_closing = HasDelays(config);
    return setup;
  }
  const auto hand = std::find_if(inputs.hands.begin(), inputs.hands.end(),
                                 [&](const SessionHand& h) { return h.hand->id == planned.hand; });
  const auto object =
      std::find_if(inputs.objects.begin(), inputs.objects.end(),
                   [&](const auto& candidate) { return candidate->id == planned.object; });
  GRASPBENCH_DEMAND(hand != inputs.hands.end() && object != inputs.objects.end(),
                    planned.hand + ", " + planned.object);
  TrialSetup setup;
  setup.hand = hand->hand;
  setup.object = *object;
  if (planned.grasp == kBySight) {
    for (const Grasp* grasp : FindSightGrasps(*hand, **object)) {
      setup.sight_grasps.push_back(FindFitted(inputs, *hand, *grasp, *object));
    }
    setup.grasp = setup.sight_grasps.front();
  } else {
    const Grasp* grasp = FindGrasp(*hand, **object, planned.grasp);
    GRASPBENCH_DEMAND(grasp, planned.grasp);
    setup.grasp = FindFitted(inputs, *hand, *grasp, *object);
  }
  setup.strategy = FindUsedStrategy(config);
  setup.policy = config.policy;
  if (!config.policy.command.empty()) setup.protocol = "policy_lift";
  setup.trial_id = planned.id;
  setup.policy_seed = static_cast<unsigned>(CalcHash64(
      JoinNames({config.seed, hand->hand->id, (*object)->id, planned.trial, "controller"})));
  setup.sim = config.sim;
  setup.draw = MakeTrialDraw(config, *hand->hand, **object, planned.trial);
  setup.positioning = FindRow(kPositionings, config.positioning)->value;
  setup.camera = config.camera;
  setup.arm = hand->arm;
  setup.touch = FindRow(kTouchSenses, config.touch)->value;
  setup.sensors = config.sensors;
  setup.keeps_closing = HasDelays(config);
  return setup;
}

}  // namespace graspbench
