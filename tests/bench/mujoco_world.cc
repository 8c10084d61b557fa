#include "tests/bench/mujoco_world.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <set>
#include <sstream>
#include <utility>

#include "core/base/error.h"
#include "core/physics/contact.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kRootArmature = 1e6;  ///< [kg]

// Who collides with whom, in MuJoCo's bits.
constexpr const char* kSphereBits = "contype='1' conaffinity='0'";
constexpr const char* kObjectBits = "contype='2' conaffinity='1'";
constexpr const char* kTableBits = "contype='0' conaffinity='3'";
constexpr const char* kCapsuleBits = "contype='4' conaffinity='4' condim='1'";
constexpr const char* kOnlyCapsuleBits = "contype='5' conaffinity='4'";  // both in one

std::string Format(const Vector3d& v) {
  std::ostringstream text;
  text << std::setprecision(17) << v.x() << ' ' << v.y() << ' ' << v.z();
  return text.str();
}

std::string FormatPose(const Pose& X) {
  const Eigen::Quaterniond q(X.linear());
  std::ostringstream text;
  text << std::setprecision(17) << "pos='" << Format(X.translation()) << "' quat='" << q.w() << ' '
       << q.x() << ' ' << q.y() << ' ' << q.z() << "'";
  return text.str();
}

std::string FormatInertial(double mass, const Vector3d& p_com, const Eigen::Matrix3d& I) {
  std::ostringstream text;
  text << std::setprecision(17) << "<inertial mass='" << mass << "' pos='" << Format(p_com)
       << "' fullinertia='" << I(0, 0) << ' ' << I(1, 1) << ' ' << I(2, 2) << ' ' << I(0, 1) << ' '
       << I(0, 2) << ' ' << I(1, 2) << "'/>\n";
  return text.str();
}

std::string LinkName(int link) { return "link" + std::to_string(link); }
std::string JointName(int joint) { return "joint" + std::to_string(joint); }

using LinkPairs = std::set<std::pair<int, int>>;

/** Writes the scene in MuJoCo's own format. */
class SceneWriter {
 public:
  SceneWriter(const Hand& hand, const GraspObject& object, PrimitiveShape shape,
              const SimConfig& sim, const MujocoConfig& config)
      : hand_(hand), object_(object), shape_(shape), sim_(sim), config_(config) {
    text_ << std::setprecision(17);
  }

  std::string Write(const Pose& X_WRoot, const std::vector<Vector3d>& slides_W,
                    const LinkPairs& apart) {
    const double mu = object_.surface.friction_static;
    double torsion_radius = 0.0;  // of the pads; all have the largest
    for (const HandLink& link : hand_.links) {
      torsion_radius = std::fmax(torsion_radius, CalcTorsionRadius(link));
    }
    text_ << "<mujoco>\n<compiler angle='radian'/>\n<size njmax='800' nconmax='200'/>\n"
          << "<option timestep='" << config_.step << "' gravity='0 0 " << -sim_.gravity
          << "' cone='elliptic' impratio='" << config_.impratio
          << "' solver='Newton' noslip_iterations='" << config_.noslip_iterations
          << "' noslip_tolerance='" << config_.noslip_tolerance << "'/>\n"
          << "<default>\n<geom solref='" << config_.time_constant << " 1' solimp='"
          << config_.impedance_min << ' ' << config_.impedance_max << " 0.001' friction='" << mu
          << ' ' << mu * torsion_radius << " 0'/>\n<equality solref='" << config_.time_constant
          << " 1'/>\n<joint solreflimit='" << config_.time_constant
          << " 1'/>\n</default>\n<worldbody>\n<geom name='table' type='plane' size='1 1 1' "
          << "priority='1' friction='" << sim_.table_friction_static << " 0 0' " << kTableBits
          << "/>\n";
    WriteLink(0, X_WRoot, slides_W);
    WriteObject();
    text_ << "</worldbody>\n";
    WriteDrives();
    text_ << "<contact>\n";
    for (const auto& [a, b] : apart) {
      text_ << "<exclude body1='" << LinkName(a) << "' body2='" << LinkName(b) << "'/>\n";
    }
    text_ << "</contact>\n</mujoco>\n";
    return text_.str();
  }

