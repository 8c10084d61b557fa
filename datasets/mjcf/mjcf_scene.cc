#include "datasets/mjcf/mjcf_scene.h"

#include <tinyxml2.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "core/hand/coupling.h"
#include "core/physics/combine_surfaces.h"
#include "datasets/mjcf/touching_links.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** At 1 ms a light object in a firm grip rattles: a marker with 14 N, held with 6 at 0.25 ms [s]. */
constexpr double kLongestTimestep = 0.00025;
// Contacts: time constant and damping ratio; impedance from .. to .. over a depth [m].
constexpr const char* kContactSolref = "0.005 1";
constexpr const char* kContactSolimp = "0.95 0.99 0.001";
/** The patch of a soft pad is that under this force [N]. */
constexpr double kPatchForce = 1.0;
// Stops, ties and locks. For a finger's inertia some 200 N m/rad, as the stops of graspbench.
constexpr const char* kStopSolimp = "0.998 0.998 0.001";

template <class Numbers>
std::string Format(const Numbers& numbers, int digits = 17) {
  std::ostringstream text;
  text.precision(digits);
  const char* separator = "";
  for (const double number : numbers) {
    text << separator << number;
    separator = " ";
  }
  return text.str();
}

std::string FormatVector(const Vector3d& v) {
  return Format(std::vector<double>{v.x(), v.y(), v.z()});
}

class SceneWriter {
 public:
  SceneWriter(const TrialSetup& setup, const WorldState& start,
              const std::vector<ConvexPart>& parts)
      : setup_(setup), hand_(*setup.hand), object_(*setup.object), start_(start), parts_(parts) {}

  std::string Write() {
    xml_.OpenElement("mujoco");
    Set("model", hand_.id + " " + object_.id + " " + setup_.grasp.id);
    WriteSettings();
    WriteAssets();
    xml_.OpenElement("worldbody");
    WriteTable();
    WriteLink(0);
    WriteObject();
    xml_.CloseElement();
    WriteExcludes();
    WriteCouplings();
    WriteActuators();
    WriteStart();
    WriteCustom();
    xml_.CloseElement();
    return xml_.CStr();
  }

 private:
  void Set(const char* name, const std::string& value) { xml_.PushAttribute(name, value.c_str()); }
  void Set(const char* name, const char* value) { xml_.PushAttribute(name, value); }
  void Set(const char* name, double value) { xml_.PushAttribute(name, value); }
  void SetPose(const Pose& X) {
    const Eigen::Quaterniond q(X.linear());
    Set("pos", FormatVector(X.translation()));
    Set("quat", Format(std::vector<double>{q.w(), q.x(), q.y(), q.z()}));
  }

  std::string BodyName(int link) const { return "hand/" + hand_.links[link].name; }
  const std::string& JointName(int joint) const { return hand_.joints[joint].name; }
  std::string SumName(int middle, int distal) const {
    return JointName(middle) + "+" + JointName(distal);
  }
  /** The distal joint that a middle one drives by the hand's rule; -1: none. */
  int FindDistal(int middle) const {
    for (int j = 0; j < hand_.num_joints(); ++j) {
      if (hand_.joints[j].coupled_to == middle && !hand_.joints[j].is_mimic) return j;
    }
    return -1;
  }
  bool IsMiddleFirst() const { return hand_.coupling == CouplingRule::kMiddleFirst; }

  void WriteSettings();
  void WriteAssets();
  void WriteTable();
  void WriteLink(int link);
  void WriteInertial(double mass, const Vector3d& p_com, const Eigen::Matrix3d& I_com);
  void WriteArmJoints(const Pose& X_WL);
  void WriteCarriedWeight();
  void WriteJoint(const HandLink& link);
  void WriteSurface(int link);
  void WriteObject();
  void WriteExcludes();
  void WriteLock(int joint, bool is_active);
  void WriteCouplings();
  void WriteActuators();
  void WriteStart();
  void WriteCustom();

  const TrialSetup& setup_;
  const Hand& hand_;
  const GraspObject& object_;
  const WorldState& start_;
  const std::vector<ConvexPart>& parts_;
  tinyxml2::XMLPrinter xml_;
  std::vector<double> qpos_, ctrl_;  // of the start, in the order in which they are written
};

