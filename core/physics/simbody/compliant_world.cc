#include "core/physics/simbody/compliant_world.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/physics/contact.h"
#include "core/physics/simbody/simtk_conversions.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kTransitionSpeed = 1e-4;  ///< transition speed of friction [m/s]
/** c in Hunt and Crossley's 1 + 3/2 c xdot [s/m]. Simbody has no inelastic contact; this value
dissipates most of the speed at 0.1 m/s. */
constexpr double kDissipation = 40.0;
constexpr double kAccuracy = 1e-4;  ///< of the integrator; absolute for positions [m]
/** At this force a contact is as deep as in our own engine [N]. */
constexpr double kTypicalForce = 2.0;
constexpr double kTypicalRadius = 0.008;  ///< of a fingertip [m]
/** A mesh is a sphere if the relative spread of its vertices' distances from O is smaller. */
constexpr double kRoundness = 0.06;
// Springs of stops, ties and locks [N m/rad], [N m s/rad].
constexpr double kStopStiffness = 50.0;
constexpr double kStopDamping = 0.02;
// a prismatic joint's stop is as stiff as at this lever arm [m]
constexpr double kSlideLever = 0.02;

/** Outer radius of an object that is a ball, ignoring seams and dimples; empty for other shapes. */
std::optional<double> FindSphereRadius(const GraspObject& object) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const Vector3d& p : object.mesh.vertices) {
    least = std::min(least, p.norm());
    most = std::max(most, p.norm());
  }
  if (most - least > kRoundness * most) return std::nullopt;
  return most;
}

/** Returns the table's coefficient that gives `wanted` against the object by Simbody's rule mu = 2
a b / (a + b), or the nearest possible one for a slippery object. */
double CalcPartnerFriction(double wanted, double object) {
  constexpr double kRough = 100.0;
  return 2.0 * object > wanted ? std::min(kRough, wanted * object / (2.0 * object - wanted))
                               : kRough;
}

/** Commanded motion of the root and the drives between two times. */
struct Course {
  double start = 0.0, length = 1.0;  ///< [s]
  Vector3d p0 = Vector3d::Zero(), v0 = Vector3d::Zero();
  Vector3d p1 = Vector3d::Zero(), v1 = Vector3d::Zero();
  Eigen::VectorXd q0, q1;

  /** Returns the given derivative of the root's position on a cubic through both ends. */
  Vector3d CalcRoot(double time, int derivative) const {
    const double h = length, x = (time - start) / h;
    const Vector3d d = p1 - p0, a = h * v0, b = h * v1;
    const Vector3d c2 = 3.0 * d - 2.0 * a - b, c3 = a + b - 2.0 * d;
    if (derivative == 0) return p0 + x * (a + x * (c2 + x * c3));
    if (derivative == 1) return (a + x * (2.0 * c2 + 3.0 * x * c3)) / h;
    return (2.0 * c2 + 6.0 * x * c3) / (h * h);
  }
  Eigen::VectorXd CalcCommand(double time) const {
    return q0 + std::min(1.0, (time - start) / length) * (q1 - q0);
  }
};

class RootMotion : public SimTK::Motion::Custom::Implementation {
 public:
  /** @param R_MW  rotation from the world to the axes of the mobilizer. */
  RootMotion(const Course& course, const SimTK::Rotation& R_MW) : course_(course), R_MW_(R_MW) {}
  SimTK::Motion::Level getLevel(const SimTK::State&) const override {
    return SimTK::Motion::Position;
  }
  void calcPrescribedPosition(const SimTK::State& state, int, SimTK::Real* q) const override {
    Write(state, 0, q);
  }
  void calcPrescribedPositionDot(const SimTK::State& state, int, SimTK::Real* qdot) const override {
    Write(state, 1, qdot);
  }
  void calcPrescribedPositionDotDot(const SimTK::State& state, int,
                                    SimTK::Real* qdotdot) const override {
    Write(state, 2, qdotdot);
  }

