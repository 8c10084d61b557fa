#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/import/checks/joint_limits.h"
#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/mjcf/mjcf_couplings.h"
#include "core/hand/import/mjcf/mjcf_document.h"
#include "core/hand/import/mjcf/mjcf_meshes.h"
#include "core/hand/import/read_foreign_urdf.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using tinyxml2::XMLElement;

constexpr int kLastGroupShown = 2;

/** Elements of a model and of a body that do not matter for a hand. */
const std::set<std::string>& ListSilentElements() {
  static const std::set<std::string> kinds = {
      "option",    "size",   "visual",   "statistic", "default", "custom",
      "keyframe",  "sensor", "asset",    "tendon",    "camera",  "light",
      "worldbody", "site",   "compiler", "equality",  "contact", "actuator"};
  return kinds;
}

class MjcfReader {
 public:
  MjcfReader(const std::string& file, const std::filesystem::path& folder,
             std::optional<bool> in_degrees, Diagnostics& problems)
      : file_(file),
        document_(file, folder, in_degrees, problems),
        problems_(problems),
        is_angle_told_(in_degrees.has_value()) {}

  ForeignHand Read(const std::string& text) {
    if (!document_.Parse(text)) return {};
    if (!CheckIsWhole()) return {};
    hand_.name = document_.FindName();
    for (const char* kind : {"extension", "deformable"}) {
      for (XMLElement* section : document_.FindSections(kind)) WarnOnce(*section, kind);
    }
    ReadAssets();
    ReadWorld();
    if (hand_.links.size() == 1)
      problems_.Fail(file_, 0, "the model has no body whose joint moves");
    if (hand_.links.size() >= kMostLinks) {
      problems_.Fail(file_, 0, "the model has 1000 bodies or more: no hand");
    }
    if (!AreErrorsLocal(hand_, problems_)) return {};
    const std::string doubt = angles_.FindDoubt(document_.settings().in_degrees);
    if (!doubt.empty() && !is_angle_told_) problems_.Warn(file_, angles_.first_line, doubt);
    ReadMjcfCouplings(document_, bodies_, file_, problems_, hand_);
    hand_.included = document_.ListIncluded();
    hand_.least_mass = document_.settings().least_mass;
    hand_.least_moment = document_.settings().least_moment;
    return std::move(hand_);
  }

 private:
  /** Returns false, with an error, for a file that another one includes. */
  bool CheckIsWhole() {
    const bool has_bodies = !document_.FindSections("worldbody").empty();
    if (document_.IsFragment() || !has_bodies) {
      problems_.Fail(file_, 0,
                     std::string(document_.IsFragment() ? "the outermost element is <mujocoinclude>"
                                                        : "the model has no <worldbody>") +
                         ": a fragment of a model; give the file that includes it");
      return false;
    }
    return true;
  }

  /** Frame of a body's content in the body's last link, and the classes that apply. */
  struct Place {
    int link = 0;
    Pose X_LB = Pose::Identity();
    const MjcfClass* childclass = nullptr;
  };

  void ReadAssets() {
    for (XMLElement* section : document_.FindSections("asset")) {
      for (XMLElement* element : document_.ListChildren(*section)) {
        const std::string kind = element->Name();
        if (kind == "mesh") meshes_.Read(*element);
        const char* name = element->Attribute("name");
        if (kind == "material" && name) materials_.emplace(name, element);
        if (kind == "model" || kind == "skin") WarnOnce(*element, kind);
      }
    }
  }

  void ReadWorld() {
    std::vector<std::string> changes;
    AddLink(link_names_.Add("world", changes), 0);
    hand_.world = 0;
    bodies_.emplace("world", MjcfBody());
    int num_moving = 0;
    for (XMLElement* world : document_.FindSections("worldbody")) {
      for (XMLElement* element : document_.ListChildren(*world)) {
        const std::string kind = element->Name();
        if (kind == "body" || kind == "frame") num_moving += Moves(*element, nullptr);
      }
    }
    keeps_world_ = num_moving > 1;
    for (XMLElement* world : document_.FindSections("worldbody")) {
      Place place;
      place.childclass = document_.FindChildClass(*world, nullptr);
      const size_t first = problems_.entries().size();
      ReadContent(*world, place, true);
      ClaimEntriesFrom(first, 0);
    }
  }

