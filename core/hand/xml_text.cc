#include "core/hand/xml_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/hand/read_urdf.h"

namespace graspbench {

std::string NameOtherText(const std::string& text) {
  const std::string head = text.substr(0, 4);
  const bool is_utf16 = head.size() == 4 &&
                        (head.substr(0, 2) == "\xff\xfe" || head.substr(0, 2) == "\xfe\xff" ||
                         head == std::string("<\0", 2) + head.substr(2, 1) + std::string(1, '\0') ||
                         head == std::string("\0<\0", 3) + head.substr(3, 1));
  if (is_utf16) return "the text is UTF-16; expected UTF-8, so save it as that";
  if (text.rfind("version https://git-lfs", 0) == 0) {
    return "a Git LFS pointer, not the file itself; get it with: git lfs pull";
  }
  return "";
}

tinyxml2::XMLElement* UrdfElements::FindRobot(tinyxml2::XMLDocument& document,
                                              const std::string& text) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    problems_.Fail(file_, 0, "the file is empty");
    return nullptr;
  }
  if (const std::string other = NameOtherText(text); !other.empty()) {
    problems_.Fail(file_, 0, other);
    return nullptr;
  }
  if (const tinyxml2::XMLError error = document.Parse(text.data(), text.size());
      error != tinyxml2::XML_SUCCESS) {
    problems_.Fail(file_, document.ErrorLineNum(),
                   std::string("not valid XML: ") +
                       (error == tinyxml2::XML_ERROR_MISMATCHED_ELEMENT
                            ? "this element is not closed by its own name"
                            : "a tag or a value from here on is not closed or not well-formed (" +
                                  std::string(document.ErrorName()) + ")"));
    return nullptr;
  }
  XMLElement* robot = document.RootElement();
  const std::string name = robot ? robot->Name() : "";
  if (name != "robot") {
    problems_.Fail(
        file_, robot ? robot->GetLineNum() : 0,
        std::string(is_own_ ? "not a URDF: the outermost element must be <robot>"
                            : "neither URDF nor MJCF: the outermost element must be <robot> or "
                              "<mujoco>") +
            (robot ? ", found <" + name + ">" : "") +
            (name == "sdf" ? ", an SDF world: give the URDF that it was made of" : ""));
    return nullptr;
  }
  for (XMLElement* e = robot->FirstChildElement(); e && !is_own_; e = e->NextSiblingElement()) {
    if (std::strncmp(e->Name(), "xacro:", 6) != 0) continue;
    Fail(*e, std::string("<") + e->Name() +
                 "> is a macro: expand the file first (xacro FILE.xacro > FILE.urdf)");
    return nullptr;
  }
  if (!is_own_ && !robot->FirstChildElement("link") &&
      (robot->FirstChildElement("palm") || robot->FirstChildElement("chain"))) {
    Fail(*robot,
         "a robot of GraspIt (<palm>, <chain>), not a URDF; give a URDF or MJCF of the hand");
    return nullptr;
  }
  size_t num_links = 0, num_joints = 0;
  for (XMLElement* e = robot->FirstChildElement(); e; e = e->NextSiblingElement()) {
    num_links += std::strcmp(e->Name(), "link") == 0;
    num_joints += std::strcmp(e->Name(), "joint") == 0;
  }
  if (std::max(num_links, num_joints) < kMostLinks) return robot;
  Fail(*robot, "the file has " + std::to_string(num_links) + " links and " +
                   std::to_string(num_joints) + " joints; expected a hand, which has fewer than " +
                   std::to_string(kMostLinks) + " of each");
  return nullptr;
}

tinyxml2::XMLElement* UrdfElements::Only(XMLElement& parent, const char* name,
                                         const std::string& where, bool is_needed) {
  XMLElement* child = parent.FirstChildElement(name);
  if (!child) {
    if (is_needed) Fail(parent, where + ": <" + name + "> is missing");
    return nullptr;
  }
  XMLElement* second = child->NextSiblingElement(name);
  // Readers use the first or the last of two, which is harmless only for a colour.
  if (second && (is_own_ || std::strcmp(name, "material") != 0)) {
    Fail(*second, where + ": a second <" + name + ">; one is allowed");
  }
  return child;
}

std::string UrdfElements::Text(XMLElement& element, const char* attribute,
                               const std::string& where) {
  const char* text = element.Attribute(attribute);
  if (text && *text) return text;
  Fail(element, where + ": <" + element.Name() + "> has no attribute " + attribute);
  return "";
}