 private:
  /** A soft pad twists as its patch does under 1 N on a fingertip; NaN: the link has neither. */
  static double CalcTorsionRadius(const HandLink& link) {
    constexpr double kFingertip = 0.007;
    const PadMaterial pad = CombineSurfaces(link.surface, {}, SimConfig()).pad;
    return pad.is_soft() ? kHertzTorsionShare * CalcPatchRadius(pad.modulus, kFingertip, 1.0)
                         : link.surface.torsion_radius;
  }

  void WriteLink(int link, const Pose& X_PL, const std::vector<Vector3d>& slides_W) {
    const HandLink& data = hand_.links[link];
    text_ << "<body name='" << LinkName(link) << "' " << FormatPose(X_PL) << ">\n";
    if (data.mass > 0.0) text_ << FormatInertial(data.mass, data.p_LLcm, data.I_LLcm);
    for (const Vector3d& slide_W : slides_W) {
      text_ << "<joint type='slide' axis='" << Format(X_PL.linear().transpose() * slide_W)
            << "' armature='" << kRootArmature << "'/>\n";
    }
    if (data.joint >= 0) WriteJoint(data);
    WriteSurface(link);
    for (int child = 0; child < static_cast<int>(hand_.links.size()); ++child) {
      if (hand_.links[child].parent == link) WriteLink(child, hand_.links[child].X_PJ, {});
    }
    text_ << "</body>\n";
  }

  void WriteSurface(int link) {
    const int dimension = CalcTorsionRadius(hand_.links[link]) > 0.0 ? 4 : 3;
    for (const ContactSphere& sphere : hand_.contact_spheres) {
      if (sphere.link != link || config_.has_capsules_only) continue;
      text_ << "<geom type='sphere' size='" << sphere.radius << "' pos='" << Format(sphere.p_LS)
            << "' condim='" << dimension << "' " << kSphereBits << "/>\n";
    }
    for (const LinkCapsule& capsule : hand_.capsules) {
      if (capsule.link != link) continue;
      const bool is_ball = (capsule.p_LA - capsule.p_LB).norm() < 1e-9;
      text_ << "<geom type='" << (is_ball ? "sphere" : "capsule") << "' size='" << capsule.radius
            << "' ";
      if (is_ball) {
        text_ << "pos='" << Format(capsule.p_LA) << "' ";
      } else {
        text_ << "fromto='" << Format(capsule.p_LA) << ' ' << Format(capsule.p_LB) << "' ";
      }
      if (config_.has_capsules_only) {
        text_ << "condim='" << dimension << "' " << kOnlyCapsuleBits << "/>\n";
      } else {
        text_ << kCapsuleBits << "/>\n";
      }
    }
  }

  void WriteJoint(const HandLink& link) {
    const HandJoint& joint = hand_.joints[link.joint];
    const bool is_coupled = joint.coupled_to >= 0;
    const bool is_tied = is_coupled && hand_.coupling != CouplingRule::kMiddleFirst;
    const JointDrive& drive = is_coupled ? hand_.joints[joint.coupled_to].drive : joint.drive;
    text_ << "<joint name='" << JointName(link.joint) << "' type='hinge' axis='"
          << Format(link.axis) << "' damping='" << (is_tied ? 0.0 : drive.damping) << "'";
    if (!is_tied) text_ << " limited='true' range='" << joint.lower << ' ' << joint.upper << "'";
    text_ << "/>\n";
  }

