#include "core/hand/read_urdf.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/base/text/text.h"
#include "core/hand/xml_text.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using tinyxml2::XMLElement;

constexpr double kLargestExtent = 2.0;       // [m]; a larger part is an error of units
constexpr double kLargestStroke = 1.0;       // [m] of a prismatic joint
constexpr double kMostElongated = 30.0;      // length / thickness of a collision shape
constexpr double kTriangleTolerance = 1e-3;  // relative, for inertia given with few digits
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/** MakeRotationRpy with the last digit of urdfdom, with which results of hands were stored. */
Eigen::Matrix3d MakeRotation(const Vector3d& rpy) {
  const Eigen::Array3d half = 0.5 * rpy.array();
  const double sx = std::sin(half.x()), sy = std::sin(half.y()), sz = std::sin(half.z());
  const double cx = std::cos(half.x()), cy = std::cos(half.y()), cz = std::cos(half.z());
  const double x = sx * cy * cz - cx * sy * sz, y = cx * sy * cz + sx * cy * sz;
  const double z = cx * cy * sz - sx * sy * cz, w = cx * cy * cz + sx * sy * sz;
  const double norm = std::sqrt(x * x + y * y + z * z + w * w);
  return Eigen::Quaterniond(w / norm, x / norm, y / norm, z / norm).normalized().toRotationMatrix();
}

class UrdfReader : UrdfElements {
 public:
  UrdfReader(std::string file, const std::optional<std::filesystem::path>& own_folder,
             Diagnostics& problems)
      : UrdfElements(std::move(file), own_folder.has_value(), problems), folder_(own_folder) {}

  Urdf Read(const std::string& text) {
    tinyxml2::XMLDocument document;
    XMLElement* robot = FindRobot(document, text);
    if (!robot) return {};
    const char* name = robot->Attribute("name");
    if (is_own_) Text(*robot, "name", "robot");
    const char* version = robot->Attribute("version");
    if (is_own_ && version && std::string(version) != "1.0") {
      Fail(*robot, std::string("robot: URDF of version \"") + version + "\"; expected 1.0");
    }
    urdf_.name = name && *name && IsUtf8(name) ? name : "hand";
    urdf_.line = robot->GetLineNum();
    WarnOfUnused(*robot, {"material", "link", "joint"}, {"gazebo", "transmission", "sensor"},
                 "robot");
    const auto for_each = [&](const char* kind, auto&& read) {
      for (XMLElement* e = robot->FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
        read(*e);
      }
    };
    for_each("material", [this](XMLElement& material) {
      const char* known = material.Attribute("name");
      if (is_own_ && known && colours_.count(known) > 0) {
        Fail(material, std::string("material: the name \"") + known + "\" is taken");
      }
      if (is_own_ && !material.FirstChildElement("color")) {
        Fail(material, "material: <color> is missing");
        if (known) colours_.emplace(known, Vector3d::Zero());
      }
      ReadColour(material, "material");
    });
    for_each("link", [this](XMLElement& link) {
      const size_t first = problems_.entries().size();
      ReadLink(link);
      if (!is_own_) urdf_.links.back().told = ListEntriesFrom(first);
    });
    if (urdf_.links.empty())
      Fail(*robot, is_own_ ? "the hand has no link" : "the file has no link");
    for_each("joint", [this](XMLElement& element) {
      const size_t first = problems_.entries().size();
      ReadJoint(element);
      UrdfJoint& joint = urdf_.joints.back();
      if (std::min(joint.parent, joint.child) >= 0)
        joint.told = ListEntriesFrom(first);
      else
        are_ends_known_ = false;
    });
    if (is_own_ && urdf_.ListMovingJoints().empty()) Fail(*robot, "the hand has no moving joint");
    if (is_own_ || are_ends_known_) CheckTree();
    return std::move(urdf_);
  }

