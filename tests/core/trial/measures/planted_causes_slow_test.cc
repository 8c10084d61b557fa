// Trials that succeed, and fail once one cause is planted in them, in the least dose that makes them
// fail: the diagnosis may name no mechanism that physics rules out with this cause. A plant acts
// through what a trial is made of (hand, object, commands, load on the object); nothing here knows
// by what signs the diagnosis decides. Other draws: --gtest_random_seed=NUMBER.

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
#include "core/grasp/placement.h"
#include "core/trial/digit_delays.h"
#include "core/trial/measures/diagnosis_text.h"
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
constexpr GripMode kGrips[] = {GripMode::kMargin, GripMode::kPosture};

enum class Plant {
  kHeight,
  kOffset,
  kMass,
  kFriction,
  kPadFriction,
  kLateDigit,
  kJointError,
  kWeakDrive,
  kPush
};
constexpr NamedValue<Plant> kPlants[] = {{Plant::kHeight, "height"},
                                         {Plant::kOffset, "offset"},
                                         {Plant::kMass, "mass"},
                                         {Plant::kFriction, "friction"},
                                         {Plant::kPadFriction, "one pad"},
                                         {Plant::kLateDigit, "late digit"},
                                         {Plant::kJointError, "joint error"},
                                         {Plant::kWeakDrive, "weak drive"},
                                         {Plant::kPush, "push"}};

constexpr int kNumHalvings = 5;  // of the dose between one that holds and one that fails
constexpr int kLeastFailures = 100;
constexpr double kMostNotIdentified = 0.3;

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
};

/** @param dose  in (0, 1]. @param undisturbed  the result of the setup. */
PlantedTrial MakePlanted(Plant plant, double dose, const TrialSetup& setup,
                         const TrialResult& undisturbed, Stream stream) {
  PlantedTrial planted{setup};
  TrialSetup& changed = planted.setup;
  const std::string digit_id = setup.grasp.digits[stream.NextIndex(setup.grasp.digits.size())];
  const Vector3d direction = stream.NextDirection();
  auto hand = std::make_shared<Hand>(*setup.hand);
  auto object = std::make_shared<GraspObject>(*setup.object);
  const auto digit = std::find_if(hand->digits.begin(), hand->digits.end(),
                                  [&](const Digit& candidate) { return candidate.id == digit_id; });
  switch (plant) {
    case Plant::kHeight:
      changed.grasp.placement = CalcPlacement(*setup.hand, setup.grasp, *setup.object);
      changed.grasp.placement->X_WH.pretranslate(Vector3d(0.0, 0.0, 0.05 * dose));
      break;
    case Plant::kOffset: {
      const Eigen::Vector2d way = 0.06 * dose * direction.head<2>().normalized();
      changed.draw.offset_x += way.x();
      changed.draw.offset_y += way.y();
      break;
    }
    case Plant::kMass:
      object->mass_properties.mass *= std::exp(3.5 * dose);
      object->mass_properties.I_OOcm *= std::exp(3.5 * dose);
      changed.object = object;
      break;
    case Plant::kFriction:
      object->surface.friction_static *= std::exp(-4.0 * dose);
      object->surface.friction_dynamic *= std::exp(-4.0 * dose);
      changed.object = object;
      break;
    case Plant::kPadFriction: {
      const double scale = std::exp(-4.0 * dose);
      for (const int link : digit->links) {
        // Links of the shipped hands leave friction to the object; 2 a b / (a + b) is scale times a.
        SurfaceMaterial& surface = hand->links[static_cast<size_t>(link)].surface;
        surface.friction_static = scale / (2.0 - scale) * setup.object->surface.friction_static;
        surface.friction_dynamic = scale / (2.0 - scale) * setup.object->surface.friction_dynamic;
      }
      changed.hand = hand;
      break;
    }
    case Plant::kLateDigit:
      changed = DelayDigit(setup, static_cast<int>(digit - hand->digits.begin()), dose);
      break;
    case Plant::kJointError:
      for (int joint = 0; joint < hand->num_joints(); ++joint) {
        if (hand->joints[static_cast<size_t>(joint)].coupled_to >= 0) continue;
        changed.draw.joint_error[joint] += 0.4 * dose * stream.NextUniform(-1.0, 1.0);
      }
      break;
    case Plant::kWeakDrive:
      for (const int joint : FindDrivenJoints(*hand, *digit)) {
        hand->joints[static_cast<size_t>(joint)].drive.torque_limit *= std::exp(-6.0 * dose);
      }
      changed.hand = hand;
      break;
    case Plant::kPush:
      planted.push.time =
          stream.NextUniform(undisturbed.snapshots.front().time, undisturbed.simulated_time);
      planted.push.duration = 0.1;
      planted.push.force_W = 20.0 * dose * direction;
      break;
  }
  return planted;
}

TrialResult RunPlanted(TrialRunner& runner, const PlantedTrial& planted) {
  const auto push = [&](TrialCourse& course) {
    if (std::isnan(planted.push.time)) return;
    const double since = course.time() - planted.push.time;
    const bool is_pushed = since >= 0.0 && since < planted.push.duration;
    course.world().SetExternalLoad(is_pushed ? planted.push.force_W : Vector3d::Zero(),
                                   Vector3d::Zero());
  };
  const TrialSetup& setup = planted.setup;
  TrialRunner own(setup.hand, setup.object);
  return std::isnan(planted.push.time) ? own.Run(setup) : runner.Run(setup, push);
}