void SceneWriter::WriteSettings() {
  xml_.OpenElement("compiler");
  Set("angle", "radian");
  Set("autolimits", "true");
  Set("inertiafromgeom", "false");
  xml_.CloseElement();
  xml_.OpenElement("option");
  Set("timestep", std::min(setup_.sim.step, kLongestTimestep));
  Set("gravity", FormatVector(start_.gravity_W));
  Set("integrator", "implicitfast");
  Set("solver", "Newton");
  Set("cone", "elliptic");
  Set("impratio", 100.0);
  Set("noslip_iterations", "5");
  xml_.OpenElement("flag");
  Set("multiccd", "enable");
  xml_.CloseElement();
  xml_.CloseElement();
  xml_.OpenElement("default");
  xml_.OpenElement("geom");
  Set("mass", 0.0);
  Set("condim", "3");
  Set("solref", kContactSolref);
  Set("solimp", kContactSolimp);
  xml_.CloseElement();
  xml_.OpenElement("joint");
  Set("solreflimit", kContactSolref);
  Set("solimplimit", kStopSolimp);
  xml_.CloseElement();
  xml_.OpenElement("equality");
  Set("solref", kContactSolref);
  Set("solimp", kStopSolimp);
  xml_.CloseElement();
  xml_.OpenElement("tendon");
  Set("solreflimit", kContactSolref);
  Set("solimplimit", kStopSolimp);
  xml_.CloseElement();
  xml_.CloseElement();
}

void SceneWriter::WriteAssets() {
  xml_.OpenElement("asset");
  for (size_t i = 0; i < parts_.size(); ++i) {
    std::vector<double> numbers;
    for (const Vector3d& p : parts_[i].vertices) numbers.insert(numbers.end(), p.begin(), p.end());
    xml_.OpenElement("mesh");
    Set("name", "part" + std::to_string(i));
    Set("inertia", "convex");
    Set("vertex", Format(numbers, 9));
    xml_.CloseElement();
  }
  xml_.CloseElement();
}

void SceneWriter::WriteTable() {
  xml_.OpenElement("geom");
  Set("name", "table");
  Set("type", "plane");
  Set("size", "1 1 0.1");
  Set("priority", "1");
  Set("friction", Format(std::vector<double>{setup_.sim.table_friction_static, 0.0, 0.0}));
  Set("rgba", "0.8 0.8 0.78 1");
  xml_.CloseElement();
}

void SceneWriter::WriteInertial(double mass, const Vector3d& p_com, const Eigen::Matrix3d& I_com) {
  if (mass <= 0.0) return;
  xml_.OpenElement("inertial");
  Set("mass", mass);
  Set("pos", FormatVector(p_com));
  Set("fullinertia", Format(std::vector<double>{I_com(0, 0), I_com(1, 1), I_com(2, 2), I_com(0, 1),
                                                I_com(0, 2), I_com(1, 2)}));
  xml_.CloseElement();
}

void SceneWriter::WriteLink(int link) {
  const HandLink& data = hand_.links[link];
  const Pose X_PJ = link == 0 ? start_.X_WH * data.X_PJ : data.X_PJ;
  xml_.OpenElement("body");
  Set("name", BodyName(link));
  SetPose(X_PJ);
  WriteInertial(data.mass, data.p_LLcm, data.I_LLcm);
  if (link == 0) WriteArmJoints(X_PJ);
  if (data.joint >= 0) WriteJoint(data);
  WriteSurface(link);
  if (link == 0) WriteCarriedWeight();
  for (int child = 0; child < static_cast<int>(hand_.links.size()); ++child) {
    if (hand_.links[child].parent == link) WriteLink(child);
  }
  xml_.CloseElement();
}

