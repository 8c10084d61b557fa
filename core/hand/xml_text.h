#pragma once
/** @file
Numbers, names and elements in XML. */

#include <tinyxml2.h>

#include <Eigen/Core>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace graspbench {

/** Parses finite numbers below 1e9, separated by blanks or commas; nullopt if the text contains
anything else. */
std::optional<std::vector<double>> ParseNumbers(const char* text);

/** Whether the text contains a number of 1e9 or more, which ParseNumbers rejects. */
bool IsTooLarge(const char* text);

/** Names the content of a file that is not XML in UTF-8: UTF-16, a Git LFS pointer; else empty. */
std::string NameOtherText(const std::string& text);

/** Names what an <origin> contains besides `xyz` and `rpy`: another attribute (`quat_xyzw`), an
element or text. Ignoring it would misplace the part. Empty: nothing. */
std::string FindUnknownInOrigin(const tinyxml2::XMLElement& origin);

/** Whether an angle of a rotation exceeds a full turn and is a multiple of 1 or 2.5, as people
write degrees. Any other angle beyond a full turn, such as 5 pi / 2, is taken for radians. */
bool AreDegrees(const Eigen::Vector3d& rpy);

/** Joins names in quotes; after the first three: "a", "b", "c" and 4 more. */
std::string JoinSome(const std::vector<std::string>& names);

/** Unique names for things of one kind ("link"). */
class NameList {
 public:
  explicit NameList(std::string kind) : kind_(std::move(kind)) {}

  /** Returns the name, or another one if it is not text or taken; then adds a note to `changes`. */
  std::string Add(const char* text, std::vector<std::string>& changes);

 private:
  std::string kind_;
  std::set<std::string> taken_;
};

/** Base class of the URDF reader: reads elements and attributes and reports their faults with
lines. In a hand of our own form any fault is an error; in a foreign description most are
warnings. */
class UrdfElements {
 protected:
  using XMLElement = tinyxml2::XMLElement;

  UrdfElements(std::string file, bool is_own, Diagnostics& problems)
      : file_(std::move(file)), is_own_(is_own), problems_(problems) {}

  void Fail(const XMLElement& at, const std::string& text) {
    problems_.Fail(file_, at.GetLineNum(), text);
  }
  void Warn(const XMLElement& at, const std::string& text) {
    problems_.Warn(file_, at.GetLineNum(), text);
  }
  /** Reports a fault that can be repaired in a foreign description. */
  void FailOrRepair(const XMLElement& at, const std::string& text, const std::string& repair) {
    is_own_ ? Fail(at, text) : Warn(at, text + "; " + repair);
  }
  /** Returns the document's <robot>; null, with an error, if it does not describe a hand. */
  XMLElement* FindRobot(tinyxml2::XMLDocument& document, const std::string& text);
  /** Returns the only child of this name; reports an error if it is needed and missing. */
  XMLElement* Only(XMLElement& parent, const char* name, const std::string& where, bool is_needed);
  std::string Text(XMLElement& element, const char* attribute, const std::string& where);
  /** Returns the numbers of an attribute. Returns none, with a problem, if it has other content or,
  in a hand of our own form, is needed and missing. */
  std::vector<double> ReadNumbers(XMLElement* element, const char* attribute, size_t count,
                                  const std::string& where, bool is_needed);
  template <int kCount>
  Eigen::Matrix<double, kCount, 1> Numbers(XMLElement* element, const char* attribute,
                                           const Eigen::Matrix<double, kCount, 1>& otherwise,
                                           const std::string& where, bool is_needed = true) {
    const std::vector<double> read = ReadNumbers(element, attribute, kCount, where, is_needed);
    if (read.empty()) return otherwise;
    return Eigen::Map<const Eigen::Matrix<double, kCount, 1>>(read.data());
  }
  double Number(XMLElement* element, const char* attribute, double otherwise,
                const std::string& where) {
    const std::vector<double> read = ReadNumbers(element, attribute, 1, where, true);
    return read.empty() ? otherwise : read[0];
  }
  /** In a hand of our own form, warns of each element that the model does not use. */
  void WarnOfUnused(XMLElement& parent, const std::vector<std::string>& used,
                    const std::vector<std::string>& ignored, const std::string& where);

  std::string file_;
  bool is_own_;
  Diagnostics& problems_;
};

}  // namespace graspbench
