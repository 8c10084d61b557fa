// Trials that succeed, and fail once one cause is planted in them: the diagnosis has to name that
// cause. A plant acts through what a trial is made of (hand, commands, load on the object); nothing
// here knows by what signs the diagnosis decides. Other draws and strengths:
// --gtest_random_seed=NUMBER.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <iterator>
#include <map>
#include <random>

#include "core/base/units.h"
#include "core/trial/digit_delays.h"
#include "core/trial/protocols/protocol.h"
#include "objects/catalogue.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr const char* kHands[] = {"tum-evolved", "shadow-evolved"};
constexpr const char* kObjects[] = {"toy_cube",  "can",      "tennis_ball", "sharpener",
                                    "cup",       "matchbox", "golf_ball",   "chocolate_bar",
                                    "tea_light", "eraser"};
constexpr FailureCause kPlants[] = {FailureCause::kWeakDigit, FailureCause::kLowFriction,
                                    FailureCause::kPush, FailureCause::kLateDigit};
constexpr GripMode kGrips[] = {GripMode::kMargin, GripMode::kPosture};
constexpr int kNumDraws = 2;
/** Plants of a kind in one trial that succeeds: a late digit seldom makes it fail. */
constexpr size_t CountStrengths(FailureCause cause) {
  return cause == FailureCause::kLateDigit ? 6 : 3;
}

constexpr int kLeastFailures = 200, kLeastFailuresOfAKind = 20;
constexpr double kLeastShareRight = 0.9;

using TrialKey = std::array<size_t, 4>;  ///< hand, object, grip, draw

/** Numbers of one trial, which no other trial moves. */
class Stream {
 public:
  Stream(const TrialKey& trial, std::initializer_list<size_t> purpose) {
    std::vector<size_t> key = {static_cast<size_t>(testing::GTEST_FLAG(random_seed))};
    key.insert(key.end(), trial.begin(), trial.end());
    key.insert(key.end(), purpose);
    std::seed_seq seeds(key.begin(), key.end());
    bits_.seed(seeds);
  }

  double NextUniform(double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(bits_() >> 11);
  }
  /** Every factor as often. */
  double NextFactor(double low, double high) {
    return std::exp(NextUniform(std::log(low), std::log(high)));
  }
  size_t NextIndex(size_t count) { return static_cast<size_t>(bits_() % count); }
  Vector3d NextDirection() {
    const double z = NextUniform(-1.0, 1.0), angle = NextUniform(0.0, 2.0 * kPi);
    const double radius = std::sqrt(1.0 - z * z);
    return Vector3d(radius * std::cos(angle), radius * std::sin(angle), z);
  }

 private:
  std::mt19937_64 bits_;
};

/** As a session varies its trials. */
TrialDraw Draw(const Hand& hand, Stream stream) {
  TrialDraw draw;
  draw.offset_x = stream.NextUniform(-0.005, 0.005);
  draw.offset_y = stream.NextUniform(-0.005, 0.005);
  draw.offset_yaw = stream.NextUniform(-RadFromDeg(5.0), RadFromDeg(5.0));
  draw.joint_error = Eigen::VectorXd::Zero(hand.num_joints());
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    if (hand.joints[static_cast<size_t>(joint)].coupled_to >= 0) continue;
    draw.joint_error[joint] = stream.NextUniform(-hand.joint_accuracy, hand.joint_accuracy);
  }
  return draw;
}

StrategyConfig MakeStrategy(GripMode grip) {
  StrategyConfig strategy;
  strategy.grip = RowOf(kGripModes, grip).name;
  if (grip == GripMode::kMargin) strategy.touch_speed = 0.25;
  return strategy;
}

struct Push {
  double time = kUnset, duration = 0.0;  ///< since the start of placing [s]
  Vector3d force_W = Vector3d::Zero();   ///< [N]
};

struct PlantedTrial {
  TrialSetup setup;
  Push push = {};
  std::string digit = {};  ///< planted; empty: none
  std::string text = {};
};