/** The arm's spring about H's origin is the ball joint's; along the axes, the slides' drives. */
void SceneWriter::WriteArmJoints(const Pose& X_WL) {
  for (int axis = 0; axis < 3; ++axis) {
    xml_.OpenElement("joint");
    Set("name", std::string("arm/") + "xyz"[axis]);
    Set("type", "slide");
    Set("axis", FormatVector(X_WL.linear().transpose() * Vector3d::Unit(axis)));
    Set("actuatorfrcrange",
        Format(std::vector<double>{-setup_.sim.arm_force_limit, setup_.sim.arm_force_limit}));
    xml_.CloseElement();
    qpos_.push_back(0.0);
  }
  xml_.OpenElement("joint");
  Set("name", "arm/turn");
  Set("type", "ball");
  Set("pos", FormatVector(hand_.links[0].X_PJ.inverse().translation()));
  Set("stiffness", setup_.sim.arm_angular_stiffness);
  Set("damping", setup_.sim.arm_angular_stiffness * setup_.sim.arm_damping_time);
  xml_.CloseElement();
  qpos_.insert(qpos_.end(), {1.0, 0.0, 0.0, 0.0});
}

/** A speck at the hand's centre of mass at the start, on which gravity works upwards by the hand's
weight: the arm carries the hand without load, and the fingers feel gravity. */
void SceneWriter::WriteCarriedWeight() {
  constexpr double kSpeck = 1e-6;  // [kg]
  const std::vector<Pose> X_HL = CalcLinkPoses(hand_, start_.q);
  double mass = 0.0;
  Vector3d moment = Vector3d::Zero();
  for (size_t link = 0; link < hand_.links.size(); ++link) {
    mass += hand_.links[link].mass;
    moment += hand_.links[link].mass * (X_HL[link] * hand_.links[link].p_LLcm);
  }
  xml_.OpenElement("body");
  Set("name", "carried");
  Set("gravcomp", (mass + kSpeck) / kSpeck);
  WriteInertial(kSpeck, hand_.links[0].X_PJ.inverse() * (moment / mass),
                1e-12 * Eigen::Matrix3d::Identity());
  xml_.CloseElement();
}

void SceneWriter::WriteJoint(const HandLink& link) {
  const HandJoint& joint = hand_.joints[link.joint];
  const bool is_tied = joint.is_mimic || (joint.coupled_to >= 0 && !IsMiddleFirst());
  xml_.OpenElement("joint");
  Set("name", joint.name);
  if (joint.is_prismatic) Set("type", "slide");
  Set("axis", FormatVector(link.axis));
  Set("range", Format(std::vector<double>{joint.lower, joint.upper}));
  if (is_tied) Set("limited", "false");  // the range of the joint it follows holds
  xml_.CloseElement();
  qpos_.push_back(start_.q[link.joint]);
}

void SceneWriter::WriteSurface(int link) {
  const int digit = hand_.FindDigitOfLink(link);
  const ContactMaterial material =
      CombineSurfaces(hand_.links[link].surface, object_.surface, setup_.sim);
  const bool is_pad = material.torsion_radius > 0.0;
  const double mu = material.friction_static;
  const auto set_friction = [&](double radius) {
    double torsion = material.torsion_radius;
    if (material.pad.is_soft()) {
      torsion = std::min(torsion, material.pad.torsion_scale * kHertzTorsionShare *
                                      CalcPatchRadius(material.pad.modulus, radius, kPatchForce));
    }
    Set("condim", is_pad ? "4" : "3");
    Set("friction", Format(std::vector<double>{mu, mu * torsion, 0.0}));
  };
  const std::string name =
      (digit >= 0 ? hand_.digits[digit].id : "palm") + "/" + hand_.links[link].name + "/";
  int number = 0;
  for (const LinkCapsule& capsule : hand_.capsules) {
    if (capsule.link != link) continue;
    const bool is_ball = (capsule.p_LA - capsule.p_LB).norm() < 1e-9;
    xml_.OpenElement("geom");
    Set("name", name + std::to_string(number++));
    Set("type", is_ball ? "sphere" : "capsule");
    Set("size", capsule.radius);
    Set(is_ball ? "pos" : "fromto",
        FormatVector(capsule.p_LA) + (is_ball ? "" : " " + FormatVector(capsule.p_LB)));
    set_friction(capsule.radius);
    Set("rgba", is_pad ? "0.75 0.6 0.5 1" : "0.6 0.6 0.6 1");
    xml_.CloseElement();
  }
  for (const ContactSphere& sphere : hand_.contact_spheres) {
    if (sphere.link != link) continue;
    xml_.OpenElement("geom");
    Set("name", name + "ball" + std::to_string(number++));
    Set("type", "sphere");
    Set("size", sphere.radius);
    Set("pos", FormatVector(sphere.p_LS));
    set_friction(sphere.radius);
    Set("group", "3");
    Set("contype", "0");
    Set("conaffinity", "0");
    xml_.CloseElement();
  }
}

