#pragma once
/** @file
Numbers, names and elements as they stand in XML. */

#include <tinyxml2.h>

#include <Eigen/Core>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace graspbench {

/** Finite numbers below 1e9, blanks or commas between them; nothing when something else stands
there. */
std::optional<std::vector<double>> ParseNumbers(const char* text);

/** True when a number in the text is 1e9 or larger, which ParseNumbers refuses. */
bool IsTooLarge(const char* text);

/** What a file is that holds no XML in UTF-8: UTF-16, a Git LFS pointer. Empty: neither. */
std::string NameOtherText(const std::string& text);

/** What an <origin> has beside `xyz` and `rpy`: another attribute (`quat_xyzw`), an element, text.
Whoever ignored it would put its part elsewhere. Empty: nothing. */
std::string FindUnknownInOrigin(const tinyxml2::XMLElement& origin);

/** True when an angle of a rotation is more than a turn and a multiple of 1 or 2.5, as people write
degrees. Any other one beyond a turn, 5 pi / 2, is right in radians. */
bool AreDegrees(const Eigen::Vector3d& rpy);

/** The first three in quotes, "a", "b", "c" and 4 more. */
std::string JoinSome(const std::vector<std::string>& names);

/** Names of one kind of thing ("link"), each given once. */
class NameList {
 public:
  explicit NameList(std::string kind) : kind_(std::move(kind)) {}

  /** The name; another one where it is no text or taken, and then `changes` says so. */
  std::string Add(const char* text, std::vector<std::string>& changes);

 private:
  std::string kind_;
  std::set<std::string> taken_;
};

/** Elements and attributes of a URDF, their faults reported with their lines. Base of the reader.
In a hand of our own form any fault is an error; in a foreign description most are warnings. */
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
  /** A fault that is repaired in a foreign description. */
  void FailOrRepair(const XMLElement& at, const std::string& text, const std::string& repair) {
    is_own_ ? Fail(at, text) : Warn(at, text + "; " + repair);
  }
  /** The document's <robot>; null, with an error, where it holds no description of a hand. */
  XMLElement* FindRobot(tinyxml2::XMLDocument& document, const std::string& text);
  /** The child of that name, with an error when it is needed and absent. */
  XMLElement* Only(XMLElement& parent, const char* name, const std::string& where, bool is_needed);
  std::string Text(XMLElement& element, const char* attribute, const std::string& where);
  /** The numbers of an attribute; none, with a problem, when something else stands there or, in a
  hand of our own that needs them, nothing. */
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
  /** In our own form, a warning of each element that the model does not use. */
  void WarnOfUnused(XMLElement& parent, const std::vector<std::string>& used,
                    const std::vector<std::string>& ignored, const std::string& where);

  std::string file_;
  bool is_own_;
  Diagnostics& problems_;
};

}  // namespace graspbench