 private:
  /** Names of links or of joints: the line of each, and the new names of foreign ones. */
  struct Names {
    std::string kind;
    NameList given{kind};
    std::map<std::string, int> lines{};
  };

  std::string ReadName(XMLElement& element, Names& names) {
    if (!is_own_) {
      std::vector<std::string> changes;
      const std::string name = names.given.Add(element.Attribute("name"), changes);
      for (const std::string& change : changes) Warn(element, change);
      return name;
    }
    const std::string name = Text(element, "name", names.kind);
    if (name.empty()) return name;
    const auto [known, is_new] = names.lines.emplace(name, element.GetLineNum());
    if (!is_new) {
      Fail(element, names.kind + " \"" + name + "\": the name is taken by line " +
                        std::to_string(known->second));
    }
    return name;
  }

  std::vector<size_t> ListEntriesFrom(size_t first) const {
    std::vector<size_t> entries(problems_.entries().size() - first);
    std::iota(entries.begin(), entries.end(), first);
    return entries;
  }

  Pose ReadOrigin(XMLElement& parent, const std::string& where) {
    XMLElement* origin = Only(parent, "origin", where, false);
    if (!origin) return Pose::Identity();
    if (const std::string unknown = FindUnknownInOrigin(*origin); !unknown.empty()) {
      Fail(*origin, where + ": its <origin> has the " + unknown +
                        "; expected the attributes \"xyz\" (a place in metres) and \"rpy\" (roll, "
                        "pitch, yaw in radians) alone; give the place and the rotation by these");
    }
    const Vector3d xyz = Numbers<3>(origin, "xyz", Vector3d::Zero(), where, false);
    if (is_own_ && xyz.norm() > kLargestExtent) {
      Fail(*origin, where + ": farther than 2 m away (URDF is in metres)");
    }
    Vector3d rpy = Numbers<3>(origin, "rpy", Vector3d::Zero(), where, false);
    if (!is_own_ && AreDegrees(rpy)) {
      Warn(*origin, where + ": an angle of " + FormatSignificant(rpy.cwiseAbs().maxCoeff(), 3) +
                        " in rpy is more than one turn; this rpy is taken as degrees, though URDF "
                        "has radians: look at the others of the file");
      rpy *= RadFromDeg(1.0);
    }
    return MakePose(is_own_ ? MakeRotation(rpy) : MakeRotationRpy(rpy.x(), rpy.y(), rpy.z()), xyz);
  }

  std::optional<Vector3d> ReadColour(XMLElement& material, const std::string& where) {
    const char* attribute = material.Attribute("name");
    const std::string name = is_own_ ? Text(material, "name", where) : attribute ? attribute : "";
    WarnOfUnused(material, {"color"}, {"texture"}, where);
    if (XMLElement* color = Only(material, "color", where, false)) {
      const Eigen::Vector4d rgba =
          Numbers<4>(color, "rgba", Eigen::Vector4d(0.6, 0.6, 0.6, 1.0), where);
      const Eigen::Vector4d inside = rgba.cwiseMax(0.0).cwiseMin(1.0);
      if (is_own_ && inside != rgba)
        Fail(*color, where + ": a colour's numbers lie between 0 and 1");
      if (!name.empty()) colours_.emplace(name, inside.head<3>());
      return inside.head<3>();
    }
    const auto known = colours_.find(name);
    if (known != colours_.end()) return known->second;
    if (is_own_ && !name.empty()) {
      std::vector<std::string> names;
      for (const auto& [other, colour] : colours_) names.push_back(other);
      Fail(material,
           where + ": material \"" + name + "\" is not defined" + SuggestNames(name, names));
    }
    return {};  // a texture, or a material defined elsewhere: drawn grey
  }