  void WriteObject() {
    const Vector3d half = 0.5 * object_.size;
    text_ << "<body name='object'>\n<freejoint/>\n"
          << FormatInertial(object_.mass_properties.mass, Vector3d::Zero(),
                            object_.mass_properties.I_OOcm)
          << "<geom name='object' pos='" << Format(-object_.mass_properties.p_OOcm)
          << "' condim='3' " << kObjectBits;
    switch (shape_) {
      case PrimitiveShape::kSphere:
        text_ << " type='sphere' size='" << half.x() << "'";
        break;
      case PrimitiveShape::kCylinder:
        text_ << " type='cylinder' size='" << half.x() << ' ' << half.z() << "'";
        break;
      case PrimitiveShape::kBox:
        text_ << " type='box' size='" << Format(half) << "'";
        break;
    }
    text_ << "/>\n</body>\n";
  }

  /** Drives and what they move: a joint, or under middle-first the sum of two joints, one of which
  is locked. */
  void WriteDrives() {
    std::ostringstream equalities, tendons, actuators;
    for (auto* part : {&equalities, &tendons, &actuators}) *part << std::setprecision(17);
    std::vector<int> distal(hand_.joints.size(), -1);
    for (int j = 0; j < hand_.num_joints(); ++j) {
      if (hand_.joints[j].coupled_to >= 0) distal[hand_.joints[j].coupled_to] = j;
    }
    for (int j = 0; j < hand_.num_joints(); ++j) {
      const HandJoint& joint = hand_.joints[j];
      if (joint.coupled_to >= 0) continue;
      std::string transmission = "joint='" + JointName(j) + "'";
      if (distal[j] >= 0 && hand_.coupling == CouplingRule::kMiddleFirst) {
        const std::string sum = "sum" + std::to_string(j);
        for (const int k : {j, distal[j]}) {
          equalities << "<joint name='lock" << k << "' joint1='" << JointName(k) << "'/>\n";
        }
        tendons << "<fixed name='" << sum << "'><joint joint='" << JointName(j)
                << "' coef='1'/><joint joint='" << JointName(distal[j]) << "' coef='1'/></fixed>\n";
        transmission = "tendon='" + sum + "'";
      } else if (distal[j] >= 0) {
        const double ratio =
            hand_.coupling == CouplingRule::kFixed ? hand_.fixed_coupling_ratio : 1.0;
        equalities << "<joint joint1='" << JointName(distal[j]) << "' joint2='" << JointName(j)
                   << "' polycoef='0 " << ratio << " 0 0 0'/>\n";
      }
      actuators << "<position " << transmission << " kp='" << joint.drive.stiffness
                << "' forcelimited='true' forcerange='" << -joint.drive.torque_limit << ' '
                << joint.drive.torque_limit << "'/>\n";
    }
    text_ << "<equality>\n"
          << equalities.str() << "</equality>\n<tendon>\n"
          << tendons.str() << "</tendon>\n<actuator>\n"
          << actuators.str() << "</actuator>\n";
  }

  const Hand& hand_;
  const GraspObject& object_;
  PrimitiveShape shape_;
  const SimConfig& sim_;
  const MujocoConfig& config_;
  std::ostringstream text_;
};

struct FreeMujoco {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPtr = std::unique_ptr<mjModel, FreeMujoco>;
using DataPtr = std::unique_ptr<mjData, FreeMujoco>;

ModelPtr Compile(const std::string& text) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  const int index =
      mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(text.size()) + 1);
  std::memcpy(files->filedata[index], text.c_str(), text.size() + 1);
  char message[1000] = "";
  ModelPtr model(mj_loadXML("scene.xml", files.get(), message, sizeof message));
  mj_deleteVFS(files.get());
  if (!model) throw Error(ErrorKind::kUnsupported, std::string("MuJoCo: ") + message);
  return model;
}

[[noreturn]] void Refuse(const std::string& what) {
  throw Error(ErrorKind::kUnsupported, "the MuJoCo world cannot " + what);
}

}  // namespace

