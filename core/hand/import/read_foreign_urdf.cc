#include "core/hand/import/read_foreign_urdf.h"

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/import/checks/joint_limits.h"
#include "core/hand/import/foreign_xml.h"
#include "core/hand/urdf_check.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using tinyxml2::XMLElement;

class ForeignUrdfReader {
 public:
  ForeignUrdfReader(std::string file, std::optional<bool> in_degrees, Diagnostics& problems)
      : file_(std::move(file)), in_degrees_(in_degrees), problems_(problems) {}

  ForeignHand Read(const std::string& text);

 private:
  using Colour = std::optional<Vector3d>;

  void Warn(const XMLElement& at, const std::string& text) {
    problems_.Warn(file_, at.GetLineNum(), text);
  }
  void Fail(const XMLElement& at, const std::string& text) {
    problems_.Fail(file_, at.GetLineNum(), text);
  }
  /** The numbers of an attribute; `otherwise`, with a warning when something else stands there. */
  template <size_t kCount>
  std::array<double, kCount> Numbers(XMLElement* element, const char* attribute,
                                     std::array<double, kCount> otherwise,
                                     const std::string& where);
  double Number(XMLElement* element, const char* attribute, double otherwise,
                const std::string& where) {
    return Numbers<1>(element, attribute, {otherwise}, where)[0];
  }
  Vector3d Vector(XMLElement* element, const char* attribute, const Vector3d& otherwise,
                  const std::string& where) {
    const auto v =
        Numbers<3>(element, attribute, {otherwise[0], otherwise[1], otherwise[2]}, where);
    return {v[0], v[1], v[2]};
  }
  Pose ReadOrigin(XMLElement& parent, const std::string& where);
  std::string ReadName(XMLElement& element, NameList& names);
  Colour ReadColour(XMLElement* material, const std::string& where);
  void ReadLink(XMLElement& element);
  std::optional<ForeignShape> ReadShape(XMLElement& element, const std::string& where);
  void ReadJoint(XMLElement& element);
  void ReadLimits(XMLElement& element, const std::string& type, const std::string& where,
                  ForeignJoint& joint);
  void JudgeAngles(XMLElement& robot);
  void CheckTree();
  void TellEfforts();

  std::string file_;
  std::optional<bool> in_degrees_;  // limits of joints; nothing: each by itself
  Diagnostics& problems_;
  ForeignHand hand_;
  NameList link_names_{"link"}, joint_names_{"joint"};
  std::map<std::string, int> link_index_;
  std::map<std::string, Vector3d> colours_;
  std::vector<NamedMimic> mimics_;
  std::vector<std::string> without_effort_, with_great_effort_;  // joints
};

template <size_t kCount>
std::array<double, kCount> ForeignUrdfReader::Numbers(XMLElement* element, const char* attribute,
                                                      std::array<double, kCount> otherwise,
                                                      const std::string& where) {
  const char* text = element ? element->Attribute(attribute) : nullptr;
  if (!text) return otherwise;
  if (const auto numbers = ParseNumbers(text); numbers && numbers->size() == kCount) {
    std::copy(numbers->begin(), numbers->end(), otherwise.begin());
    return otherwise;
  }
  const std::string fault = where + ", <" + element->Name() + "> " + attribute + ": expected " +
                            FormatCount(kCount, "finite number") + ", found \"" + text + "\"";
  if (std::strstr(text, "${")) {
    Fail(*element, fault + ", a macro: expand the file first (xacro FILE.xacro > FILE.urdf)");
  } else if (std::strcmp(element->Name(), "origin") == 0) {
    Fail(*element,
         fault + "; without it nobody knows where the " + element->Parent()->Value() + " is");
  } else {
    Warn(*element, fault + "; taken as if it were not there");
  }
  return otherwise;
}