void SceneWriter::WriteObject() {
  const MassProperties& mass = object_.mass_properties;
  const Pose X_WO = MakePose(start_.R_WO, start_.p_WOcm - start_.R_WO * mass.p_OOcm);
  xml_.OpenElement("body");
  Set("name", "object");
  SetPose(X_WO);
  xml_.OpenElement("freejoint");
  Set("name", "object");
  xml_.CloseElement();
  WriteInertial(mass.mass, mass.p_OOcm, mass.I_OOcm);
  const Eigen::Vector3d colour = object_.colour.cast<double>();
  for (size_t i = 0; i < parts_.size(); ++i) {
    xml_.OpenElement("geom");
    Set("name", "object/" + std::to_string(i));
    Set("type", "mesh");
    Set("mesh", "part" + std::to_string(i));
    Set("friction", Format(std::vector<double>{object_.surface.friction_static, 0.0, 0.0}));
    Set("rgba", FormatVector(colour) + " 1");
    xml_.CloseElement();
  }
  xml_.CloseElement();
  const Eigen::Quaterniond q(X_WO.linear());
  const Vector3d p = X_WO.translation();
  qpos_.insert(qpos_.end(), {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()});
}

/** A finger does not meet itself, and what touches in the rest posture is built so. */
void SceneWriter::WriteExcludes() {
  std::set<std::pair<int, int>> apart = FindLinksTouchingAtRest(hand_);
  const int num_links = static_cast<int>(hand_.links.size());
  for (int a = 0; a < num_links; ++a) {
    for (int b = a + 1; b < num_links; ++b) {
      if (hand_.FindDigitOfLink(a) == hand_.FindDigitOfLink(b)) apart.insert({a, b});
    }
  }
  xml_.OpenElement("contact");
  for (const auto& [a, b] : apart) {
    xml_.OpenElement("exclude");
    Set("body1", BodyName(a));
    Set("body2", BodyName(b));
    xml_.CloseElement();
  }
  xml_.CloseElement();
}

void SceneWriter::WriteLock(int joint, bool is_active) {
  xml_.OpenElement("joint");
  Set("name", "lock/" + JointName(joint));
  Set("joint1", JointName(joint));
  Set("polycoef", Format(std::vector<double>{start_.q[joint], 0.0, 0.0, 0.0, 0.0}));
  Set("active", is_active ? "true" : "false");
  xml_.CloseElement();
}

void SceneWriter::WriteCouplings() {
  xml_.OpenElement("equality");
  for (int distal = 0; distal < hand_.num_joints(); ++distal) {
    const int middle = hand_.joints[distal].coupled_to;
    if (middle < 0) continue;
    const HandJoint& follower = hand_.joints[distal];
    if (!follower.is_mimic && IsMiddleFirst()) {
      WriteLock(middle, false);
      WriteLock(distal, true);
      continue;
    }
    const double ratio =
        follower.is_mimic
            ? follower.mimic_ratio
            : CalcDistalRates(hand_.coupling, hand_.fixed_coupling_ratio, DistalMode::kMiddleMoves)
                  .distal;
    xml_.OpenElement("joint");
    Set("name", "couple/" + JointName(distal));
    Set("joint1", JointName(distal));
    Set("joint2", JointName(middle));
    Set("polycoef", Format(std::vector<double>{follower.mimic_offset, ratio, 0.0, 0.0, 0.0}));
    xml_.CloseElement();
  }
  xml_.CloseElement();
  if (!IsMiddleFirst()) return;
  xml_.OpenElement("tendon");
  for (int distal = 0; distal < hand_.num_joints(); ++distal) {
    const int middle = hand_.joints[distal].coupled_to;
    if (middle < 0 || hand_.joints[distal].is_mimic) continue;
    for (const double sign : {1.0, -1.0}) {
      xml_.OpenElement("fixed");
      Set("name",
          sign > 0.0 ? SumName(middle, distal) : JointName(middle) + "-" + JointName(distal));
      if (sign < 0.0) Set("range", "0 10");
      for (const auto& [joint, coef] : {std::pair(middle, 1.0), std::pair(distal, sign)}) {
        xml_.OpenElement("joint");
        Set("joint", JointName(joint));
        Set("coef", coef);
        xml_.CloseElement();
      }
      xml_.CloseElement();
    }
  }
  xml_.CloseElement();
}