  /** Whether a hinge or slide belongs to the body or to one below. */
  bool Moves(XMLElement& body, const MjcfClass* childclass) {
    const MjcfClass* own = document_.FindChildClass(body, childclass);
    for (XMLElement* element : document_.ListChildren(body)) {
      const std::string kind = element->Name();
      if (kind == "joint") {
        const char* type = document_.Find(document_.Resolve(*element, own), "type");
        const std::string text = type ? type : "hinge";
        if (text == "hinge" || text == "slide") return true;
      }
      if ((kind == "body" || kind == "frame" || kind == "replicate") && Moves(*element, own))
        return true;
    }
    return false;
  }

  void ReadContent(XMLElement& parent, const Place& place, bool is_world) {
    for (XMLElement* element : document_.ListChildren(parent)) {
      const std::string kind = element->Name();
      if (hand_.links.size() >= kMostLinks) return;
      if (kind == "body") {
        if (!is_world || keeps_world_ || Moves(*element, place.childclass)) {
          ReadBody(*element, place);
        } else {
          const char* name = element->Attribute("name");
          document_.Warn(*element,
                         "body \"" + std::string(name ? name : "") +
                             "\": no joint moves below it: a part of the scene; left out");
        }
      } else if (kind == "frame") {
        Place inner = place;
        const MjcfNode node = {element, nullptr};
        inner.X_LB = place.X_LB * document_.FindPose(node, "frame", true);
        inner.childclass = document_.FindChildClass(*element, place.childclass);
        ReadContent(*element, inner, is_world);
      } else if (kind == "geom") {
        if (!is_world || keeps_world_) {
          ReadGeom(document_.Resolve(*element, place.childclass), place);
        } else if (told_.insert("world's geoms").second) {
          document_.Warn(*element, "shapes of the world belong to the scene; left out");
        }
      } else if (kind == "replicate" || kind == "attach" || kind == "composite" ||
                 kind == "flexcomp") {
        document_.Fail(*element, "<" + kind +
                                     "> makes bodies and is not read; save the compiled model with "
                                     "MuJoCo (mj_saveLastXML) and give that");
      } else if (kind == "inertial") {
        ReadInertial({element, nullptr}, place);
      } else if (kind != "joint" && kind != "freejoint" && ListSilentElements().count(kind) == 0) {
        WarnOnce(*element, kind);
      }
    }
  }

  void ReadBody(XMLElement& element, const Place& above) {
    const size_t first = problems_.entries().size();
    const std::string name = FindName(element, link_names_, "");
    Place place;
    place.childclass = document_.FindChildClass(element, above.childclass);
    const Pose X_PB =
        above.X_LB * document_.FindPose({&element, nullptr}, "body \"" + name + "\"", true);
    place.X_LB = AddJoints(element, place.childclass, name, X_PB, above.link);
    place.link = static_cast<int>(hand_.links.size()) - 1;
    const int link = place.link;
    hand_.links[static_cast<size_t>(link)].X_LF = place.X_LB;
    bodies_.emplace(name, MjcfBody{link, place.X_LB});
    ReadContent(element, place, false);
    ClaimEntriesFrom(first, link);
    // Contact shapes are also visible, unless there is a visual.
    ForeignLink& own = hand_.links[static_cast<size_t>(link)];
    if (own.inertia) own.weights.clear();
    const MjcfSettings& settings = document_.settings();
    if (!own.inertia && own.weights.empty() && settings.least_mass > 0.0) {
      own.inertia.emplace().line = own.line;  // MuJoCo raises it to the bounds (RaiseToBounds)
      own.inertia->X_LI = place.X_LB;
    }
    if (!has_picture_[static_cast<size_t>(link)]) return;
    const auto is_plain = [](const ForeignShape& shape) {
      return shape.kind != ForeignShape::Kind::kMesh && shape.also_touches;
    };
    own.visuals.erase(std::remove_if(own.visuals.begin(), own.visuals.end(), is_plain),
                      own.visuals.end());
  }

