#pragma once
/** @file
Two long fingers that pinch a cube at its middle with a known force. */

#include <memory>

#include "core/physics/implicit_world.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/shape/primitives.h"
#include "core/trial/judge/judge.h"

namespace graspbench {

/** Each finger turns about the world's y axis at the root and presses with drive torque / length
along x; along y and z it is stiff. The palm's axes are the world's. */
class TestPinch {
 public:
  static constexpr double kSide = 0.03;      ///< of the cube [m]
  static constexpr double kLength = 0.1;     ///< of a finger [m]
  static constexpr double kStiffness = 1.0;  ///< of a drive [N m/rad]
  static constexpr double kTorsionRadius = 0.004;

  /** @param force  of each finger [N] */
  TestPinch(double force, double mass, double mu, const Eigen::Vector3d& gravity_W) {
    constexpr double kTip = 0.005;
    auto hand = std::make_shared<Hand>(MakeBareHand());
    command_.q = Eigen::Vector2d(force, -force) * (kLength / kStiffness);
    for (const double side : {-1.0, 1.0}) {
      Pose X_PJ = MakePose(Eigen::Vector3d(side * (0.5 * kSide + kTip), 0.0, 0.0));
      X_PJ.rotate(Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()));
      AddRodLink(*hand, 0, X_PJ, Eigen::Vector3d::UnitY(), 0.02, kLength);
      const int link = static_cast<int>(hand->links.size()) - 1;
      hand->links.back().surface.torsion_radius = kTorsionRadius;
      hand->joints.back().drive = {kStiffness, 0.02, 100.0};
      hand->contact_spheres.push_back({link, Eigen::Vector3d(0.0, 0.0, kLength), kTip});
      Digit digit;
      digit.id = side < 0.0 ? "TH" : "FF";
      digit.is_thumb = side < 0.0;
      digit.links = {link};
      hand->digits.push_back(digit);
    }
    GraspObject object =
        MakeSolid(MakeRoundedBox(Eigen::Vector3d::Constant(kSide), 0.001, 2), mass, mu, mu);
    object.id = "cube";
    object.size = Eigen::Vector3d::Constant(kSide);
    setup_.hand = hand;
    setup_.object = std::make_shared<const GraspObject>(object);
    setup_.grasp.digits = {"TH", "FF"};
    world_ = std::make_unique<ImplicitWorld>(*setup_.hand, *setup_.object, setup_.sim);
    WorldState state;
    state.X_WH = command_.X_WH = MakePose(Eigen::Vector3d(0.0, 0.0, 1.0));
    state.q = Eigen::Vector2d::Zero();
    state.u = Eigen::Vector2d::Zero();
    state.p_WOcm = Eigen::Vector3d(0.0, 0.0, 1.0 - kLength);
    state.gravity_W.setZero();
    world_->Reset(state);
    Settle();
    world_->SetGravity(gravity_W);
    Settle();
  }

  StepReport Step() { return world_->Step(command_); }
  World& world() { return *world_; }
  const TrialSetup& setup() const { return setup_; }
  HeldObject MakeHeldObject() const {
    return HeldObject(*world_, command_, setup_, GripRegulator(setup_, {}));
  }

 private:
  void Settle() {
    for (int i = 0; i < 400; ++i) Step();
  }

  TrialSetup setup_;
  std::unique_ptr<World> world_;
  WorldCommand command_;
};

}  // namespace graspbench