/** @param undisturbed  the result of the setup. */
PlantedTrial Plant(FailureCause cause, const TrialSetup& setup, const TrialResult& undisturbed,
                   Stream stream) {
  PlantedTrial planted{setup};
  if (cause == FailureCause::kPush) {
    const double closure = undisturbed.snapshots.front().time;
    planted.push.time = stream.NextUniform(closure, undisturbed.simulated_time);
    planted.push.duration = stream.NextUniform(0.02, 0.1);
    planted.push.force_W = stream.NextFactor(0.5, 15.0) * stream.NextDirection();
    const Vector3d& force_W = planted.push.force_W;
    planted.text =
        fmt::format("push of ({:.2f}, {:.2f}, {:.2f}) N at {:.3f} s for {:.3f} s", force_W.x(),
                    force_W.y(), force_W.z(), planted.push.time, planted.push.duration);
    return planted;
  }
  planted.digit = setup.grasp.digits[stream.NextIndex(setup.grasp.digits.size())];
  auto hand = std::make_shared<Hand>(*setup.hand);
  const auto digit =
      std::find_if(hand->digits.begin(), hand->digits.end(),
                   [&](const Digit& candidate) { return candidate.id == planted.digit; });
  if (cause == FailureCause::kLateDigit) {
    const double delay = stream.NextUniform(0.1, 0.6);
    planted.setup = DelayDigit(setup, static_cast<int>(digit - hand->digits.begin()), delay);
    planted.text = fmt::format("{} late by {:.3f} s", planted.digit, delay);
    return planted;
  }
  if (cause == FailureCause::kWeakDigit) {
    const double scale = stream.NextFactor(0.005, 0.3);
    for (const int joint : FindDrivenJoints(*hand, *digit)) {
      hand->joints[static_cast<size_t>(joint)].drive.torque_limit *= scale;
    }
    planted.text = fmt::format("{} with torque limits times {:.4f}", planted.digit, scale);
  } else {
    const double scale = stream.NextFactor(0.02, 0.5);
    for (const int link : digit->links) {
      // Links of the shipped hands leave friction to the object; 2 a b / (a + b) is scale times a.
      SurfaceMaterial& surface = hand->links[static_cast<size_t>(link)].surface;
      surface.friction_static = scale / (2.0 - scale) * setup.object->surface.friction_static;
      surface.friction_dynamic = scale / (2.0 - scale) * setup.object->surface.friction_dynamic;
    }
    planted.text = fmt::format("{} with friction times {:.4f}", planted.digit, scale);
  }
  planted.setup.hand = hand;
  return planted;
}

struct Observed {
  TrialResult result;
  Eigen::VectorXd last_command;  ///< of the drives (num_joints) [rad]
};

/** @param runner  of the setup's hand and object. */
Observed RunPlanted(TrialRunner& runner, const PlantedTrial& planted) {
  Observed observed;
  observed.result = runner.Run(planted.setup, [&](TrialCourse& course) {
    observed.last_command = course.last_command().q;
    if (std::isnan(planted.push.time)) return;
    const double since = course.time() - planted.push.time;
    const bool is_pushed = since >= 0.0 && since < planted.push.duration;
    course.world().SetExternalLoad(is_pushed ? planted.push.force_W : Vector3d::Zero(),
                                   Vector3d::Zero());
  });
  return observed;
}

/** The digit did not touch, though its last command is its target. */
bool IsMissed(const PlantedTrial& planted, const Observed& observed) {
  const TrialSetup& setup = planted.setup;
  for (const DigitContact& contact : observed.result.contacts) {
    if (contact.digit == planted.digit && !std::isnan(contact.time)) return false;
  }
  const auto& digits = setup.hand->digits;
  const auto digit = std::find_if(digits.begin(), digits.end(), [&](const Digit& candidate) {
    return candidate.id == planted.digit;
  });
  const std::vector<int> joints = FindDrivenJoints(*setup.hand, *digit);
  return std::all_of(joints.begin(), joints.end(), [&](int joint) {
    const double target = setup.grasp.q_target[joint] + setup.draw.joint_error[joint];
    return std::abs(observed.last_command[joint] - target) < 1e-9;
  });
}

bool IsRight(FailureCause cause, const PlantedTrial& planted, const Observed& observed) {
  const std::optional<Diagnosis>& diagnosis = observed.result.diagnosis;
  if (!diagnosis) return false;
  if (cause == FailureCause::kPush) return diagnosis->cause == cause;
  if (diagnosis->digit != planted.digit) return false;
  // Asked for its target and still not at the object, a digit would not have touched in time either.
  return diagnosis->cause == cause ||
         (cause == FailureCause::kLateDigit && diagnosis->cause == FailureCause::kNoTouch &&
          IsMissed(planted, observed));
}

struct Tally {
  int num_planted = 0, num_failed = 0, num_right = 0;
  std::map<std::string, int> named;  ///< failures by the cause that the diagnosis names
};

