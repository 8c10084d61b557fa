// Known answers of hands: dynamics against Simbody, coupled joints, energy of a swing.

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/physics/known_answers/known_answer.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/physics/simbody/simbody_model.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kNumStates = 50;
MassProperties MakeBall() {
  MassProperties ball;
  ball.mass = 0.1;
  ball.I_OOcm = 4e-5 * Eigen::Matrix3d::Identity();
  return ball;
}

VectorXd MakeRandomVector(int size, double scale, RandomStream& random) {
  VectorXd v(size);
  for (double& value : v) value = scale * random.NextNormal();
  return v;
}

/** Gives every joint its own degree of freedom. */
Hand MakeUncoupled(Hand hand) {
  for (HandJoint& joint : hand.joints) joint.coupled_to = -1;
  return hand;
}

/** Removes drives, stops and self-contact from a hand on a fixed base. */
Hand MakeLoose(Hand hand, double damping) {
  hand.links[0].mass = MakeBareHand().links[0].mass;
  hand.links[0].I_LLcm = MakeBareHand().links[0].I_LLcm;
  for (HandJoint& joint : hand.joints) {
    joint.lower = -100.0;
    joint.upper = 100.0;
    joint.drive = {0.0, damping, 1e9};
  }
  hand.capsules.clear();
  return hand;
}

/** Makes three links that swing in a plane and out of it. */
Hand MakePendulum() {
  Hand hand = MakeBareHand();
  AddRodLink(hand, 0, Pose::Identity(), Vector3d::UnitX(), 0.05, 0.05);
  AddRodLink(hand, 1, MakePose(Vector3d(0, 0, 0.05)), Vector3d::UnitX(), 0.03, 0.03);
  AddRodLink(hand, 2, MakePose(Vector3d(0, 0, 0.03)), Vector3d::UnitY(), 0.02, 0.02);
  return hand;
}

struct Swing {
  double drift = 0.0;         ///< largest deviation of the energy from its initial value
  double largest_rise = 0.0;  ///< largest rise of the energy in one step
};

/** Lets a loose hand swing for 5 s and returns energies over the largest kinetic energy. The object
is far away and weighs nothing. */
Swing LetSwing(const Hand& hand, double step) {
  SmallWorld world(hand, MakeBlock(1e-9), MakeStepConfig(step));
  world.start().X_WH = MakePose(MakeRotationRpy(kPi / 2, 0.0, 0.0), Vector3d(0.0, 0.0, 1.0));
  for (int j = 0; j < hand.num_joints(); ++j) world.start().q[j] = j % 2 == 0 ? 0.3 : 0.5;
  ApplyCoupling(hand, world.start().q);
  world.start().p_WOcm = Vector3d(5.0, 0.0, 0.01);
  world.Reset();
  const auto energy = [&] {
    return world.world().CalcKineticEnergy() + world.CalcPotentialEnergy();
  };
  const double start = energy();
  double before = start, largest_kinetic = 0.0;
  Swing swing;
  for (double t = 0.0; t < 5.0; t += step) {
    world.Step();
    largest_kinetic = std::max(largest_kinetic, world.world().CalcKineticEnergy());
    const double now = energy();
    swing.drift = std::max(swing.drift, std::abs(now - start));
    swing.largest_rise = std::max(swing.largest_rise, now - before);
    before = now;
  }
  swing.drift /= largest_kinetic;
  swing.largest_rise /= largest_kinetic;
  return swing;
}

}  // namespace

