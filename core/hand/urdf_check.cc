#include "core/hand/urdf_check.h"

#include <tinyxml2.h>

#include <Eigen/Dense>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>

namespace graspbench {
namespace {

using tinyxml2::XMLElement;

constexpr double kLargestExtent = 2.0;       // [m]; a larger part is a mistake of units
constexpr double kLargestStroke = 1.0;       // [m] of a prismatic joint
constexpr double kMostElongated = 30.0;      // length / thickness of a collision shape
constexpr double kTriangleTolerance = 1e-3;  // relative, for inertia given with few digits

std::string Join(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
  return text;
}

/** `count` numbers separated by blanks; nothing when there are more, fewer or other characters. */
std::optional<std::vector<double>> ParseNumbers(const char* text, size_t count) {
  std::vector<double> numbers;
  const char* const end = text + std::strlen(text);
  for (const char* at = text;;) {
    while (at != end && std::isspace(static_cast<unsigned char>(*at))) ++at;
    if (at == end) break;
    if (*at == '+') ++at;  // from_chars does not take it
    double number = 0.0;
    const auto [next, status] = std::from_chars(at, end, number);
    if (status != std::errc() || !std::isfinite(number)) return std::nullopt;
    if (next != end && !std::isspace(static_cast<unsigned char>(*next))) return std::nullopt;
    numbers.push_back(number);
    at = next;
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

class UrdfChecker {
 public:
  UrdfChecker(std::string file, std::filesystem::path folder, Diagnostics& problems)
      : file_(std::move(file)), folder_(std::move(folder)), problems_(problems) {}

  UrdfOutline Check(const std::string& text);

 private:
  struct JointLine {
    std::string name, parent, child;
    int line = 0;
  };

  void CheckMaterial(XMLElement& material, const std::string& where);
  void CheckLink(XMLElement& link);
  void CheckInertial(XMLElement& inertial, const std::string& where);
  void CheckShape(XMLElement& shape, const std::string& where, bool is_collision);
  void CheckMesh(XMLElement& mesh, const std::string& where);
  void CheckJoint(XMLElement& joint);
  /** The links that it joins; noted for CheckTree when both are there. */
  JointLine ReadEnds(XMLElement& joint, const std::string& name, const std::string& where);
  void CheckLimit(XMLElement& joint, bool is_prismatic, const std::string& where);
  void CheckTree();

  void Fail(const XMLElement& at, const std::string& text) {
    problems_.Fail(file_, at.GetLineNum(), text);
  }
  /** The child of that name, with a problem when it is needed and absent. */
  XMLElement* Only(XMLElement& parent, const char* name, const std::string& where, bool is_needed);
  std::string Text(XMLElement& element, const char* attribute, const std::string& where);
  std::optional<std::vector<double>> Numbers(XMLElement& element, const char* attribute,
                                             size_t count, const std::string& where,
                                             bool is_needed = true);
  void CheckOrigin(XMLElement& parent, const std::string& where);
  /** Takes away what the model does not use; a name that is not URDF's gets a warning. */
  void Prune(XMLElement& parent, const std::vector<std::string>& used,
             const std::vector<std::string>& ignored, const std::string& where);

  std::string file_;
  std::filesystem::path folder_;
  Diagnostics& problems_;
  std::map<std::string, int> link_lines_;
  std::map<std::string, bool> has_inertial_;
  std::set<std::string> joint_names_, materials_;
  std::vector<JointLine> joints_;
  UrdfOutline outline_;
};

XMLElement* UrdfChecker::Only(XMLElement& parent, const char* name, const std::string& where,
                              bool is_needed) {
  XMLElement* child = parent.FirstChildElement(name);
  if (!child) {
    if (is_needed) Fail(parent, where + ": <" + name + "> is missing");
    return nullptr;
  }
  if (XMLElement* second = child->NextSiblingElement(name)) {
    Fail(*second, where + ": a second <" + name + ">; one is allowed");
  }
  return child;
}

std::string UrdfChecker::Text(XMLElement& element, const char* attribute,
                              const std::string& where) {
  const char* text = element.Attribute(attribute);
  if (text && *text) return text;
  Fail(element, where + ": <" + element.Name() + "> has no attribute " + attribute);
  return "";
}

std::optional<std::vector<double>> UrdfChecker::Numbers(XMLElement& element, const char* attribute,
                                                        size_t count, const std::string& where,
                                                        bool is_needed) {
  const char* text = element.Attribute(attribute);
  if (!text) {
    if (is_needed) Text(element, attribute, where);
    return std::nullopt;
  }
  auto numbers = ParseNumbers(text, count);
  if (!numbers) {
    Fail(element, where + ", <" + element.Name() + "> " + attribute + ": expected " +
                      (count == 1 ? "a finite number" : std::to_string(count) + " finite numbers") +
                      ", found \"" + text + "\"");
  }
  return numbers;
}

void UrdfChecker::CheckOrigin(XMLElement& parent, const std::string& where) {
  if (XMLElement* origin = Only(parent, "origin", where, false)) {
    const auto xyz = Numbers(*origin, "xyz", 3, where, false);
    if (xyz && std::hypot((*xyz)[0], (*xyz)[1], (*xyz)[2]) > kLargestExtent) {
      Fail(*origin, where + ": farther than 2 m away (URDF is in metres)");
    }
    Numbers(*origin, "rpy", 3, where, false);
    const std::string unknown = FindUnknownInOrigin(*origin);
    if (!unknown.empty()) Fail(*origin, where + unknown);
  }
}

void UrdfChecker::Prune(XMLElement& parent, const std::vector<std::string>& used,
                        const std::vector<std::string>& ignored, const std::string& where) {
  const auto contains = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (XMLElement* child = parent.FirstChildElement(); child;) {
    XMLElement* next = child->NextSiblingElement();
    const std::string name = child->Name();
    if (!contains(used, name)) {
      if (!contains(ignored, name)) {
        problems_.Warn(file_, child->GetLineNum(),
                       where + ": <" + name + "> is not used" + SuggestNames(name, used));
      }
      parent.DeleteChild(child);
    }
    child = next;
  }
}

void UrdfChecker::CheckMaterial(XMLElement& material, const std::string& where) {
  Text(material, "name", where);
  Prune(material, {"color"}, {"texture"}, where);
  if (XMLElement* color = Only(material, "color", where, false)) {
    if (const auto rgba = Numbers(*color, "rgba", 4, where)) {
      if (std::any_of(rgba->begin(), rgba->end(), [](double v) { return v < 0.0 || v > 1.0; })) {
        Fail(*color, where + ": a colour's numbers lie between 0 and 1");
      }
    }
  }
}

void UrdfChecker::CheckInertial(XMLElement& inertial, const std::string& where) {
  Prune(inertial, {"origin", "mass", "inertia"}, {}, where);
  CheckOrigin(inertial, where);
  double mass = 0.0;
  if (XMLElement* element = Only(inertial, "mass", where, true)) {
    const auto value = Numbers(*element, "value", 1, where);
    if (value) mass = value->front();
    if (value && mass <= 0.0) Fail(*element, where + ": the mass must be positive");
  }
  XMLElement* inertia = Only(inertial, "inertia", where, true);
  if (!inertia) return;
  Eigen::Matrix3d I = Eigen::Matrix3d::Zero();
  bool is_complete = true;
  const char* names[3][3] = {{"ixx", "ixy", "ixz"}, {"ixy", "iyy", "iyz"}, {"ixz", "iyz", "izz"}};
  for (int r = 0; r < 3; ++r) {
    for (int c = r; c < 3; ++c) {
      const auto value = Numbers(*inertia, names[r][c], 1, where);
      is_complete = is_complete && value;
      if (value) I(r, c) = I(c, r) = value->front();
    }
  }
  if (!is_complete) return;
  // Sorted upwards. Scaled, so that tiny and huge numbers keep their ratios.
  const double scale = I.cwiseAbs().maxCoeff();
  if (scale == 0.0) {
    Fail(*inertia, where + ": the inertia is zero; a moving body needs one");
    return;
  }
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(I / scale, Eigen::EigenvaluesOnly)
          .eigenvalues();
  if (moments[0] <= 0.0) {
    Fail(*inertia, where + ": the inertia has a principal moment that is not positive");
  } else if (moments[0] + moments[1] < moments[2] * (1.0 - kTriangleTolerance)) {
    Fail(*inertia, where +
                       ": no body has this inertia: the largest principal moment exceeds the sum "
                       "of the other two");
  } else if (mass > 0.0 && moments[2] * scale > mass * kLargestExtent * kLargestExtent) {
    Fail(*inertia, where +
                       ": far too large for the mass, that of a body of more than 2 m across "
                       "(URDF is in kg m^2)");
  }
}

void UrdfChecker::CheckMesh(XMLElement& mesh, const std::string& where) {
  Numbers(mesh, "scale", 3, where, false);
  const std::string filename = Text(mesh, "filename", where);
  if (filename.empty()) return;
  if (filename.find("://") != std::string::npos) {
    Fail(mesh, where + ": mesh \"" + filename +
                   "\" is an address; give a path relative to the hand's folder");
  } else if (std::filesystem::path(filename).extension() != ".obj") {
    Fail(mesh, where + ": mesh \"" + filename + "\": only OBJ files are read; convert it");
  } else if (std::error_code status;
             !std::filesystem::is_regular_file(folder_ / filename, status)) {
    Fail(mesh, where + ": mesh not found: \"" + filename + "\", relative to the hand's folder");
  }
}

void UrdfChecker::CheckShape(XMLElement& shape, const std::string& where, bool is_collision) {
  Prune(shape, {"origin", "geometry", "material"}, {}, where);
  CheckOrigin(shape, where);
  if (XMLElement* material = Only(shape, "material", where, false)) {
    CheckMaterial(*material, where);
    const char* name = material->Attribute("name");
    if (name && material->FirstChildElement("color")) materials_.insert(name);
    if (name && materials_.count(name) == 0) {
      Fail(*material, where + ": material \"" + name + "\" is not defined" +
                          SuggestNames(name, {materials_.begin(), materials_.end()}));
    }
  }
  XMLElement* geometry = Only(shape, "geometry", where, true);
  if (!geometry) return;
  XMLElement* solid = geometry->FirstChildElement();
  if (!solid) {
    Fail(*geometry, where + ": <geometry> is empty");
    return;
  }
  if (XMLElement* second = solid->NextSiblingElement()) {
    Fail(*second, where + ": one shape for each <geometry>");
  }
  const std::string kind = solid->Name();
  std::vector<double> extents;
  const auto read = [&](const char* attribute, size_t count, double factor) {
    if (const auto numbers = Numbers(*solid, attribute, count, where)) {
      for (double number : *numbers) extents.push_back(factor * number);
    }
  };
  if (kind == "sphere") {
    read("radius", 1, 2.0);
  } else if (kind == "cylinder") {
    read("radius", 1, 2.0);
    read("length", 1, 1.0);
  } else if (kind == "box") {
    read("size", 3, 1.0);
  } else if (kind == "mesh" && !is_collision) {
    CheckMesh(*solid, where);
  } else if (kind == "mesh") {
    Fail(*solid, where + ": a mesh cannot touch; describe it by spheres, cylinders and boxes");
  } else {
    Fail(*solid, where + ": unknown shape <" + kind + ">" +
                     SuggestNames(kind, {"sphere", "cylinder", "box", "mesh"}));
  }
  if (extents.empty()) return;
  const auto [smallest, largest] = std::minmax_element(extents.begin(), extents.end());
  if (*smallest <= 0.0 || *largest > kLargestExtent) {
    Fail(*solid, where + ": a size must be positive and at most 2 m (URDF is in metres)");
  } else if (is_collision && *largest > kMostElongated * *smallest) {
    Fail(*solid, where + ": more than 30 times as long as thick; split it or make it thicker");
  }
}

void UrdfChecker::CheckLink(XMLElement& link) {
  const std::string name = Text(link, "name", "link");
  const std::string where = "link \"" + name + "\"";
  if (!name.empty()) {
    const auto [known, is_new] = link_lines_.emplace(name, link.GetLineNum());
    if (is_new) {
      outline_.links.push_back(name);
    } else {
      Fail(link, where + ": the name is taken by line " + std::to_string(known->second));
    }
  }
  Prune(link, {"inertial", "visual", "collision"}, {}, where);
  XMLElement* inertial = Only(link, "inertial", where, false);
  has_inertial_[name] = inertial != nullptr;
  if (inertial) CheckInertial(*inertial, where + ", inertial");
  for (const char* kind : {"visual", "collision"}) {
    for (XMLElement* shape = link.FirstChildElement(kind); shape;
         shape = shape->NextSiblingElement(kind)) {
      CheckShape(*shape, where + ", " + kind, std::strcmp(kind, "collision") == 0);
    }
  }
}

UrdfChecker::JointLine UrdfChecker::ReadEnds(XMLElement& joint, const std::string& name,
                                             const std::string& where) {
  JointLine ends;
  ends.name = name;
  ends.line = joint.GetLineNum();
  for (const auto& [role, end] : {std::pair{"parent", &ends.parent}, {"child", &ends.child}}) {
    XMLElement* element = Only(joint, role, where, true);
    if (!element) continue;
    *end = Text(*element, "link", where);
    if (!end->empty() && link_lines_.count(*end) == 0) {
      Fail(*element, where + ": " + role + " link \"" + *end + "\" does not exist" +
                         SuggestNames(*end, outline_.links));
      end->clear();
    }
  }
  if (!ends.parent.empty() && !ends.child.empty()) joints_.push_back(ends);
  return ends;
}

void UrdfChecker::CheckJoint(XMLElement& joint) {
  const std::string name = Text(joint, "name", "joint");
  const std::string where = "joint \"" + name + "\"";
  const bool is_new = joint_names_.insert(name).second;
  if (!name.empty() && !is_new) Fail(joint, where + ": the name is taken by another joint");
  if (XMLElement* mimic = joint.FirstChildElement("mimic")) {
    problems_.Warn(file_, mimic->GetLineNum(),
                   where + ": <mimic> is not used; name the joint under mimic in hand.yaml");
  }
  Prune(joint, {"parent", "child", "origin", "axis", "limit"},
        {"mimic", "dynamics", "safety_controller", "calibration"}, where);
  CheckOrigin(joint, where);

  const JointLine ends = ReadEnds(joint, name, where);
  const std::string type = Text(joint, "type", where);
  if (type == "fixed" || type.empty()) return;
  if (type != "revolute" && type != "prismatic") {
    Fail(joint, where + ": type \"" + type +
                    "\" is not supported; a hand's joints are revolute or prismatic (with limits), "
                    "or fixed");
    return;
  }
  if (is_new) outline_.moving_joints.push_back(name);
  if (!ends.child.empty() && !has_inertial_[ends.child]) {
    problems_.Fail(file_, link_lines_[ends.child],
                   "link \"" + ends.child + "\": <inertial> is missing; joint \"" + name +
                       "\" moves it, so it needs mass and inertia");
  }
  if (XMLElement* axis = Only(joint, "axis", where, false)) {
    const auto xyz = Numbers(*axis, "xyz", 3, where);
    if (xyz && std::hypot((*xyz)[0], (*xyz)[1], (*xyz)[2]) < 1e-6) {
      Fail(*axis, where + ": the axis has no direction");
    }
  }
  CheckLimit(joint, type == "prismatic", where);
}

void UrdfChecker::CheckLimit(XMLElement& joint, bool is_prismatic, const std::string& where) {
  XMLElement* limit = Only(joint, "limit", where, true);
  if (!limit) return;
  Numbers(*limit, "effort", 1, where);
  Numbers(*limit, "velocity", 1, where);
  const auto lower = Numbers(*limit, "lower", 1, where);
  const auto upper = Numbers(*limit, "upper", 1, where);
  if (!lower || !upper) return;
  if (lower->front() >= upper->front()) {
    Fail(*limit, where + ": the lower limit " + limit->Attribute("lower") +
                     " is not below the upper limit " + limit->Attribute("upper"));
  }
  const double largest = std::max(-lower->front(), upper->front());
  if (is_prismatic && largest > kLargestStroke) {
    Fail(*limit, where + ": a limit exceeds 1 m; URDF lengths are in metres");
  } else if (!is_prismatic && largest > 2.0 * EIGEN_PI) {
    Fail(*limit, where + ": a limit exceeds one turn; URDF angles are in radians");
  }
}

void UrdfChecker::CheckTree() {
  std::map<std::string, const JointLine*> joint_of_child;
  for (const JointLine& joint : joints_) {
    const auto [known, is_new] = joint_of_child.emplace(joint.child, &joint);
    if (!is_new) {
      problems_.Fail(file_, joint.line,
                     "joint \"" + joint.name + "\": link \"" + joint.child +
                         "\" already hangs on joint \"" + known->second->name + "\"");
    }
  }
  // A link that does not reach a root by going up as many joints as there are lies in a cycle or
  // hangs on one; the cycle itself is reported once, by its joints.
  std::vector<std::string> roots;
  std::set<std::string> reported;
  for (const std::string& link : outline_.links) {
    if (joint_of_child.count(link) == 0) {
      roots.push_back(link);
      continue;
    }
    std::string at = link;
    size_t num_joints = 0;
    while (joint_of_child.count(at) != 0 && num_joints++ < joints_.size()) {
      at = joint_of_child[at]->parent;
    }
    if (joint_of_child.count(at) == 0 || reported.count(at) != 0) continue;
    std::vector<std::string> cycle;
    const int line = joint_of_child[at]->line;
    while (reported.insert(at).second) {
      cycle.push_back(joint_of_child[at]->name);
      at = joint_of_child[at]->parent;
    }
    problems_.Fail(file_, line, "the joints " + Join(cycle) + " form a cycle; a hand is a tree");
  }
  if (roots.size() > 1) {
    problems_.Fail(file_, link_lines_[roots[1]],
                   "several roots: " + Join(roots) +
                       "; join all links into one tree below the link that the arm carries");
  }
}

UrdfOutline UrdfChecker::Check(const std::string& text) {
  const int num_errors_before = problems_.num_errors();
  tinyxml2::XMLDocument document;
  if (const tinyxml2::XMLError error = document.Parse(text.data(), text.size());
      error != tinyxml2::XML_SUCCESS) {
    problems_.Fail(file_, document.ErrorLineNum(),
                   std::string("not valid XML: ") +
                       (error == tinyxml2::XML_ERROR_MISMATCHED_ELEMENT
                            ? "this element is not closed by its own name"
                            : "a tag or a value from here on is not closed or not well-formed (" +
                                  std::string(document.ErrorName()) + ")"));
    return {};
  }
  XMLElement* robot = document.RootElement();
  if (!robot || std::strcmp(robot->Name(), "robot") != 0) {
    problems_.Fail(file_, robot ? robot->GetLineNum() : 0,
                   "not a URDF: the outermost element must be <robot>");
    return {};
  }
  Text(*robot, "name", "robot");
  Prune(*robot, {"material", "link", "joint"}, {"gazebo", "transmission", "sensor"}, "robot");
  const auto for_each = [&](const char* name, auto&& check) {
    for (XMLElement* e = robot->FirstChildElement(name); e; e = e->NextSiblingElement(name)) {
      check(*e);
    }
  };
  for_each("material", [this](XMLElement& material) {
    CheckMaterial(material, "material");
    if (!material.FirstChildElement("color")) Fail(material, "material: <color> is missing");
    if (const char* name = material.Attribute("name")) materials_.insert(name);
  });
  for_each("link", [this](XMLElement& link) { CheckLink(link); });
  for_each("joint", [this](XMLElement& joint) { CheckJoint(joint); });
  if (outline_.links.empty()) Fail(*robot, "the hand has no link");
  if (outline_.moving_joints.empty()) Fail(*robot, "the hand has no moving joint");
  CheckTree();
  if (problems_.num_errors() == num_errors_before) {
    tinyxml2::XMLPrinter printer;
    robot->Accept(&printer);
    outline_.document = printer.CStr();
  }
  return std::move(outline_);
}

}  // namespace

UrdfOutline CheckUrdf(const std::string& text, const std::string& file,
                      const std::filesystem::path& folder, Diagnostics& problems) {
  return UrdfChecker(file, folder, problems).Check(text);
}

std::string FindUnknownInOrigin(const XMLElement& origin) {
  std::string found;
  for (const tinyxml2::XMLAttribute* a = origin.FirstAttribute(); a && found.empty();
       a = a->Next()) {
    const std::string name = a->Name();
    if (name != "xyz" && name != "rpy") found = "attribute \"" + name + "\"";
  }
  for (const tinyxml2::XMLNode* n = origin.FirstChild(); n && found.empty(); n = n->NextSibling()) {
    if (const XMLElement* element = n->ToElement()) {
      found = std::string("element <") + element->Name() + ">";
    } else if (n->ToText()) {
      found = std::string("text \"") + n->Value() + "\"";
    }
  }
  if (found.empty()) return "";
  return ": its <origin> has the " + found +
         "; expected the attributes \"xyz\" (a place in metres) and \"rpy\" (roll, pitch, yaw in "
         "radians) alone; give the place and the rotation by these";
}

}  // namespace graspbench