class PlantedCausesTest : public testing::Test {
 protected:
  /** Plants all causes in one trial, if it succeeds. */
  void PlantAll(TrialRunner& runner, const TrialSetup& setup, const TrialKey& key);
  void Judge(FailureCause cause, const PlantedTrial& planted, const Observed& observed);

  std::map<FailureCause, Tally> tallies_;
  int num_trials_ = 0, num_held_ = 0, num_numerical_ = 0;
};

void PlantedCausesTest::PlantAll(TrialRunner& runner, const TrialSetup& setup,
                                 const TrialKey& key) {
  ++num_trials_;
  const TrialResult undisturbed = runner.Run(setup);
  if (!IsSuccess(undisturbed.outcome)) return;
  ++num_held_;
  for (const FailureCause cause : kPlants) {
    for (size_t strength = 0; strength < CountStrengths(cause); ++strength) {
      const PlantedTrial planted =
          Plant(cause, setup, undisturbed, Stream(key, {1, static_cast<size_t>(cause), strength}));
      const bool has_own_hand = planted.setup.hand != setup.hand;
      std::optional<TrialRunner> own;
      if (has_own_hand) own.emplace(planted.setup.hand, planted.setup.object);
      Judge(cause, planted, RunPlanted(has_own_hand ? *own : runner, planted));
    }
  }
}

void PlantedCausesTest::Judge(FailureCause cause, const PlantedTrial& planted,
                              const Observed& observed) {
  const TrialResult& result = observed.result;
  Tally& tally = tallies_[cause];
  ++tally.num_planted;
  if (IsSuccess(result.outcome)) return;
  if (IsNumericalFailure(result.outcome)) {
    ++num_numerical_;
    return;
  }
  ++tally.num_failed;
  const std::optional<Diagnosis>& diagnosis = result.diagnosis;
  ++tally.named[diagnosis ? NameOf(diagnosis->cause) : "nothing"];
  if (IsRight(cause, planted, observed)) {
    ++tally.num_right;
    return;
  }
  const TrialSetup& setup = planted.setup;
  std::cout << fmt::format("{}, {}, {}, grip {}, {}: {}, {}\n", setup.hand->id, setup.object->id,
                           setup.grasp.id, setup.strategy.grip, planted.text,
                           NameOf(result.outcome), diagnosis ? diagnosis->text : result.reason);
}

TEST_F(PlantedCausesTest, AreNamedInNineOfTenFailures) {
  for (size_t h = 0; h < std::size(kHands); ++h) {
    const auto hand = std::make_shared<const Hand>(LoadHand(kHands[h]));
    for (size_t o = 0; o < std::size(kObjects); ++o) {
      const std::shared_ptr<const GraspObject> object = LoadObject(kObjects[o]);
      const auto best = object->best_grasp.find(hand->id);
      const std::string grasp =
          best == object->best_grasp.end() ? object->grasp_order.front() : best->second;
      TrialRunner runner(hand, object);
      for (size_t g = 0; g < std::size(kGrips); ++g) {
        for (size_t draw = 0; draw < kNumDraws; ++draw) {
          TrialSetup setup = MakeSetup(hand, grasp, object);
          setup.strategy = MakeStrategy(kGrips[g]);
          setup.draw = Draw(*hand, Stream({h, o, g, draw}, {0}));
          PlantAll(runner, setup, {h, o, g, draw});
        }
      }
    }
  }
  int num_failed = 0, num_right = 0;
  std::cout << fmt::format("{} trials, {} succeed; {} planted ones fail numerically\n", num_trials_,
                           num_held_, num_numerical_);
  for (const FailureCause cause : kPlants) {
    const Tally& tally = tallies_[cause];
    std::cout << fmt::format("{}: {} planted, {} fail, {} right;", NameOf(cause), tally.num_planted,
                             tally.num_failed, tally.num_right);
    for (const auto& [named, count] : tally.named) std::cout << " " << count << " " << named;
    std::cout << "\n";
    EXPECT_GE(tally.num_failed, kLeastFailuresOfAKind) << NameOf(cause);
    num_failed += tally.num_failed;
    num_right += tally.num_right;
  }
  std::cout << fmt::format("{} of {} right\n", num_right, num_failed);
  EXPECT_GE(num_failed, kLeastFailures);
  EXPECT_GE(num_right, kLeastShareRight * num_failed);
}

}  // namespace
}  // namespace graspbench