struct MujocoWorld::Impl {
  const GraspObject* object;
  PrimitiveShape shape;
  SimConfig sim;
  MujocoConfig config;
  std::vector<Vector3d> slides_W;

  ModelPtr model;
  DataPtr data;
  Pose X_WH_built = Pose::Identity();
  Vector3d p_WH_at_start = Vector3d::Zero();
  std::vector<int> link_of_geom;   // -1: none
  std::vector<int> qpos_of_joint;  // by joint of the hand
  std::vector<int> dof_of_joint;
  std::vector<int> lock_of_joint;  // equality that holds it; -1: none
  int object_geom = -1, table_geom = -1, object_qpos = -1, object_dof = -1;

  std::vector<HandContact> touches;  // of the last step

  void Build(const Hand& hand, const Pose& X_WH);
  void FindAddresses(const Hand& hand);
  void LockJoints(const Hand& hand, const HandDynamics& dynamics);
  void SetRoot(const Vector3d& p_WH, const Vector3d& v_WH, const Vector3d& a_WH);
  void TakeState(const Hand& hand, const HandDynamics& dynamics, WorldState& state) const;
  StepReport TakeContacts(size_t num_links);
};

MujocoWorld::MujocoWorld(const Hand& hand, const GraspObject& object, PrimitiveShape shape,
                         const SimConfig& sim, const MujocoConfig& config,
                         const Vector3d& approach_W)
    : World(hand, object, sim, TablePresence::kPresent), impl_(std::make_unique<Impl>()) {
  impl_->object = &object;
  impl_->shape = shape;
  impl_->sim = sim;
  impl_->config = config;
  impl_->slides_W = {Vector3d::UnitZ()};
  if (std::abs(approach_W.z()) < 0.999) impl_->slides_W.push_back(approach_W);
}

MujocoWorld::~MujocoWorld() = default;

void MujocoWorld::Impl::Build(const Hand& hand, const Pose& X_WH) {
  const auto compile = [&](const LinkPairs& apart) {
    model = Compile(SceneWriter(hand, *object, shape, sim, config)
                        .Write(X_WH * hand.links[0].X_PJ, slides_W, apart));
    data.reset(mj_makeData(model.get()));
    FindAddresses(hand);
    mj_forward(model.get(), data.get());
  };
  X_WH_built = X_WH;
  // As in our own collider: a finger does not meet itself, and what touches at rest is built so.
  LinkPairs apart;
  const int num_links = static_cast<int>(hand.links.size());
  for (int a = 0; a < num_links; ++a) {
    for (int b = a + 1; b < num_links; ++b) {
      if (hand.FindDigitOfLink(a) == hand.FindDigitOfLink(b)) apart.insert({a, b});
    }
  }
  compile(apart);
  for (int c = 0; c < data->ncon; ++c) {
    const int a = link_of_geom[data->contact[c].geom1], b = link_of_geom[data->contact[c].geom2];
    if (a >= 0 && b >= 0) apart.insert({std::min(a, b), std::max(a, b)});
  }
  compile(apart);
  // The solver's tolerance is relative to the mean inertia, which must not be that of the root.
  const int nv = model->nv, num_slides = static_cast<int>(slides_W.size());
  std::vector<double> M(static_cast<size_t>(nv * nv));
  mj_fullM(model.get(), M.data(), data->qM);
  double sum = 0.0;
  for (int i = num_slides; i < nv; ++i) sum += M[i * nv + i];
  model->stat.meaninertia = sum / (nv - num_slides);
}

