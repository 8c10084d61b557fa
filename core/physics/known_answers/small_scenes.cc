#include "core/physics/known_answers/small_scenes.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kHeight = 1.0;  // of the squeezed object [m]

Hand MakeFingers(const Squeeze& squeeze, double half_width) {
  Hand hand =
      MakeSqueezeHand(squeeze.num_fingers, half_width, squeeze.force, squeeze.torsion_radius);
  if (squeeze.pad.youngs_modulus == 0.0) return hand;
  for (HandLink& link : hand.links) {
    link.surface.pad = squeeze.pad;
    link.surface.torsion_radius = kUnset;
  }
  return hand;
}

GraspObject SetMaterial(GraspObject object, const Squeeze& squeeze) {
  const double scale = squeeze.mass / object.mass_properties.mass;
  object.mass_properties.mass = squeeze.mass;
  object.mass_properties.I_OOcm *= scale;
  object.surface.friction_static = object.surface.friction_dynamic = squeeze.mu;
  return object;
}

}  // namespace

SimConfig MakeStepConfig(double step) {
  SimConfig config;
  config.step = step;
  return config;
}

std::string FormatStep(double step) {
  return "step " + std::to_string(std::lround(step * 1e6)) + " us";
}

GraspObject MakeSolid(TriMesh mesh, double mass, double mu_s, double mu_d) {
  GraspObject object;
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : mesh.vertices) box.extend(p);
  object.size = box.sizes();
  object.mesh = std::move(mesh);
  object.field = std::make_shared<SignedDistanceField>(SignedDistanceField::Build(object.mesh));
  object.mass_properties = CalcSolidMassProperties(object.mesh, mass);
  object.surface.friction_static = mu_s;
  object.surface.friction_dynamic = mu_d;
  return object;
}

GraspObject MakeBlock(double mass) {
  return MakeSolid(MakeRoundedBox(Vector3d(0.06, 0.04, 0.02), 0.0), mass, 0.5, 0.5);
}

TriMesh MakePrism(int num_sides, double apothem, double height) {
  const double half_side = kPi / num_sides, radius = apothem / std::cos(half_side);
  std::vector<Ring> rings(2);
  for (int i = 0; i < num_sides; ++i) {
    const double angle = (2 * i + 1) * half_side;
    const Vector3d p(radius * std::cos(angle), radius * std::sin(angle), 0.5 * height);
    rings[0].emplace_back(p.x(), p.y(), -p.z());
    rings[1].push_back(p);
  }
  return MakeLoft(rings);
}

Hand MakeBareHand() {
  Hand hand;
  HandLink root;
  root.name = "root";
  root.mass = 1e12;
  root.I_LLcm = 1e12 * Eigen::Matrix3d::Identity();
  hand.links.push_back(root);
  return hand;
}

void AddRodLink(Hand& hand, int parent, const Pose& X_PJ, const Vector3d& axis, double mass,
                double length) {
  HandLink link;
  link.name = "link" + std::to_string(hand.links.size());
  link.parent = parent;
  link.joint = hand.num_joints();
  link.X_PJ = X_PJ;
  link.axis = axis;
  link.mass = mass;
  link.p_LLcm = Vector3d(0.0, 0.0, 0.5 * length);
  const double across = mass * length * length / 12.0 + 1e-7;
  link.I_LLcm = Vector3d(across, across, 0.1 * across + 1e-7).asDiagonal();
  HandJoint joint;
  joint.name = "joint" + std::to_string(hand.num_joints());
  joint.link = static_cast<int>(hand.links.size());
  joint.lower = -100.0;
  joint.upper = 100.0;
  hand.links.push_back(link);
  hand.joints.push_back(joint);
}