Pose ForeignUrdfReader::ReadOrigin(XMLElement& parent, const std::string& where) {
  XMLElement* origin = parent.FirstChildElement("origin");
  if (!origin) return Pose::Identity();
  const std::string unknown = FindUnknownInOrigin(*origin);
  if (!unknown.empty()) Fail(*origin, where + unknown);
  if (XMLElement* second = origin->NextSiblingElement("origin")) {
    Fail(*second, where + ": a second <origin>; one is allowed");
  }
  const Vector3d xyz = Vector(origin, "xyz", Vector3d::Zero(), where);
  Vector3d rpy = Vector(origin, "rpy", Vector3d::Zero(), where);
  if (const double largest = rpy.cwiseAbs().maxCoeff(); largest > kWholeTurn) {
    Warn(*origin, where + ": an angle of " + FormatSignificant(largest, 3) +
                      " in rpy is more than one turn; this rpy is taken as degrees, though URDF "
                      "has radians: look at the others of the file");
    rpy *= RadFromDeg(1.0);
  }
  return MakePose(MakeRotationRpy(rpy.x(), rpy.y(), rpy.z()), xyz);
}

std::string ForeignUrdfReader::ReadName(XMLElement& element, NameList& names) {
  std::vector<std::string> changes;
  const std::string name = names.Add(element.Attribute("name"), changes);
  for (const std::string& change : changes) Warn(element, change);
  return name;
}

ForeignUrdfReader::Colour ForeignUrdfReader::ReadColour(XMLElement* material,
                                                        const std::string& where) {
  if (!material) return {};
  const char* name = material->Attribute("name");
  if (XMLElement* color = material->FirstChildElement("color")) {
    const auto rgba = Numbers<4>(color, "rgba", {0.6, 0.6, 0.6, 1.0}, where);
    const Vector3d rgb = Vector3d(rgba[0], rgba[1], rgba[2]).cwiseMax(0.0).cwiseMin(1.0);
    if (name && *name) colours_.emplace(name, rgb);
    return rgb;
  }
  const auto known = colours_.find(name ? name : "");
  if (known != colours_.end()) return known->second;
  return {};  // a texture, or a material that the file leaves to others: drawn grey
}

std::optional<ForeignShape> ForeignUrdfReader::ReadShape(XMLElement& element,
                                                         const std::string& where) {
  ForeignShape shape;
  shape.line = element.GetLineNum();
  shape.X_LS = ReadOrigin(element, where);
  shape.colour = ReadColour(element.FirstChildElement("material"), where);
  XMLElement* geometry = element.FirstChildElement("geometry");
  XMLElement* solid = geometry ? geometry->FirstChildElement() : nullptr;
  if (!solid) {
    Warn(element, where + " has no <geometry>; left out");
    return {};
  }
  const std::string kind = solid->Name();
  if (kind == "sphere") {
    shape.size.setConstant(2.0 * Number(solid, "radius", 0.0, where));
  } else if (kind == "cylinder" || kind == "capsule") {
    const double radius = Number(solid, "radius", 0.0, where);
    const double length = Number(solid, "length", 0.0, where);
    shape.kind = kind == "cylinder" ? ForeignShape::Kind::kCylinder : ForeignShape::Kind::kCapsule;
    // A capsule's length is that of its middle part.
    shape.size = {2.0 * radius, 2.0 * radius, kind == "cylinder" ? length : length + 2.0 * radius};
  } else if (kind == "box") {
    shape.kind = ForeignShape::Kind::kBox;
    shape.size = Vector(solid, "size", Vector3d::Zero(), where);
  } else if (kind == "mesh") {
    shape.kind = ForeignShape::Kind::kMesh;
    const char* address = solid->Attribute("filename");
    shape.mesh = address ? address : "";
    shape.scale = Vector(solid, "scale", Vector3d::Ones(), where);
    if (!shape.mesh.empty() && shape.scale.cwiseAbs().minCoeff() > 0.0) return shape;
    Warn(*solid, where + ": a mesh with" + (shape.mesh.empty() ? "out filename" : " a scale of 0") +
                     "; left out");
    return {};
  } else {
    Warn(*solid, where + ": <" + kind + "> is no shape of URDF; left out");
    return {};
  }
  if (shape.size.minCoeff() <= 0.0) {
    Warn(*solid, where + ": the " + kind + " has no extent; left out");
    return {};
  }
  return shape;
}

