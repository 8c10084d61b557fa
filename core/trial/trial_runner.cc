#include "core/trial/trial_runner.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/physics/implicit_world.h"
#include "core/physics/simbody/compliant_world.h"
#include "core/trial/digit_delays.h"
#include "core/trial/measures/object_in_hand.h"
#include "core/trial/policy/hand_policy.h"
#include "core/trial/protocols/protocol.h"
#include "core/trial/protocols/table_lift.h"
#include "core/vision/locate_object.h"
#include "core/vision/wrist_camera.h"

namespace graspbench {
namespace {

JudgedTrial MakeNumericalFailure(const char* reason) {
  JudgedTrial trial;
  trial.result.outcome = Outcome::kNumericalFailure;
  trial.result.reason = reason;
  return trial;
}

/** Setups of one hand and object, without a delayed digit. */
bool IsSame(const TrialSetup& a, const TrialSetup& b) {
  return a.grasp.id == b.grasp.id && a.grasp.q_pre == b.grasp.q_pre &&
         a.grasp.q_target == b.grasp.q_target && HaveEqualValues(a.sim, b.sim) &&
         a.draw.offset_x == b.draw.offset_x && a.draw.offset_y == b.draw.offset_y &&
         a.draw.offset_yaw == b.draw.offset_yaw && a.draw.joint_error == b.draw.joint_error &&
         a.sight_grasps.empty() && b.sight_grasps.empty() &&
         a.sight.has_value() == b.sight.has_value() && a.protocol == b.protocol &&
         a.positioning == b.positioning && a.arm == b.arm && a.touch == b.touch &&
         HaveEqualValues(a.strategy, b.strategy) && HaveEqualValues(a.camera, b.camera) &&
         HaveEqualValues(a.sensors, b.sensors);
}

}  // namespace

struct TrialRunner::Impl {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  std::unique_ptr<const World> world;  // for `sim` and `table`; trials run in clones
  SimConfig sim;
  TablePresence table = TablePresence::kPresent;
  std::unique_ptr<WristCamera> camera;  // for `camera_config`; null: not used yet
  CameraConfig camera_config;
  struct Undelayed {
    TrialSetup setup;
    TrialResult result;
  };
  std::optional<Undelayed> undelayed;  // the last undelayed trial, for one with a delayed digit

  Impl(std::shared_ptr<const Hand> the_hand, std::shared_ptr<const GraspObject> the_object)
      : hand(std::move(the_hand)), object(std::move(the_object)) {}