void SceneWriter::WriteActuators() {
  xml_.OpenElement("actuator");
  for (const char axis : {'x', 'y', 'z'}) {
    const std::string joint = std::string("arm/") + axis;
    xml_.OpenElement("position");
    Set("name", joint);
    Set("joint", joint);
    Set("kp", setup_.sim.arm_stiffness);
    xml_.CloseElement();
    xml_.OpenElement("velocity");
    Set("name", joint + "/speed");
    Set("joint", joint);
    Set("kv", setup_.sim.arm_stiffness * setup_.sim.arm_damping_time);
    xml_.CloseElement();
    ctrl_.insert(ctrl_.end(), {0.0, 0.0});
  }
  for (int j = 0; j < hand_.num_joints(); ++j) {
    const HandJoint& joint = hand_.joints[j];
    if (joint.coupled_to >= 0) continue;
    const int distal = FindDistal(j);
    const bool pulls_on_sum = distal >= 0 && IsMiddleFirst();
    xml_.OpenElement("position");
    Set("name", joint.name);
    Set(pulls_on_sum ? "tendon" : "joint", pulls_on_sum ? SumName(j, distal) : joint.name);
    Set("kp", joint.drive.stiffness);
    Set("kv", joint.drive.damping);
    Set("forcerange",
        Format(std::vector<double>{-joint.drive.torque_limit, joint.drive.torque_limit}));
    xml_.CloseElement();
    ctrl_.push_back(start_.q[j]);
  }
  xml_.CloseElement();
}

void SceneWriter::WriteStart() {
  xml_.OpenElement("keyframe");
  xml_.OpenElement("key");
  Set("name", "start");
  Set("qpos", Format(qpos_));
  Set("ctrl", Format(ctrl_));
  xml_.CloseElement();
  xml_.CloseElement();
}

void SceneWriter::WriteCustom() {
  const auto write_number = [&](const char* name, double value) {
    xml_.OpenElement("numeric");
    Set("name", name);
    Set("data", Format(std::vector<double>{value}));
    xml_.CloseElement();
  };
  const auto write_text = [&](const char* name, const std::string& value) {
    xml_.OpenElement("text");
    Set("name", name);
    Set("data", value);
    xml_.CloseElement();
  };
  double excess = 0.0;
  for (const ConvexPart& part : parts_) excess = std::max(excess, part.excess);
  xml_.OpenElement("custom");
  write_number("physics_version", kPhysicsVersion);
  write_number("friction_dynamic", object_.surface.friction_dynamic);
  write_number("table_friction_dynamic", setup_.sim.table_friction_dynamic);
  write_number("object_parts_excess_m", excess);
  write_number("arm_force_limit_n", setup_.sim.arm_force_limit);
  write_number("arm_moment_limit_nm", setup_.sim.arm_moment_limit);
  write_number("lift_distance_m", setup_.grasp.approach_distance);
  write_text("coupling", NameOf(hand_.coupling));
  std::string digits;
  for (const std::string& id : setup_.grasp.digits) digits += (digits.empty() ? "" : " ") + id;
  write_text("grasping_digits", digits);
  write_text("palm", BodyName(hand_.palm_link));
  xml_.CloseElement();
}

}  // namespace

std::string FormatMjcf(const TrialSetup& setup, const WorldState& start,
                       const std::vector<ConvexPart>& parts) {
  return SceneWriter(setup, start, parts).Write();
}

}  // namespace graspbench
