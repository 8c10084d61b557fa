#include "core/trial/protocols/free_space.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "core/base/error.h"
#include "core/physics/implicit_world.h"
#include "core/quality/epsilon_fast.h"
#include "core/quality/wrench_space.h"
#include "core/trial/chain_limit.h"
#include "core/trial/measures/stability_meter.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr char kPalm[] = "palm";

struct ObjectMotion {
  double shift, turn_deg;
};

ObjectMotion CalcMotion(const Pose& before, const Pose& after) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(before.linear().transpose() * after.linear()));
  return {(after.translation() - before.translation()).norm(), DegFromRad(turn.angle())};
}

/** A world that has gone through some of the way; a copy goes on from the same instant. */
class FreeSpaceCourse {
 public:
  FreeSpaceCourse(const ProfiledScene& scene, const FreeSpaceProfile& profile)
      : scene_(scene),
        profile_(profile),
        is_lift_(RowFromName(kProfileTests, profile.test, "test").value == ProfileTest::kLift),
        world_(MakeWorld()) {}

  const World& world() const { return *world_; }
  bool is_lift() const { return is_lift_; }
  bool is_finite() const { return report_.is_finite; }
  const StepReport& report() const { return report_; }
  int num_steps() const { return num_steps_; }
  int num_unconverged() const { return num_unconverged_; }
  ObjectMotion CalcMoved(double height = 0.0) const {
    Pose start = scene_.X_WO;
    start.pretranslate(Vector3d(0.0, 0.0, height));
    return CalcMotion(start, world_->CalcObjectPose());
  }

  void Push(const Vector3d& acceleration_W) {
    world_->SetExternalLoad(world_->mass_properties().mass * acceleration_W, Vector3d::Zero());
  }

  /** From one pose and posture to another, as the profile updates commands. */
  void Go(const Pose& X_WH0, const Eigen::VectorXd& q0, const Pose& X_WH1,
          const Eigen::VectorXd& q1, double duration) {
    const int num_steps = std::max(1, static_cast<int>(std::lround(duration / profile_.sim.step)));
    const int updates = profile_.stage_updates > 0 ? profile_.stage_updates : num_steps;
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(X_WH0.linear().transpose() * X_WH1.linear()));
    const Vector3d moved = X_WH1.translation() - X_WH0.translation();
    for (int step = 0; step < num_steps && report_.is_finite; ++step) {
      const double share = static_cast<double>(step * updates / num_steps + 1) / updates;
      command_.q = q0 + share * (q1 - q0);
      command_.X_WH = MakePose(
          X_WH0.linear() * Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix(),
          X_WH0.translation() + share * moved);
      if (profile_.stage_updates == 0) {
        command_.v_WH = moved / duration;
        command_.w_WH = X_WH0.linear() * turn.axis() * (turn.angle() / duration);
      }
      Step();
    }
    command_.v_WH = command_.w_WH = Vector3d::Zero();
  }

  void Wait(double duration) {
    const int num_steps = std::max(1, static_cast<int>(std::lround(duration / profile_.sim.step)));
    for (int step = 0; step < num_steps && report_.is_finite; ++step) Step();
  }

  /** What the hand is asked for at a stage: under middle-first one drive bends both joints. */
  Eigen::VectorXd MakeCommand(const ScriptedStage& stage) const {
    Eigen::VectorXd q = stage.q;
    if (scene_.hand->coupling != CouplingRule::kMiddleFirst) return q;
    for (size_t j = 0; j < scene_.hand->joints.size(); ++j) {
      const HandJoint& joint = scene_.hand->joints[j];
      if (joint.coupled_to < 0 || joint.is_mimic) continue;
      q[joint.coupled_to] += stage.q[static_cast<Eigen::Index>(j)];
    }
    return q;
  }

  void Begin() {
    WorldState state;
    state.gravity_W = MakeGravity(profile_.sim);
    state.X_WH = scene_.X_WO * scene_.stages.front().X_OH;
    state.q = scene_.stages.front().q;
    state.u = Eigen::VectorXd::Zero(world_->dynamics().num_dofs());
    state.R_WO = scene_.X_WO.linear();
    state.p_WOcm = scene_.X_WO * scene_.object->mass_properties.p_OOcm;
    world_->Reset(state);
  }

 private:
  WorldCopy MakeWorld() const {
    return WorldCopy(ImplicitWorld(*scene_.hand, *scene_.object, profile_.sim,
                                   is_lift_ ? TablePresence::kPresent : TablePresence::kNone));
  }
  void Step() {
    report_ = world_->Step(command_);
    ++num_steps_;
    num_unconverged_ += !report_.converged;
  }

  const ProfiledScene& scene_;
  const FreeSpaceProfile& profile_;
  bool is_lift_;
  WorldCopy world_;
  WorldCommand command_;
  StepReport report_;
  int num_steps_ = 0, num_unconverged_ = 0;
};

