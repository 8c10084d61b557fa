#include "core/hand/import/decoration.h"

#include <numeric>

namespace graspbench {

void FindDecoration(const std::string& file, Diagnostics& problems, ForeignHand& hand) {
  // By link: one link of its body, that of all links of the body.
  std::vector<size_t> body(hand.links.size());
  std::iota(body.begin(), body.end(), size_t{0});
  const auto find = [&](size_t link) {
    while (body[link] != link) link = body[link] = body[body[link]];
    return link;
  };
  for (const ForeignJoint& joint : hand.joints) {
    if (joint.kind != ForeignJoint::Kind::kFixed) continue;
    body[find(static_cast<size_t>(joint.child))] = find(static_cast<size_t>(joint.parent));
  }
  std::vector<const ForeignLink*> touching(hand.links.size());  // by body
  for (size_t i = 0; i < hand.links.size(); ++i) {
    const ForeignLink*& first = touching[find(i)];
    if (!first && !hand.links[i].collisions.empty()) first = &hand.links[i];
  }
  for (size_t i = 0; i < hand.links.size(); ++i) {
    ForeignLink& link = hand.links[i];
    const ForeignLink* other = touching[find(i)];
    if (!other || !link.collisions.empty() || link.visuals.empty()) continue;
    link.is_decoration = true;
    problems.Warn(file, link.line,
                  "link \"" + link.name + "\" has a picture and no collision shape, and \"" +
                      other->name +
                      "\", to which it is fixed, has some: its picture is decoration, left out of "
                      "contact and mass");
  }
}

}  // namespace graspbench