 private:
  void Write(const SimTK::State& state, int derivative, SimTK::Real* values) const {
    const SimTK::Vec3 value = R_MW_ * ToSimTK(course_.CalcRoot(state.getTime(), derivative));
    for (int i = 0; i < 3; ++i) values[i] = value[i];
  }
  const Course& course_;
  SimTK::Rotation R_MW_;
};

/** Drives, stops, ties and locks of the joints. */
class JointForces : public SimTK::Force::Custom::Implementation {
 public:
  JointForces(const Hand& hand, const std::vector<SimTK::MobilizedBody>& links,
              const HandDynamics& dynamics, const Course& course)
      : hand_(hand), links_(links), dynamics_(dynamics), course_(course) {}

  void Lock(int joint, double angle) { locked_at_[joint] = angle; }
  void Prepare() { locked_at_.assign(hand_.joints.size(), 0.0); }
  void TakeLocks(const JointForces& other) { locked_at_ = other.locked_at_; }

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>&,
                 SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector& forces) const override {
    const Eigen::VectorXd command = course_.CalcCommand(state.getTime());
    const int n = hand_.num_joints();
    std::vector<double> q(n), u(n), torque(n, 0.0);
    for (int j = 0; j < n; ++j) {
      q[j] = Body(j).getOneQ(state, 0);
      u[j] = Body(j).getOneU(state, 0);
    }
    const bool is_middle_first = hand_.coupling == CouplingRule::kMiddleFirst;
    for (int j = 0; j < n; ++j) {
      const HandJoint& joint = hand_.joints[j];
      const auto pull = [slides = joint.is_prismatic](double stretch, double rate) {
        const double scale = slides ? 1.0 / (kSlideLever * kSlideLever) : 1.0;
        return -scale * (kStopStiffness * stretch + kStopDamping * rate);
      };
      const int distal = dynamics_.distal_of_dof(dynamics_.dof_of_joint(j));
      if (joint.coupled_to < 0) {
        double theta = q[j], rate = u[j];
        const bool is_sum = distal >= 0 && is_middle_first;
        if (is_sum) {
          theta += q[distal];
          rate += u[distal];
        }
        const double tau =
            std::clamp(joint.drive.stiffness * (command[j] - theta) - joint.drive.damping * rate,
                       -joint.drive.torque_limit, joint.drive.torque_limit);
        torque[is_sum && dynamics_.rate_of_joint(j) == 0.0 ? distal : j] += tau;
      } else if (joint.is_mimic || !is_middle_first) {
        const int middle = joint.coupled_to;
        const double ratio = dynamics_.rate_of_joint(j);
        const double offset = joint.is_mimic ? joint.mimic_offset : 0.0;
        const double tie = pull(q[j] - ratio * q[middle] - offset, u[j] - ratio * u[middle]);
        torque[j] += tie;
        torque[middle] -= ratio * tie;
        continue;  // the limits of the joint that it follows apply
      }
      if (dynamics_.rate_of_joint(j) == 0.0) {
        torque[j] += pull(q[j] - locked_at_[j], u[j]);
      } else if (q[j] < joint.lower) {
        torque[j] += pull(q[j] - joint.lower, u[j]);
      } else if (q[j] > joint.upper) {
        torque[j] += pull(q[j] - joint.upper, u[j]);
      }
    }
    for (int j = 0; j < n; ++j) Body(j).applyOneMobilityForce(state, 0, torque[j], forces);
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }

 private:
  const SimTK::MobilizedBody& Body(int joint) const { return links_[hand_.joints[joint].link]; }

  const Hand& hand_;
  const std::vector<SimTK::MobilizedBody>& links_;
  const HandDynamics& dynamics_;
  const Course& course_;
  std::vector<double> locked_at_;
};

/** The multibody system that the integrator advances. */
struct Model {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::ContactTrackerSubsystem tracker{system};
  SimTK::CompliantContactSubsystem contact{system, tracker};
  std::vector<SimTK::MobilizedBody> links;
  SimTK::MobilizedBody::Free object;
  JointForces* joint_forces = nullptr;  // the system owns it
  std::optional<SimTK::CPodesIntegrator> integrator;