/** Whether physics allows the mechanism in a trial that held without the plant. The object's
friction is that on the table, too, so that less of it lets a digit push it aside. */
bool MayBe(Plant plant, Mechanism mechanism) {
  switch (mechanism) {
    case Mechanism::kOutsidePush:
      return plant == Plant::kPush;
    case Mechanism::kArmAtLimit:
      return plant == Plant::kMass || plant == Plant::kPush;
    case Mechanism::kDriveAtLimit:
      return plant == Plant::kMass || plant == Plant::kWeakDrive;
    case Mechanism::kNotReached:
    case Mechanism::kPushed:
      return plant != Plant::kMass && plant != Plant::kPush;
    default:
      return plant != Plant::kPush;
  }
}

struct Tally {
  int num_failed = 0, num_wrong = 0, num_unknown = 0;
  std::map<std::string, int> named;  ///< failures by mechanism
};

class PlantedCausesTest : public testing::Test {
 protected:
  /** Plants all causes in one trial, if it succeeds. */
  void PlantAll(TrialRunner& runner, const TrialSetup& setup, const TrialKey& key);
  void Judge(Plant plant, double dose, const TrialSetup& setup, const TrialResult& result);

  std::map<Plant, Tally> tallies_;
  int num_trials_ = 0, num_held_ = 0, num_without_dose_ = 0;
};

void PlantedCausesTest::PlantAll(TrialRunner& runner, const TrialSetup& setup,
                                 const TrialKey& key) {
  ++num_trials_;
  const TrialResult undisturbed = runner.Run(setup);
  if (!IsSuccess(undisturbed.outcome)) return;
  ++num_held_;
  for (const NamedValue<Plant>& row : kPlants) {
    const auto run = [&](double dose) {
      return RunPlanted(runner, MakePlanted(row.value, dose, setup, undisturbed,
                                            Stream(key, {1, static_cast<size_t>(row.value)})));
    };
    double holds = 0.0, fails = 1.0;
    TrialResult result = run(fails);
    if (IsSuccess(result.outcome)) {
      ++num_without_dose_;
      continue;
    }
    for (int i = 0; i < kNumHalvings; ++i) {
      const double dose = 0.5 * (holds + fails);
      const TrialResult tried = run(dose);
      (IsSuccess(tried.outcome) ? holds : fails) = dose;
      if (!IsSuccess(tried.outcome)) result = tried;
    }
    Judge(row.value, fails, setup, result);
  }
}

void PlantedCausesTest::Judge(Plant plant, double dose, const TrialSetup& setup,
                              const TrialResult& result) {
  if (!result.diagnosis) return;  // its outcome says it all: unreachable, not physical, ..
  Tally& tally = tallies_[plant];
  const Mechanism mechanism = result.diagnosis->mechanism;
  ++tally.num_failed;
  ++tally.named[NameOf(mechanism)];
  tally.num_unknown += mechanism == Mechanism::kNotIdentified;
  if (mechanism == Mechanism::kNotIdentified || MayBe(plant, mechanism)) return;
  ++tally.num_wrong;
  std::cout << fmt::format("{}, {}, {}, grip {}, {} {:.3f}: {}, {}\n", setup.hand->id,
                           setup.object->id, setup.grasp.id, setup.strategy.grip,
                           RowOf(kPlants, plant).name, dose, NameOf(result.outcome),
                           DescribeDiagnosis(result));
}

TEST_F(PlantedCausesTest, NoMechanismIsNamedThatIsNotThere) {
  for (size_t h = 0; h < std::size(kHands); ++h) {
    const auto hand = std::make_shared<const Hand>(LoadHand(kHands[h]));
    for (size_t o = 0; o < std::size(kObjects); ++o) {
      const std::shared_ptr<const GraspObject> object = LoadObject(kObjects[o]);
      const auto best = object->best_grasp.find(hand->id);
      const std::string grasp =
          best == object->best_grasp.end() ? object->grasp_order.front() : best->second;
      TrialRunner runner(hand, object);
      for (size_t g = 0; g < std::size(kGrips); ++g) {
        TrialSetup setup = MakeSetup(hand, grasp, object);
        setup.strategy = MakeStrategy(kGrips[g]);
        setup.draw = Draw(*hand, Stream({h, o, g, 0}, {0}));
        PlantAll(runner, setup, {h, o, g, 0});
      }
    }
  }
  int num_failed = 0, num_wrong = 0, num_unknown = 0;
  std::cout << fmt::format("{} trials, {} succeed; {} plants never make one fail\n", num_trials_,
                           num_held_, num_without_dose_);
  for (const auto& [plant, tally] : tallies_) {
    std::cout << fmt::format("{}: {} fail, {} wrong;", RowOf(kPlants, plant).name, tally.num_failed,
                             tally.num_wrong);
    for (const auto& [named, count] : tally.named) std::cout << " " << count << " " << named << ",";
    std::cout << "\n";
    num_failed += tally.num_failed;
    num_wrong += tally.num_wrong;
    num_unknown += tally.num_unknown;
  }
  std::cout << fmt::format("{} failed, {} wrong, {} not identified\n", num_failed, num_wrong,
                           num_unknown);
  EXPECT_GE(num_failed, kLeastFailures);
  EXPECT_EQ(num_wrong, 0);
  EXPECT_LE(num_unknown, kMostNotIdentified * num_failed);
}

}  // namespace
}  // namespace graspbench