void MujocoWorld::Impl::FindAddresses(const Hand& hand) {
  const mjModel& m = *model;
  const auto find = [&](int type, const std::string& name) {
    return mj_name2id(&m, type, name.c_str());
  };
  std::vector<int> link_of_body(static_cast<size_t>(m.nbody), -1);
  for (int link = 0; link < static_cast<int>(hand.links.size()); ++link) {
    link_of_body[find(mjOBJ_BODY, LinkName(link))] = link;
  }
  link_of_geom.assign(static_cast<size_t>(m.ngeom), -1);
  for (int geom = 0; geom < m.ngeom; ++geom) {
    link_of_geom[geom] = link_of_body[m.geom_bodyid[geom]];
  }
  qpos_of_joint.clear();
  dof_of_joint.clear();
  lock_of_joint.clear();
  for (int j = 0; j < hand.num_joints(); ++j) {
    const int id = find(mjOBJ_JOINT, JointName(j));
    qpos_of_joint.push_back(m.jnt_qposadr[id]);
    dof_of_joint.push_back(m.jnt_dofadr[id]);
    lock_of_joint.push_back(find(mjOBJ_EQUALITY, "lock" + std::to_string(j)));
  }
  object_geom = find(mjOBJ_GEOM, "object");
  table_geom = find(mjOBJ_GEOM, "table");
  const int body = find(mjOBJ_BODY, "object");
  object_qpos = m.jnt_qposadr[m.body_jntadr[body]];
  object_dof = m.body_dofadr[body];
}

void MujocoWorld::Reset(const WorldState& state) {
  ResetScene(state);
  Impl& impl = *impl_;
  if (!impl.model || !impl.X_WH_built.isApprox(state.X_WH, 0.0)) impl.Build(*hand_, state.X_WH);
  mj_resetData(impl.model.get(), impl.data.get());
  for (const int lock : impl.lock_of_joint) {
    if (lock >= 0) impl.model->eq_active[lock] = 0;
  }
  impl.p_WH_at_start = state.X_WH.translation();
  double* qpos = impl.data->qpos;
  for (int j = 0; j < hand_->num_joints(); ++j) qpos[impl.qpos_of_joint[j]] = state.q[j];
  const Eigen::Quaterniond q(state.R_WO);
  const double pose[7] = {
      state.p_WOcm.x(), state.p_WOcm.y(), state.p_WOcm.z(), q.w(), q.x(), q.y(), q.z()};
  std::copy(pose, pose + 7, qpos + impl.object_qpos);
  impl.LockJoints(*hand_, dynamics_);
}

/** Of a pair under middle-first one joint moves and the other is held where it is. */
void MujocoWorld::Impl::LockJoints(const Hand& hand, const HandDynamics& dynamics) {
  if (hand.coupling != CouplingRule::kMiddleFirst) return;
  for (int j = 0; j < hand.num_joints(); ++j) {
    const int lock = lock_of_joint[j];
    if (lock < 0) continue;
    const bool is_locked = dynamics.rate_of_joint(j) == 0.0;
    if (is_locked && !model->eq_active[lock]) {
      model->eq_data[mjNEQDATA * lock] = data->qpos[qpos_of_joint[j]];
    }
    model->eq_active[lock] = is_locked;
  }
}

void MujocoWorld::Impl::SetRoot(const Vector3d& p_WH, const Vector3d& v_WH, const Vector3d& a_WH) {
  for (size_t i = 0; i < slides_W.size(); ++i) {
    data->qpos[i] = slides_W[i].dot(p_WH - p_WH_at_start);
    data->qvel[i] = slides_W[i].dot(v_WH);
    data->qfrc_applied[i] = kRootArmature * slides_W[i].dot(a_WH);
  }
}

void MujocoWorld::Impl::TakeState(const Hand& hand, const HandDynamics& dynamics,
                                  WorldState& state) const {
  for (int j = 0; j < hand.num_joints(); ++j) state.q[j] = data->qpos[qpos_of_joint[j]];
  for (int dof = 0; dof < dynamics.num_dofs(); ++dof) {
    state.u[dof] = data->qvel[dof_of_joint[dynamics.joint_of_dof(dof)]];
  }
  const double* pose = data->qpos + object_qpos;
  const double* speed = data->qvel + object_dof;
  state.p_WOcm = Vector3d(pose[0], pose[1], pose[2]);
  state.R_WO = Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6]).toRotationMatrix();
  state.v_WOcm = Vector3d(speed[0], speed[1], speed[2]);
  state.w_WO = state.R_WO * Vector3d(speed[3], speed[4], speed[5]);
}