std::vector<KnownAnswer> CheckSimbodyDynamics() {
  std::vector<KnownAnswer> answers;
  for (const char* id : {"tum", "shadow"}) {
    const Hand hand = MakeUncoupled(LoadHand(id));
    const int joints = hand.num_joints();
    SimbodyModel simbody(hand, MakeBall());
    HandDynamics dynamics(hand);
    RandomStream random("known answers", id);
    double worst_mass = 0.0, worst_bias = 0.0;
    for (int i = 0; i < kNumStates; ++i) {
      const VectorXd q = MakeRandomVector(joints, 1.0, random);
      VectorXd u = VectorXd::Zero(joints + 12);
      u.head(joints) = MakeRandomVector(joints, 5.0, random);
      u.segment<3>(joints) = MakeRandomVector(3, 1.0, random);
      u.segment<3>(joints + 3) = MakeRandomVector(3, 0.3, random);
      const Vector3d rpy = MakeRandomVector(3, 2.0, random);
      const Vector3d gravity_W = MakeRandomVector(3, 6.0, random);
      const Pose X_WH =
          MakePose(MakeRotationRpy(rpy.x(), rpy.y(), rpy.z()), MakeRandomVector(3, 0.2, random));
      simbody.SetPositions(X_WH, q, Pose::Identity());
      simbody.SetSpeeds(u);
      dynamics.UpdatePositions(X_WH, q);
      const int speeds = dynamics.num_speeds();
      Eigen::MatrixXd M(speeds, speeds);
      dynamics.CalcMassMatrix(M);
      VectorXd bias(speeds);
      dynamics.CalcBias(u.head(speeds), gravity_W, bias);
      const Eigen::MatrixXd M_simbody = simbody.CalcMassMatrix().topLeftCorner(speeds, speeds);
      const VectorXd bias_simbody = simbody.CalcBias(gravity_W).head(speeds);
      worst_mass = std::max(worst_mass, (M - M_simbody).cwiseAbs().maxCoeff());
      worst_bias = std::max(worst_bias, (bias - bias_simbody).cwiseAbs().maxCoeff());
    }
    const std::string what = hand.name + ", " + std::to_string(joints) + " joints and base: ";
    answers.push_back({what + "mass matrix", "kg m^2", 0.0, worst_mass, 1e-12});
    answers.push_back({what + "bias", "N m", 0.0, worst_bias, 1e-12});
  }
  return answers;
}

std::vector<KnownAnswer> CheckCoupledAccelerations() {
  std::vector<KnownAnswer> answers;
  Hand hand = LoadHand("shadow");
  const int joints = hand.num_joints();
  for (const CouplingRule rule : ListCouplingRules()) {
    hand.coupling = rule;
    for (const DistalMode mode : {DistalMode::kMiddleMoves, DistalMode::kDistalMoves}) {
      if (mode == DistalMode::kDistalMoves && rule != CouplingRule::kMiddleFirst) continue;
      SimbodyModel simbody(hand, MakeBall(), mode);
      HandDynamics dynamics(hand);
      const DistalRates rates = CalcDistalRates(rule, hand.fixed_coupling_ratio, mode);
      Eigen::MatrixXd T = Eigen::MatrixXd::Zero(joints, dynamics.num_dofs());  // u_joint = T u_dof
      for (int j = 0; j < joints; ++j) {
        const int distal = dynamics.distal_of_dof(dynamics.dof_of_joint(j));
        if (j == distal) dynamics.SetRate(j, rates.distal);
        if (j != distal && distal >= 0) dynamics.SetRate(j, rates.middle);
        T(j, dynamics.dof_of_joint(j)) = dynamics.rate_of_joint(j);
      }
      RandomStream random("coupled accelerations", NameOf(rule));
      double worst = 0.0;
      for (int i = 0; i < kNumStates; ++i) {
        VectorXd q = MakeRandomVector(joints, 0.7, random);
        ApplyCoupling(hand, q);
        const int dofs = dynamics.num_dofs(), speeds = dynamics.num_speeds();
        VectorXd u = VectorXd::Zero(speeds);
        u.head(dofs) = MakeRandomVector(dofs, 5.0, random);
        const VectorXd torques = MakeRandomVector(joints, 0.2, random);
        const Vector3d gravity_W = MakeRandomVector(3, 6.0, random);
        VectorXd all_speeds = VectorXd::Zero(joints + 12);
        all_speeds.head(joints) = T * u.head(dofs);
        simbody.SetPositions(Pose::Identity(), q, MakePose(Vector3d(1.0, 0.0, 0.0)));
        simbody.SetSpeeds(all_speeds);
        const VectorXd expected = simbody.CalcJointAccelerations(torques, gravity_W);

        dynamics.UpdatePositions(Pose::Identity(), q);
        Eigen::MatrixXd M(speeds, speeds);
        dynamics.CalcMassMatrix(M);
        VectorXd bias(speeds);
        dynamics.CalcBias(u, gravity_W, bias);
        const VectorXd obtained =
            T * M.topLeftCorner(dofs, dofs).llt().solve(T.transpose() * torques - bias.head(dofs));
        worst = std::max(worst, (obtained - expected).norm() / expected.norm());
      }
      std::string what = "rule " + NameOf(rule);
      if (rule == CouplingRule::kMiddleFirst) {
        what += mode == DistalMode::kMiddleMoves ? ", middle moves" : ", distal moves";
      }
      answers.push_back({what + ": relative difference", "", 0.0, worst, 1e-9});
    }
  }
  return answers;
}

