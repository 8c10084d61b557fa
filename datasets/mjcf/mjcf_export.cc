#include "datasets/mjcf/mjcf_export.h"

#include <tinyxml2.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "core/base/files/files.h"
#include "core/base/text/csv.h"
#include "core/hand/hand.h"
#include "core/physics/carrying_arm.h"
#include "core/physics/contact.h"
#include "core/physics/implicit_world.h"
#include "core/trial/protocols/table_lift.h"
#include "datasets/mjcf/arm_urdf.h"

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

/** An attribute's value: 17 digits of numbers, so that they come back as they are. */
struct Value {
  Value(const char* value) : text(value) {}
  Value(std::string value) : text(std::move(value)) {}
  Value(double value) {
    char buffer[64];
    tinyxml2::XMLUtil::ToStr(value, buffer, sizeof buffer);
    text = buffer;
  }
  Value(const std::vector<double>& numbers, int digits = 17) {
    std::ostringstream out;
    out.precision(digits);
    for (size_t i = 0; i < numbers.size(); ++i) out << (i > 0 ? " " : "") << numbers[i];
    text = out.str();
  }
  Value(std::initializer_list<double> numbers) : Value(std::vector<double>(numbers)) {}
  Value(const Vector3d& v) : Value({v.x(), v.y(), v.z()}) {}

  std::string text;
};
using Attributes = std::initializer_list<std::pair<const char*, Value>>;

Value QuaternionOf(const Pose& X) {
  const Eigen::Quaterniond q(X.linear());
  return {q.w(), q.x(), q.y(), q.z()};
}

class SceneWriter {
 public:
  SceneWriter(const TrialSetup& setup, const WorldState& start,
              const std::vector<ConvexPart>& parts)
      : setup_(setup), hand_(*setup.hand), object_(*setup.object), start_(start), parts_(parts) {}

  std::string Write() {
    Open("mujoco", {{"model", hand_.id + " " + object_.id + " " + setup_.grasp.id}});
    WriteSettings();
    WriteAssets();
    Open("worldbody");
    Add("geom", {{"name", "table"},
                 {"type", "plane"},
                 {"size", "1 1 0.1"},
                 {"priority", "1"},
                 {"friction", {setup_.sim.table_friction_static, 0.0, 0.0}},
                 {"rgba", "0.8 0.8 0.78 1"}});
    if (start_.arm) WriteArmLink(0);
    if (!start_.arm) WriteLink(0);
    WriteObject();
    Close();
    WriteExcludes();
    WriteCouplings();
    WriteActuators();
    Open("keyframe");
    Add("key", {{"name", "start"}, {"qpos", qpos_}, {"ctrl", ctrl_}});
    Close();
    WriteCustom();
    Close();
    return xml_.CStr();
  }