void ForeignUrdfReader::ReadLink(XMLElement& element) {
  const char* own_name = element.Attribute("name");
  ForeignLink& link = hand_.links.emplace_back();
  link.name = ReadName(element, link_names_);
  link.line = element.GetLineNum();
  link_index_.emplace(own_name ? own_name : link.name, static_cast<int>(hand_.links.size()) - 1);
  const std::string where = "link \"" + link.name + "\"";
  if (XMLElement* inertial = element.FirstChildElement("inertial")) {
    ForeignInertia& inertia = link.inertia.emplace();
    inertia.line = inertial->GetLineNum();
    inertia.X_LI = ReadOrigin(*inertial, where + ", inertial");
    inertia.mass = Number(inertial->FirstChildElement("mass"), "value", 0.0, where);
    XMLElement* I = inertial->FirstChildElement("inertia");
    const char* const names[3][3] = {
        {"ixx", "ixy", "ixz"}, {"ixy", "iyy", "iyz"}, {"ixz", "iyz", "izz"}};
    for (int r = 0; r < 3; ++r) {
      for (int c = r; c < 3; ++c) {
        inertia.I_I(r, c) = inertia.I_I(c, r) = Number(I, names[r][c], 0.0, where);
      }
    }
  }
  for (const auto& [kind, shapes] :
       {std::pair{"visual", &link.visuals}, std::pair{"collision", &link.collisions}}) {
    for (XMLElement* shape = element.FirstChildElement(kind); shape;
         shape = shape->NextSiblingElement(kind)) {
      if (auto read = ReadShape(*shape, where + ", " + kind)) shapes->push_back(*read);
    }
  }
}

void ForeignUrdfReader::ReadLimits(XMLElement& element, const std::string& type,
                                   const std::string& where, ForeignJoint& joint) {
  XMLElement* limit = element.FirstChildElement("limit");
  const double effort = Number(limit, "effort", 0.0, where);
  joint.drive.effort = std::max(0.0, effort);
  const bool is_driven = !element.FirstChildElement("mimic");
  if (limit && limit->Attribute("effort") && is_driven && effort <= 0.0)
    without_effort_.push_back(joint.name);
  const double most_effort = joint.kind == ForeignJoint::Kind::kRevolute ? 200.0 : 5000.0;
  if (effort > most_effort) with_great_effort_.push_back(joint.name);
  StatedLimits stated;
  if (!limit || type == "continuous") stated.missing = "<limit>";
  for (const char* end : {"lower", "upper"}) {
    const char* text = limit ? limit->Attribute(end) : nullptr;
    const auto numbers = text ? ParseNumbers(text) : std::vector<double>{0.0};
    if (!numbers || numbers->size() != 1) stated.missing = std::string(end) + " limit to be read";
  }
  // A limit that is left out is zero in URDF.
  stated.lower = Number(limit, "lower", 0.0, where);
  stated.upper = Number(limit, "upper", 0.0, where);
  if (joint.kind == ForeignJoint::Kind::kRevolute) {
    const double largest = std::max(std::abs(stated.lower), std::abs(stated.upper));
    const bool in_degrees = in_degrees_.value_or(largest > kWholeTurn && largest <= 360.0);
    if (in_degrees) {
      stated.lower = RadFromDeg(stated.lower);
      stated.upper = RadFromDeg(stated.upper);
    }
    if (in_degrees && !in_degrees_ && type != "continuous") {
      Warn(*limit, where + ": a limit of " + FormatSignificant(largest, 3) +
                       " would be more than one turn; this joint's limits are taken as degrees "
                       "(--angle says otherwise)");
    }
    const double range = stated.upper - stated.lower;
    if (!in_degrees && !in_degrees_ && type != "continuous" && range > kWholeTurn) {
      Warn(*limit, where + ": its limits are " + FormatSignificant(DegFromRad(range), 3) +
                       " deg apart, more than one turn; if they are degrees, say --angle deg");
    }
  }
  const std::string repaired = SetLimits(stated, joint);
  if (type == "continuous") {
    joint.no_limits.clear();
    Warn(element, where +
                      " is continuous, it turns without end; its limits are taken as half a "
                      "turn each way");
  } else if (!repaired.empty()) {
    Warn(limit ? *limit : element, where + repaired);
  }
}

