#include "core/trial/protocols/free_space.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "core/base/error.h"
#include "core/physics/implicit_world.h"
#include "core/trial/measures/stability.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr char kPalm[] = "palm";
constexpr size_t kTouchesThatRelease = 2;  // of digits and palm

/** From a pose of the object to another. */
struct ObjectMotion {
  double shift = 0.0;  ///< [m]
  double turn_deg = 0.0;
};

/** Hand and object on their way through the stages of a grasp, and what is done to the object then.
A copy goes on from the same instant, so that every push begins at it. */
class FreeSpaceCourse {
 public:
  /** Both must outlive it. @param trace_interval  of the instants that are kept [s]; 0: none. */
  FreeSpaceCourse(const ProfiledScene& scene, const FreeSpaceProfile& profile,
                  double trace_interval)
      : scene_(scene),
        profile_(profile),
        is_lift_(RowFromName(kProfileTests, profile.test, "test").value == ProfileTest::kLift),
        world_(ImplicitWorld(*scene.hand, *scene.object, profile.sim,
                             is_lift_ ? TablePresence::kPresent : TablePresence::kNone)),
        trace_interval_(trace_interval) {}

  /** Hand at the first stage, object at rest. Before all else. */
  void Begin() {
    WorldState state;
    state.gravity_W = MakeGravity(profile_.sim);
    state.X_WH = scene_.X_WO * scene_.stages.front().X_OH;
    state.q = scene_.stages.front().q;
    state.u = VectorXd::Zero(world_->dynamics().num_dofs());
    PutObject(state);
    world_->Reset(state);
    if (is_traced()) Trace();
  }
  /** A force at the object's centre of mass, its mass times this, from now on [m/s^2]. */
  void Push(const Vector3d& acceleration_W) {
    world_->SetExternalLoad(world_->mass_properties().mass * acceleration_W, Vector3d::Zero());
  }
  /** From one pose and posture that are asked for to another, as the profile updates commands. */
  void Go(const Pose& X_WH0, const VectorXd& q0, const Pose& X_WH1, const VectorXd& q1,
          double duration);
  /** Closes with the object put back after each step until enough parts touch it.
  @returns false: that never came, or the state is no longer finite. */
  bool CloseOnHeld(const Pose& X_WH, const VectorXd& q, double duration);
  /** Of a held object: by enough parts. */
  bool IsTouchedEnough() const;
  /** With the commands as they are. */
  void Wait(double duration) {
    const int num_steps = CountSteps(duration);
    for (int step = 0; step < num_steps && report_.is_finite; ++step) Step();
  }

  /** What the drives are asked for at a stage: under middle-first one drive bends both joints. */
  VectorXd MakeCommand(const ScriptedStage& stage) const;
  /** From where it began, that raised by a height [m]. */
  ObjectMotion CalcMoved(double height = 0.0) const;
  /** Digits on the object after the last step, in the hand's order, then "palm". */
  std::vector<std::string> ListTouching() const;

  const World& world() const { return *world_; }
  const StepReport& report() const { return report_; }
  bool is_lift() const { return is_lift_; }
  bool is_finite() const { return report_.is_finite; }
  int num_steps() const { return num_steps_; }
  int num_unconverged() const { return num_unconverged_; }

  bool is_traced() const { return trace_interval_ > 0.0; }
  /** Of the instants from now on. */
  void SetPhase(Phase phase) {
    if (is_traced()) {
      Trace();
      trace_.back().next_phase = phase;
    }
    phase_ = phase;
  }
  /** All instants since Begin, the last among them; leaves none. */
  std::vector<TraceInstant> TakeTrace() {
    if (is_traced() && !trace_.empty()) Trace();
    return std::move(trace_);
  }