  /** Does not throw for events within the trial. */
  JudgedTrial Run(const TrialSetup& setup, bool is_judged,
                  const std::function<void(TrialCourse&)>& observe = {});
  /** Runs a setup that is neither chosen by sight nor delayed. */
  JudgedTrial RunCourse(const TrialSetup& setup, bool is_judged,
                        const std::function<void(TrialCourse&)>& observe);
  std::unique_ptr<World> MakeWorld(const SimConfig& config, TablePresence the_table);
  /** Returns the setup with the delay of its late digit. */
  TrialSetup Delay(const TrialSetup& setup);
  /** Returns null if none is needed. */
  WristCamera* FindCamera(const TrialSetup& setup);
};

WristCamera* TrialRunner::Impl::FindCamera(const TrialSetup& setup) {
  const bool tells =
      setup.controller &&
      setup.policy.object_pose == RowOf(kPolicyObjectPoses, PolicyObjectPose::kCamera).name;
  if (setup.positioning != Positioning::kCamera && setup.sight_grasps.empty() && !tells) {
    return nullptr;
  }
  if (!camera || !HaveEqualValues(setup.camera, camera_config)) {
    camera_config = setup.camera;
    camera = std::make_unique<WristCamera>(hand, object, camera_config);
  }
  return camera.get();
}

std::unique_ptr<World> TrialRunner::Impl::MakeWorld(const SimConfig& config,
                                                    TablePresence the_table) {
  if (!world || !HaveEqualValues(config, sim) || table != the_table) {
    sim = config;
    table = the_table;
    world = std::make_unique<ImplicitWorld>(*hand, *object, config, table);
  }
  return world->Clone();
}

TrialRunner::TrialRunner(std::shared_ptr<const Hand> hand,
                         std::shared_ptr<const GraspObject> object)
    : impl_(std::make_unique<Impl>(std::move(hand), std::move(object))) {
  DemandShortChains(*impl_->hand);
}

TrialRunner::~TrialRunner() = default;

void TrialRunner::Prepare(const SimConfig& sim) {
  try {
    impl_->MakeWorld(sim, TablePresence::kPresent);
  } catch (const std::bad_alloc&) {  // a fault of the machine, not of the trial
    throw;
  } catch (const std::exception&) {  // the trial will fail with this reason
  }
}

TrialResult TrialRunner::Run(const TrialSetup& setup) {
  TrialResult result = impl_->Run(setup, false).result;
  // In a plan, the same trial with a delayed digit follows.
  if (setup.keeps_closing && setup.late == LateDigit::kNone && !setup.is_compliant) {
    impl_->undelayed = Impl::Undelayed{setup, result};
  }
  return result;
}

TrialResult TrialRunner::Run(const TrialSetup& setup,
                             const std::function<void(TrialCourse&)>& observe) {
  return impl_->Run(setup, false, observe).result;
}

JudgedTrial TrialRunner::Judge(const TrialSetup& setup) { return impl_->Run(setup, true); }

TrialSetup TrialRunner::Impl::Delay(const TrialSetup& setup) {
  TrialSetup plain = setup;
  plain.late = LateDigit::kNone;
  if (!undelayed || !IsSame(undelayed->setup, plain)) {
    undelayed = Undelayed{plain, Run(plain, false).result};
  }
  return DelayLateDigit(setup, undelayed->result);
}

JudgedTrial TrialRunner::Impl::Run(const TrialSetup& setup, bool is_judged,
                                   const std::function<void(TrialCourse&)>& observe) {
  GRASPBENCH_DEMAND(setup.hand == hand && setup.object == object,
                    "a runner serves one hand and one object");
  if (setup.sight_grasps.empty() && setup.late != LateDigit::kNone) {
    return Run(Delay(setup), is_judged, observe);
  }
  try {
    if (!setup.sight_grasps.empty()) {
      return Run(ChooseGraspBySight(setup, MakeWorld(setup.sim, TablePresence::kPresent),
                                    FindCamera(setup)),
                 is_judged, observe);
    }
    if (setup.is_compliant) {
      auto second_world = MakeCompliantWorld(*hand, *object, setup.sim);
      return {TableLift(std::move(second_world), setup).Run(), std::nullopt};
    }
    return RunCourse(setup, is_judged, observe);
  } catch (const std::bad_alloc&) {  // a fault of the machine, not of the trial
    throw;
  } catch (const PolicyLost&) {  // the trial has no result
    throw;
  } catch (const std::exception& e) {
    // Simbody thus reports impossible states, and steps that become too short.
    return MakeNumericalFailure(e.what());
  }
}

JudgedTrial TrialRunner::Impl::RunCourse(const TrialSetup& setup, bool is_judged,
                                         const std::function<void(TrialCourse&)>& observe) {
  const Protocol& protocol = FindProtocol(setup.protocol);
  const std::unique_ptr<TrialCourse> course =
      protocol.make_course(MakeWorld(setup.sim, protocol.table), setup, FindCamera(setup));
  JudgedTrial trial;
  TrialResult& result = trial.result;
  if (setup.keeps_closing) {
    ClosingMeter closing;
    result = course->Run([&](TrialCourse& watched) {
      closing.Observe(watched.phase(), watched.world().CalcObjectPose());
      if (observe) observe(watched);
    });
    result.closing = closing.Calc();
  } else {
    result = course->Run(observe);
  }
  if (result.outcome == Outcome::kNumericalFailure) return trial;
  if (setup.finds_strength) result.strength = course->FindStrength();
  if (is_judged && course->is_held()) trial.judgement = course->Judge();
  return trial;
}

TrialSetup ChooseGraspBySight(TrialSetup setup, std::unique_ptr<World> world, WristCamera* camera) {
  if (setup.sight_grasps.empty()) return setup;
  TrialSetup looking = setup;
  looking.positioning = Positioning::kNominal;  // else the course would use the camera, too
  const Sighting seen = TableLift(std::move(world), looking).Look(camera);
  const std::vector<Grasp> grasps = std::exchange(setup.sight_grasps, {});
  if (!seen.is_found) {
    setup.sight = SightChoice{"", seen.reason};
    return setup;
  }
  const GraspType type = SuggestGraspType(seen);
  const auto chosen = std::find_if(grasps.begin(), grasps.end(),
                                   [&](const Grasp& grasp) { return grasp.type == type; });
  GRASPBENCH_DEMAND(chosen != grasps.end(), setup.hand->id);
  setup.grasp = *chosen;
  setup.sight = SightChoice{chosen->id, ""};
  return setup;
}

TrialSetup ChooseGraspBySight(TrialSetup setup) {
  if (setup.sight_grasps.empty()) return setup;
  auto world = std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim);
  return ChooseGraspBySight(std::move(setup), std::move(world), nullptr);
}

}  // namespace graspbench
