#include "workbench/shell/shell_scene.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/hand/coupling.h"
#include "core/physics/implicit_world.h"
#include "datasets/session/session_plan.h"

namespace graspbench {
namespace {

constexpr double kFirstSpacing = 0.02;  // of the saved instants [s]
constexpr size_t kMaxInstants = 320;    // some 0.2 MB each: 64 MB

/** Of the trial with number `draw` of the session that `choice` is part of. */
TrialSetup MakeDrawnSetup(const SceneChoice& choice, const SessionInputs& inputs,
                          std::optional<int> draw) {
  SessionConfig config = choice.config;
  config.trials = 1;
  CheckSessionConfig(config);
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  PlannedTrial planned = plan.front();
  planned.trial = draw.value_or(0);
  TrialSetup setup = MakeTrialSetup(config, inputs, planned);
  if (!draw) {
    setup.draw = {};
    setup.draw.joint_error = Eigen::VectorXd::Zero(setup.hand->num_joints());
  }
  return setup;
}

void ApplyEdit(const Hand& hand, const JointEdit& edit, StandardGrasp& grasp) {
  const int index = hand.FindJoint(edit.joint);
  GRASPBENCH_DEMAND(index >= 0, edit.joint);
  Eigen::VectorXd& q = edit.is_target ? grasp.q_target : grasp.q_pre;
  q[index] = edit.position;
  ApplyCoupling(hand, q);
}

TrialSetup MakeChosenSetup(const SceneChoice& choice, const SessionInputs& inputs,
                           std::optional<int> draw) {
  TrialSetup setup = MakeDrawnSetup(choice, inputs, draw);
  if (choice.place) {
    setup.draw.offset_x = choice.place->x;
    setup.draw.offset_y = choice.place->y;
    setup.draw.offset_yaw = choice.place->yaw;
  }
  for (const JointEdit& edit : choice.joints) ApplyEdit(*setup.hand, edit, setup.grasp);
  return setup;
}

}  // namespace

SceneChoice SceneChoice::MakeDefault() {
  SceneChoice choice;
  choice.config.hands = {"tum"};
  choice.config.objects = {"golf_ball"};
  choice.config.grasps = {"best"};
  return choice;
}

void ShellScene::Choose(const SceneChoice& choice) {
  SessionInputs inputs = LoadSessionInputs(choice.config, FieldUse::kNow, choice.folder);
  auto setup = std::make_unique<TrialSetup>(MakeChosenSetup(choice, inputs, choice.draw));
  auto runner = std::make_unique<TrialRunner>(setup->hand, setup->object);
  auto course = std::make_unique<TrialCourse>(
      std::make_unique<ImplicitWorld>(*setup->hand, *setup->object, setup->sim), *setup);
  course->Begin();
  choice_ = choice;
  inputs_ = std::move(inputs);
  course_ = std::move(course);  // before the setup and objects that the older one refers to
  runner_ = std::move(runner);
  setup_ = std::move(setup);
  spacing_ = kFirstSpacing;
  instants_.clear();
  instants_.push_back(course_->Save());
}

StandardGrasp ShellScene::unedited_grasp() const {
  return MakeDrawnSetup(choice_, inputs_, std::nullopt).grasp;
}

TrialSetup ShellScene::MakeSetup(std::optional<int> draw) const {
  TrialSetup setup = MakeChosenSetup(choice_, inputs_, draw);
  setup.hand = setup_->hand;  // those of the runner
  setup.object = setup_->object;
  return setup;
}

bool ShellScene::Advance() {
  if (!course_->Advance()) return false;
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
  const auto later = std::find_if(
      instants_.begin() + 1, instants_.end(),
      [&](const TrialInstant& instant) { return instant.notes.time > target + slack; });
  const TrialInstant& nearest = *(later - 1);
  if (target < time() - slack || nearest.notes.time > time()) course_->Restore(nearest);
  while (time() < target - slack && !stops() && Advance()) {
  }
}

void ShellScene::Reset() { course_->Restore(instants_.front()); }

}  // namespace graspbench