 private:
  int CountSteps(double duration) const {
    return std::max(1, static_cast<int>(std::lround(duration / profile_.sim.step)));
  }
  /** At rest where it began. */
  void PutObject(WorldState& state) const {
    state.R_WO = scene_.X_WO.linear();
    state.p_WOcm = scene_.X_WO * scene_.object->mass_properties.p_OOcm;
    state.w_WO = state.v_WOcm = Vector3d::Zero();
  }
  void Step();
  /** Keeps this instant, unless it is the last that was kept. */
  void Trace();

  const ProfiledScene& scene_;
  const FreeSpaceProfile& profile_;
  bool is_lift_;
  WorldCopy world_;
  WorldCommand command_;
  StepReport report_;
  int num_steps_ = 0, num_unconverged_ = 0;
  double trace_interval_;
  Phase phase_ = Phase::kPlacing;
  std::vector<TraceInstant> trace_;
};

void FreeSpaceCourse::Go(const Pose& X_WH0, const VectorXd& q0, const Pose& X_WH1,
                         const VectorXd& q1, double duration) {
  const int num_steps = CountSteps(duration);
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

bool FreeSpaceCourse::CloseOnHeld(const Pose& X_WH, const VectorXd& q, double duration) {
  const int num_steps = CountSteps(duration);
  command_.X_WH = X_WH;
  command_.q = q;
  for (int step = 0; step < num_steps; ++step) {
    Step();
    if (!report_.is_finite) return false;
    WorldState state = world_->state();
    PutObject(state);
    world_->Reset(state);
    if (IsTouchedEnough()) return true;
  }
  return false;
}

bool FreeSpaceCourse::IsTouchedEnough() const {
  if (!scene_.table) return ListTouching().size() >= kTouchesThatRelease;
  int num_touching = 0;
  for (size_t link = 0; link < report_.link_touches_object.size(); ++link) {
    num_touching += report_.link_touches_object[link] && scene_.table->counts[link];
  }
  return num_touching >= scene_.table->num_touching;
}

VectorXd FreeSpaceCourse::MakeCommand(const ScriptedStage& stage) const {
  VectorXd q = stage.q;
  if (scene_.hand->coupling != CouplingRule::kMiddleFirst) return q;
  for (size_t j = 0; j < scene_.hand->joints.size(); ++j) {
    const HandJoint& joint = scene_.hand->joints[j];
    if (joint.coupled_to < 0 || joint.is_mimic) continue;
    q[joint.coupled_to] += stage.q[static_cast<Eigen::Index>(j)];
  }
  return q;
}

ObjectMotion FreeSpaceCourse::CalcMoved(double height) const {
  const Pose X_WO = world_->CalcObjectPose();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(scene_.X_WO.linear().transpose() * X_WO.linear()));
  const Vector3d start = scene_.X_WO.translation() + Vector3d(0.0, 0.0, height);
  return {(X_WO.translation() - start).norm(), DegFromRad(turn.angle())};
}

std::vector<std::string> FreeSpaceCourse::ListTouching() const {
  const Hand& hand = *scene_.hand;
  std::vector<bool> touches(hand.digits.size(), false);
  bool palm_touches = false;
  for (size_t link = 0; link < report_.link_touches_object.size(); ++link) {
    if (!report_.link_touches_object[link]) continue;
    const int digit = hand.FindDigitOfLink(static_cast<int>(link));
    digit < 0 ? palm_touches = true : touches[static_cast<size_t>(digit)] = true;
  }
  std::vector<std::string> names;
  for (size_t d = 0; d < touches.size(); ++d) {
    if (touches[d]) names.push_back(hand.digits[d].id);
  }
  if (palm_touches) names.push_back(kPalm);
  return names;
}

void FreeSpaceCourse::Step() {
  report_ = world_->Step(command_);
  ++num_steps_;
  num_unconverged_ += !report_.converged;
  if (!is_traced() || !report_.is_finite) return;
  const double time = num_steps_ * profile_.sim.step;
  if (time >= trace_.back().time + trace_interval_ - 1e-9) Trace();
}

