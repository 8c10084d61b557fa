#include "core/hand/import/mjcf/mjcf_document.h"

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/base/whole_number.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

constexpr double kGeomDensity = 1000.0;  // [kg/m^3], MuJoCo's default

}  // namespace

std::optional<ForeignShape::Weight> FindGeomWeight(MjcfDocument& document, const MjcfNode& node,
                                                   const std::string& where) {
  const MjcfSettings& settings = document.settings();
  const double group = document.FindNumber(node, "group", 0.0, where);
  if (settings.inertia_from_geom == MjcfSettings::GeomInertia::kNever ||
      group < settings.first_inertia_group || group > settings.last_inertia_group) {
    return {};
  }
  ForeignShape::Weight weight;
  if (const auto mass = document.FindNumbers(node, "mass", 1, 1, where)) weight.mass = (*mass)[0];
  weight.density = document.FindNumber(node, "density", kGeomDensity, where);
  if (const double weighs = weight.mass.value_or(weight.density); weighs < 0.0) {
    document.Fail(*node.xml, where +
                                 (weight.mass ? ": a negative mass, " : ": a negative density, ") +
                                 FormatSignificant(weighs, 3) + (weight.mass ? " kg" : " kg/m^3") +
                                 "; give what the part weighs, or 0 where it weighs nothing");
  }
  if (weight.mass.value_or(weight.density) <= 0.0) return {};
  return weight;
}

bool ReadGeomFromTo(MjcfDocument& document, const MjcfNode& node, const std::string& where,
                    ForeignShape& shape) {
  const auto ends = document.FindNumbers(node, "fromto", 6, 6, where);
  const auto size = document.FindNumbers(node, "size", 1, 3, where);
  if (!ends || !size) return false;
  const std::vector<double>& v = *ends;
  const Vector3d p_A(v[0], v[1], v[2]), p_B(v[3], v[4], v[5]), along = p_A - p_B;
  if (along.norm() < 1e-9) return false;
  shape.X_LS = MakePose(MakeRotationFromZ(along), 0.5 * (p_A + p_B));
  const double thick = 2.0 * (*size)[0];
  const bool has_ends = shape.kind == ForeignShape::Kind::kCapsule;
  shape.size = {thick, thick, along.norm() + (has_ends ? thick : 0.0)};
  return true;
}

bool ReadGeomExtent(MjcfDocument& document, const MjcfNode& node, const std::string& where,
                    ForeignShape& shape) {
  using Kind = ForeignShape::Kind;
  const bool is_round = shape.kind == Kind::kCylinder || shape.kind == Kind::kCapsule;
  const size_t count = shape.kind == Kind::kSphere ? 1 : is_round ? 2 : 3;
  const auto size = document.FindNumbers(node, "size", count, 3, where);
  if (!size) return false;
  const std::vector<double>& v = *size;
  if (count == 1) {
    shape.size.setConstant(2.0 * v[0]);
  } else if (count == 2) {
    const double ends = shape.kind == Kind::kCapsule ? v[0] : 0.0;
    shape.size = {2.0 * v[0], 2.0 * v[0], 2.0 * (v[1] + ends)};
  } else {
    shape.size = {2.0 * v[0], 2.0 * v[1], 2.0 * v[2]};
  }
  return true;
}

namespace {

constexpr size_t kMostFiles = 20;

bool IsNamed(const XMLElement& element, const char* name) {
  return std::strcmp(element.Name(), name) == 0;
}

/** Kind under which defaults are stored: all actuators share theirs. */
std::string KindOf(const char* name) {
  const std::string kind = name;
  for (const char* actuator : {"general", "motor", "position", "velocity", "intvelocity", "damper",
                               "cylinder", "muscle", "adhesion"}) {
    if (kind == actuator) return "actuator";
  }
  return kind == "freejoint" ? "joint" : kind;
}

}  // namespace