std::vector<double> UrdfElements::ReadNumbers(XMLElement* element, const char* attribute,
                                              size_t count, const std::string& where,
                                              bool is_needed) {
  const char* text = element ? element->Attribute(attribute) : nullptr;
  if (!text) {
    if (element && is_own_ && is_needed) Text(*element, attribute, where);
    return {};
  }
  const auto numbers = ParseNumbers(text);
  const bool is_separated = !is_own_ || !std::strchr(text, ',');
  if (numbers && numbers->size() == count && is_separated) return *numbers;
  const std::string fault = where + ", <" + element->Name() + "> " + attribute + ": expected " +
                            FormatCount(static_cast<int64_t>(count), "finite number") +
                            (numbers || !IsTooLarge(text) ? "" : " below 1e9 in size") +
                            ", found \"" + text + "\"";
  if (std::strstr(text, "${")) {
    Fail(*element, fault + ", a macro: expand the file first (xacro FILE.xacro > FILE.urdf)");
  } else if (std::strcmp(element->Name(), "origin") == 0) {
    Fail(*element,
         fault + "; without it nobody knows where the " + element->Parent()->Value() + " is");
  } else {
    FailOrRepair(*element, fault, "taken as if it were not there");
  }
  return {};
}

void UrdfElements::WarnOfUnused(XMLElement& parent, const std::vector<std::string>& used,
                                const std::vector<std::string>& ignored, const std::string& where) {
  const auto contains = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (XMLElement* e = parent.FirstChildElement(); e && is_own_; e = e->NextSiblingElement()) {
    const std::string name = e->Name();
    if (contains(used, name) || contains(ignored, name)) continue;
    Warn(*e, where + ": <" + name + "> is not used" + SuggestNames(name, used));
  }
}

std::optional<std::vector<double>> ParseNumbers(const char* text) {
  const char* const end = text + std::strlen(text);
  const auto is_blank = [](char c) {
    return std::isspace(static_cast<unsigned char>(c)) || c == ',';
  };
  std::vector<double> numbers;
  for (const char* at = text;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return numbers;
    if (*at == '+') ++at;
    double number = 0.0;
    const auto [next, status] = std::from_chars(at, end, number);
    if (status != std::errc() || !std::isfinite(number) || std::abs(number) >= 1e9) return {};
    if (next != end && !is_blank(*next)) return {};
    numbers.push_back(number);
    at = next;
  }
}

bool IsTooLarge(const char* text) {
  for (const char* at = text; *at;) {
    char* next = nullptr;
    const double number = std::strtod(at, &next);
    if (next == at) {
      ++at;
      continue;
    }
    if (std::isfinite(number) ? std::abs(number) >= 1e9 : std::isdigit(*(next - 1)) != 0)
      return true;
    at = next;
  }
  return false;
}

std::string FindUnknownInOrigin(const tinyxml2::XMLElement& origin) {
  for (const tinyxml2::XMLAttribute* a = origin.FirstAttribute(); a; a = a->Next()) {
    const std::string name = a->Name();
    if (name != "xyz" && name != "rpy") return "attribute \"" + name + "\"";
  }
  for (const tinyxml2::XMLNode* n = origin.FirstChild(); n; n = n->NextSibling()) {
    if (n->ToElement()) return std::string("element <") + n->Value() + ">";
    if (n->ToText()) return std::string("text \"") + n->Value() + "\"";
  }
  return "";
}

bool AreDegrees(const Eigen::Vector3d& rpy) {
  const auto is_multiple = [](double angle, double of) {
    return std::abs(std::remainder(angle, of)) < 1e-3;
  };
  return std::any_of(rpy.begin(), rpy.end(), [&](double angle) {
    return std::abs(angle) > kWholeTurn && (is_multiple(angle, 1.0) || is_multiple(angle, 2.5));
  });
}

std::string JoinSome(const std::vector<std::string>& names) {
  constexpr size_t kMost = 3;
  std::string text;
  for (size_t i = 0; i < std::min(kMost, names.size()); ++i) {
    text += (i > 0 ? ", \"" : "\"") + names[i] + "\"";
  }
  if (names.size() > kMost) text += " and " + std::to_string(names.size() - kMost) + " more";
  return text;
}

std::string NameList::Add(const char* text, std::vector<std::string>& changes) {
  std::string name = text ? text : "";
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  if (name.empty() || !IsUtf8(name)) {
    name = kind_ + "_" + std::to_string(taken_.size() + 1);
    changes.push_back(kind_ + " without a name that is text; called \"" + name + "\"");
  }
  if (taken_.insert(name).second) return name;
  std::string other;
  for (int number = 2; !taken_.insert(other = name + "_" + std::to_string(number)).second;) {
    ++number;
  }
  changes.push_back(kind_ + " \"" + name + "\": the name is taken; called \"" + other + "\"");
  return other;
}

}  // namespace graspbench