void FreeSpaceCourse::Trace() {
  const double time = num_steps_ * profile_.sim.step;
  if (!trace_.empty() && trace_.back().time == time) return;
  trace_.push_back(MakeTraceInstant(*world_, time, phase_, report_, command_));
}

/** Of the search for the breaking load: its bounds over the profile's push, and its precision. */
constexpr double kLeastFactor = 1.0 / 64.0, kMostFactor = 16.0, kLoadPrecision = 1.05;

struct Push {
  std::string stage;  ///< "push -x", "fall"
  Vector3d axis_W;    ///< unit
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

double FindDepthInTable(const ProfiledScene& scene) {
  double lowest = 0.0;
  for (const Vector3d& p_OV : scene.object->mesh.vertices) {
    lowest = std::min(lowest, (scene.X_WO * p_OV).z());
  }
  return -lowest;
}

class FreeSpaceRun {
 public:
  /** @param trace_interval  0: no trace is kept [s] */
  FreeSpaceRun(const ProfiledScene& scene, const FreeSpaceProfile& profile, double trace_interval)
      : scene_(scene), profile_(profile), course_(scene, profile, trace_interval) {}

  /** Of the push that decides, or of that which moved the object most. */
  std::vector<TraceInstant> TakeTrace() {
    return shown_.empty() ? course_.TakeTrace() : std::move(shown_);
  }

  FreeSpaceResult Run() {
    result_.num_beyond_limits = scene_.num_beyond_limits;
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
    result_.passed = course_.is_lift() ? Lift() : PushAll();
    if (result_.passed && !is_touched_) FailUntouched();
    if (profile_.finds_breaking_load && !course_.is_lift() && is_touched_ && !IsMovedByClosing()) {
      FindBreakingLoad();
    }
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
    course_.SetPhase(Phase::kClosure);
    for (size_t s = 0; s + 1 < scene_.stages.size(); ++s) {
      const ScriptedStage &from = scene_.stages[s], &to = scene_.stages[s + 1];
      course_.Go(scene_.X_WO * from.X_OH, course_.MakeCommand(from), scene_.X_WO * to.X_OH,
                 course_.MakeCommand(to), profile_.stage_time);
      if (!course_.is_finite()) return FailNumerically(to.name);
    }
    const bool is_closed = CloseBeyond();
    Count(course_, 0, 0);
    if (!is_closed) return false;
    const ObjectMotion closing = course_.CalcMoved();
    result_.closing_shift = closing.shift;
    result_.closing_turn_deg = closing.turn_deg;
    is_touched_ = !course_.ListTouching().empty();
    result_.touching = fmt::format("{}", fmt::join(course_.ListTouching(), " "));
    result_.grip_force = course_.report().grip_force;
    result_.epsilon = CalcEpsilon();
    return true;
  }

  double CalcEpsilon() const {
    std::vector<HandContact> touching;
    course_.world().FindHandContacts(touching);
    std::vector<GraspContact> contacts;
    for (const HandContact& contact : touching) {
      contacts.push_back(MakeGraspContact(contact, course_.world().state(), contact.mu));
    }
    return CalcContactQuality(contacts, CalcObjectRadius(*scene_.object));
  }

  /** Past the last stage; a grasp of one stage is held at least as it stands. */
  bool CloseBeyond() {
    const ScriptedStage& last = scene_.stages.back();
    ScriptedStage closed = last;
    closed.q = CalcClosingCommand(scene_, profile_);
    q_held_ = course_.MakeCommand(closed);
    const Pose X_WH = scene_.X_WO * last.X_OH;
    if (profile_.closing.object_is_held) {
      if (course_.CloseOnHeld(X_WH, q_held_, profile_.stage_time)) return true;
      if (!course_.is_finite()) return FailNumerically(last.name);
      const std::vector<std::string> touching = course_.ListTouching();
      Fail(last.name,
           fmt::format("closing for {:g} s on the held object, {} touched it, where {} must",
                       profile_.stage_time,
                       touching.empty() ? "nothing" : fmt::format("{}", fmt::join(touching, " ")),
                       scene_.table ? fmt::format("{} links", scene_.table->num_touching)
                                    : "two of digits and palm"));
      return false;
    }
    if (closed.q == last.q && scene_.stages.size() > 1) return true;
    course_.Go(X_WH, course_.MakeCommand(last), X_WH, q_held_, profile_.stage_time);
    return course_.is_finite() || FailNumerically(last.name);
  }