Matrix3d MakeRotationFromZ(const Vector3d& direction) {
  const Vector3d z = direction.normalized();
  const Vector3d axis = Vector3d::UnitZ().cross(z);
  const double sine = axis.norm();
  if (sine < 1e-10) {
    return Eigen::AngleAxisd(z.z() < 0.0 ? kPi : 0.0, Vector3d::UnitX()).toRotationMatrix();
  }
  return Eigen::AngleAxisd(std::atan2(sine, z.z()), axis / sine).toRotationMatrix();
}

MjcfDocument::MjcfDocument(std::string file, std::filesystem::path folder,
                           std::optional<bool> in_degrees, Diagnostics& problems)
    : file_(std::move(file)),
      folder_(std::move(folder)),
      in_degrees_(in_degrees),
      problems_(problems) {}
MjcfDocument::~MjcfDocument() = default;

const std::string& MjcfDocument::FileOf(const XMLElement& element) const {
  for (const Loaded& loaded : loaded_) {
    if (loaded.document.get() == element.GetDocument()) return loaded.name;
  }
  return file_;
}

int MjcfDocument::LineOf(const XMLElement& element) const {
  return element.GetDocument() == loaded_.front().document.get() ? element.GetLineNum() : 0;
}

void MjcfDocument::Warn(const XMLElement& at, const std::string& text) {
  problems_.Warn(FileOf(at), at.GetLineNum(), text);
}

void MjcfDocument::Fail(const XMLElement& at, const std::string& text) {
  problems_.Fail(FileOf(at), at.GetLineNum(), text);
}

XMLElement* MjcfDocument::Include(XMLElement& include) {
  const auto known = included_.find(&include);
  if (known != included_.end()) return known->second;
  XMLElement*& root = included_[&include];
  const char* address = include.Attribute("file");
  const std::string name = (folder_ / (address ? address : "")).lexically_normal().string();
  const auto is_loaded = [&](const Loaded& loaded) { return loaded.name == name; };
  if (!address || !*address) {
    Fail(include, "<include> without a file");
  } else if (std::any_of(loaded_.begin(), loaded_.end(), is_loaded) ||
             loaded_.size() >= kMostFiles) {
    Fail(include, "<include> of \"" + std::string(address) +
                      "\", which is included already; a model includes a file once");
  } else {
    try {
      const std::string text = ReadFile(name);
      Loaded& loaded = loaded_.emplace_back();
      loaded.name = name;
      loaded.document = std::make_unique<tinyxml2::XMLDocument>();
      if (loaded.document->Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS) {
        root = loaded.document->RootElement();
      } else {
        problems_.Fail(name, loaded.document->ErrorLineNum(),
                       std::string("not valid XML (") + loaded.document->ErrorName() + ")");
      }
    } catch (const Error& error) {
      Fail(include, "<include> of \"" + std::string(address) + "\": " + error.what());
    }
  }
  return root;
}

std::vector<std::string> MjcfDocument::ListIncluded() const {
  std::vector<std::string> names;
  for (size_t i = 1; i < loaded_.size(); ++i) names.push_back(loaded_[i].name);
  return names;
}

std::vector<XMLElement*> MjcfDocument::ListChildren(XMLElement& parent) {
  std::vector<XMLElement*> children;
  for (XMLElement* e = parent.FirstChildElement(); e; e = e->NextSiblingElement()) {
    if (!IsNamed(*e, "include")) {
      children.push_back(e);
    } else if (XMLElement* root = Include(*e)) {
      const std::vector<XMLElement*> inner = ListChildren(*root);
      children.insert(children.end(), inner.begin(), inner.end());
    }
  }
  return children;
}

std::vector<XMLElement*> MjcfDocument::FindSections(const std::string& kind) {
  std::vector<XMLElement*> sections;
  for (XMLElement* section : ListChildren(*loaded_.front().document->RootElement())) {
    if (section->Name() == kind) sections.push_back(section);
  }
  return sections;
}

