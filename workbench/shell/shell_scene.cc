#include "workbench/shell/shell_scene.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/grasp/placement.h"
#include "core/hand/hand.h"
#include "core/physics/implicit_world.h"
#include "core/trial/trial_runner.h"
#include "datasets/plan/rehearsed_grasps.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {
namespace {

constexpr double kFirstSpacing = 0.02;  // of the saved instants [s]
constexpr size_t kMaxInstants = 320;    // some 0.2 MB each: 64 MB

/** Of the trial with number `draw` of the session that `choice` is part of, with the object where
it was moved to. */
TrialSetup MakeDrawnSetup(const SceneChoice& choice, const SessionInputs& inputs,
                          std::optional<int> draw) {
  SessionConfig config = choice.config;
  config.trials = 1;
  if (!config.policy.command.empty()) {
    throw Error(ErrorKind::kUsage, "the shell controls the hand; leave out policy.command");
  }
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  PlannedTrial planned = plan.front();
  planned.trial = draw.value_or(0);
  TrialSetup setup = MakeTrialSetup(config, inputs, planned);
  if (!draw) {
    setup.draw = {};
    setup.draw.joint_error = Eigen::VectorXd::Zero(setup.hand->num_joints());
  }
  if (choice.place) {
    setup.draw.offset_x = choice.place->x;
    setup.draw.offset_y = choice.place->y;
    setup.draw.offset_yaw = choice.place->yaw;
  }
  return ChooseGraspBySight(std::move(setup));
}

/** Whether `a` loads the same things as `b`, none of which a user may have changed meanwhile. */
bool LoadsTheSame(const SceneChoice& a, const SceneChoice& b) {
  for (const SessionConfig* config : {&a.config, &b.config}) {
    for (const auto* names : {&config->hands, &config->objects, &config->grasps}) {
      if (std::filesystem::exists(names->front())) return false;
    }
    if (std::filesystem::exists(config->arm.model)) return false;
  }
  for (const SceneChoice* one : {&a, &b}) {
    const bool is_rehearsed = HasBestGrasp(one->config) || !ListRehearsals(one->config).empty();
    if (is_rehearsed && a.config.grasps != b.config.grasps) return false;
  }
  return a.config.hands == b.config.hands && a.config.approach == b.config.approach &&
         a.config.objects == b.config.objects && a.folder.empty() && b.folder.empty() &&
         HaveEqualValues(a.config.model, b.config.model) &&
         HaveEqualValues(a.config.arm, b.config.arm);
}

/** Moves the place at which the hand grasps, and from where it comes. */
void ApplyHandPlace(const HandPlace& place, const TrialSetup& setup, Grasp& grasp) {
  Placement placement = CalcPlacement(*setup.hand, grasp, *setup.object);
  const Eigen::Vector3d middle(0.0, 0.0, 0.5 * setup.object->size.z());
  const Eigen::Matrix3d R = MakeRotationRpy(place.angles.x(), place.angles.y(), place.angles.z());
  placement.X_WH = MakePose(R * placement.X_WH.linear(),
                            middle + R * (placement.X_WH.translation() - middle) + place.shift);
  placement.approach_W = R * placement.approach_W;
  grasp.placement = placement;
  grasp.object = setup.object->id;
}

void ApplyEdit(const Hand& hand, const JointEdit& edit, Grasp& grasp) {
  const int index = hand.FindJoint(edit.joint);
  GRASPBENCH_DEMAND(index >= 0, edit.joint);
  Eigen::VectorXd& q = edit.is_target ? grasp.q_target : grasp.q_pre;
  q[index] = edit.position;
  ApplyCoupling(hand, q);
}

TrialSetup MakeChosenSetup(const SceneChoice& choice, const SessionInputs& inputs,
                           std::optional<int> draw) {
  TrialSetup setup = MakeDrawnSetup(choice, inputs, draw);
  if (choice.learned) setup.grasp = *choice.learned;
  for (const JointEdit& edit : choice.joints) ApplyEdit(*setup.hand, edit, setup.grasp);
  for (const auto& [digit, schedule] : choice.closing) setup.grasp.closing[digit] = schedule;
  if (choice.hand_place) ApplyHandPlace(*choice.hand_place, setup, setup.grasp);
  for (const DriveEdit& edit : choice.drives) {
    setup.drives.push_back({edit.time, setup.hand->FindJoint(edit.joint), edit.position});
  }
  return setup;
}

}  // namespace