/** Limits of many joints beyond a turn: the file is in degrees. */
void ForeignUrdfReader::JudgeAngles(XMLElement& robot) {
  if (in_degrees_) return;
  int num_beyond = 0, num_within = 0;
  double largest = 0.0;
  for (XMLElement* e = robot.FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
    const char* type = e->Attribute("type");
    XMLElement* limit = e->FirstChildElement("limit");
    if (!limit || !type || std::strcmp(type, "revolute") != 0) continue;
    double most = 0.0;
    for (const char* end : {"lower", "upper"}) {
      const char* text = limit->Attribute(end);
      const auto number = text ? ParseNumbers(text) : std::nullopt;
      if (number && number->size() == 1) most = std::max(most, std::abs((*number)[0]));
    }
    num_beyond += most > kWholeTurn;
    num_within += most > 0.0 && most <= kWholeTurn;
    largest = std::max(largest, most);
  }
  if (num_beyond < 2 || num_beyond <= num_within || largest > 360.0) return;
  in_degrees_ = true;
  Warn(robot, "limits of " + std::to_string(num_beyond) + " of " +
                  FormatCount(num_beyond + num_within, "joint") +
                  " would be more than one turn, up to " + FormatSignificant(largest, 3) +
                  "; all are taken as degrees, though URDF has radians (--angle says otherwise)");
}

void ForeignUrdfReader::ReadJoint(XMLElement& element) {
  ForeignJoint joint;
  joint.name = ReadName(element, joint_names_);
  joint.line = element.GetLineNum();
  const std::string where = "joint \"" + joint.name + "\"";
  for (const auto& [role, end] : {std::pair{"parent", &joint.parent}, {"child", &joint.child}}) {
    XMLElement* at = element.FirstChildElement(role);
    const char* name = at ? at->Attribute("link") : nullptr;
    const auto found = link_index_.find(name ? name : "");
    if (found != link_index_.end()) {
      *end = found->second;
      continue;
    }
    std::vector<std::string> known;
    for (const ForeignLink& link : hand_.links) known.push_back(link.name);
    Fail(element,
         where + ": " + role + " link " +
             (name ? "\"" + std::string(name) + "\" does not exist" + SuggestNames(name, known)
                   : "is missing"));
  }
  joint.X_PJ = ReadOrigin(element, where);
  const char* type_text = element.Attribute("type");
  const std::string type = type_text ? type_text : "";
  if (type == "revolute" || type == "continuous") {
    joint.kind = ForeignJoint::Kind::kRevolute;
  } else if (type == "prismatic") {
    joint.kind = ForeignJoint::Kind::kPrismatic;
  } else if (type != "fixed" && type != "floating" && type != "planar") {
    Fail(element, where + ": type \"" + type +
                      "\" is not one of URDF: revolute, continuous, prismatic, fixed, floating, "
                      "planar");
  } else if (type != "fixed") {
    Warn(element, where + ": type \"" + type + "\" is no joint of a hand; taken as fixed");
  }
  const int index = static_cast<int>(hand_.joints.size());
  if (joint.kind != ForeignJoint::Kind::kFixed) {
    const Vector3d axis =
        Vector(element.FirstChildElement("axis"), "xyz", Vector3d::UnitX(), where);
    if (axis.norm() > 1e-6) {
      joint.axis = axis.normalized();
    } else {
      Warn(element, where + ": the axis has no direction; taken as x");
    }
    ReadLimits(element, type, where, joint);
    if (XMLElement* mimic = element.FirstChildElement("mimic")) {
      const char* follows = mimic->Attribute("joint");
      mimics_.push_back({index, mimic->GetLineNum(), follows ? follows : "",
                         Number(mimic, "multiplier", 1.0, where),
                         Number(mimic, "offset", 0.0, where)});
    }
  }
  if (joint.parent >= 0 && joint.child >= 0) hand_.joints.push_back(joint);
}