/** Deepest overlaps at a stage: with the object, and of the hand with itself [m]. */
struct Overlaps {
  double object = 0.0, self = 0.0;
};
Overlaps FindOverlaps(const ProfiledScene& scene, const ScriptedStage& stage,
                      const SimConfig& sim) {
  HandDynamics dynamics(*scene.hand);
  Collider collider(*scene.hand, *scene.object, sim, TablePresence::kNone);
  dynamics.UpdatePositions(scene.X_WO * stage.X_OH, stage.q);
  std::vector<ContactPoint> contacts;
  collider.FindContacts(dynamics, scene.X_WO, scene.X_WO * scene.object->mass_properties.p_OOcm, 0,
                        contacts);
  Overlaps overlaps;
  for (const ContactPoint& contact : contacts) {
    double& deepest = contact.is_on_object ? overlaps.object : overlaps.self;
    deepest = std::max(deepest, contact.depth);
  }
  return overlaps;
}

double CalcEpsilon(const World& world, double radius) {
  const WorldState& state = world.state();
  const Eigen::Matrix3d R_OW = state.R_WO.transpose();
  std::vector<HandContact> touching;
  world.FindHandContacts(touching);
  std::vector<GraspContact> contacts;
  for (const HandContact& contact : touching) {
    contacts.push_back({R_OW * (contact.p_WC - state.p_WOcm), (R_OW * contact.nhat_W).normalized(),
                        contact.mu, contact.mu * contact.torsion_radius, std::nullopt});
  }
  if (contacts.size() < 2) return 0.0;
  WrenchSpace space;
  space.torque_scale = radius;
  return CalcEpsilonBounds(CalcConeWrenches(contacts, space).wrenches).lower;
}

double FindDepthInTable(const ProfiledScene& scene) {
  double lowest = 0.0;
  for (const Vector3d& p_OV : scene.object->mesh.vertices) {
    lowest = std::min(lowest, (scene.X_WO * p_OV).z());
  }
  return -lowest;
}

std::string ListTouching(const Hand& hand, const std::vector<bool>& link_touches) {
  std::vector<bool> touches(hand.digits.size(), false);
  bool palm_touches = false;
  for (size_t link = 0; link < link_touches.size(); ++link) {
    if (!link_touches[link]) continue;
    const int digit = hand.FindDigitOfLink(static_cast<int>(link));
    digit < 0 ? palm_touches = true : touches[static_cast<size_t>(digit)] = true;
  }
  std::string names;
  const auto add = [&](const std::string& name) { names += (names.empty() ? "" : " ") + name; };
  for (size_t d = 0; d < touches.size(); ++d) {
    if (touches[d]) add(hand.digits[d].id);
  }
  if (palm_touches) add(kPalm);
  return names;
}

class FreeSpaceRun {
 public:
  FreeSpaceRun(const ProfiledScene& scene, const FreeSpaceProfile& profile)
      : scene_(scene), profile_(profile), course_(scene, profile) {}

  FreeSpaceResult Run() {
    if (!scene_.refusal.empty()) return Fail("limits", scene_.refusal);
    const ScriptedStage& second = scene_.stages[std::min<size_t>(1, scene_.stages.size() - 1)];
    result_.start_penetration = FindOverlaps(scene_, scene_.stages.front(), profile_.sim).object;
    result_.self_penetration = FindOverlaps(scene_, second, profile_.sim).self;
    if (result_.start_penetration > profile_.max_start_penetration) {
      return Fail("start",
                  fmt::format("at {} the hand is {:.1f} mm deep in the object, more than {:g} mm",
                              scene_.stages.front().name, MmFromM(result_.start_penetration),
                              MmFromM(profile_.max_start_penetration)));
    }
    const double in_table = course_.is_lift() ? FindDepthInTable(scene_) : 0.0;
    if (in_table > profile_.max_start_penetration) {
      return Fail("start",
                  fmt::format("the object is {:.1f} mm deep in the table, the file's z = 0, "
                              "more than {:g} mm",
                              MmFromM(in_table), MmFromM(profile_.max_start_penetration)));
    }
    course_.Begin();
    if (course_.is_lift()) course_.Push({0.0, 0.0, -profile_.acceleration});
    if (!Close()) return result_;
    if (course_.is_lift() ? Lift() : PushAll()) result_.passed = true;
    return result_;
  }

 private:
  FreeSpaceResult& Fail(const std::string& stage, const std::string& reason) {
    result_.failed_stage = stage;
    result_.reason = reason;
    return result_;
  }
  bool FailNumerically(const std::string& stage) {
    result_.is_numerical = true;
    Fail(stage, "the simulation gave up: positions or speeds left all bounds");
    return false;
  }
  void Count(const FreeSpaceCourse& course, int steps_before, int unconverged_before) {
    result_.num_steps += course.num_steps() - steps_before;
    result_.num_unconverged += course.num_unconverged() - unconverged_before;
  }

