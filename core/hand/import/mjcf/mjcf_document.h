#pragma once
/** @file
The XML of a MuJoCo model (MJCF): included files, default classes, the compiler's settings.

An attribute that an element omits comes from its class, or the next class above that has it. The
class is the one that the element names, otherwise the nearest `childclass` of a body above it,
otherwise the outermost. All kinds of actuators share their defaults.

Orientations: quat (w x y z), axisangle, xyaxes, zaxis (smallest rotation from z), and euler in the
order of `eulerseq`, with small letters for moving axes and capitals for fixed ones. If an element
and its classes give several, the nearest counts. Angles are degrees unless the compiler says
radian.

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

/** An element, with the classes that supply its omitted attributes. */
struct MjcfNode {
  tinyxml2::XMLElement* xml = nullptr;
  const MjcfClass* defaults = nullptr;  ///< null: none
};

struct MjcfSettings {
  bool in_degrees = true;
  enum class GeomInertia { kNever, kWhereMissing, kAlways };
  GeomInertia inertia_from_geom = GeomInertia::kWhereMissing;
  int first_inertia_group = 0, last_inertia_group = 5;  ///< of the geoms that have mass
  double least_mass = 0.0, least_moment = 0.0;          ///< boundmass [kg], boundinertia [kg m^2]
  bool strips_paths = false;
  std::string mesh_folder;  ///< "assets/"; empty: the model's folder
  std::string euler_order = "xyz";
};

class MjcfDocument {
 public:
  /** @param folder  the model's folder, where included files are found. @param in_degrees
  overrides the compiler's unit of angles. */
  MjcfDocument(std::string file, std::filesystem::path folder, std::optional<bool> in_degrees,
               Diagnostics& problems);
  ~MjcfDocument();

  /** Returns false, with an error reported, if it is not a MuJoCo model. */
  bool Parse(const std::string& text);
  const MjcfSettings& settings() const { return settings_; }
  /** Paths of the files included so far. */
  std::vector<std::string> ListIncluded() const;
  /** The model's name; "hand" if it has none. */
  std::string FindName() const;
  /** Whether the outermost element is that of a file for <include>. */
  bool IsFragment() const;

  /** Sections of a kind ("worldbody", "asset"), in order. */
  std::vector<tinyxml2::XMLElement*> FindSections(const std::string& kind);
  /** Children of an element, with included files expanded in place. */
  std::vector<tinyxml2::XMLElement*> ListChildren(tinyxml2::XMLElement& parent);
  /** Adds the classes that apply to an element. @param childclass  that of the bodies above; null:
  the outermost class. An unknown class is reported. */
  MjcfNode Resolve(tinyxml2::XMLElement& element, const MjcfClass* childclass);
  /** Returns the `childclass` of a body or frame, otherwise the argument `childclass`. */
  const MjcfClass* FindChildClass(tinyxml2::XMLElement& body, const MjcfClass* childclass);

  /** Returns null if the attribute is neither in the element nor in its classes. */
  const char* Find(const MjcfNode& node, const char* attribute) const;
  /** Returns the numbers of an attribute, at most `most`. Returns nullopt if there are fewer than
  `least`, or other text, which is reported. @param is_needed  report an error, not a warning. */
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
  /** Reads `pos` and the orientation. */
  Pose FindPose(const MjcfNode& node, const std::string& where, bool is_needed = false);

  /** Line in the model itself; 0 in an included file. */
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

/** The smallest rotation from z to a direction; half a turn about x if it is -z. */
Eigen::Matrix3d MakeRotationFromZ(const Eigen::Vector3d& direction);

/** Reads the extent of a geom from `size`, for the kind of `shape`, and its mass. Returns false if
`size` is missing or invalid. */
bool ReadGeomExtent(MjcfDocument& document, const MjcfNode& node, const std::string& where,
                    ForeignShape& shape);
/** The same from `fromto`, which also gives its pose in the body. */
bool ReadGeomFromTo(MjcfDocument& document, const MjcfNode& node, const std::string& where,
                    ForeignShape& shape);

/** Returns `mass`, otherwise `density`; nullopt if the geom has no mass, or if the compiler does
not compute inertia from it. */
std::optional<ForeignShape::Weight> FindGeomWeight(MjcfDocument& document, const MjcfNode& node,
                                                   const std::string& where);

}  // namespace graspbench