  void ReadLink(XMLElement& element) {
    const size_t num_before = link_names_.lines.size();
    UrdfLink link;
    link.name = ReadName(element, link_names_);
    link.line = element.GetLineNum();
    const std::string where = "link \"" + link.name + "\"";
    WarnOfUnused(element, {"inertial", "visual", "collision"}, {}, where);
    if (XMLElement* inertial = Only(element, "inertial", where, false)) {
      link.inertia = ReadInertia(*inertial, where + ", inertial");
    }
    for (const auto& [kind, shapes] :
         {std::pair{"visual", &link.visuals}, std::pair{"collision", &link.collisions}}) {
      for (XMLElement* e = element.FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
        auto shape = ReadShape(*e, where + ", " + kind, shapes == &link.collisions);
        if (shape) shapes->push_back(*shape);
      }
    }
    if (is_own_ && link_names_.lines.size() == num_before) return;  // no name, or a duplicate
    const char* own_name = element.Attribute("name");
    link_index_.emplace(own_name ? own_name : link.name, static_cast<int>(urdf_.links.size()));
    urdf_.links.push_back(std::move(link));
  }

  UrdfInertia ReadInertia(XMLElement& element, const std::string& where) {
    const double unknown = is_own_ ? kNaN : 0.0;
    UrdfInertia inertia;
    inertia.line = element.GetLineNum();
    WarnOfUnused(element, {"origin", "mass", "inertia"}, {}, where);
    inertia.X_LI = ReadOrigin(element, where);
    XMLElement* mass = Only(element, "mass", where, is_own_);
    inertia.mass = Number(mass, "value", unknown, where);
    if (is_own_ && inertia.mass <= 0.0) Fail(*mass, where + ": the mass must be positive");
    XMLElement* I = Only(element, "inertia", where, is_own_);
    const char* const names[3][3] = {
        {"ixx", "ixy", "ixz"}, {"ixy", "iyy", "iyz"}, {"ixz", "iyz", "izz"}};
    for (int r = 0; r < 3; ++r) {
      for (int c = r; c < 3; ++c) {
        inertia.I_I(r, c) = inertia.I_I(c, r) = Number(I, names[r][c], unknown, where);
      }
    }
    if (is_own_ && !inertia.I_I.hasNaN()) CheckInertia(*I, inertia, where);
    return inertia;
  }