  bool IsBeyond(const ObjectMotion& moved) const {
    return moved.shift >= profile_.max_shift || moved.turn_deg >= profile_.max_turn_deg;
  }
  /** What is kept of a look; false: it has moved too far. */
  bool Look(const ObjectMotion& moved, const std::string& stage, double time) {
    result_.worst_shift = std::max(result_.worst_shift, moved.shift);
    result_.worst_turn_deg = std::max(result_.worst_turn_deg, moved.turn_deg);
    if (!IsBeyond(moved)) return true;
    const bool was_before = !course_.is_lift() && IsMovedByClosing();
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
         (was_before  ? fmt::format("closing the hand moved the object by {:.1f} mm and turned it "
                                     "by {:.1f} degrees (limits {:g} mm and {:g}); {:.1f} s into "
                                     "the {} it has ",
                                    MmFromM(result_.closing_shift), result_.closing_turn_deg,
                                    MmFromM(profile_.max_shift), profile_.max_turn_deg, time, stage)
          : is_missed ? "the hand does not reach the object, which in the " + stage + " has "
                      : fmt::format("{:.1f} s into the {} the object has ", time, stage)) +
             how + "; " + touched);
    return false;
  }
  bool IsMovedByClosing() const {
    return IsBeyond({result_.closing_shift, result_.closing_turn_deg});
  }
  /** Limits that a free object keeps say nothing of the grasp. */
  void FailUntouched() {
    result_.passed = false;
    Fail(scene_.stages.back().name,
         "the hand does not reach the object: nothing touched it in any look");
  }
  bool DemandTouch(const FreeSpaceCourse& course, const std::string& stage) {
    is_touched_ = is_touched_ || !course.ListTouching().empty();
    if (!profile_.must_touch || !course.ListTouching().empty()) return true;
    const double shift = course.CalcMoved(course.is_lift() ? profile_.lift_height : 0.0).shift;
    Fail(stage,
         fmt::format("nothing touches the object at the end of the {}: it has moved {:.1f} mm",
                     stage, MmFromM(shift)));
    return false;
  }

  std::vector<Push> ListPushes() const {
    if (RowFromName(kProfileTests, profile_.test, "test").value == ProfileTest::kFall) {
      const Pose X_WH = scene_.X_WO * scene_.stages.back().X_OH;
      return {{"fall", X_WH.linear() * (scene_.table ? scene_.table->down_H
                                                     : scene_.hand->palm_normal.normalized())}};
    }
    std::vector<Push> pushes;
    for (int push = 0; push < 6; ++push) {
      const double sign = push % 2 == 0 ? -1.0 : 1.0;
      pushes.push_back({std::string("push ") + (sign < 0.0 ? "-" : "+") + "xyz"[push / 2],
                        sign * Vector3d::Unit(push / 2)});
    }
    return pushes;
  }

  bool StandPush(const Push& push, double acceleration) {
    FreeSpaceCourse pushed = course_;
    const int steps = pushed.num_steps(), unconverged = pushed.num_unconverged();
    pushed.SetPhase(Phase::kHold);
    pushed.Push(acceleration * push.axis_W);
    const double worst_before = result_.worst_shift;
    bool stands = true;
    const int num_looks =
        std::max(1, static_cast<int>(std::lround(profile_.test_time / profile_.check_interval)));
    for (int look = 1; stands && look <= num_looks; ++look) {
      pushed.Wait(profile_.test_time / num_looks);
      stands = pushed.is_finite()
                   ? Look(pushed.CalcMoved(), push.stage, look * profile_.test_time / num_looks)
                   : FailNumerically(push.stage);
    }
    stands = stands && DemandTouch(pushed, push.stage);
    Count(pushed, steps, unconverged);
    if (course_.is_traced() && (!stands || result_.worst_shift > worst_before)) {
      shown_ = pushed.TakeTrace();
    }
    return stands;
  }