Hand MakeSqueezeHand(int num_fingers, double radius, double force, double pad_torsion_radius) {
  constexpr double kBallRadius = 0.008;
  Hand hand = MakeBareHand();
  for (int i = 0; i < num_fingers; ++i) {
    const double angle = 2.0 * kPi * i / num_fingers;
    const Vector3d outwards(std::cos(angle), std::sin(angle), 0.0);
    const Vector3d axis = Vector3d::UnitZ().cross(outwards);
    AddRodLink(hand, 0, MakePose(radius * outwards), axis, 0.01, kSqueezeLever);
    HandLink& finger = hand.links.back();
    finger.p_LLcm.setZero();
    finger.surface.torsion_radius = pad_torsion_radius;
    hand.joints.back().drive = {1e3, 0.0, force * kSqueezeLever};
    hand.contact_spheres.push_back({hand.joints.back().link,
                                    kBallRadius * outwards - kSqueezeLever * Vector3d::UnitZ(),
                                    kBallRadius});
  }
  return hand;
}

SmallWorld::SmallWorld(Hand hand, GraspObject object, const SimConfig& config)
    : hand_(std::move(hand)),
      object_(std::move(object)),
      config_(config),
      world_(hand_, object_, config) {
  start_.X_WH = MakePose(Vector3d(0.0, 0.0, 10.0));
  start_.q = Eigen::VectorXd::Zero(hand_.num_joints());
  start_.u = Eigen::VectorXd::Zero(world_.dynamics().num_dofs());
}

SmallWorld::SmallWorld(GraspObject object, const SimConfig& config)
    : SmallWorld(MakeBareHand(), std::move(object), config) {}

void SmallWorld::Reset(const Eigen::VectorXd& q) {
  command_.q = q;
  command_.X_WH = start_.X_WH;
  command_.v_WH = start_.v_WH;
  num_unconverged_ = 0;
  world_.Reset(start_);
}

StepReport SmallWorld::Step() {
  const StepReport report = world_.Step(command_);
  if (!report.converged) ++num_unconverged_;
  return report;
}

StepReport SmallWorld::Run(double duration) {
  StepReport report;
  const auto num_steps = std::lround(duration / config_.step);
  for (long i = 0; i < num_steps; ++i) report = Step();
  return report;
}

void SmallWorld::RampGravity(const Vector3d& gravity_W, double duration) {
  const Vector3d from = world_.state().gravity_W;
  const auto num_steps = std::lround(duration / config_.step);
  for (long i = 1; i <= num_steps; ++i) {
    world_.SetGravity(from + (gravity_W - from) * (static_cast<double>(i) / num_steps));
    Step();
  }
}

double SmallWorld::CalcPotentialEnergy() {
  double energy = 0.0;
  world_.dynamics().UpdatePositions(state().X_WH, state().q);
  for (size_t i = 1; i < hand_.links.size(); ++i) {
    const Vector3d p_W = world_.dynamics().X_WL(static_cast<int>(i)) * hand_.links[i].p_LLcm;
    energy -= hand_.links[i].mass * state().gravity_W.dot(p_W);
  }
  return energy;
}

SqueezeScene::SqueezeScene(const Squeeze& squeeze, GraspObject object, double half_width)
    : world_(MakeFingers(squeeze, half_width), SetMaterial(std::move(object), squeeze),
             MakeStepConfig(squeeze.step)) {
  world_.start().X_WH = MakePose(Vector3d(0.0, squeeze.off_centre, kHeight + kSqueezeLever));
  world_.start().p_WOcm = Vector3d(0.0, 0.0, kHeight);
  world_.start().gravity_W.setZero();
  world_.Reset(Eigen::VectorXd::Ones(squeeze.num_fingers));
  world_.Run(0.3);
  world_.RampGravity(Vector3d(0.0, 0.0, -kStandardGravity), 0.3);
}

double SqueezeScene::CalcFall() const { return kHeight - world_.state().p_WOcm.z(); }

double SqueezeScene::CalcTilt() const {
  return std::abs(std::asin(std::clamp(world_.state().R_WO(2, 1), -1.0, 1.0)));
}

double FindThreshold(double low, double high, const std::function<bool(double)>& holds) {
  const bool holds_at_low = holds(low);
  if (holds(high) == holds_at_low) return std::nan("");
  while (high - low > 0.002 * std::abs(high)) {
    const double middle = 0.5 * (low + high);
    (holds(middle) == holds_at_low ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace graspbench
