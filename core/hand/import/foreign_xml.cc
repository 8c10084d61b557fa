#include "core/hand/import/foreign_xml.h"

#include <cmath>
#include <map>

#include "core/base/text/text.h"

namespace graspbench {

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