 private:
  void Set(const char* name, const Value& value) { xml_.PushAttribute(name, value.text.c_str()); }
  void Open(const char* element, Attributes attributes = {}) {
    xml_.OpenElement(element);
    for (const auto& [name, value] : attributes) Set(name, value);
  }
  void Close() { xml_.CloseElement(); }
  void Add(const char* element, Attributes attributes) {
    Open(element, attributes);
    Close();
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
  void WriteArmLink(int link);
  void WriteArmActuators();
  void WriteLink(int link);
  void WriteInertial(double mass, const Vector3d& p_com, const Eigen::Matrix3d& I_com);
  void WriteArmJoints(const Pose& X_WL);
  void WriteCarriedWeight();
  void WriteJoint(const HandLink& link);
  void WriteSurface(int link);
  void WriteTaxels(int link);
  void WriteObject();
  void WriteExcludes();
  void WriteLock(int joint, bool is_active);
  void WriteCouplings();
  void WriteActuators();
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
  Add("compiler", {{"angle", "radian"}, {"autolimits", "true"}, {"inertiafromgeom", "false"}});
  Open("option", {{"timestep", std::min(setup_.sim.step, kLongestTimestep)},
                  {"gravity", start_.gravity_W},
                  {"integrator", "implicitfast"},
                  {"solver", "Newton"},
                  {"cone", "elliptic"},
                  {"impratio", 100.0},
                  {"noslip_iterations", "5"}});
  Add("flag", {{"multiccd", "enable"}});
  Close();
  Open("default");
  Add("geom",
      {{"mass", 0.0}, {"condim", "3"}, {"solref", kContactSolref}, {"solimp", kContactSolimp}});
  Add("joint", {{"solreflimit", kContactSolref}, {"solimplimit", kStopSolimp}});
  Add("equality", {{"solref", kContactSolref}, {"solimp", kStopSolimp}});
  Add("tendon", {{"solreflimit", kContactSolref}, {"solimplimit", kStopSolimp}});
  Close();
}

void SceneWriter::WriteAssets() {
  Open("asset");
  for (size_t i = 0; i < parts_.size(); ++i) {
    std::vector<double> numbers;
    for (const Vector3d& p : parts_[i].vertices) numbers.insert(numbers.end(), p.begin(), p.end());
    Add("mesh", {{"name", "part" + std::to_string(i)},
                 {"inertia", "convex"},
                 {"vertex", Value(numbers, 9)}});
  }
  Close();
}

void SceneWriter::WriteInertial(double mass, const Vector3d& p_com, const Eigen::Matrix3d& I_com) {
  if (mass <= 0.0) return;
  Add("inertial",
      {{"mass", mass},
       {"pos", p_com},
       {"fullinertia",
        {I_com(0, 0), I_com(1, 1), I_com(2, 2), I_com(0, 1), I_com(0, 2), I_com(1, 2)}}});
}

void SceneWriter::WriteLink(int link) {
  const HandLink& data = hand_.links[link];
  const Pose& X_PH = start_.arm ? start_.arm->X_FH : start_.X_WH;  // in the arm's flange, or world
  const Pose X_PJ = link == 0 ? X_PH * data.X_PJ : data.X_PJ;
  Open("body", {{"name", BodyName(link)},
                {"pos", Vector3d(X_PJ.translation())},
                {"quat", QuaternionOf(X_PJ)}});
  WriteInertial(data.mass, data.p_LLcm, data.I_LLcm);
  if (link == 0 && !start_.arm) WriteArmJoints(X_PJ);
  if (data.joint >= 0) WriteJoint(data);
  WriteSurface(link);
  WriteTaxels(link);
  if (link == 0) WriteCarriedWeight();
  for (int child = 0; child < static_cast<int>(hand_.links.size()); ++child) {
    if (hand_.links[child].parent == link) WriteLink(child);
  }
  Close();
}

/** The link's body lies on its joint's axis, turned and shifted as at zero; the next one, and the
hand behind the last, hang in its frame. */
void SceneWriter::WriteArmLink(int link) {
  const Arm& arm = *start_.arm->arm;
  const Pose X_PL = link == 0 ? start_.arm->X_WB : CalcArmPoseAtZero(arm.joints[link - 1]);
  const std::string name = link == 0 ? "arm" : "arm/" + arm.joints[link - 1].name;
  Open("body", {{"name", name},
                {"pos", Vector3d(X_PL.translation())},
                {"quat", QuaternionOf(X_PL)},
                {"gravcomp", "1"}});
  if (link > 0) {
    const ArmJoint& joint = arm.joints[link - 1];
    WriteInertial(std::max(joint.mass, 1e-6), joint.p_com,
                  MakePossibleInertia(joint.inertia).asDiagonal().toDenseMatrix());
    const Pose X_LP = X_PL.inverse();
    Add("joint", {{"name", name},
                  {"pos", Vector3d(X_LP.translation())},
                  {"axis", Vector3d(X_LP.linear().col(2))},
                  {"range", {joint.lower, joint.upper}},
                  {"armature", joint.armature},
                  {"actuatorfrcrange", {-joint.torque, joint.torque}}});
    qpos_.push_back(start_.q_arm[link - 1]);
  }
  for (const ArmCapsule& capsule : arm.capsules) {
    if (capsule.link != link) continue;
    const bool is_ball = (capsule.p_LA - capsule.p_LB).norm() < 1e-9;
    Open("geom", {{"type", is_ball ? "sphere" : "capsule"},
                  {"size", capsule.radius},
                  {"contype", "0"},
                  {"conaffinity", "0"},
                  {"rgba", "0.7 0.7 0.72 1"}});
    Set(is_ball ? "pos" : "fromto",
        Value(capsule.p_LA).text + (is_ball ? "" : " " + Value(capsule.p_LB).text));
    Close();
  }
  link < arm.num_joints() ? WriteArmLink(link + 1) : WriteLink(0);
  Close();
}

/** The arm's spring about H's origin is the ball joint's; along the axes, the slides' drives. */
void SceneWriter::WriteArmJoints(const Pose& X_WL) {
  for (int axis = 0; axis < 3; ++axis) {
    Add("joint", {{"name", std::string("arm/") + "xyz"[axis]},
                  {"type", "slide"},
                  {"axis", Vector3d(X_WL.linear().transpose() * Vector3d::Unit(axis))},
                  {"actuatorfrcrange", {-setup_.sim.arm_force_limit, setup_.sim.arm_force_limit}}});
    qpos_.push_back(0.0);
  }
  Add("joint", {{"name", "arm/turn"},
                {"type", "ball"},
                {"pos", Vector3d(hand_.links[0].X_PJ.inverse().translation())},
                {"stiffness", setup_.sim.arm_angular_stiffness},
                {"damping", setup_.sim.arm_angular_stiffness * setup_.sim.arm_damping_time}});
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
  Open("body", {{"name", "carried"}, {"gravcomp", (mass + kSpeck) / kSpeck}});
  WriteInertial(kSpeck, hand_.links[0].X_PJ.inverse() * (moment / mass),
                1e-12 * Eigen::Matrix3d::Identity());
  Close();
}

void SceneWriter::WriteJoint(const HandLink& link) {
  const HandJoint& joint = hand_.joints[link.joint];
  const bool is_tied = joint.is_mimic || (joint.coupled_to >= 0 && !IsMiddleFirst());
  Open("joint", {{"name", joint.name}});
  if (joint.is_prismatic) Set("type", "slide");
  Set("axis", link.axis);
  Set("range", {joint.lower, joint.upper});
  if (is_tied) Set("limited", "false");  // the range of the joint it follows holds
  Close();
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
    Set("friction", {mu, mu * torsion, 0.0});
  };
  const std::string name =
      (digit >= 0 ? hand_.digits[digit].id : "palm") + "/" + hand_.links[link].name + "/";
  int number = 0;
  for (const LinkCapsule& capsule : hand_.capsules) {
    if (capsule.link != link) continue;
    const bool is_ball = (capsule.p_LA - capsule.p_LB).norm() < 1e-9;
    Open("geom", {{"name", name + std::to_string(number++)},
                  {"type", is_ball ? "sphere" : "capsule"},
                  {"size", capsule.radius}});
    Set(is_ball ? "pos" : "fromto",
        Value(capsule.p_LA).text + (is_ball ? "" : " " + Value(capsule.p_LB).text));
    set_friction(capsule.radius);
    Set("rgba", is_pad ? "0.75 0.6 0.5 1" : "0.6 0.6 0.6 1");
    Close();
  }
  for (const ContactSphere& sphere : hand_.contact_spheres) {
    if (sphere.link != link) continue;
    Open("geom", {{"name", name + "ball" + std::to_string(number++)},
                  {"type", "sphere"},
                  {"size", sphere.radius},
                  {"pos", sphere.p_LS}});
    set_friction(sphere.radius);
    Set("group", "3");
    Set("contype", "0");
    Set("conaffinity", "0");
    Close();
  }
}