void MjcfDocument::ReadSettings() {
  std::string asset_folder;
  const char* mesh_folder = nullptr;
  for (XMLElement* compiler : FindSections("compiler")) {
    if (const char* angle = compiler->Attribute("angle")) {
      settings_.in_degrees = std::strcmp(angle, "radian") != 0;
    }
    if (const char* folder = compiler->Attribute("assetdir")) asset_folder = folder;
    if (const char* mass = compiler->Attribute("settotalmass")) {
      Warn(*compiler, "<compiler settotalmass=\"" + std::string(mass) +
                          "\">: not applied; masses are those of the bodies");
    }
    const auto read_bound = [&](const char* name, double& bound) {
      const char* text = compiler->Attribute(name);
      if (!text) return;
      const auto numbers = ParseNumbers(text);
      if (numbers && numbers->size() == 1 && (*numbers)[0] >= 0.0) {
        bound = (*numbers)[0];
      } else {
        Fail(*compiler,
             std::string(name) + ": expected a number of at least 0, found \"" + text + "\"");
      }
    };
    read_bound("boundmass", settings_.least_mass);
    read_bound("boundinertia", settings_.least_moment);
    if (const char* folder = compiler->Attribute("meshdir")) mesh_folder = folder;
    if (const char* strips = compiler->Attribute("strippath")) {
      settings_.strips_paths = std::strcmp(strips, "true") == 0;
    }
    if (const char* from = compiler->Attribute("inertiafromgeom")) {
      using From = MjcfSettings::GeomInertia;
      settings_.inertia_from_geom = std::strcmp(from, "true") == 0    ? From::kAlways
                                    : std::strcmp(from, "false") == 0 ? From::kNever
                                                                      : From::kWhereMissing;
    }
    const char* groups = compiler->Attribute("inertiagrouprange");
    const auto range = groups ? ParseNumbers(groups) : std::nullopt;
    if (range && range->size() == 2) {
      settings_.first_inertia_group = ToWhole<int>(std::clamp((*range)[0], 0.0, 5.0));
      settings_.last_inertia_group = ToWhole<int>(std::clamp((*range)[1], 0.0, 5.0));
    }
    if (const char* order = compiler->Attribute("eulerseq")) {
      const std::string text = order;
      if (text.size() == 3 && text.find_first_not_of("xyzXYZ") == std::string::npos) {
        settings_.euler_order = text;
      } else {
        Fail(*compiler, "eulerseq: expected three of x, y, z, X, Y, Z, found \"" + text + "\"");
      }
    }
    const char* coordinate = compiler->Attribute("coordinate");
    if (coordinate && std::strcmp(coordinate, "local") != 0) {
      Fail(*compiler, "coordinate=\"" + std::string(coordinate) +
                          "\": places in the world's frame, which MuJoCo itself gave up; load and "
                          "save the model with MuJoCo before version 2.3");
    }
  }
  settings_.in_degrees = in_degrees_.value_or(settings_.in_degrees);
  settings_.mesh_folder = mesh_folder ? mesh_folder : asset_folder;
}

void MjcfDocument::ReadDefaults(XMLElement& element, MjcfClass* above) {
  const char* named = element.Attribute("class");
  const std::string name = named ? named : above ? "" : "main";
  if (name.empty()) {
    Warn(element, "<default> inside another without a class; left out");
    return;
  }
  std::unique_ptr<MjcfClass>& place = classes_[name];
  if (!place) {  // a name that is used twice keeps its place, so there are no rings
    place = std::make_unique<MjcfClass>();
    place->above = above ? above : outermost_;
  }
  if (!outermost_) outermost_ = place.get();
  MjcfClass* const own = place.get();
  for (XMLElement* e : ListChildren(element)) {
    if (IsNamed(*e, "default")) continue;
    auto& values = own->values[KindOf(e->Name())];
    for (const tinyxml2::XMLAttribute* a = e->FirstAttribute(); a; a = a->Next()) {
      values[a->Name()] = a->Value();
    }
  }
  for (XMLElement* e : ListChildren(element)) {
    if (IsNamed(*e, "default")) ReadDefaults(*e, own);
  }
}