std::vector<KnownAnswer> CheckCouplingRules() {
  std::vector<KnownAnswer> answers;
  const GraspObject block = MakeBlock(0.1);
  Hand hand = LoadHand("shadow");
  const int distal = hand.FindJoint("FFJ1"), middle = hand.FindJoint("FFJ2");
  for (const CouplingRule rule : {CouplingRule::kEven, CouplingRule::kFixed}) {
    hand.coupling = rule;
    const double ratio = rule == CouplingRule::kEven ? 1.0 : hand.fixed_coupling_ratio;
    SmallWorld world(hand, block, SimConfig());
    world.Reset(VectorXd::Constant(hand.num_joints(), 0.6));
    double worst = 0.0;
    for (int i = 0; i < 1000; ++i) {
      world.Step();
      worst = std::max(worst, std::abs(world.state().q[distal] - ratio * world.state().q[middle]));
    }
    answers.push_back(
        {"rule " + NameOf(rule) + ": J1 - r J2 while closing", "rad", 0.0, worst, 1e-12});
  }

  hand.coupling = CouplingRule::kMiddleFirst;
  SmallWorld world(hand, block, SimConfig());
  VectorXd command = VectorXd::Zero(hand.num_joints());
  command[middle] = RadFromDeg(120.0);
  world.Reset(command);
  double early = 0.0;
  for (int i = 0; i < 1000; ++i) {
    world.Step();
    if (world.state().q[middle] < hand.joints[middle].upper - RadFromDeg(1.0)) {
      early = std::max(early, std::abs(world.state().q[distal]));
    }
  }
  answers.push_back({"rule middle-first: J1 before J2 is at its end", "rad", 0.0, early, 1e-12});
  answers.push_back({"rule middle-first: J1 + J2 of a free finger commanded to 120 deg", "deg",
                     120.0, DegFromRad(world.state().q[middle] + world.state().q[distal]), 1.0});
  answers.push_back({"rule middle-first: J2 of it", "deg", DegFromRad(hand.joints[middle].upper),
                     DegFromRad(world.state().q[middle]), 1.0});

  // Opening: J1 moves back first.
  const double bent = world.state().q[middle];
  world.start() = world.state();
  world.Reset(VectorXd::Zero(hand.num_joints()));
  double moved = 0.0;
  for (int i = 0; i < 1000; ++i) {
    world.Step();
    if (world.state().q[distal] > 0.0) moved = std::abs(world.state().q[middle] - bent);
  }
  answers.push_back({"rule middle-first: motion of J2 while J1 opens", "rad", 0.0, moved, 1e-12});
  answers.push_back(
      {"rule middle-first: J1 at its stop", "deg", 0.0, DegFromRad(world.state().q[distal]), 0.2});
  return answers;
}

std::vector<KnownAnswer> CheckArm() {
  constexpr double kRadius = 0.01, kTime = 0.5;
  Hand hand = MakeBareHand();
  hand.links[0].mass = 1.0;
  hand.links[0].I_LLcm = 1e-3 * Eigen::Matrix3d::Identity();
  hand.contact_spheres.push_back({0, Vector3d::Zero(), kRadius});
  std::vector<KnownAnswer> answers;
  for (double step : kAnswerSteps) {
    const SimConfig config = MakeStepConfig(step);
    SmallWorld world(hand, MakeBlock(0.1), config);
    world.start().p_WOcm = Vector3d(5.0, 0.0, 0.01);
    // The hand moves by x(t) = a t^2 / 2 and then stays.
    const auto move = [&](double start, double end) {
      world.start().X_WH = MakePose(Vector3d(0.0, 0.0, start));
      world.Reset();
      StepReport report;
      double worst = 0.0;
      const double acceleration = 2.0 * (end - start) / (kTime * kTime);
      for (double t = step; t < 2.0 * kTime; t += step) {
        const double now = std::min(t, kTime), speed = t < kTime ? acceleration * now : 0.0;
        const double z = start + 0.5 * acceleration * now * now;
        report = world.world().Step(
            {VectorXd(), MakePose(Vector3d(0.0, 0.0, z)), Vector3d(0.0, 0.0, speed)});
        if (t < kTime) worst = std::max(worst, std::abs(world.state().X_WH.translation().z() - z));
      }
      return std::make_pair(report.arm_force, worst);
    };
    const std::string how = FormatStep(step) + ": ";
    answers.push_back({how + "a free hand is off by", "m", 0.0, move(1.0, 1.2).second, 1e-9});
    const double in_a_row = 1.0 / (1.0 / config.arm_stiffness + 1.0 / config.contact_stiffness);
    answers.push_back({how + "commanded 1 mm in the table", "N", 0.001 * in_a_row,
                       move(kRadius + 0.001, kRadius - 0.001).first, 1e-4});
    answers.push_back(
        {how + "energy without a cause", "J", 0.0, world.world().CalcEnergyResidual(), 1e-6});
    answers.push_back({how + "commanded 20 mm in the table", "N", config.arm_force_limit,
                       move(kRadius + 0.001, kRadius - 0.02).first, 1e-9});
  }
  return answers;
}