  /** @param X_WH  its rotation is constant. */
  Model(const Hand& hand, const GraspObject& object, const SimConfig& sim, const Pose& X_WH,
        const HandDynamics& dynamics, const Course& course);

  SimTK::State MakeState();
  void StartFrom(const SimTK::State& start);

 private:
  SimTK::ContactMaterial MakeMaterial(const SimConfig& sim, double mu_s, double mu_d) const;
  void AddTable(const GraspObject& grasp_object, const SimConfig& sim);
  void AddLinks(const Hand& hand, const SimConfig& sim, const SimTK::ContactMaterial& skin,
                const Pose& X_WH, const Course& course);
  void AddObject(const GraspObject& grasp_object, const SimTK::ContactMaterial& skin);
};

Model::Model(const Hand& hand, const GraspObject& grasp_object, const SimConfig& sim,
             const Pose& X_WH, const HandDynamics& dynamics, const Course& course) {
  contact.setTransitionVelocity(kTransitionSpeed);
  // The subsystem keeps the force of this handle. NOLINTNEXTLINE(bugprone-unused-raii)
  SimTK::Force::UniformGravity(forces, matter, SimTK::Vec3(0, 0, -sim.gravity));
  const SimTK::ContactMaterial skin = MakeMaterial(sim, grasp_object.surface.friction_static,
                                                   grasp_object.surface.friction_dynamic);
  AddTable(grasp_object, sim);
  AddLinks(hand, sim, skin, X_WH, course);
  AddObject(grasp_object, skin);
  joint_forces = new JointForces(hand, links, dynamics, course);
  joint_forces->Prepare();
  SimTK::Force::Custom(forces, joint_forces);
}

SimTK::ContactMaterial Model::MakeMaterial(const SimConfig& sim, double mu_s, double mu_d) const {
  // Two equal Hertz solids share the strain.
  const double depth = kTypicalForce / sim.contact_stiffness;
  const double stiffness =
      2.0 * kTypicalForce / (4.0 / 3.0 * std::sqrt(kTypicalRadius) * std::pow(depth, 1.5));
  return {stiffness, kDissipation, mu_s, mu_d};
}

void Model::AddTable(const GraspObject& grasp_object, const SimConfig& sim) {
  const double mu_s =
      CalcPartnerFriction(sim.table_friction_static, grasp_object.surface.friction_static);
  const double mu_d =
      CalcPartnerFriction(sim.table_friction_dynamic, grasp_object.surface.friction_dynamic);
  // A half-space fills x > 0 of its frame.
  matter.updGround().updBody().addContactSurface(
      SimTK::Transform(SimTK::Rotation(0.5 * SimTK::Pi, SimTK::YAxis)),
      SimTK::ContactSurface(SimTK::ContactGeometry::HalfSpace(),
                            MakeMaterial(sim, std::max(mu_s, mu_d), mu_d)));
}

void Model::AddLinks(const Hand& hand, const SimConfig& sim, const SimTK::ContactMaterial& skin,
                     const Pose& X_WH, const Course& course) {
  const SimTK::ContactCliqueId clique = SimTK::ContactSurface::createNewContactClique();
  for (size_t i = 0; i < hand.links.size(); ++i) {
    const HandLink& link = hand.links[i];
    SimTK::Body::Rigid body(MakeMassProperties(link.mass, link.p_LLcm, link.I_LLcm));
    const PadMaterial pad = CombineSurfaces(link.surface, SurfaceMaterial(), sim).pad;
    SimTK::ContactMaterial surface = skin;
    if (pad.is_soft()) surface.setStiffness(pad.modulus);
    for (const ContactSphere& sphere : hand.contact_spheres) {
      if (sphere.link != static_cast<int>(i)) continue;
      body.addContactSurface(
          SimTK::Transform(ToSimTK(sphere.p_LS)),
          SimTK::ContactSurface(SimTK::ContactGeometry::Sphere(sphere.radius), surface)
              .joinClique(clique));
    }
    if (link.parent < 0) {
      const SimTK::Rotation R_WL = ToSimTK(X_WH * link.X_PJ).R();
      links.push_back(SimTK::MobilizedBody::Translation(matter.updGround(), SimTK::Transform(R_WL),
                                                        body, SimTK::Transform()));
      SimTK::Motion::Custom(links.back(), new RootMotion(course, ~R_WL));
    } else {
      links.push_back(AddLink(hand, link, links[link.parent], body));
    }
  }
}