  bool PushAll() {
    for (const Push& push : ListPushes()) {
      if (!StandPush(push, profile_.acceleration)) return false;
      ++result_.num_stood;
    }
    return true;
  }

  void FindBreakingLoad() {
    const double mass = scene_.object->mass_properties.mass;
    double most = kMostFactor * profile_.acceleration;
    std::string breaks_along;
    for (const Push& push : ListPushes()) {
      const auto stands = [&](double acceleration) {
        FreeSpaceRun other = *this;  // which keeps what it finds to itself, but for the steps
        const bool stood = other.StandPush(push, acceleration);
        result_.num_steps = other.result_.num_steps;
        result_.num_unconverged = other.result_.num_unconverged;
        return stood;
      };
      if (most == 0.0 || stands(most)) continue;
      breaks_along = push.stage;
      double least = kLeastFactor * profile_.acceleration;
      if (least >= most || !stands(least)) {
        most = 0.0;
        continue;
      }
      while (most > kLoadPrecision * least) {
        const double middle = std::sqrt(least * most);
        (stands(middle) ? least : most) = middle;
      }
      most = least;
    }
    result_.breaking_load = mass * most;
    result_.breaks_along = breaks_along;
  }

  bool Lift() {
    const ScriptedStage& last = scene_.stages.back();
    const Pose X_WH = scene_.X_WO * last.X_OH;
    Pose lifted = X_WH;
    lifted.pretranslate(Vector3d(0.0, 0.0, profile_.lift_height));
    const int steps = course_.num_steps(), unconverged = course_.num_unconverged();
    course_.SetPhase(Phase::kLiftOff);
    course_.Go(X_WH, q_held_, lifted, q_held_, profile_.test_time);
    Count(course_, steps, unconverged);
    if (!course_.is_finite()) return FailNumerically("lift");
    if (!Look(course_.CalcMoved(profile_.lift_height), "lift", profile_.test_time)) return false;
    if (!DemandTouch(course_, "lift")) return false;
    result_.num_stood = 1;
    return true;
  }

  const ProfiledScene& scene_;
  const FreeSpaceProfile& profile_;
  FreeSpaceCourse course_;
  std::vector<TraceInstant> shown_;
  VectorXd q_held_;          // what the drives are asked for once the hand has closed
  bool is_touched_ = false;  // after closing or at the end of a push or lift
  FreeSpaceResult result_;
};

TracedFreeSpace Run(const ProfiledScene& scene, const FreeSpaceProfile& profile,
                    double trace_interval) {
  TracedFreeSpace traced;
  try {
    DemandShortChains(*scene.hand);
    FreeSpaceRun run(scene, profile, trace_interval);
    traced.result = run.Run();
    traced.trace = run.TakeTrace();
  } catch (const std::bad_alloc&) {  // of the machine, not of the grasp
    throw;
  } catch (const std::exception& e) {
    traced.result = FreeSpaceResult();
    traced.result.is_numerical = true;
    traced.result.failed_stage = "start";
    traced.result.reason = e.what();
  }
  return traced;
}

}  // namespace

FreeSpaceResult RunFreeSpace(const ProfiledScene& scene, const FreeSpaceProfile& profile) {
  return Run(scene, profile, 0.0).result;
}

TracedFreeSpace TraceFreeSpace(const ProfiledScene& scene, const FreeSpaceProfile& profile,
                               double interval) {
  return Run(scene, profile, interval);
}

}  // namespace graspbench
