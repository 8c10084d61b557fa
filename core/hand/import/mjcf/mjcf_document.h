#pragma once
/** @file
The XML of a MuJoCo model (MJCF): included files, default classes, the compiler's settings.

An attribute that an element leaves out comes from its class, the class above that, and so on. The
class is the one that the element names, else the nearest `childclass` of a body above it, else the
outermost. All kinds of actuators share their defaults.

Orientations: quat (w x y z), axisangle, xyaxes, zaxis (least rotation from z), euler in the order
of `eulerseq`, small letters about moving axes, capitals about fixed ones. Where several stand in
the element and its classes, the nearest counts. Angles are degrees unless the compiler says radian.

Source: MuJoCo's XML reference, mujoco.readthedocs.io/en/stable/XMLreference.html. */

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/pose.h"
#include "core/hand/import/foreign_hand.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace graspbench {

struct MjcfClass {
  const MjcfClass* above = nullptr;
  std::map<std::string, std::map<std::string, std::string>> values;  ///< kind -> attribute -> text
};

/** An element, and the classes that fill what it leaves out. */
struct MjcfNode {
  tinyxml2::XMLElement* xml = nullptr;
  const MjcfClass* defaults = nullptr;  ///< null: none
};

struct MjcfSettings {
  bool in_degrees = true;
  enum class GeomInertia { kNever, kWhereMissing, kAlways };
  GeomInertia inertia_from_geom = GeomInertia::kWhereMissing;
  int first_inertia_group = 0, last_inertia_group = 5;  ///< of the geoms that weigh
  double least_mass = 0.0, least_moment = 0.0;          ///< boundmass [kg], boundinertia [kg m^2]
  bool strips_paths = false;
  std::string mesh_folder;  ///< "assets/"; empty: the model's
  std::string euler_order = "xyz";
};

class MjcfDocument {
 public:
  /** @param folder  of the model; included files lie there. @param in_degrees  instead of what the
  compiler says of angles. */
  MjcfDocument(std::string file, std::filesystem::path folder, std::optional<bool> in_degrees,
               Diagnostics& problems);
  ~MjcfDocument();

  /** False, with an error reported, when it is no MuJoCo model. */
  bool Parse(const std::string& text);
  const MjcfSettings& settings() const { return settings_; }
  /** Paths of the files included so far. */
  std::vector<std::string> ListIncluded() const;
  /** The model's name; "hand" when it has none. */
  std::string FindName() const;
  /** True when the outermost element is that of a file for <include>. */
  bool IsFragment() const;

  /** Sections of a kind ("worldbody", "asset"), in order. */
  std::vector<tinyxml2::XMLElement*> FindSections(const std::string& kind);
  /** What stands in an element, included files in their places. */
  std::vector<tinyxml2::XMLElement*> ListChildren(tinyxml2::XMLElement& parent);
  /** Adds the classes that hold for an element. @param childclass  of the bodies above; null: the
  outermost. An unknown class is told. */
  MjcfNode Resolve(tinyxml2::XMLElement& element, const MjcfClass* childclass);
  /** The `childclass` of a body or frame, else `childclass`. */
  const MjcfClass* FindChildClass(tinyxml2::XMLElement& body, const MjcfClass* childclass);

  /** Null: neither in the element nor in its classes. */
  const char* Find(const MjcfNode& node, const char* attribute) const;
  /** As many numbers as stand there, `most` at most; nothing when there are fewer than `least`, or
  something else, which is told. @param is_needed  an error instead of a warning. */
  std::optional<std::vector<double>> FindNumbers(const MjcfNode& node, const char* attribute,
                                                 size_t least, size_t most,
                                                 const std::string& where, bool is_needed = false);
  double FindNumber(const MjcfNode& node, const char* attribute, double otherwise,
                    const std::string& where);
  Eigen::Vector3d FindVector(const MjcfNode& node, const char* attribute,
                             const Eigen::Vector3d& otherwise, const std::string& where,
                             bool is_needed = false);
  Eigen::Matrix3d FindRotation(const MjcfNode& node, const std::string& where,
                               bool is_needed = false);
  /** `pos` and the orientation. */
  Pose FindPose(const MjcfNode& node, const std::string& where, bool is_needed = false);

  /** In the model itself; 0 in a file that it includes. */
  int LineOf(const tinyxml2::XMLElement& element) const;
  void Warn(const tinyxml2::XMLElement& at, const std::string& text);
  void Fail(const tinyxml2::XMLElement& at, const std::string& text);

 private:
  struct Loaded {
    std::string name;
    std::unique_ptr<tinyxml2::XMLDocument> document;
  };
  const std::string& FileOf(const tinyxml2::XMLElement& element) const;
  tinyxml2::XMLElement* Include(tinyxml2::XMLElement& include);
  void ReadSettings();
  void ReadDefaults(tinyxml2::XMLElement& element, MjcfClass* above);

  std::string file_;
  std::filesystem::path folder_;
  std::optional<bool> in_degrees_;
  Diagnostics& problems_;
  std::vector<Loaded> loaded_;                                             // the model first
  std::map<const tinyxml2::XMLElement*, tinyxml2::XMLElement*> included_;  // <include> -> root
  MjcfSettings settings_;
  std::map<std::string, std::unique_ptr<MjcfClass>> classes_;
  const MjcfClass* outermost_ = nullptr;
};

/** Rotation from z to a direction, the least one; half a turn about x when it is -z. */
Eigen::Matrix3d MakeRotationFromZ(const Eigen::Vector3d& direction);

/** The extent of a geom of a MuJoCo model, and what of it weighs. By `size`, for the kind that
`shape` has. False: it has no good one. */
bool ReadGeomExtent(MjcfDocument& document, const MjcfNode& node, const std::string& where,
                    ForeignShape& shape);
/** The same by `fromto`, which also says its place in the body. */
bool ReadGeomFromTo(MjcfDocument& document, const MjcfNode& node, const std::string& where,
                    ForeignShape& shape);

/** `mass`, else `density`; nothing when it weighs nothing, or when the compiler takes no inertia
from it. */
std::optional<ForeignShape::Weight> FindGeomWeight(MjcfDocument& document, const MjcfNode& node,
                                                   const std::string& where);

}  // namespace graspbench