void Model::AddObject(const GraspObject& grasp_object, const SimTK::ContactMaterial& skin) {
  const MassProperties& mass = grasp_object.mass_properties;
  SimTK::Body::Rigid body(MakeMassProperties(mass.mass, Vector3d::Zero(), mass.I_OOcm));
  const SimTK::Transform X_OcmO(ToSimTK(Vector3d(-mass.p_OOcm)));
  body.addContactSurface(
      X_OcmO, SimTK::ContactSurface(
                  SimTK::ContactGeometry::Sphere(FindSphereRadius(grasp_object).value()), skin));
  object =
      SimTK::MobilizedBody::Free(matter.updGround(), SimTK::Transform(), body, SimTK::Transform());
}

SimTK::State Model::MakeState() {
  SimTK::State state = system.realizeTopology();
  system.realizeModel(state);
  return state;
}

void Model::StartFrom(const SimTK::State& start) {
  integrator.emplace(system, SimTK::CPodes::BDF);
  integrator->setAccuracy(kAccuracy);
  integrator->initialize(start);
}

class CompliantWorld : public World {
 public:
  CompliantWorld(const Hand& hand, const GraspObject& object, const SimConfig& sim)
      : World(hand, object, sim, TablePresence::kPresent), object_(object), sim_(sim) {}
  CompliantWorld(const CompliantWorld& other);

  std::unique_ptr<World> Clone() const override { return std::make_unique<CompliantWorld>(*this); }
  void Reset(const WorldState& state) override;
  StepReport Step(const WorldCommand& command) override;
  void SetGravity(const Vector3d&) override { Refuse("turn gravity"); }
  void SetExternalLoad(const Vector3d&, const Vector3d&) override { Refuse("load the object"); }
  void FindHandContacts(std::vector<HandContact>& contacts) const override { contacts = contacts_; }
  double CalcEnergyResidual() override { return kUnset; }

 private:
  [[noreturn]] static void Refuse(const std::string& what) {
    throw Error(ErrorKind::kUnsupported, "the compliant world cannot " + what);
  }
  void TakeState(const WorldCommand& command);
  StepReport TakeContacts();
  void AddHandContact(int link, const SimTK::ContactForce& force, const Vector3d& f_W,
                      StepReport& report);
  void TakeSphereDepths(StepReport& report) const;

  const GraspObject& object_;
  SimConfig sim_;
  Course course_;
  std::unique_ptr<Model> model_;  // refers to course_ and dynamics_
  std::vector<HandContact> contacts_;
};

CompliantWorld::CompliantWorld(const CompliantWorld& other)
    : World(other),
      object_(other.object_),
      sim_(other.sim_),
      course_(other.course_),
      contacts_(other.contacts_) {
  if (!other.model_) return;
  model_ = std::make_unique<Model>(*hand_, object_, sim_, state_.X_WH, dynamics_, course_);
  model_->joint_forces->TakeLocks(*other.model_->joint_forces);
  const SimTK::State& now = other.model_->integrator->getState();
  SimTK::State start = model_->MakeState();
  start.setTime(now.getTime());
  start.setQ(now.getQ());
  start.setU(now.getU());
  start.setZ(now.getZ());
  model_->StartFrom(start);
}