  bool Close() {
    for (size_t s = 0; s + 1 < scene_.stages.size(); ++s) {
      const ScriptedStage &from = scene_.stages[s], &to = scene_.stages[s + 1];
      course_.Go(scene_.X_WO * from.X_OH, course_.MakeCommand(from), scene_.X_WO * to.X_OH,
                 course_.MakeCommand(to), profile_.stage_time);
      if (!course_.is_finite()) return FailNumerically(to.name);
    }
    // A grasp of one stage is held as it stands.
    if (scene_.stages.size() == 1) {
      const ScriptedStage& only = scene_.stages.front();
      course_.Go(scene_.X_WO * only.X_OH, course_.MakeCommand(only), scene_.X_WO * only.X_OH,
                 course_.MakeCommand(only), profile_.stage_time);
      if (!course_.is_finite()) return FailNumerically(only.name);
    }
    Count(course_, 0, 0);
    const ObjectMotion closing = course_.CalcMoved();
    result_.closing_shift = closing.shift;
    result_.closing_turn_deg = closing.turn_deg;
    result_.touching = ListTouching(*scene_.hand, course_.report().link_touches_object);
    result_.grip_force = course_.report().grip_force;
    result_.epsilon = CalcEpsilon(course_.world(), CalcObjectRadius(*scene_.object));
    return true;
  }

  bool IsBeyond(const ObjectMotion& moved) const {
    return moved.shift >= profile_.max_shift || moved.turn_deg >= profile_.max_turn_deg;
  }
  /** What is kept of a look; false: it has moved too far. */
  bool Look(const ObjectMotion& moved, const std::string& stage, double time) {
    result_.worst_shift = std::max(result_.worst_shift, moved.shift);
    result_.worst_turn_deg = std::max(result_.worst_turn_deg, moved.turn_deg);
    if (!IsBeyond(moved)) return true;
    const bool was_before =
        !course_.is_lift() && IsBeyond({result_.closing_shift, result_.closing_turn_deg});
    const std::string how = moved.shift >= profile_.max_shift
                                ? fmt::format("moved {:.1f} mm, the limit is {:g} mm",
                                              MmFromM(moved.shift), MmFromM(profile_.max_shift))
                                : fmt::format("turned {:.1f} degrees, the limit is {:g}",
                                              moved.turn_deg, profile_.max_turn_deg);
    const bool is_missed = result_.touching.empty();
    const std::string& last = scene_.stages.back().name;
    const std::string touched =
        (is_missed ? "nothing" : result_.touching) + " touched it after the " + last;
    Fail(was_before || is_missed ? last : stage,
         (was_before  ? "closing the hand moved the object away: it has "
          : is_missed ? "the hand does not reach the object, which in the " + stage + " has "
                      : fmt::format("{:.1f} s into the {} the object has ", time, stage)) +
             how + "; " + touched);
    return false;
  }

  bool PushAll() {
    for (int push = 0; push < 6; ++push) {
      const double sign = push % 2 == 0 ? -1.0 : 1.0;
      const std::string stage = std::string("push ") + (sign < 0.0 ? "-" : "+") + "xyz"[push / 2];
      FreeSpaceCourse pushed = course_;
      const int steps = pushed.num_steps(), unconverged = pushed.num_unconverged();
      pushed.Push(sign * profile_.acceleration * Vector3d::Unit(push / 2));
      bool stands = true;
      const int num_looks =
          std::max(1, static_cast<int>(std::lround(profile_.test_time / profile_.check_interval)));
      for (int look = 1; stands && look <= num_looks; ++look) {
        pushed.Wait(profile_.test_time / num_looks);
        stands = pushed.is_finite()
                     ? Look(pushed.CalcMoved(), stage, look * profile_.test_time / num_looks)
                     : FailNumerically(stage);
      }
      Count(pushed, steps, unconverged);
      if (!stands) return false;
      ++result_.num_stood;
    }
    return true;
  }

  bool Lift() {
    const ScriptedStage& last = scene_.stages.back();
    const Pose X_WH = scene_.X_WO * last.X_OH;
    Pose lifted = X_WH;
    lifted.pretranslate(Vector3d(0.0, 0.0, profile_.lift_height));
    const int steps = course_.num_steps(), unconverged = course_.num_unconverged();
    course_.Go(X_WH, course_.MakeCommand(last), lifted, course_.MakeCommand(last),
               profile_.test_time);
    Count(course_, steps, unconverged);
    if (!course_.is_finite()) return FailNumerically("lift");
    if (!Look(course_.CalcMoved(profile_.lift_height), "lift", profile_.test_time)) return false;
    result_.num_stood = 1;
    return true;
  }

  const ProfiledScene& scene_;
  const FreeSpaceProfile& profile_;
  FreeSpaceCourse course_;
  FreeSpaceResult result_;
};

}  // namespace

FreeSpaceResult RunFreeSpace(const ProfiledScene& scene, const FreeSpaceProfile& profile) {
  try {
    DemandShortChains(*scene.hand);
    return FreeSpaceRun(scene, profile).Run();
  } catch (const std::bad_alloc&) {  // of the machine, not of the grasp
    throw;
  } catch (const std::exception& e) {
    FreeSpaceResult result;
    result.is_numerical = true;
    result.failed_stage = "start";
    result.reason = e.what();
    return result;
  }
}

}  // namespace graspbench
