// Failures planted one by one, by an author who had read neither the diagnosis nor the remedies: a
// trial that holds, of synthetic objects and the developed hands, in which one thing is made worse
// step by step until it fails. What the diagnosis then names is compared with the trajectory, by
// other means than its own: it may name nothing that did not happen there. Other draws:
// --gtest_random_seed=NUMBER.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <map>

#include "core/base/random.h"
#include "core/grasp/predict_grasp.h"
#include "core/hand/load_hand.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/shape/primitives.h"
#include "core/trial/digit_delays.h"
#include "core/trial/measures/diagnosis_text.h"
#include "core/trial/trial_trace.h"

namespace graspbench {
namespace {

struct Shape {
  const char* name;
  double mass, mu;
  std::function<TriMesh()> make;
};
TriMesh MakeBody(std::vector<Eigen::Vector2d> outline) {  // (radius, z), bottom to top
  outline.insert(outline.begin(), {0.0, outline.front().y()});
  outline.emplace_back(0.0, outline.back().y());
  return MakeRevolution(outline);
}
const std::vector<Shape> kShapes = {
    {"cylinder", 0.20, 0.50,
     [] {
       return MakeBody({{0.030, -0.05}, {0.030, 0.05}});
     }},
    {"frustum", 0.18, 0.50,
     [] {
       return MakeBody({{0.034, -0.04}, {0.024, 0.04}});
     }},
    {"barrel", 0.15, 0.45,
     [] {
       return MakeBody({{0.022, -0.035}, {0.028, -0.012}, {0.028, 0.012}, {0.022, 0.035}});
     }},
    {"hourglass", 0.16, 0.45,
     [] {
       return MakeBody({{0.032, -0.045}, {0.020, 0.0}, {0.032, 0.045}});
     }},
    {"block", 0.14, 0.50,
     [] {
       return MakeRoundedBox({0.070, 0.040, 0.050}, 0.002);
     }},
    {"bar", 0.12, 0.50,
     [] {
       return MakeRoundedBox({0.140, 0.028, 0.030}, 0.002);
     }},
    {"prism", 0.12, 0.50, [] { return MakePrism(5, 0.026, 0.070); }},
    {"disc", 0.10, 0.50,
     [] {
       return MakeBody({{0.036, -0.012}, {0.036, 0.012}});
     }},
};
constexpr const char* kHands[] = {"tum", "shadow"};
constexpr const char* kGrasps[] = {"g1", "g2", "g3"};

/** A trial whose hand and object are its own, so that they may be changed. */
struct Plant {
  TrialSetup setup;
  Hand hand;
  GraspObject object;