void CompliantWorld::Reset(const WorldState& state) {
  ResetScene(state);
  const Vector3d p_WR = (state.X_WH * hand_->links[0].X_PJ).translation();
  course_ = Course();
  course_.p0 = course_.p1 = p_WR;
  course_.v0 = course_.v1 = state.v_WH;
  course_.q0 = course_.q1 = state.q;
  contacts_.clear();
  model_ = std::make_unique<Model>(*hand_, object_, sim_, state.X_WH, dynamics_, course_);
  SimTK::State start = model_->MakeState();
  for (int j = 0; j < hand_->num_joints(); ++j) {
    model_->links[hand_->joints[j].link].setOneQ(start, 0, state.q[j]);
    model_->joint_forces->Lock(j, state.q[j]);
  }
  model_->object.setQToFitTransform(start, ToSimTK(MakePose(state.R_WO, state.p_WOcm)));
  model_->StartFrom(start);
}

StepReport CompliantWorld::Step(const WorldCommand& command) {
  Model& model = *model_;
  const Eigen::VectorXd q_before = course_.q1;
  course_.start = model.integrator->getTime();
  course_.length = command.num_steps * sim_.step;
  course_.p0 = course_.p1;
  course_.v0 = course_.v1;
  course_.p1 = (command.X_WH * hand_->links[0].X_PJ).translation();
  course_.v1 = command.v_WH;
  course_.q0 = q_before;
  course_.q1 = command.q;

  std::vector<double> rates;
  for (int j = 0; j < hand_->num_joints(); ++j) rates.push_back(dynamics_.rate_of_joint(j));
  double stop_work = 0.0;  // energy is not tracked
  ChooseDistalModes(command, stop_work);
  bool has_changed = false;
  for (int j = 0; j < hand_->num_joints(); ++j) {
    if (rates[j] == dynamics_.rate_of_joint(j)) continue;
    has_changed = true;
    model.joint_forces->Lock(j, state_.q[j]);
  }
  if (has_changed) model.integrator->reinitialize(SimTK::Stage::Time, false);

  // The integrator must not look beyond what has been commanded.
  const double end = course_.start + course_.length;
  // When the corrector fails, integration restarts once from the current state, at the lowest
  // order.
  bool has_started_again = false;
  while (model.integrator->getTime() < end - 1e-9) {
    try {
      model.integrator->stepTo(end, end);
    } catch (const std::exception&) {
      if (std::exchange(has_started_again, true)) throw;
      model.StartFrom(SimTK::State(model.integrator->getState()));
    }
  }
  TakeState(command);
  StepReport report = TakeContacts();
  link_blocks_ = report.link_touches_object;
  return report;
}

void CompliantWorld::TakeState(const WorldCommand& command) {
  const Model& model = *model_;
  const SimTK::State& state = model.integrator->getState();
  model.system.realize(state, SimTK::Stage::Dynamics);
  for (int j = 0; j < hand_->num_joints(); ++j) {
    state_.q[j] = model.links[hand_->joints[j].link].getOneQ(state, 0);
  }
  for (int dof = 0; dof < dynamics_.num_dofs(); ++dof) {
    const int joint = dynamics_.joint_of_dof(dof);
    state_.u[dof] = model.links[hand_->joints[joint].link].getOneU(state, 0);
  }
  const SimTK::Transform& X_WOcm = model.object.getBodyTransform(state);
  state_.R_WO = FromSimTK(X_WOcm.R());
  state_.p_WOcm = FromSimTK(X_WOcm.p());
  state_.w_WO = FromSimTK(model.object.getBodyAngularVelocity(state));
  state_.v_WOcm = FromSimTK(model.object.getBodyOriginVelocity(state));
  state_.X_WH = command.X_WH;
  state_.v_WH = command.v_WH;
}

