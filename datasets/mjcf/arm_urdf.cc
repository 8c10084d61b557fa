#include "datasets/mjcf/arm_urdf.h"

#include <tinyxml2.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/text/json.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using tinyxml2::XMLElement;

/** Digits enough that the numbers come back as they are. */
std::string FormatNumbers(const Vector3d& v) {
  return FormatJson(v.x()) + " " + FormatJson(v.y()) + " " + FormatJson(v.z());
}

void Set(XMLElement* element, const char* name, double value) {
  element->SetAttribute(name, FormatJson(value).c_str());
}

void AddOrigin(const Pose& X, XMLElement* parent) {
  XMLElement* origin = parent->InsertNewChildElement("origin");
  origin->SetAttribute("xyz", FormatNumbers(X.translation()).c_str());
  origin->SetAttribute("rpy", FormatNumbers(CalcRollPitchYaw(X.linear())).c_str());
}

XMLElement* AddNamed(const char* kind, const std::string& name, XMLElement* robot) {
  for (XMLElement* other = robot->FirstChildElement(kind); other != nullptr;
       other = other->NextSiblingElement(kind)) {
    if (!other->Attribute("name", name.c_str())) continue;
    throw Error(ErrorKind::kUnsupported, std::string("the hand has a <") + kind + "> named \"" +
                                             name +
                                             "\", and so has the arm; rename it in the hand");
  }
  XMLElement* element = robot->InsertNewChildElement(kind);
  element->SetAttribute("name", name.c_str());
  return element;
}

XMLElement* AddJoint(const char* type, const std::string& name, const std::string& parent,
                     const std::string& child, const Pose& X_PJ, XMLElement* robot) {
  XMLElement* joint = AddNamed("joint", name, robot);
  joint->SetAttribute("type", type);
  joint->InsertNewChildElement("parent")->SetAttribute("link", parent.c_str());
  joint->InsertNewChildElement("child")->SetAttribute("link", child.c_str());
  AddOrigin(X_PJ, joint);
  return joint;
}

void AddInertial(const ArmJoint& joint, const Pose& X_JL, XMLElement* link) {
  if (joint.mass <= 0.0) return;
  XMLElement* inertial = link->InsertNewChildElement("inertial");
  AddOrigin(X_JL * MakePose(joint.p_com), inertial);
  Set(inertial->InsertNewChildElement("mass"), "value", joint.mass);
  const Vector3d moments = MakePossibleInertia(joint.inertia);
  XMLElement* inertia = inertial->InsertNewChildElement("inertia");
  for (const auto& [name, value] : {std::pair("ixx", moments.x()),
                                    {"iyy", moments.y()},
                                    {"izz", moments.z()},
                                    {"ixy", 0.0},
                                    {"ixz", 0.0},
                                    {"iyz", 0.0}}) {
    Set(inertia, name, value);
  }
}

XMLElement* AddGeometry(const char* kind, const char* shape, const Pose& X, double radius,
                        XMLElement* link) {
  XMLElement* element = link->InsertNewChildElement(kind);
  AddOrigin(X, element);
  XMLElement* geometry = element->InsertNewChildElement("geometry")->InsertNewChildElement(shape);
  Set(geometry, "radius", radius);
  return geometry;
}

/** URDF has no capsule: a cylinder and a ball at either end. */
void AddCapsule(const ArmCapsule& capsule, const Pose& X_JL, XMLElement* link) {
  const Vector3d along = capsule.p_LB - capsule.p_LA;
  for (const char* kind : {"visual", "collision"}) {
    AddGeometry(kind, "sphere", X_JL * MakePose(capsule.p_LA), capsule.radius, link);
    if (along.norm() < 1e-9) continue;
    AddGeometry(kind, "sphere", X_JL * MakePose(capsule.p_LB), capsule.radius, link);
    const Pose X_LC =
        MakePose(Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), along).toRotationMatrix(),
                 Vector3d(0.5 * (capsule.p_LA + capsule.p_LB)));
    Set(AddGeometry(kind, "cylinder", X_JL * X_LC, capsule.radius, link), "length", along.norm());
  }
}

void AddLimit(const ArmJoint& joint, XMLElement* element) {
  element->InsertNewChildElement("axis")->SetAttribute("xyz", "0 0 1");
  XMLElement* limit = element->InsertNewChildElement("limit");
  Set(limit, "lower", joint.lower);
  Set(limit, "upper", joint.upper);
  Set(limit, "effort", joint.torque);
  Set(limit, "velocity", joint.speed);
}

}  // namespace

Vector3d MakePossibleInertia(Vector3d inertia) {
  for (int i = 0; i < 3; ++i) {
    const double missing = inertia[i] - inertia[(i + 1) % 3] - inertia[(i + 2) % 3];
    if (missing <= 0.0) continue;
    inertia[(i + 1) % 3] += 0.5 * missing;
    inertia[(i + 2) % 3] += 0.5 * missing;
  }
  return inertia.cwiseMax(1e-9);
}

std::string FormatArmUrdf(const MountedArm& mounted, const Hand& hand,
                          const std::string& hand_urdf) {
  tinyxml2::XMLDocument document;
  document.Parse(hand_urdf.c_str());
  XMLElement* robot = document.FirstChildElement("robot");
  if (document.Error() || robot == nullptr) {
    throw Error(ErrorKind::kFormat, "the hand \"" + hand.id + "\": its hand.urdf is no URDF");
  }
  const Arm& arm = *mounted.arm;
  robot->SetAttribute("name", (arm.id + "_" + hand.id).c_str());
  AddNamed("link", "world", robot);
  std::string parent = "world";
  Pose X_PL = mounted.X_WB;  // of the frame of Denavit and Hartenberg in the link before
  for (int i = 0; i <= arm.num_joints(); ++i) {
    const std::string name = i == 0 ? "arm" : "arm/" + arm.joints[static_cast<size_t>(i - 1)].name;
    XMLElement* link = AddNamed("link", name, robot);
    Pose X_JL = Pose::Identity();
    if (i == 0) {
      AddJoint("fixed", name, parent, name, X_PL, robot);
    } else {
      const ArmJoint& joint = arm.joints[static_cast<size_t>(i - 1)];
      const Pose turned = MakePose(MakeRotationRpy(0.0, 0.0, joint.offset), Vector3d::Zero());
      AddLimit(joint, AddJoint("revolute", name, parent, name, X_PL * turned, robot));
      X_JL = turned.inverse() * CalcArmPoseAtZero(joint);
      AddInertial(joint, X_JL, link);
    }
    for (const ArmCapsule& capsule : arm.capsules) {
      if (capsule.link == i) AddCapsule(capsule, X_JL, link);
    }
    parent = name;
    X_PL = X_JL;
  }
  const HandLink& root = hand.links.front();
  AddJoint("fixed", "arm to hand", parent, root.name, X_PL * mounted.X_FH * root.X_PJ, robot);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace graspbench