std::vector<KnownAnswer> CheckDriveLag() {
  constexpr double kSpeed = 1.5, kStiffness = 2.0, kDamping = 0.05;  // rad/s, N m/rad, N m s/rad
  Hand hand = MakeBareHand();
  AddRodLink(hand, 0, Pose::Identity(), Vector3d::UnitX(), 0.05, 0.05);
  hand.joints[0].drive = {kStiffness, kDamping, 10.0};
  std::vector<KnownAnswer> answers;
  for (double step : kAnswerSteps) {
    SmallWorld world(hand, MakeBlock(0.1), MakeStepConfig(step));
    world.start().gravity_W.setZero();
    world.start().X_WH = MakePose(Vector3d(0.0, 0.0, 1.0));
    world.Reset();
    WorldCommand command{VectorXd::Zero(1), world.start().X_WH, Vector3d::Zero()};
    for (double t = step; t < 0.5; t += step) {
      command.q[0] = kSpeed * t;
      world.world().Step(command);
    }
    answers.push_back({FormatStep(step) + ": lag", "rad", kDamping / kStiffness * kSpeed,
                       command.q[0] - world.state().q[0], 1e-6});
  }
  return answers;
}

std::vector<KnownAnswer> CheckSwingEnergy() {
  std::vector<KnownAnswer> answers;
  const auto add = [&](const std::string& name, const Hand& hand, double step) {
    answers.push_back({name + ", " + FormatStep(step), "", 0.0,
                       LetSwing(MakeLoose(hand, 0.0), step).drift, 1e-3});
  };
  for (double step : {0.0005, 0.001, 0.002}) add("pendulum of three links", MakePendulum(), step);
  add("TUM Hand", LoadHand("tum"), 0.0005);
  // With the middle-first rule, a joint that reaches its stop loses energy.
  Hand shadow = LoadHand("shadow");
  shadow.coupling = CouplingRule::kFixed;
  add("Shadow Hand", shadow, 0.0005);
  return answers;
}

std::vector<KnownAnswer> CheckDampedSwing() {
  std::vector<KnownAnswer> answers;
  for (double step : kAnswerSteps) {
    answers.push_back({"pendulum of three links, " + FormatStep(step) + ": largest rise", "", 0.0,
                       LetSwing(MakeLoose(MakePendulum(), 2e-4), step).largest_rise, 1e-4});
  }
  return answers;
}

std::vector<KnownAnswer> CheckUndampedDrive() {
  constexpr double kFrequency = 8.7, kAmplitude = 0.2, kMass = 0.02, kLength = 0.05;
  constexpr int kSwings = 17;
  Hand hand = MakeBareHand();
  AddRodLink(hand, 0, Pose::Identity(), Vector3d::UnitX(), kMass, kLength);
  const HandLink& rod = hand.links.back();
  const double inertia = rod.I_LLcm(0, 0) + kMass * rod.p_LLcm.squaredNorm();
  const double rate = 2.0 * kPi * kFrequency;
  hand.joints[0].drive = {inertia * rate * rate, 0.0, 100.0};
  std::vector<KnownAnswer> answers;
  for (double step : kAnswerSteps) {
    SmallWorld world(hand, MakeBlock(0.1), MakeStepConfig(step));
    world.start().gravity_W.setZero();
    world.start().q[0] = kAmplitude;
    world.Reset(VectorXd::Zero(1));
    world.Run((kSwings - 0.5) / kFrequency);
    double amplitude = 0.0;
    for (long i = std::lround(1.0 / (kFrequency * step)); i >= 0; --i) {
      world.Step();
      amplitude = std::max(amplitude, std::abs(world.state().q[0]));
    }
    answers.push_back({"8.7 Hz, " + FormatStep(step) + ": amplitude left after 17 swings", "", 1.0,
                       amplitude / kAmplitude, 0.05});
  }
  return answers;
}

}  // namespace graspbench