  void CheckInertia(XMLElement& element, const UrdfInertia& inertia, const std::string& where) {
    // In ascending order, and scaled, so that tiny and huge numbers keep their ratios.
    const double scale = inertia.I_I.cwiseAbs().maxCoeff();
    if (scale == 0.0) {
      Fail(element, where + ": the inertia is zero; a moving body needs one");
      return;
    }
    const Vector3d moments =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia.I_I / scale, Eigen::EigenvaluesOnly)
            .eigenvalues();
    if (moments[0] <= 0.0) {
      Fail(element, where + ": the inertia has a principal moment that is not positive");
    } else if (moments[0] + moments[1] < moments[2] * (1.0 - kTriangleTolerance)) {
      Fail(element,
           where +
               ": no body has this inertia: the largest principal moment exceeds the sum of "
               "the other two");
    } else if (inertia.mass > 0.0 &&
               moments[2] * scale > inertia.mass * kLargestExtent * kLargestExtent) {
      Fail(element,
           where +
               ": far too large for the mass, that of a body of more than 2 m across (URDF "
               "is in kg m^2)");
    }
  }

  std::optional<UrdfShape> ReadShape(XMLElement& element, const std::string& where,
                                     bool is_collision) {
    UrdfShape shape;
    const char* name = element.Attribute("name");
    shape.name = name ? name : "";
    shape.line = element.GetLineNum();
    WarnOfUnused(element, {"origin", "geometry", "material"}, {}, where);
    shape.X_LS = ReadOrigin(element, where);
    if (XMLElement* material = Only(element, "material", where, false)) {
      shape.colour = ReadColour(*material, where);
    }
    XMLElement* geometry = Only(element, "geometry", where, false);
    XMLElement* solid = geometry ? geometry->FirstChildElement() : nullptr;
    if (!solid) {
      FailOrRepair(geometry ? *geometry : element,
                   where + ": <geometry> is " + (geometry ? "empty" : "missing"), "left out");
      return {};
    }
    XMLElement* second = solid->NextSiblingElement();
    if (is_own_ && second) Fail(*second, where + ": one shape for each <geometry>");
    const std::string kind = solid->Name();
    if (kind == "sphere") {
      shape.size.setConstant(2.0 * Number(solid, "radius", kNaN, where));
    } else if (kind == "cylinder" || (kind == "capsule" && !is_own_)) {
      const double radius = Number(solid, "radius", kNaN, where);
      const double length = Number(solid, "length", kind == "cylinder" ? kNaN : 0.0, where);
      shape.kind = kind == "cylinder" ? UrdfShape::Kind::kCylinder : UrdfShape::Kind::kCapsule;
      // A capsule's length is that of its cylindrical part.
      shape.size = {2.0 * radius, 2.0 * radius,
                    kind == "cylinder" ? length : length + 2.0 * radius};
    } else if (kind == "box") {
      shape.kind = UrdfShape::Kind::kBox;
      shape.size = Numbers<3>(solid, "size", Vector3d::Constant(kNaN), where);
    } else if (kind == "mesh" && is_own_ && is_collision) {
      Fail(*solid, where + ": a mesh cannot touch; describe it by spheres, cylinders and boxes");
      return {};
    } else if (kind == "mesh") {
      shape.kind = UrdfShape::Kind::kMesh;
      return ReadMesh(*solid, where, shape) ? std::optional(shape) : std::nullopt;
    } else {
      is_own_ ? Fail(*solid, where + ": unknown shape <" + kind + ">" +
                                 SuggestNames(kind, {"sphere", "cylinder", "box", "mesh"}))
              : Warn(*solid, where + ": <" + kind + "> is no shape of URDF; left out");
      return {};
    }
    if (is_own_ &&
        ((shape.size.array() <= 0.0).any() || (shape.size.array() > kLargestExtent).any())) {
      Fail(*solid, where + ": a size must be positive and at most 2 m (URDF is in metres)");
    } else if (is_own_ && is_collision &&
               shape.size.maxCoeff() > kMostElongated * shape.size.minCoeff()) {
      Fail(*solid, where + ": more than 30 times as long as thick; split it or make it thicker");
    } else if (!is_own_ && !(shape.size.array() > 0.0).all()) {
      Warn(*solid, where + ": the " + kind + " has no extent; left out");
      return {};
    }
    return shape;
  }

  bool ReadMesh(XMLElement& element, const std::string& where, UrdfShape& shape) {
    const char* address = element.Attribute("filename");
    shape.mesh = address ? address : "";
    shape.scale = Numbers<3>(&element, "scale", Vector3d::Ones(), where, false);
    if (shape.mesh.empty()) {
      FailOrRepair(element, where + ": <mesh> has no attribute filename", "left out");
      return false;
    }
    if (shape.scale.cwiseAbs().minCoeff() == 0.0) {
      FailOrRepair(element, where + ": a mesh with a scale of 0", "left out");
      return false;
    }
    if (!is_own_) return true;
    const std::string mesh = where + ": mesh \"" + shape.mesh + "\"";
    if (shape.mesh.find("://") != std::string::npos) {
      Fail(element, mesh + " is an address; give a path relative to the hand's folder");
    } else if (std::filesystem::path(shape.mesh).extension() != ".obj") {
      Fail(element, mesh + ": only OBJ files are read; convert it");
    } else if (std::error_code status;
               !std::filesystem::is_regular_file(*folder_ / shape.mesh, status)) {
      Fail(element,
           where + ": mesh not found: \"" + shape.mesh + "\", relative to the hand's folder");
    }
    return true;
  }

  void ReadJoint(XMLElement& element) {
    UrdfJoint& joint = urdf_.joints.emplace_back();
    joint.name = ReadName(element, joint_names_);
    joint.line = element.GetLineNum();
    const std::string where = "joint \"" + joint.name + "\"";
    if (XMLElement* mimic = element.FirstChildElement("mimic"); mimic && is_own_) {
      Warn(*mimic, where + ": <mimic> is not used; name the joint under mimic in hand.yaml");
    }
    WarnOfUnused(element, {"parent", "child", "origin", "axis", "limit"},
                 {"mimic", "dynamics", "safety_controller", "calibration"}, where);
    joint.X_PJ = ReadOrigin(element, where);
    joint.parent = ReadEnd(element, "parent", where);
    joint.child = ReadEnd(element, "child", where);
    const std::string type = Text(element, "type", where);
    if (type.empty() || type == "fixed") return;
    if (type == "revolute") {
      joint.kind = UrdfJoint::Kind::kRevolute;
    } else if (type == "prismatic") {
      joint.kind = UrdfJoint::Kind::kPrismatic;
    } else if (is_own_) {
      Fail(element, where + ": type \"" + type +
                        "\" is not supported; a hand's joints are revolute or prismatic (with "
                        "limits), or fixed");
      return;
    } else if (type == "continuous") {
      joint.kind = UrdfJoint::Kind::kContinuous;
    } else if (type == "floating" || type == "planar") {
      Warn(element, where + ": type \"" + type + "\" is no joint of a hand; taken as fixed");
      return;
    } else {
      Fail(element, where + ": type \"" + type +
                        "\" is not one of URDF: revolute, continuous, prismatic, fixed, floating, "
                        "planar");
      return;
    }
    if (is_own_ && joint.child >= 0 && !urdf_.links[joint.child].inertia) {
      const UrdfLink& child = urdf_.links[joint.child];
      problems_.Fail(file_, child.line,
                     "link \"" + child.name + "\": <inertial> is missing; joint \"" + joint.name +
                         "\" moves it, so it needs mass and inertia");
    }
    ReadMotion(element, where, joint);
  }

  int ReadEnd(XMLElement& joint, const char* role, const std::string& where) {
    XMLElement* element = Only(joint, role, where, true);
    const std::string name = element ? Text(*element, "link", where) : "";
    const auto found = link_index_.find(name);
    if (found != link_index_.end()) return found->second;
    if (name.empty()) return -1;
    Fail(*element, where + ": " + role + " link \"" + name + "\" does not exist" +
                       SuggestNames(name, urdf_.ListLinks()));
    return -1;
  }

  /** Reads axis, limit and mimic of a moving joint. */
  void ReadMotion(XMLElement& element, const std::string& where, UrdfJoint& joint) {
    if (XMLElement* axis = Only(element, "axis", where, false)) {
      const Vector3d xyz = Numbers<3>(axis, "xyz", Vector3d::UnitX(), where);
      if (xyz.norm() < 1e-6) {
        FailOrRepair(*axis, where + ": the axis has no direction", "taken as x");
      } else {
        joint.axis = xyz.normalized();
      }
    }
    if (XMLElement* e = Only(element, "limit", where, is_own_)) {
      UrdfLimit& limit = joint.limit.emplace();
      limit.line = e->GetLineNum();
      const double effort = Number(e, "effort", kNaN, where);
      if (!std::isnan(effort)) limit.effort = effort;
      // An omitted limit is zero in URDF.
      const auto read = [&](const char* end) {
        return Number(e, end, is_own_ || e->Attribute(end) ? kNaN : 0.0, where);
      };
      limit.lower = read("lower");
      limit.upper = read("upper");
      if (is_own_) CheckLimit(*e, limit, joint.kind == UrdfJoint::Kind::kPrismatic, where);
    }
    XMLElement* mimic = element.FirstChildElement("mimic");
    if (!mimic || is_own_) return;
    const char* follows = mimic->Attribute("joint");
    joint.mimic = UrdfMimic{follows ? follows : "", Number(mimic, "multiplier", 1.0, where),
                            Number(mimic, "offset", 0.0, where), mimic->GetLineNum()};
  }

  void CheckLimit(XMLElement& element, const UrdfLimit& limit, bool is_prismatic,
                  const std::string& where) {
    Number(&element, "velocity", 0.0, where);
    if (limit.lower >= limit.upper) {
      Fail(element, where + ": the lower limit " + element.Attribute("lower") +
                        " is not below the upper limit " + element.Attribute("upper"));
    }
    const double largest = std::max(-limit.lower, limit.upper);
    if (is_prismatic && largest > kLargestStroke) {
      Fail(element, where + ": a limit exceeds 1 m; URDF lengths are in metres");
    } else if (!is_prismatic && largest > 2.0 * kPi) {
      Fail(element, where + ": a limit exceeds one turn; URDF angles are in radians");
    }
  }

  void CheckTree() {
    std::vector<const UrdfJoint*> above(urdf_.links.size(), nullptr);
    for (const UrdfJoint& joint : urdf_.joints) {
      if (joint.parent < 0 || joint.child < 0) continue;
      const UrdfJoint*& other = above[joint.child];
      if (other) {
        problems_.Fail(file_, joint.line,
                       "joint \"" + joint.name + "\": link \"" + urdf_.links[joint.child].name +
                           "\" already hangs on joint \"" + other->name + "\" (line " +
                           std::to_string(other->line) +
                           "); a hand is a tree, so cut the loop and give one side a mimic");
      } else {
        other = &joint;
      }
    }
    // Walk up from every link, visiting none twice: meeting the current walk again is a cycle.
    std::vector<size_t> walks(urdf_.links.size(), urdf_.links.size());
    std::vector<std::string> roots;
    int line = 0;  // of the second root
    for (size_t i = 0; i < urdf_.links.size(); ++i) {
      if (!above[i]) {
        roots.push_back(urdf_.links[i].name);
        if (roots.size() == 2) line = urdf_.links[i].line;
      }
      size_t at = i;
      for (; above[at] && walks[at] == urdf_.links.size(); at = above[at]->parent) walks[at] = i;
      if (!above[at] || walks[at] != i) continue;
      std::vector<std::string> cycle;
      const int cycle_line = above[at]->line;
      const size_t begin = at;
      do {
        cycle.push_back(above[at]->name);
        at = above[at]->parent;
      } while (at != begin);
      problems_.Fail(file_, cycle_line,
                     "the joints " + JoinSome(cycle) + " form a cycle; a hand is a tree");
    }
    if (roots.size() > 1) {
      problems_.Fail(file_, line,
                     "several roots: " + JoinSome(roots) +
                         "; join all links into one tree below the link that the arm carries");
    }
  }

  std::optional<std::filesystem::path> folder_;
  Urdf urdf_;
  Names link_names_{"link"}, joint_names_{"joint"};
  std::map<std::string, int> link_index_;  // by the name in the file
  bool are_ends_known_ = true;             // of all joints
  std::map<std::string, Vector3d> colours_;
};

}  // namespace

std::vector<std::string> Urdf::ListLinks() const {
  std::vector<std::string> names;
  for (const UrdfLink& link : links) names.push_back(link.name);
  return names;
}

std::vector<std::string> Urdf::ListMovingJoints() const {
  std::vector<std::string> names;
  for (const UrdfJoint& joint : joints) {
    const bool is_new = std::find(names.begin(), names.end(), joint.name) == names.end();
    if (joint.kind != UrdfJoint::Kind::kFixed && is_new) names.push_back(joint.name);
  }
  return names;
}

Urdf ReadUrdf(const std::string& text, const std::string& file,
              const std::optional<std::filesystem::path>& own_folder, Diagnostics& problems) {
  return UrdfReader(file, own_folder, problems).Read(text);
}

}  // namespace graspbench
