#include "core/trial/grip/unfelt_force.h"

#include <gtest/gtest.h>

#include "core/physics/implicit_world.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/** The straight index of the TUM Hand, pressed from its palm's side: by 2 N 30 mm beyond the joint
of its proximal link, by 4 N 20 mm beyond that of its middle link, 51 mm further out, and by 3 N on
its fingertip, whose joint lies 30 mm beyond and turns with the middle one. */
class PressedFinger : public testing::Test {
 protected:
  PressedFinger() : hand_(LoadHand("tum")), dynamics_(hand_), sensors_(hand_, MakePerfect(), "a") {
    dynamics_.UpdatePositions(Pose::Identity(), VectorXd::Zero(hand_.num_joints()));
    Press("ff_proximal", 0.03, 2.0);
    Press("ff_middle", 0.02, 4.0);
    Press("ff_distal", 0.006, 3.0);
    sensors_.Observe(0.0, contacts_, dynamics_);
    // By hand: force times distance along the finger, from each joint that turns.
    torques_ = VectorXd::Zero(dynamics_.num_dofs());
    torque("FFq2") = 2.0 * 0.03 + 4.0 * 0.071 + 3.0 * 0.087;
    torque("FFq3") = 4.0 * 0.02 + 3.0 * (0.036 + 0.006);
  }
  static SensorConfig MakePerfect() {
    SensorConfig config;
    config.noise = config.hysteresis = 0.0;
    return config;
  }
  void Press(const char* link, double along, double force) {
    HandContact contact;
    contact.link = hand_.FindLink(link);
    const Pose& X_WL = dynamics_.X_WL(contact.link);
    contact.p_WC = X_WL * Vector3d(0.007, 0.0, along);
    contact.nhat_W = X_WL.linear() * Vector3d::UnitX();
    contact.normal_force = force;
    contacts_.push_back(contact);
  }
  double& torque(const char* joint) {
    return torques_[dynamics_.dof_of_joint(hand_.FindJoint(joint))];
  }
  /** Forces from proximal to distal. The contacts' own are hidden: 100 N each. */
  std::vector<double> Estimate() const {
    std::vector<HandContact> contacts = contacts_;
    for (HandContact& contact : contacts) contact.normal_force = 100.0;
    std::vector<double> forces;
    for (const HandContact& contact : EstimateContacts(contacts, sensors_, dynamics_, torques_)) {
      forces.push_back(contact.normal_force);
    }
    return forces;
  }

  Hand hand_;
  HandDynamics dynamics_;
  TouchSensors sensors_;
  std::vector<HandContact> contacts_;
  VectorXd torques_;
};

TEST_F(PressedFinger, TorquesSayWhatElementsDoNotFeel) {
  const std::vector<double> forces = Estimate();
  EXPECT_NEAR(forces[0], 2.0, 0.04);
  EXPECT_NEAR(forces[1], 4.0, 0.04);
  EXPECT_NEAR(forces[2], 3.0, 1e-9);
}

// Less torque than the fingertip alone needs: the links press with nothing, they do not pull.
TEST_F(PressedFinger, NoContactPulls) {
  torque("FFq2") = 0.1;
  torque("FFq3") = 0.1;
  EXPECT_EQ(Estimate(), (std::vector<double>{0.0, 0.0, Estimate()[2]}));
}

// One joint at its stop: the other's torque is explained all the same. Both: nothing is known.
TEST_F(PressedFinger, StopsHideForces) {
  torque("FFq3") = kUnset;
  std::vector<double> forces = Estimate();
  EXPECT_NEAR(0.03 * forces[0] + 0.071 * forces[1], 2.0 * 0.03 + 4.0 * 0.071, 1e-3);
  torque("FFq2") = kUnset;
  forces = Estimate();
  EXPECT_TRUE(std::isnan(forces[0]));
  EXPECT_TRUE(std::isnan(forces[1]));
  EXPECT_NEAR(forces[2], 3.0, 1e-9);
}

class ContactTorques : public testing::Test {
 protected:
  ContactTorques() : world_(hand_, *object_, SimConfig(), TablePresence::kNone) {
    state_.q = VectorXd::Constant(hand_.num_joints(), 0.1);  // no digit touches another
    ApplyCoupling(hand_, state_.q);
    state_.u = VectorXd::Zero(world_.dynamics().num_dofs());
    state_.p_WOcm = Vector3d(1.0, 0.0, 0.0);  // out of reach
  }
  int dof_of(const char* joint) { return world_.dynamics().dof_of_joint(hand_.FindJoint(joint)); }

  Hand hand_ = LoadHand("tum");
  std::shared_ptr<const GraspObject> object_ = MakeCube(0.05, 0.5);
  ImplicitWorld world_;
  WorldState state_;
};

// Its springs have 3 N m/rad and give at most 1 N m.
TEST_F(ContactTorques, AreThoseOfTheDrivesWithoutGravity) {
  state_.gravity_W.setZero();
  state_.q[hand_.FindJoint("MFq2")] =
      hand_.joints[static_cast<size_t>(hand_.FindJoint("MFq2"))].upper;
  world_.Reset(state_);
  world_.dynamics().UpdatePositions(state_.X_WH, state_.q);
  WorldCommand command;
  command.q = state_.q;
  command.q[hand_.FindJoint("FFq2")] += 0.1;
  command.q[hand_.FindJoint("THq2")] -= 1.0;
  const VectorXd torques = CalcContactTorques(hand_, world_, command);
  EXPECT_NEAR(torques[dof_of("FFq2")], 0.3, 1e-9);
  EXPECT_NEAR(torques[dof_of("THq2")], -1.0, 1e-9);
  EXPECT_NEAR(torques[dof_of("FFq1")], 0.0, 1e-9);
  EXPECT_TRUE(std::isnan(torques[dof_of("MFq2")])) << "its stop may bear it";
}

// At rest in the air the drives bear their digits, and nothing else, however the hand is turned.
TEST_F(ContactTorques, AreNoneInTheAir) {
  for (const Vector3d& axis : {Vector3d(1.0, 0.0, 0.0), Vector3d(0.3, 1.0, 0.2).normalized()}) {
    state_.X_WH.linear() = Eigen::AngleAxisd(1.2, axis).toRotationMatrix();
    world_.Reset(state_);
    WorldCommand command;
    command.q = state_.q;
    command.X_WH = state_.X_WH;
    for (int i = 0; i < 500; ++i) world_.Step(command);
    const VectorXd torques = CalcContactTorques(hand_, world_, command);
    double largest = 0.0;  // that a drive gives
    for (int dof = 0; dof < torques.size(); ++dof) {
      const int joint = world_.dynamics().joint_of_dof(dof);
      EXPECT_NEAR(torques[dof], 0.0, 1e-4) << hand_.joints[static_cast<size_t>(joint)].name;
      largest = std::max(largest, std::abs(CalcDriveTorque(hand_, world_.dynamics(), world_.state(),
                                                           joint, command.q[joint])));
    }
    EXPECT_GT(largest, 5e-3);
  }
}

}  // namespace
}  // namespace graspbench