/** A site for each tactile element, its z axis out of the hand. */
void SceneWriter::WriteTaxels(int link) {
  if (!hand_.skin) return;
  for (size_t i = 0; i < hand_.skin->elements.size(); ++i) {
    const TactileElement& element = hand_.skin->elements[i];
    if (element.link != link) continue;
    Add("site", {{"name", "taxel/" + std::to_string(i)},
                 {"pos", element.p_LE},
                 {"zaxis", element.normal_L},
                 {"size", std::sqrt(element.area / kPi)},
                 {"group", "4"}});
  }
}

void SceneWriter::WriteObject() {
  const MassProperties& mass = object_.mass_properties;
  const Pose X_WO = MakePose(start_.R_WO, start_.p_WOcm - start_.R_WO * mass.p_OOcm);
  const Vector3d p = X_WO.translation();
  Open("body", {{"name", "object"}, {"pos", p}, {"quat", QuaternionOf(X_WO)}});
  Add("freejoint", {{"name", "object"}});
  WriteInertial(mass.mass, mass.p_OOcm, mass.I_OOcm);
  const Vector3d colour = object_.colour.cast<double>();
  for (size_t i = 0; i < parts_.size(); ++i) {
    Add("geom", {{"name", "object/" + std::to_string(i)},
                 {"type", "mesh"},
                 {"mesh", "part" + std::to_string(i)},
                 {"friction", {object_.surface.friction_static, 0.0, 0.0}},
                 {"rgba", Value(colour).text + " 1"}});
  }
  Close();
  const Eigen::Quaterniond q(X_WO.linear());
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
  Open("contact");
  for (const auto& [a, b] : apart) {
    Add("exclude", {{"body1", BodyName(a)}, {"body2", BodyName(b)}});
  }
  Close();
}