void ForeignUrdfReader::CheckTree() {
  std::vector<int> joint_of(hand_.links.size(), -1);
  for (size_t j = 0; j < hand_.joints.size(); ++j) {
    const ForeignJoint& joint = hand_.joints[j];
    int& above = joint_of[joint.child];
    if (above >= 0) {
      problems_.Fail(file_, joint.line,
                     "joint \"" + joint.name + "\": link \"" + hand_.links[joint.child].name +
                         "\" already hangs on joint \"" + hand_.joints[above].name + "\" (line " +
                         std::to_string(hand_.joints[above].line) +
                         "); a hand is a tree, so cut the loop and give one side a <mimic>");
    } else {
      above = static_cast<int>(j);
    }
  }
  std::vector<std::string> roots;
  int root_line = 0;
  for (size_t link = 0; link < hand_.links.size(); ++link) {
    if (joint_of[link] < 0) {
      roots.push_back(hand_.links[link].name);
      root_line = hand_.links[link].line;
      continue;
    }
    int at = static_cast<int>(link);
    for (size_t step = 0; at >= 0 && joint_of[at] >= 0 && step <= hand_.joints.size(); ++step) {
      at = hand_.joints[joint_of[at]].parent;
    }
    if (joint_of[at] < 0) continue;
    problems_.Fail(file_, hand_.joints[joint_of[at]].line,
                   "joint \"" + hand_.joints[joint_of[at]].name +
                       "\" lies in a ring of joints; a hand is a tree");
    return;
  }
  if (roots.size() > 1) {
    std::string names;
    for (const std::string& name : roots) names += (names.empty() ? "\"" : ", \"") + name + "\"";
    problems_.Fail(file_, root_line,
                   "several roots: " + names + "; join all links into one tree by <joint>s");
  }
}

void ForeignUrdfReader::TellEfforts() {
  const auto tell = [&](const std::vector<std::string>& joints, const std::string& what) {
    if (joints.empty()) return;
    problems_.Warn(file_, 0,
                   "effort of " + FormatCount(static_cast<int64_t>(joints.size()), "joint") + " (" +
                       JoinSome(joints) + ") " + what + "; their drives are guessed");
  };
  tell(without_effort_, "is 0 or less: a drive without torque moves nothing");
  tell(with_great_effort_, "is above 200 N m or 5000 N, more than a finger bears");
}

ForeignHand ForeignUrdfReader::Read(const std::string& text) {
  tinyxml2::XMLDocument document;
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    problems_.Fail(file_, 0, "the file is empty");
    return {};
  }
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    problems_.Fail(file_, document.ErrorLineNum(),
                   "not valid XML in line " + std::to_string(document.ErrorLineNum()) + " (" +
                       document.ErrorName() + "); is the file whole?");
    return {};
  }
  XMLElement* robot = document.RootElement();
  if (!robot || std::strcmp(robot->Name(), "robot") != 0) {
    problems_.Fail(file_, robot ? robot->GetLineNum() : 0,
                   "neither URDF nor MJCF: the outermost element must be <robot> or <mujoco>" +
                       std::string(robot ? ", found <" + std::string(robot->Name()) + ">" : "") +
                       (robot && std::strcmp(robot->Name(), "sdf") == 0
                            ? ", an SDF world: give the URDF that it was made of"
                            : ""));
    return {};
  }
  for (XMLElement* e = robot->FirstChildElement(); e; e = e->NextSiblingElement()) {
    if (std::strncmp(e->Name(), "xacro:", 6) == 0) {
      Fail(*e, std::string("<") + e->Name() +
                   "> is a macro: expand the file first (xacro FILE.xacro > FILE.urdf)");
      return {};
    }
  }
  const char* name = robot->Attribute("name");
  hand_.name = name && *name && IsUtf8(name) ? name : "hand";
  const auto for_each = [&](const char* kind, auto&& read) {
    for (XMLElement* e = robot->FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
      read(*e);
    }
  };
  for_each("material", [this](XMLElement& material) { ReadColour(&material, "material"); });
  for_each("link", [this](XMLElement& link) {
    if (hand_.links.size() < kMostForeignLinks) ReadLink(link);
  });
  JudgeAngles(*robot);
  if (hand_.links.empty()) Fail(*robot, "the file has no link");
  if (hand_.links.size() == kMostForeignLinks)
    Fail(*robot, "the file has 1000 links or more: no hand");
  for_each("joint", [this](XMLElement& joint) { ReadJoint(joint); });
  if (problems_.num_errors() > 0) return {};
  CheckTree();
  ResolveMimics(mimics_, "<mimic>", file_, problems_, hand_);
  FixUnlimited(file_, problems_, hand_);
  TellEfforts();
  return std::move(hand_);
}

}  // namespace

ForeignHand ReadForeignUrdf(const std::string& text, const std::string& file, Diagnostics& problems,
                            std::optional<bool> in_degrees) {
  return ForeignUrdfReader(file, in_degrees, problems).Read(text);
}

}  // namespace graspbench