  /** Assigns the problems reported since `first` to the link, except those of bodies on it. */
  void ClaimEntriesFrom(size_t first, int link) {
    for (size_t k = first; k < problems_.entries().size(); ++k) {
      if (claimed_.insert(k).second) hand_.links[static_cast<size_t>(link)].told.push_back(k);
    }
  }

  int AddLink(const std::string& name, int line) {
    ForeignLink& link = hand_.links.emplace_back();
    link.name = name;
    link.line = line;
    has_picture_.push_back(false);
    return static_cast<int>(hand_.links.size()) - 1;
  }

  /** Adds the body's links, one per joint, or one that is fixed. Its content belongs to the last.
@returns the body's frame in that link, whose own frame is that of its joint. */
  Pose AddJoints(XMLElement& element, const MjcfClass* childclass, const std::string& body,
                 const Pose& X_PB, int parent) {
    std::vector<MjcfNode> joints;
    for (XMLElement* e : document_.ListChildren(element)) {
      const std::string kind = e->Name();
      if (kind != "joint" && kind != "freejoint") continue;
      const MjcfNode node = document_.Resolve(*e, childclass);
      const char* type_text = document_.Find(node, "type");
      const std::string type = kind == "freejoint" ? "free" : type_text ? type_text : "hinge";
      if (type == "hinge" || type == "slide") {
        joints.push_back(node);
      } else {
        document_.Warn(*e,
                       "body \"" + body + "\": a joint of type \"" + type + "\" is fixed" +
                           (type == "free" ? ": the arm of an experiment carries the hand" : ""));
      }
    }
    const int line = document_.LineOf(element);
    if (joints.empty()) {
      const int child = AddLink(body, line);
      ForeignJoint& joint = hand_.joints.emplace_back();
      std::vector<std::string> changes;
      joint.name = joint_names_.Add(("fixed_" + body).c_str(), changes);
      joint.line = line;
      joint.parent = parent;
      joint.child = child;
      joint.X_PJ = X_PB;
      return Pose::Identity();
    }
    Pose X_PF = X_PB;  // the body's frame in the link above
    Vector3d p_BJ = Vector3d::Zero();
    for (size_t i = 0; i < joints.size(); ++i) {
      const std::string where = "a joint of body \"" + body + "\"";
      const char* type = document_.Find(joints[i], "type");
      if (!type || std::string(type) == "hinge") {  // a slide has no position
        p_BJ = document_.FindVector(joints[i], "pos", Vector3d::Zero(), where, true);
      }
      std::string name = body;
      if (i + 1 < joints.size()) {
        std::vector<std::string> changes;
        name = link_names_.Add((body + "_" + std::to_string(i + 1)).c_str(), changes);
      }
      const int child = AddLink(name, line);
      ReadJoint(joints[i], X_PF * MakePose(p_BJ), parent, child);
      parent = child;
      X_PF = MakePose(-p_BJ);
    }
    return X_PF;
  }