void SceneWriter::WriteLock(int joint, bool is_active) {
  Add("joint", {{"name", "lock/" + JointName(joint)},
                {"joint1", JointName(joint)},
                {"polycoef", {start_.q[joint], 0.0, 0.0, 0.0, 0.0}},
                {"active", is_active ? "true" : "false"}});
}

void SceneWriter::WriteCouplings() {
  Open("equality");
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
    Add("joint", {{"name", "couple/" + JointName(distal)},
                  {"joint1", JointName(distal)},
                  {"joint2", JointName(middle)},
                  {"polycoef", {follower.mimic_offset, ratio, 0.0, 0.0, 0.0}}});
  }
  Close();
  if (!IsMiddleFirst()) return;
  Open("tendon");
  for (int distal = 0; distal < hand_.num_joints(); ++distal) {
    const int middle = hand_.joints[distal].coupled_to;
    if (middle < 0 || hand_.joints[distal].is_mimic) continue;
    for (const double sign : {1.0, -1.0}) {
      Open("fixed", {{"name", sign > 0.0 ? SumName(middle, distal)
                                         : JointName(middle) + "-" + JointName(distal)}});
      if (sign < 0.0) Set("range", "0 10");
      Add("joint", {{"joint", JointName(middle)}, {"coef", 1.0}});
      Add("joint", {{"joint", JointName(distal)}, {"coef", sign}});
      Close();
    }
  }
  Close();
}

void SceneWriter::WriteArmActuators() {
  const Arm& arm = *start_.arm->arm;
  for (int i = 0; i < arm.num_joints(); ++i) {
    const ArmJoint& joint = arm.joints[static_cast<size_t>(i)];
    const std::string name = "arm/" + joint.name;
    Add("position", {{"name", name}, {"joint", name}, {"kp", joint.stiffness}});
    Add("velocity", {{"name", name + "/speed"},
                     {"joint", name},
                     {"kv", joint.stiffness * setup_.sim.arm_damping_time}});
    ctrl_.insert(ctrl_.end(), {start_.q_arm[i], 0.0});
  }
}