bool MjcfDocument::Parse(const std::string& text) {
  Loaded& model = loaded_.emplace_back();
  model.name = file_;
  model.document = std::make_unique<tinyxml2::XMLDocument>();
  tinyxml2::XMLDocument& document = *model.document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    problems_.Fail(file_, document.ErrorLineNum(),
                   std::string("not valid XML (") + document.ErrorName() + ")");
    return false;
  }
  const int errors = problems_.num_errors();
  ReadSettings();
  for (XMLElement* section : FindSections("default")) ReadDefaults(*section, nullptr);
  return problems_.num_errors() == errors;
}

std::string MjcfDocument::FindName() const {
  const char* name = loaded_.front().document->RootElement()->Attribute("model");
  return name && *name && IsUtf8(name) ? name : "hand";
}

bool MjcfDocument::IsFragment() const {
  return std::string(loaded_.front().document->RootElement()->Name()) == "mujocoinclude";
}

const MjcfClass* MjcfDocument::FindChildClass(XMLElement& body, const MjcfClass* childclass) {
  const char* name = body.Attribute("childclass");
  if (!name) return childclass;
  const auto found = classes_.find(name);
  if (found != classes_.end()) return found->second.get();
  Warn(body, "childclass \"" + std::string(name) + "\" does not exist; as if it were not there");
  return childclass;
}

MjcfNode MjcfDocument::Resolve(XMLElement& element, const MjcfClass* childclass) {
  MjcfNode node = {&element, childclass ? childclass : outermost_};
  const char* name = element.Attribute("class");
  if (!name) return node;
  const auto found = classes_.find(name);
  if (found != classes_.end()) {
    node.defaults = found->second.get();
  } else {
    Warn(element, "class \"" + std::string(name) + "\" does not exist; as if it were not there");
  }
  return node;
}

namespace {

/** Looks up one class only. */
const char* FindIn(const MjcfClass& values, const std::string& kind, const char* attribute) {
  const auto of_kind = values.values.find(kind);
  if (of_kind == values.values.end()) return nullptr;
  const auto found = of_kind->second.find(attribute);
  return found == of_kind->second.end() ? nullptr : found->second.c_str();
}

}  // namespace

const char* MjcfDocument::Find(const MjcfNode& node, const char* attribute) const {
  if (const char* own = node.xml->Attribute(attribute)) return own;
  const std::string kind = KindOf(node.xml->Name());
  for (const MjcfClass* at = node.defaults; at; at = at->above) {
    if (const char* value = FindIn(*at, kind, attribute)) return value;
  }
  return nullptr;
}

std::optional<std::vector<double>> MjcfDocument::FindNumbers(const MjcfNode& node,
                                                             const char* attribute, size_t least,
                                                             size_t most, const std::string& where,
                                                             bool is_needed) {
  const char* text = Find(node, attribute);
  if (!text) return {};
  auto numbers = ParseNumbers(text);
  if (numbers && numbers->size() >= least && numbers->size() <= most) return numbers;
  std::string expected = FormatCount(static_cast<int64_t>(least), "finite number");
  if (most > least)
    expected = std::to_string(least) + " to " + std::to_string(most) + " finite numbers";
  if (!numbers && IsTooLarge(text)) expected += " below 1e9 in size";
  const std::string fault =
      where + ": " + attribute + ": expected " + expected + ", found \"" + text + "\"";
  if (is_needed) {
    Fail(*node.xml, fault + "; without it nobody knows where it is");
  } else {
    Warn(*node.xml, fault + "; taken as if it were not there");
  }
  return {};
}

double MjcfDocument::FindNumber(const MjcfNode& node, const char* attribute, double otherwise,
                                const std::string& where) {
  const auto numbers = FindNumbers(node, attribute, 1, 1, where);
  return numbers ? (*numbers)[0] : otherwise;
}