std::string FindStandardId(const Grasp& grasp) {
  std::string found = grasp.id;
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (taxon.id == grasp.id) return taxon.id;
    if (taxon.type == grasp.type && taxon.approach_distance == grasp.approach_distance &&
        taxon.alpha == grasp.alpha && found == grasp.id) {
      found = taxon.id;
    }
  }
  return found;
}

SceneChoice SceneChoice::MakeDefault() {
  SceneChoice choice;
  choice.config.hands = {"tum"};
  choice.config.objects = {"golf_ball"};
  choice.config.grasps = {"best"};
  return choice;
}

void ShellScene::Choose(const SceneChoice& choice) {
  CheckSessionConfig(choice.config);
  auto inputs = inputs_;
  if (!inputs || !LoadsTheSame(choice, choice_)) {
    inputs = std::make_shared<SessionInputs>(
        LoadSessionInputs(choice.config, FieldUse::kNow, choice.folder));
  }
  auto setup = std::make_unique<TrialSetup>(MakeChosenSetup(choice, *inputs, choice.draw));
  auto course = std::make_unique<TableLift>(
      std::make_unique<ImplicitWorld>(*setup->hand, *setup->object, setup->sim), *setup);
  course->Begin();
  choice_ = choice;
  if (inputs != inputs_) runner_.reset();
  course_ = std::move(course);  // before the setup and objects that the older one refers to
  inputs_ = std::move(inputs);
  setup_ = std::move(setup);
  spacing_ = kFirstSpacing;
  end_time_ = std::numeric_limits<double>::infinity();
  instants_.clear();
  instants_.push_back(course_->Save());
}

Grasp ShellScene::unedited_grasp() const {
  return choice_.learned ? *choice_.learned : MakeDrawnSetup(choice_, *inputs_, choice_.draw).grasp;
}

TrialRunner& ShellScene::runner() {
  if (!runner_) runner_ = std::make_unique<TrialRunner>(setup_->hand, setup_->object);
  return *runner_;
}

TrialSetup ShellScene::MakeSetup(std::optional<int> draw) const {
  TrialSetup setup = MakeChosenSetup(choice_, *inputs_, draw);
  setup.hand = setup_->hand;  // those of the runner
  setup.object = setup_->object;
  return setup;
}

bool ShellScene::Advance() {
  if (!course_->Advance()) {
    end_time_ = time();
    return false;
  }
  KeepInstant();
  return true;
}

void ShellScene::KeepInstant() {
  // Half a step less, so that the times of steps need no exact sums.
  if (time() < instants_.back().notes.time + spacing_ - 0.5 * setup_->sim.step) return;
  instants_.push_back(course_->Save());
  if (instants_.size() <= kMaxInstants) return;
  spacing_ *= 2.0;
  std::vector<TrialInstant> kept;
  for (size_t i = 0; i < instants_.size(); i += 2) kept.push_back(std::move(instants_[i]));
  instants_ = std::move(kept);
}

void ShellScene::GoTo(double target, const std::function<bool()>& stops) {
  const double slack = 0.5 * setup_->sim.step;
  const bool to_the_end = target > end_time_ - slack;  // which some trials reach without a step
  const auto later = std::find_if(
      instants_.begin() + 1, instants_.end(),
      [&](const TrialInstant& instant) { return instant.notes.time > target + slack; });
  const TrialInstant& nearest = *(later - 1);
  if (target < time() - slack || nearest.notes.time > time()) course_->Restore(nearest);
  while ((time() < target - slack || to_the_end) && !stops() && Advance()) {
  }
}

void ShellScene::Reset() { course_->Restore(instants_.front()); }

}  // namespace graspbench