  void ReadJoint(const MjcfNode& node, const Pose& X_PJ, int parent, int child) {
    const char* type = document_.Find(node, "type");
    ForeignJoint joint;
    joint.name = FindName(*node.xml, joint_names_, hand_.links[static_cast<size_t>(child)].name);
    joint.line = document_.LineOf(*node.xml);
    joint.parent = parent;
    joint.child = child;
    joint.X_PJ = X_PJ;
    const bool slides = type && std::string(type) == "slide";
    joint.kind = slides ? ForeignJoint::Kind::kPrismatic : ForeignJoint::Kind::kRevolute;
    const std::string where = "joint \"" + joint.name + "\"";
    const Vector3d axis = document_.FindVector(node, "axis", Vector3d::UnitZ(), where);
    if (axis.norm() > 1e-6) {
      joint.axis = axis.normalized();
    } else {
      document_.Warn(*node.xml, where + ": the axis has no direction; taken as z");
      joint.axis = Vector3d::UnitZ();
    }
    const double unit = !slides && document_.settings().in_degrees ? RadFromDeg(1.0) : 1.0;
    const double ref = unit * document_.FindNumber(node, "ref", 0.0, where);
    if (ref != 0.0) {
      document_.Warn(*node.xml, where + ": its zero is its place in the file, which MuJoCo calls " +
                                    (slides ? FormatFixed(MmFromM(ref), 1) + " mm"
                                            : FormatFixed(DegFromRad(ref), 1) + " deg"));
    }
    const char* limited = document_.Find(node, "limited");
    const auto range = document_.FindNumbers(node, "range", 2, 2, where);
    StatedLimits limits;
    if (!range || (limited && std::string(limited) == "false")) {
      limits.missing = "range";
    } else {
      limits.lower = unit * (*range)[0] - ref;
      limits.upper = unit * (*range)[1] - ref;
    }
    if (!slides && limits.missing.empty()) angles_.Add((*range)[0], (*range)[1], unit, joint.line);
    const std::string repaired = SetLimits(limits, joint);
    if (!repaired.empty()) document_.Warn(*node.xml, where + repaired);
    joint.drive.damping = std::max(0.0, document_.FindNumber(node, "damping", 0.0, where));
    joint.spring_stiffness = std::max(0.0, document_.FindNumber(node, "stiffness", 0.0, where));
    joint.reference = ref;
    joint.spring_rest = unit * document_.FindNumber(node, "springref", 0.0, where) - ref;
    if (const auto force = document_.FindNumbers(node, "actuatorfrcrange", 2, 2, where)) {
      joint.drive.effort = std::max(std::abs((*force)[0]), std::abs((*force)[1]));
    }
    hand_.joints.push_back(joint);
  }

  void ReadInertial(const MjcfNode& node, const Place& place) {
    if (document_.settings().inertia_from_geom == MjcfSettings::GeomInertia::kAlways) return;
    ForeignLink& link = hand_.links[static_cast<size_t>(place.link)];
    const std::string where = "body \"" + link.name + "\", inertial";
    ForeignInertia inertia;
    inertia.line = document_.LineOf(*node.xml);
    inertia.X_LI = place.X_LB * document_.FindPose(node, where);
    inertia.mass = document_.FindNumber(node, "mass", 0.0, where);
    if (const auto full = document_.FindNumbers(node, "fullinertia", 6, 6, where)) {
      const std::vector<double>& v = *full;
      inertia.I_I << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
    } else {
      inertia.I_I = document_.FindVector(node, "diaginertia", Vector3d::Zero(), where).asDiagonal();
    }
    link.inertia = inertia;
  }