void SceneWriter::WriteActuators() {
  Open("actuator");
  if (start_.arm) WriteArmActuators();
  for (const char axis : {'x', 'y', 'z'}) {
    if (start_.arm) break;
    const std::string joint = std::string("arm/") + axis;
    Add("position", {{"name", joint}, {"joint", joint}, {"kp", setup_.sim.arm_stiffness}});
    Add("velocity", {{"name", joint + "/speed"},
                     {"joint", joint},
                     {"kv", setup_.sim.arm_stiffness * setup_.sim.arm_damping_time}});
    ctrl_.insert(ctrl_.end(), {0.0, 0.0});
  }
  for (int j = 0; j < hand_.num_joints(); ++j) {
    const HandJoint& joint = hand_.joints[j];
    if (joint.coupled_to >= 0) continue;
    const int distal = FindDistal(j);
    const bool pulls_on_sum = distal >= 0 && IsMiddleFirst();
    Add("position",
        {{"name", joint.name},
         {pulls_on_sum ? "tendon" : "joint", pulls_on_sum ? SumName(j, distal) : joint.name},
         {"kp", joint.drive.stiffness},
         {"kv", joint.drive.damping},
         {"forcerange", {-joint.drive.torque_limit, joint.drive.torque_limit}}});
    ctrl_.push_back(start_.q[j]);
  }
  Close();
}

void SceneWriter::WriteCustom() {
  const auto add_number = [&](const char* name, double value) {
    Add("numeric", {{"name", name}, {"data", std::vector<double>{value}}});
  };
  const auto add_text = [&](const char* name, const std::string& value) {
    Add("text", {{"name", name}, {"data", value}});
  };
  double excess = 0.0;
  for (const ConvexPart& part : parts_) excess = std::max(excess, part.excess);
  Open("custom");
  add_number("physics_version", kPhysicsVersion);
  add_number("friction_dynamic", object_.surface.friction_dynamic);
  add_number("table_friction_dynamic", setup_.sim.table_friction_dynamic);
  add_number("object_parts_excess_m", excess);
  add_number("arm_force_limit_n", setup_.sim.arm_force_limit);
  add_number("arm_moment_limit_nm", setup_.sim.arm_moment_limit);
  add_number("lift_distance_m", setup_.grasp.approach_distance);
  add_text("coupling", NameOf(hand_.coupling));
  std::string digits;
  for (const std::string& id : setup_.grasp.digits) digits += (digits.empty() ? "" : " ") + id;
  add_text("grasping_digits", digits);
  add_text("palm", BodyName(hand_.palm_link));
  Close();
}

}  // namespace

std::string FormatMjcf(const TrialSetup& setup, const WorldState& start,
                       const std::vector<ConvexPart>& parts) {
  return SceneWriter(setup, start, parts).Write();
}

CommandedMotion RecordMotion(const TrialSetup& recorded) {
  TrialSetup setup = recorded;
  setup.sim.steady_step_factor = 1;  // a row for every step
  const std::unique_ptr<TrialCourse> made =
      FindProtocol(setup.protocol)
          .make_course(std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim),
                       setup, nullptr);
  auto& course = dynamic_cast<TableLift&>(*made);  // trials of sessions are
  CommandedMotion motion;
  motion.step = setup.sim.step;
  course.Begin();
  motion.start = course.world().state();
  while (course.Advance()) motion.steps.push_back({course.phase(), course.last_command()});
  while (const std::optional<WorldCommand> command = course.ComputeOpenLoopCommand()) {
    motion.steps.push_back({course.phase(), *command});
  }
  if (motion.start.arm) {
    CarryingArm arm(*motion.start.arm, motion.start.q_arm, motion.start.u_arm);
    for (MotionStep& step : motion.steps) {
      arm.Follow(step.command, motion.step);
      step.q_arm = arm.q_command();
      step.u_arm = arm.u_command();
    }
  }
  for (const MotionStep& step : motion.steps) {
    if (step.command.stiffness.size() == 0 &&
        (motion.start.arm ||
         step.command.X_WH.linear().isApprox(motion.start.X_WH.linear(), 1e-9))) {
      continue;
    }
    throw Error(ErrorKind::kUnsupported,
                "the trial's controller turns the hand or scales the stiffness of its drives, and "
                "the scene has no drives for that; choose another trial");
  }
  return motion;
}