StepReport MujocoWorld::Impl::TakeContacts(size_t num_links) {
  StepReport report;
  report.link_touches_object.assign(num_links, false);
  touches.clear();
  for (int c = 0; c < data->ncon; ++c) {
    const mjContact& contact = data->contact[c];
    if (contact.geom1 != object_geom && contact.geom2 != object_geom) continue;
    double force[6];
    mj_contactForce(model.get(), data.get(), c, force);
    if (force[0] <= 0.0) continue;
    const bool object_is_second = contact.geom2 == object_geom;
    const int other = object_is_second ? contact.geom1 : contact.geom2;
    if (other == table_geom) {
      report.table_force += force[0];
      continue;
    }
    // The frame's first row points from the first geom to the second, the force acts on the second.
    const double sign = object_is_second ? 1.0 : -1.0;
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> frame(contact.frame);
    HandContact touch;
    touch.link = link_of_geom[other];
    touch.p_WC = Vector3d(contact.pos[0], contact.pos[1], contact.pos[2]);
    touch.nhat_W = sign * frame.row(0).transpose();
    touch.normal_force = force[0];
    touch.friction_W =
        sign * (force[1] * frame.row(1).transpose() + force[2] * frame.row(2).transpose());
    touch.mu = touch.mu_dynamic = contact.friction[0];
    touch.torsion_radius = contact.dim > 3 ? contact.friction[2] / contact.friction[0] : 0.0;
    touches.push_back(touch);
    report.grip_force += force[0];
    report.link_touches_object[touch.link] = true;
    report.worst_penetration = std::max(report.worst_penetration, -contact.dist);
  }
  report.converged = data->solver_iter < model->opt.iterations &&
                     data->warning[mjWARN_CONTACTFULL].number == 0 &&
                     data->warning[mjWARN_CNSTRFULL].number == 0;
  report.is_finite = data->warning[mjWARN_BADQACC].number == 0 &&
                     data->warning[mjWARN_BADQPOS].number == 0 &&
                     data->warning[mjWARN_BADQVEL].number == 0;
  return report;
}

StepReport MujocoWorld::Step(const WorldCommand& command) {
  Impl& impl = *impl_;
  double stop_work = 0.0;  // no account of energy is kept
  ChooseDistalModes(command, stop_work);
  impl.LockJoints(*hand_, dynamics_);
  impl.SetRoot(state_.X_WH.translation(), state_.v_WH,
               (command.v_WH - state_.v_WH) / impl.config.step);
  int actuator = 0;
  for (int j = 0; j < hand_->num_joints(); ++j) {
    if (hand_->joints[j].coupled_to < 0) impl.data->ctrl[actuator++] = command.q[j];
  }
  mj_step(impl.model.get(), impl.data.get());
  impl.TakeState(*hand_, dynamics_, state_);
  state_.X_WH = command.X_WH;
  state_.v_WH = command.v_WH;
  const StepReport report = impl.TakeContacts(hand_->links.size());
  link_blocks_ = report.link_touches_object;
  return report;
}

void MujocoWorld::UpdateDynamics() { dynamics_.UpdatePositions(state_.X_WH, state_.q); }

void MujocoWorld::FindHandContacts(std::vector<HandContact>& contacts) const {
  contacts = impl_->touches;
}

std::unique_ptr<World> MujocoWorld::Clone() const { Refuse("be cloned"); }

void MujocoWorld::SetGravity(const Vector3d&) { Refuse("turn gravity"); }

void MujocoWorld::SetExternalLoad(const Vector3d&, const Vector3d&) { Refuse("load the object"); }

double MujocoWorld::CalcEnergyResidual() { return kUnset; }

}  // namespace graspbench
