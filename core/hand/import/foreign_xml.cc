#include "core/hand/import/foreign_xml.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>

#include "core/base/text/text.h"

namespace graspbench {

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

void ResolveMimics(const std::vector<NamedMimic>& mimics, const std::string& what,
                   const std::string& file, Diagnostics& problems, ForeignHand& hand) {
  std::map<int, NamedMimic> own;  // by joint
  const auto drop = [&](const NamedMimic& mimic, const std::string& why) {
    problems.Warn(file, mimic.line,
                  "joint \"" + hand.joints[mimic.joint].name + "\": " + what + " " + why +
                      "; the joint gets a drive of its own");
  };
  std::map<std::string, int> index;
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    index.emplace(hand.joints[j].name, static_cast<int>(j));
  }
  for (const NamedMimic& mimic : mimics) {
    const auto found = index.find(mimic.follows);
    if (found == index.end()) {
      drop(mimic, "of \"" + mimic.follows + "\", which is no joint");
    } else if (found->second == mimic.joint) {
      drop(mimic, "of itself");
    } else if (hand.joints[found->second].kind == ForeignJoint::Kind::kFixed) {
      drop(mimic, "of \"" + mimic.follows + "\", which does not move");
    } else if (mimic.ratio == 0.0 || std::abs(mimic.ratio) > 100.0) {
      drop(mimic, "has a multiplier of " + FormatSignificant(mimic.ratio, 3));
    } else {
      own.emplace(mimic.joint, mimic);
    }
  }
  for (const NamedMimic& mimic : mimics) {
    if (own.count(mimic.joint) == 0) continue;
    ForeignMimic resolved;
    resolved.joint = mimic.joint;
    size_t steps = 0;  // the other may follow a third
    while (own.count(resolved.joint) != 0 && steps++ <= own.size()) {
      const NamedMimic& next = own.at(resolved.joint);
      resolved.joint = index.at(next.follows);
      resolved.offset += resolved.ratio * next.offset;
      resolved.ratio *= next.ratio;
    }
    if (steps > own.size()) {
      drop(mimic, "goes round in a ring");
      own.erase(mimic.joint);
    } else {
      hand.joints[mimic.joint].mimic = resolved;
    }
  }
}

}  // namespace graspbench