StepReport CompliantWorld::TakeContacts() {
  const Model& model = *model_;
  const SimTK::State& state = model.integrator->getState();
  StepReport report;
  report.link_touches_object.assign(hand_->links.size(), false);
  report.is_finite = state_.p_WOcm.allFinite() && state_.q.allFinite();
  contacts_.clear();
  std::vector<int> link_of_body(static_cast<size_t>(model.matter.getNumBodies()), -1);
  for (size_t i = 0; i < model.links.size(); ++i) {
    link_of_body[model.links[i].getMobilizedBodyIndex()] = static_cast<int>(i);
  }
  const SimTK::MobilizedBodyIndex object = model.object.getMobilizedBodyIndex();
  const SimTK::ContactSnapshot& active = model.tracker.getActiveContacts(state);
  for (int c = 0; c < model.contact.getNumContactForces(state); ++c) {
    const SimTK::ContactForce& force = model.contact.getContactForce(state, c);
    if (!active.hasContact(force.getContactId())) continue;
    const SimTK::Contact& contact = active.getContactById(force.getContactId());
    const auto body1 =
        model.tracker.getMobilizedBody(contact.getSurface1()).getMobilizedBodyIndex();
    const auto body2 =
        model.tracker.getMobilizedBody(contact.getSurface2()).getMobilizedBodyIndex();
    if (body1 != object && body2 != object) continue;
    const double sign = body2 == object ? 1.0 : -1.0;
    const Vector3d f_W = sign * FromSimTK(force.getForceOnSurface2()[1]);
    const int link = link_of_body[body2 == object ? body1 : body2];
    if (link < 0) {
      report.table_force += std::max(0.0, f_W.z());
      continue;
    }
    AddHandContact(link, force, f_W, report);
  }
  TakeSphereDepths(report);
  return report;
}

void CompliantWorld::AddHandContact(int link, const SimTK::ContactForce& force, const Vector3d& f_W,
                                    StepReport& report) {
  const Pose X_WO = CalcObjectPose();
  HandContact touch;
  touch.link = link;
  touch.p_WC = FromSimTK(force.getContactPoint());
  const Vector3d outward_O = object_.field->Query(X_WO.inverse() * touch.p_WC).gradient;
  touch.nhat_W = -(X_WO.linear() * outward_O);
  touch.normal_force = f_W.dot(touch.nhat_W);
  if (touch.normal_force <= 0.0) return;
  touch.friction_W = f_W - touch.normal_force * touch.nhat_W;
  touch.mu = object_.surface.friction_static;
  touch.mu_dynamic = object_.surface.friction_dynamic;
  contacts_.push_back(touch);
  report.grip_force += touch.normal_force;
  report.link_touches_object[link] = true;
}

void CompliantWorld::TakeSphereDepths(StepReport& report) const {
  if (contacts_.empty()) return;
  const std::vector<Pose> X_HL = CalcLinkPoses(*hand_, state_.q);
  const Pose X_OH = CalcObjectPose().inverse() * state_.X_WH;
  for (const ContactSphere& sphere : hand_->contact_spheres) {
    if (!report.link_touches_object[sphere.link]) continue;
    const Vector3d p_OS = X_OH * (X_HL[sphere.link] * sphere.p_LS);
    report.worst_penetration =
        std::max(report.worst_penetration, sphere.radius - object_.field->Query(p_OS).distance -
                                               hand_->links[sphere.link].surface.pad.depth);
  }
}

}  // namespace

bool CanMoveCompliantly(const GraspObject& object) {
  return !object.compressible && FindSphereRadius(object).has_value();
}

bool CanMoveCompliantly(const Hand& hand) {
  return std::all_of(hand.joints.begin(), hand.joints.end(), [](const HandJoint& joint) {
    return joint.drive.hysteresis_width == 0.0 && joint.drive.friction_static == 0.0 &&
           joint.drive.armature == 0.0 && joint.coupling_compliance == 0.0;
  });
}

std::unique_ptr<World> MakeCompliantWorld(const Hand& hand, const GraspObject& object,
                                          const SimConfig& config) {
  return std::make_unique<CompliantWorld>(hand, object, config);
}

}  // namespace graspbench