  TrialSetup Make() const {
    TrialSetup made = setup;
    made.hand = std::make_shared<const Hand>(hand);
    made.object = std::make_shared<const GraspObject>(object);
    return made;
  }
  int FindThumb() const { return FindOpposingDigit(hand, setup.grasp); }
  /** The first grasping digit that is not the thumb. */
  int FindFinger() const {
    for (size_t d = 0; d < hand.digits.size(); ++d) {
      const auto& ids = setup.grasp.digits;
      if (static_cast<int>(d) != FindThumb() &&
          std::find(ids.begin(), ids.end(), hand.digits[d].id) != ids.end()) {
        return static_cast<int>(d);
      }
    }
    return -1;
  }
};

/** The combined coefficient, the harmonic mean of both sides, becomes `share` of the object's. */
void SetPad(Plant& plant, int digit, double share) {
  for (const int link : plant.hand.digits[static_cast<size_t>(digit)].links) {
    SurfaceMaterial& surface = plant.hand.links[static_cast<size_t>(link)].surface;
    surface.friction_static = share / (2.0 - share) * plant.object.surface.friction_static;
    surface.friction_dynamic = share / (2.0 - share) * plant.object.surface.friction_dynamic;
  }
}
void Weaken(Plant& plant, int digit, double share) {
  for (const int joint :
       FindDrivenJoints(plant.hand, plant.hand.digits[static_cast<size_t>(digit)])) {
    plant.hand.joints[static_cast<size_t>(joint)].drive.torque_limit *= share;
  }
}
void Bend(Plant& plant, int digit, double angle) {
  for (const int joint :
       FindDrivenJoints(plant.hand, plant.hand.digits[static_cast<size_t>(digit)])) {
    plant.setup.draw.joint_error[joint] += angle;
  }
}
void Move(Plant& plant, const Eigen::Vector3d& shift_W) {
  plant.setup.grasp.placement->X_WH.pretranslate(shift_W);
}
void Delay(Plant& plant, int digit, double delay) {
  plant.setup.lateness.assign(plant.hand.digits.size(), 0.0);
  plant.setup.lateness[static_cast<size_t>(digit)] = delay;
}

struct Cause {
  const char* name;
  std::vector<double> doses;  ///< growing worse
  std::function<void(Plant&, double dose)> plant;
};
const std::vector<double> kLengths = {0.003, 0.005, 0.007, 0.010, 0.013, 0.017,
                                      0.022, 0.028, 0.035, 0.045, 0.060};
const std::vector<double> kShares = {0.8, 0.65, 0.5, 0.4, 0.3, 0.22, 0.15, 0.10, 0.06, 0.03};
const std::vector<double> kTimes = {0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.55, 0.75, 1.0, 1.4};
const std::vector<double> kAngles = {0.05, 0.1, 0.15, 0.2, 0.27, 0.35, 0.45, 0.6};
const std::vector<Cause> kCauses = {
    {"height, up", kLengths,
     [](Plant& p, double d) {
       Move(p, {0, 0, d});
     }},
    {"offset along x", kLengths, [](Plant& p, double d) { p.setup.draw.offset_x += d; }},
    {"offset along y", kLengths, [](Plant& p, double d) { p.setup.draw.offset_y -= d; }},
    {"mass",
     {1.5, 2, 3, 4, 6, 8, 12, 16, 24},
     [](Plant& p, double d) {
       p.object.mass_properties.mass *= d;
       p.object.mass_properties.I_OOcm *= d;
     }},
    {"friction", kShares,
     [](Plant& p, double d) {
       p.object.surface.friction_static *= d;
       p.object.surface.friction_dynamic *= d;
     }},
    {"friction of the thumb", kShares, [](Plant& p, double d) { SetPad(p, p.FindThumb(), d); }},
    {"friction of a finger", kShares, [](Plant& p, double d) { SetPad(p, p.FindFinger(), d); }},
    {"wet pads",
     {1, 2, 3, 4, 5},
     [](Plant& p, double d) {  // a film of water; the thumb last
       int num_wet = 0;
       for (size_t digit = 0; digit < p.hand.digits.size() && num_wet < d; ++digit) {
         if (static_cast<int>(digit) == p.FindThumb() && num_wet + 1 < d) continue;
         SetPad(p, static_cast<int>(digit), 0.2);
         ++num_wet;
       }
     }},
    {"late thumb", kTimes, [](Plant& p, double d) { Delay(p, p.FindThumb(), d); }},
    {"late finger", kTimes, [](Plant& p, double d) { Delay(p, p.FindFinger(), d); }},
    {"joint error of the thumb", kAngles, [](Plant& p, double d) { Bend(p, p.FindThumb(), -d); }},
    {"joint error of a finger", kAngles, [](Plant& p, double d) { Bend(p, p.FindFinger(), -d); }},
    {"weak thumb", kShares, [](Plant& p, double d) { Weaken(p, p.FindThumb(), d); }},
    {"weak finger", kShares, [](Plant& p, double d) { Weaken(p, p.FindFinger(), d); }},
};

/** What the trajectory shows, by instants 2 ms apart. */
struct Evidence {
  double opposed_time = 0.0;  ///< with parts that press more than 110 degrees apart [s]
  double shift_before = 0.0;  ///< of the object before that, horizontally [m]
  /** By normal forces in the last 0.1 and 0.3 s of it, and, of what is in the hand at the end, since
  lift-off [J]. */
  double work[3] = {0, 0, 0};
  double largest_turn = 0.0;   ///< of the object in the palm from its begin on [rad]
  double largest_slide = 0.0;  ///< the same, downwards [m]
  double drive_share = 0.0;    ///< of its limit, the hardest working drive's, while touching
};

Evidence FindEvidence(const TrialSetup& setup, const std::vector<TraceInstant>& trace) {
  const double kOpposed = std::cos(RadFromDeg(110.0));
  constexpr double kGlance = 0.02;  // shorter ones hold nothing [s]
  const Hand& hand = *setup.hand;
  Evidence evidence;
  std::vector<bool> opposed;
  for (const TraceInstant& now : trace) {
    bool is_opposed = false;
    for (const HandContact& a : now.contacts) {
      for (const HandContact& b : now.contacts) {
        is_opposed |=
            a.normal_force > 0.05 && b.normal_force > 0.05 && a.nhat_W.dot(b.nhat_W) < kOpposed;
      }
    }
    opposed.push_back(is_opposed);
  }
  size_t first = trace.size(), last = 0;
  for (size_t i = 0; i < trace.size(); ++i) {
    if (!opposed[i] || i == 0) continue;
    evidence.opposed_time += trace[i].time - trace[i - 1].time;
    if (evidence.opposed_time > kGlance) first = std::min(first, i);
    last = i;
  }
  const bool is_held = first < trace.size() && trace.back().time - trace[last].time < kGlance;
  const auto in_hand = [](const TraceInstant& at) { return at.X_WH.inverse() * at.X_WO; };
  for (size_t i = 1; i < trace.size(); ++i) {
    const TraceInstant &before = trace[i - 1], &now = trace[i];
    if (i <= first) {
      const Eigen::Vector3d shift = now.X_WO.translation() - trace[0].X_WO.translation();
      evidence.shift_before = std::max(evidence.shift_before, shift.head<2>().norm());
    } else {
      const Pose X_start = in_hand(trace[first]), X_now = in_hand(now);
      evidence.largest_turn =
          std::max(evidence.largest_turn,
                   Eigen::AngleAxisd(X_start.linear().transpose() * X_now.linear()).angle());
      evidence.largest_slide =
          std::max(evidence.largest_slide,
                   -(now.X_WH.linear() * (X_now.translation() - X_start.translation())).z());
    }
    if (!now.contacts.empty() && now.q_asked.size() == now.q.size()) {
      for (int j = 0; j < hand.num_joints(); ++j) {
        const HandJoint& joint = hand.joints[static_cast<size_t>(j)];
        if (joint.coupled_to >= 0 || joint.drive.torque_limit <= 0.0) continue;
        const double rate = (now.q[j] - before.q[j]) / (now.time - before.time);
        const double torque =
            joint.drive.stiffness * (now.q_asked[j] - now.q[j]) - joint.drive.damping * rate;
        evidence.drive_share =
            std::max(evidence.drive_share, std::abs(torque) / joint.drive.torque_limit);
      }
    }
    if (first == trace.size() || i > last) continue;
    for (const HandContact& contact : now.contacts) {  // a point of the object, seen from the palm
      const Eigen::Vector3d p_OC = now.X_WO.inverse() * contact.p_WC;
      const Eigen::Vector3d moved_W =
          now.X_WH.linear() * (in_hand(now) * p_OC - in_hand(before) * p_OC);
      const double work = contact.normal_force * contact.nhat_W.dot(moved_W);
      if (now.time > trace[last].time - 0.1) evidence.work[0] += work;
      if (now.time > trace[last].time - 0.3) evidence.work[1] += work;
      if (is_held && now.phase >= Phase::kLiftOff) evidence.work[2] += work;
    }
  }
  return evidence;
}

/** How the trajectory contradicts the mechanism; empty: it does not. */
std::string FindContradiction(const std::string& cause, const TrialResult& result,
                              const Evidence& seen) {
  const bool is_grip = cause == "mass" || cause.find("friction") == 0 || cause == "wet pads";
  switch (result.diagnosis->mechanism) {
    case Mechanism::kNotReached:
      if (is_grip) return "the hand closes as in the trial that holds";
      return seen.opposed_time > 0.1 ? "it was pressed from both sides" : "";
    case Mechanism::kPushed:
      if (cause == "mass") return "what is heavier moves less";
      return seen.shift_before < 0.003 ? "it had not moved before" : "";
    case Mechanism::kSqueezedOut:
      if (seen.opposed_time == 0.0) return "nothing opposed";
      return *std::max_element(std::begin(seen.work), std::end(seen.work)) <= 0.0
                 ? "normal forces did no work"
                 : "";
    case Mechanism::kSagged:
      return seen.largest_turn < RadFromDeg(10.0) ? "it did not turn" : "";
    case Mechanism::kSlid:
      return seen.largest_slide < 0.001 ? "it did not come down in the hand" : "";
    case Mechanism::kDriveAtLimit:
      return seen.drive_share < 0.85 ? "no drive was near its limit" : "";
    case Mechanism::kArmAtLimit:
      return result.outcome != Outcome::kArmOverloaded ? "the arm bore it" : "";
    case Mechanism::kOutsidePush:
      return "nobody pushed";
    default:
      return "";
  }
}

TEST(PlantedTrials, NothingIsNamedThatDidNotHappen) {
  std::map<std::string, std::map<std::string, int>> named;  // by cause
  int num_scenes = 0, num_held = 0, num_failed = 0, num_wrong = 0, num_unknown = 0;
  for (const char* const hand_id : kHands) {
    const Hand hand = LoadHand(hand_id);
    for (const Shape& shape : kShapes) {
      GraspObject object = MakeSolid(shape.make(), shape.mass, shape.mu, 0.9 * shape.mu);
      object.id = shape.name;
      for (const Grasp& grasp : LoadStandardGrasps(hand)) {
        if (std::find(std::begin(kGrasps), std::end(kGrasps), grasp.id) == std::end(kGrasps)) {
          continue;
        }
        Plant base{{}, hand, object};
        base.setup.grasp = FitGrasp(hand, grasp, object);
        base.setup.grasp.placement = CalcPlacement(hand, base.setup.grasp, object);
        if (++num_scenes % 2 == 0) {
          base.setup.strategy.grip = RowOf(kGripModes, GripMode::kMargin).name;
          base.setup.strategy.touch_speed = 0.25;
        }
        RandomStream stream(fmt::format("{}/{}/{}/{}", testing::GTEST_FLAG(random_seed), hand_id,
                                        shape.name, grasp.id),
                            "planted trials");
        TrialDraw& draw = base.setup.draw;
        draw.offset_x = stream.NextUniform(-0.005, 0.005);
        draw.offset_y = stream.NextUniform(-0.005, 0.005);
        draw.offset_yaw = stream.NextUniform(-RadFromDeg(5.0), RadFromDeg(5.0));
        draw.joint_error = Eigen::VectorXd::Zero(hand.num_joints());
        const auto run = [](const TrialSetup& setup) {
          TrialRunner runner(setup.hand, setup.object);
          return runner.Run(setup);
        };
        if (!IsSuccess(run(base.Make()).outcome)) continue;
        ++num_held;
        for (const Cause& cause : kCauses) {
          const auto make = [&](size_t dose) {
            Plant plant = base;
            cause.plant(plant, cause.doses[dose]);
            return plant.Make();
          };
          // The least dose that fails, where the largest does.
          size_t holds = 0, fails = cause.doses.size() - 1;
          if (IsSuccess(run(make(fails)).outcome)) continue;
          while (holds < fails) {
            const size_t middle = (holds + fails) / 2;
            IsSuccess(run(make(middle)).outcome) ? holds = middle + 1 : fails = middle;
          }
          const TrialSetup setup = make(fails);
          TrialRunner runner(setup.hand, setup.object);
          const TracedTrial traced = TraceTrial(runner, setup, 0.0);
          if (!traced.result.diagnosis) continue;  // its outcome says it all
          ++num_failed;
          const Mechanism mechanism = traced.result.diagnosis->mechanism;
          ++named[cause.name][NameOf(mechanism)];
          num_unknown += mechanism == Mechanism::kNotIdentified;
          const Evidence seen = FindEvidence(setup, traced.trace);
          const std::string why = FindContradiction(cause.name, traced.result, seen);
          num_wrong += !why.empty();
          if (!why.empty()) {
            std::cout << fmt::format(
                "{}, {}, {}, {} {}: {}, but {} (opposed {:.2f} s, before {:.1f} mm, work {:.2g} "
                "{:.2g} J, turned {:.0f} deg, down {:.1f} mm, drive {:.2f})\n  {}\n",
                hand_id, shape.name, grasp.id, cause.name, cause.doses[fails], NameOf(mechanism),
                why, seen.opposed_time, 1e3 * seen.shift_before, seen.work[0], seen.work[1],
                DegFromRad(seen.largest_turn), 1e3 * seen.largest_slide, seen.drive_share,
                DescribeDiagnosis(traced.result));
          }
        }
      }
    }
  }
  std::cout << fmt::format("{} trials, {} hold; {} planted failures\n", num_scenes, num_held,
                           num_failed);
  for (const auto& [cause, counts] : named) {
    std::cout << cause << ":";
    for (const auto& [mechanism, count] : counts) std::cout << " " << count << " " << mechanism;
    std::cout << "\n";
  }
  std::cout << fmt::format("{} contradicted, {} not identified\n", num_wrong, num_unknown);
  EXPECT_GE(num_failed, 100);
  EXPECT_EQ(num_wrong, 0);
  EXPECT_LE(num_unknown, 0.3 * num_failed);
}

}  // namespace
}  // namespace graspbench