namespace {

struct MotionRow {
  double time;
  MotionStep step;
};

/** In place of the hand's root. */
void AddArmColumns(const Arm& arm, std::vector<CsvColumn<MotionRow>>& columns) {
  for (int i = 0; i < arm.num_joints(); ++i) {
    columns.push_back({"arm/" + arm.joints[static_cast<size_t>(i)].name + "_rad", "rad",
                       "command of the arm's joint",
                       [i](const MotionRow& row) { return row.step.q_arm[i]; }});
  }
  for (int i = 0; i < arm.num_joints(); ++i) {
    columns.push_back({"arm/" + arm.joints[static_cast<size_t>(i)].name + "_rad_per_s", "rad/s",
                       "its rate", [i](const MotionRow& row) { return row.step.u_arm[i]; }});
  }
}

/** @param start  of the motion. */
std::vector<CsvColumn<MotionRow>> ListMotionColumns(const Hand& hand, const WorldState& start) {
  using Row = MotionRow;
  const Eigen::Vector3d p_WStart = start.X_WH.translation();
  std::vector<CsvColumn<Row>> columns = {
      {"time_s", "s", "since the start", &Row::time},
      {"phase", "", "of the strategy", [](const Row& row) { return NameOf(row.step.phase); }}};
  if (start.arm) AddArmColumns(*start.arm->arm, columns);
  for (int axis = 0; !start.arm && axis < 3; ++axis) {
    const std::string name = std::string("arm_") + "xyz"[axis];
    columns.push_back(
        {name + "_m", "m", "displacement of the hand's root", [axis, p_WStart](const Row& row) {
           return row.step.command.X_WH.translation()[axis] - p_WStart[axis];
         }});
  }
  for (int axis = 0; !start.arm && axis < 3; ++axis) {
    const std::string name = std::string("arm_") + "xyz"[axis];
    columns.push_back({name + "_m_per_s", "m/s", "its rate",
                       [axis](const Row& row) { return row.step.command.v_WH[axis]; }});
  }
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    if (hand.joints[joint].coupled_to >= 0) continue;
    columns.push_back({hand.joints[joint].name + "_rad", "rad", "command of the drive",
                       [joint](const Row& row) { return row.step.command.q[joint]; }});
  }
  return columns;
}

}  // namespace

std::string FormatMotionCsv(const Hand& hand, const CommandedMotion& motion) {
  std::vector<MotionRow> rows = {{0.0,
                                  {motion.steps.empty() ? Phase::kPlacing : motion.steps[0].phase,
                                   {motion.start.q, motion.start.X_WH},
                                   motion.start.q_arm,
                                   motion.start.u_arm}}};
  for (size_t i = 0; i < motion.steps.size(); ++i) {
    rows.push_back({motion.step * static_cast<double>(i + 1), motion.steps[i]});
  }
  return FormatCsv(ListMotionColumns(hand, motion.start), rows);
}

Json MakeMotionSchema(const Hand& hand) {
  return MakeTableSchema(ListMotionColumns(hand, WorldState()), "");
}

void MjcfExporter::Export(const TrialSetup& setup, const std::filesystem::path& folder) {
  const GraspObject& object = *setup.object;
  const auto [parts, is_new] = parts_.try_emplace(object.content_hash);
  if (is_new) parts->second = CutIntoConvexParts(object.mesh, *object.field);
  const CommandedMotion motion = RecordMotion(setup);
  MakeFolder(folder);
  WriteFileAtomically(folder / "scene.xml", FormatMjcf(setup, motion.start, parts->second));
  WriteFileAtomically(folder / "motion.csv", FormatMotionCsv(*setup.hand, motion));
}

}  // namespace graspbench