  void ReadGeom(const MjcfNode& node, const Place& place) {
    using Kind = ForeignShape::Kind;
    const size_t link = static_cast<size_t>(place.link);
    const char* own_name = node.xml->Attribute("name");
    const std::string where = "body \"" + hand_.links[link].name + "\", geom" +
                              (own_name ? " \"" + std::string(own_name) + "\"" : "");
    const std::map<std::string, Kind> kinds = {
        {"sphere", Kind::kSphere}, {"capsule", Kind::kCapsule},     {"cylinder", Kind::kCylinder},
        {"box", Kind::kBox},       {"ellipsoid", Kind::kEllipsoid}, {"mesh", Kind::kMesh}};
    const char* type = document_.Find(node, "type");
    const auto kind = kinds.find(type ? type : "sphere");
    if (kind == kinds.end()) {
      document_.Warn(*node.xml, where + ": type \"" + type + "\" is no part of a hand; left out");
      return;
    }
    const auto is_zero = [&](const char* attribute) {
      return document_.FindNumber(node, attribute, 1.0, where) == 0.0;
    };
    const bool touches = !is_zero("contype") || !is_zero("conaffinity");
    const bool is_shown = document_.FindNumber(node, "group", 0.0, where) <= kLastGroupShown;
    ForeignShape shape;
    shape.weight = FindGeomWeight(document_, node, where);
    if (!touches && !is_shown && !shape.weight) return;
    shape.line = document_.LineOf(*node.xml);
    shape.kind = kind->second;
    bool is_clear = false;
    shape.colour = FindColour(node, where, is_clear);
    const bool is_mesh = kind->second == Kind::kMesh || document_.Find(node, "mesh") != nullptr;
    const bool has_ends = !is_mesh && document_.Find(node, "fromto") && shape.kind != Kind::kSphere;
    if (!has_ends) shape.X_LS = document_.FindPose(node, where);
    const bool is_good = is_mesh    ? meshes_.Place(node, where, shape)
                         : has_ends ? ReadGeomFromTo(document_, node, where, shape)
                                    : ReadGeomExtent(document_, node, where, shape);
    if (is_mesh && !is_good) return;
    if (!is_mesh && (!is_good || shape.size.minCoeff() <= 0.0)) {
      document_.Warn(*node.xml, where + ": the " + kind->first + " has no extent; left out");
      return;
    }
    shape.X_LS = place.X_LB * shape.X_LS;
    if (shape.weight) hand_.links[link].weights.push_back(shape);
    if (touches) hand_.links[link].collisions.push_back(shape);
    shape.also_touches = touches;
    if (!is_shown || is_clear) return;
    hand_.links[link].visuals.push_back(shape);
    if (!touches) has_picture_[link] = true;
  }

  std::optional<Vector3d> FindColour(const MjcfNode& node, const std::string& where,
                                     bool& is_clear) {
    auto rgba = document_.FindNumbers(node, "rgba", 4, 4, where);
    const char* material = document_.Find(node, "material");
    const auto found = materials_.find(material ? material : "");
    if (!rgba && found != materials_.end()) {
      const MjcfNode of_material = document_.Resolve(*found->second, nullptr);
      rgba = document_.FindNumbers(of_material, "rgba", 4, 4, "material");
    }
    is_clear = rgba && (*rgba)[3] == 0.0;
    if (!rgba) return {};
    return Vector3d((*rgba)[0], (*rgba)[1], (*rgba)[2]).cwiseMax(0.0).cwiseMin(1.0);
  }

  void WarnOnce(const XMLElement& at, const std::string& kind) {
    if (told_.insert(kind).second) {
      claimed_.insert(problems_.entries().size());  // belongs to all links
      document_.Warn(at, "<" + kind + "> is not read, here and below; left out");
    }
  }

  std::string FindName(XMLElement& element, NameList& names, const std::string& otherwise) {
    const char* own = element.Attribute("name");
    std::vector<std::string> changes;
    const std::string name = names.Add(own ? own : otherwise.c_str(), changes);
    for (const std::string& change : own ? changes : std::vector<std::string>()) {
      document_.Warn(element, change);
    }
    return name;
  }

  const std::string& file_;
  MjcfDocument document_;
  Diagnostics& problems_;
  ForeignHand hand_;
  NameList link_names_{"body"}, joint_names_{"joint"};
  MjcfMeshes meshes_{document_};
  std::map<std::string, MjcfBody> bodies_;
  std::map<std::string, XMLElement*> materials_;
  std::set<std::string> told_;
  std::set<size_t> claimed_;       // indices into the problems
  std::vector<bool> has_picture_;  // by link: it has a geom that is visual only
  bool keeps_world_ = false;
  const bool is_angle_told_;  // given by the user
  StatedAngles angles_;
};

}  // namespace

bool IsMjcf(const std::string& text) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) return false;
  const XMLElement* root = document.RootElement();
  const std::string name = root ? root->Name() : "";
  return name == "mujoco" || name == "mujocoinclude";
}

ForeignHand ReadForeignMjcf(const std::string& text, const std::string& file,
                            const std::filesystem::path& folder, Diagnostics& problems,
                            std::optional<bool> in_degrees) {
  return MjcfReader(file, folder, in_degrees, problems).Read(text);
}

}  // namespace graspbench