Vector3d MjcfDocument::FindVector(const MjcfNode& node, const char* attribute,
                                  const Vector3d& otherwise, const std::string& where,
                                  bool is_needed) {
  const auto numbers = FindNumbers(node, attribute, 3, 3, where, is_needed);
  return numbers ? Vector3d((*numbers)[0], (*numbers)[1], (*numbers)[2]) : otherwise;
}

namespace {

using Numbers = std::vector<double>;

/** Rotation for the values of one orientation attribute; nullopt if they have no direction. */
std::optional<Matrix3d> MakeRotation(const std::string& attribute, const Numbers& v,
                                     const MjcfSettings& settings) {
  const auto radians = [&](double angle) {
    return settings.in_degrees ? RadFromDeg(angle) : angle;
  };
  if (attribute == "quat") {
    const Eigen::Quaterniond q(v[0], v[1], v[2], v[3]);
    if (q.norm() < 1e-10) return {};
    return q.normalized().toRotationMatrix();
  }
  if (attribute == "euler") {
    Matrix3d R = Matrix3d::Identity();
    for (int k = 0; k < 3; ++k) {
      const char axis = settings.euler_order[static_cast<size_t>(k)];
      const bool is_moving = axis >= 'x';
      const Matrix3d turn = Eigen::AngleAxisd(radians(v[static_cast<size_t>(k)]),
                                              Vector3d::Unit(axis - (is_moving ? 'x' : 'X')))
                                .toRotationMatrix();
      R = is_moving ? Matrix3d(R * turn) : Matrix3d(turn * R);
    }
    return R;
  }
  const Vector3d first(v[0], v[1], v[2]);
  if (first.norm() < 1e-10) return {};
  if (attribute == "axisangle") {
    return Eigen::AngleAxisd(radians(v[3]), first.normalized()).toRotationMatrix();
  }
  if (attribute == "zaxis") return MakeRotationFromZ(first);
  const Vector3d x = first.normalized(), second(v[3], v[4], v[5]);
  const Vector3d y = second - second.dot(x) * x;
  if (y.norm() < 1e-10) return {};
  Matrix3d R;
  R << x, y.normalized(), x.cross(y.normalized());
  return R;
}

struct OrientationAttribute {
  const char* name;
  size_t count;
};
constexpr OrientationAttribute kOrientations[] = {
    {"axisangle", 4}, {"xyaxes", 6}, {"zaxis", 3}, {"euler", 3}, {"quat", 4}};

}  // namespace

Matrix3d MjcfDocument::FindRotation(const MjcfNode& node, const std::string& where,
                                    bool is_needed) {
  const std::string kind = KindOf(node.xml->Name());
  const auto read = [&](const OrientationAttribute& attribute, const char* text) {
    const auto numbers = ParseNumbers(text);
    std::optional<Matrix3d> R;
    if (numbers && numbers->size() == attribute.count) {
      R = MakeRotation(attribute.name, *numbers, settings_);
    }
    if (R) return *R;
    const std::string fault =
        where + ": " + attribute.name + ": no orientation is given by \"" + text + "\"";
    if (is_needed) {
      Fail(*node.xml, fault);
    } else {
      Warn(*node.xml, fault + "; taken as if it were not there");
    }
    return Matrix3d(Matrix3d::Identity());
  };
  for (const OrientationAttribute& attribute : kOrientations) {
    if (const char* text = node.xml->Attribute(attribute.name)) return read(attribute, text);
  }
  for (const MjcfClass* at = node.defaults; at; at = at->above) {
    for (const OrientationAttribute& attribute : kOrientations) {
      if (const char* text = FindIn(*at, kind, attribute.name)) return read(attribute, text);
    }
  }
  return Matrix3d::Identity();
}

Pose MjcfDocument::FindPose(const MjcfNode& node, const std::string& where, bool is_needed) {
  return MakePose(FindRotation(node, where, is_needed),
                  FindVector(node, "pos", Vector3d::Zero(), where, is_needed));
}

}  // namespace graspbench
