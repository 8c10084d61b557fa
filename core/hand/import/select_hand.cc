#include "core/hand/import/select_hand.h"

#include <algorithm>

#include "core/base/text/text.h"

namespace graspbench {
namespace {

constexpr int kMostWristJoints = 2;
constexpr double kHeaviestHand = 10.0;  // [kg]

bool IsMoving(const ForeignJoint& joint) { return joint.kind != ForeignJoint::Kind::kFixed; }

class HandSelector {
 public:
  HandSelector(ForeignHand& foreign, const std::string& file, Diagnostics& problems)
      : foreign_(foreign), file_(file), problems_(problems), tree_(MakeForeignTree(foreign)) {}

  int Select(const std::string& palm, const std::function<bool(const ForeignLink&)>& lacks_mesh) {
    std::vector<bool> touches;
    for (const ForeignLink& link : foreign_.links) {
      touches.push_back(!link.collisions.empty() || !link.visuals.empty());
    }
    const std::vector<bool> has_body = FixEmptyEnds(touches, tree_, file_, problems_, foreign_);
    std::vector<bool> is_asked;  // at or below a named palm
    for (int link = 0; link < static_cast<int>(foreign_.links.size()); ++link) {
      is_asked.push_back(palm.empty() || IsBelowNamed(link, palm));
    }
    MarkFixedJaw(tree_, has_body, is_asked, file_, problems_, foreign_);
    const HandCandidate place = FindHand(foreign_, tree_, has_body, palm, file_, problems_);
    if (place.palm < 0) return -1;
    FindRoot(place);
    if (!palm.empty()) CutAtMissing(place.palm, lacks_mesh);
    left_out_ = place.left_out;
    if (!CheckMass()) return -1;
    return Keep(place.palm);
  }

 private:
  void FindRoot(const HandCandidate& place) {
    root_ = tree_.order.front();
    if (place.carrier >= 0) {
      root_ = place.root;
      WarnAt(foreign_.links[place.carrier].line,
             "\"" + foreign_.links[place.carrier].name + "\" carries the palm \"" +
                 foreign_.links[place.palm].name + "\"; left out with all above it");
      return;
    }
    int num_joints = 0, below = place.palm;
    for (int link = place.palm; link != place.top && tree_.joint_of[link] >= 0;) {
      const ForeignJoint& joint = foreign_.joints[tree_.joint_of[link]];
      num_joints += IsMoving(joint);
      if (!IsMoving(joint) && num_joints == 0) below = joint.parent;
      link = joint.parent;
    }
    if (num_joints <= kMostWristJoints) {
      root_ = place.top;
      return;
    }
    root_ = below;
    WarnAt(foreign_.links[below].line,
           "the " + std::to_string(num_joints) + " joints above \"" + foreign_.links[below].name +
               "\" are taken as an arm and left out: the arm of an experiment carries the palm");
  }

  /** Cuts at missing meshes: parts above a named palm may be missing. */
  void CutAtMissing(int palm, const std::function<bool(const ForeignLink&)>& lacks_mesh) {
    if (root_ == palm || !IsBelow(palm, root_)) return;
    int missing = -1;
    for (const int link : tree_.order) {
      const bool is_above = IsBelow(link, root_) && !IsBelow(link, palm);
      if (is_above && IsBelow(palm, link) && lacks_mesh(foreign_.links[link])) missing = link;
    }
    if (missing < 0) return;
    root_ = palm;
    WarnAt(foreign_.links[missing].line, "the mesh of \"" + foreign_.links[missing].name +
                                             "\", above the palm, is missing; the palm is the root "
                                             "and all above it is left out");
  }

  /** Returns false, with an error, if the remaining links are too heavy for a hand. */
  bool CheckMass() {
    double mass = 0.0, most = 0.0;
    int heaviest = -1;
    for (const int link : tree_.order) {
      const auto& inertia = foreign_.links[link].inertia;
      if (!inertia || IsLeftOut(link)) continue;
      mass += std::max(0.0, inertia->mass);
      if (inertia->mass <= most) continue;
      most = inertia->mass;
      heaviest = link;
    }
    if (mass <= kHeaviestHand) return true;
    problems_.Fail(file_, foreign_.links[heaviest].inertia->line,
                   "its links weigh " + FormatSignificant(mass, 3) + " kg in all, \"" +
                       foreign_.links[heaviest].name + "\" alone " + FormatSignificant(most, 3) +
                       " kg; a hand weighs 10 kg at most. Are these grams, or parts of a scene? "
                       "Give kilograms, or name the palm with --palm");
    return false;
  }

  int Keep(int palm) {
    std::vector<int> link_of(foreign_.links.size(), -1), joint_of(foreign_.joints.size(), -1);
    ForeignHand kept = foreign_;
    kept.links.clear();
    kept.joints.clear();
    for (size_t link = 0; link < foreign_.links.size(); ++link) {
      if (IsLeftOut(static_cast<int>(link))) continue;
      link_of[link] = static_cast<int>(kept.links.size());
      kept.links.push_back(std::move(foreign_.links[link]));
    }
    for (size_t j = 0; j < foreign_.joints.size(); ++j) {
      ForeignJoint& joint = foreign_.joints[j];
      if (joint.child == root_ || link_of[joint.child] < 0) continue;
      joint_of[j] = static_cast<int>(kept.joints.size());
      joint.parent = link_of[joint.parent];
      joint.child = link_of[joint.child];
      kept.joints.push_back(std::move(joint));
    }
    for (ForeignJoint& joint : kept.joints) {
      if (!joint.mimic) continue;
      joint.mimic->joint = joint_of[joint.mimic->joint];
      if (joint.mimic->joint < 0) joint.mimic.reset();
    }
    kept.world = foreign_.world < 0 ? -1 : link_of[foreign_.world];
    foreign_ = std::move(kept);
    return link_of[palm];
  }

  bool IsBelow(int link, int ancestor) const {
    while (link != ancestor && tree_.joint_of[link] >= 0) {
      link = foreign_.joints[tree_.joint_of[link]].parent;
    }
    return link == ancestor;
  }
  bool IsBelowNamed(int link, const std::string& name) const {
    while (foreign_.links[link].name != name && tree_.joint_of[link] >= 0) {
      link = foreign_.joints[tree_.joint_of[link]].parent;
    }
    return foreign_.links[link].name == name;
  }
  bool IsLeftOut(int link) const {
    return !IsBelow(link, root_) || std::any_of(left_out_.begin(), left_out_.end(),
                                                [&](int other) { return IsBelow(link, other); });
  }
  void WarnAt(int line, const std::string& text) { problems_.Warn(file_, line, text); }

  ForeignHand& foreign_;
  const std::string& file_;
  Diagnostics& problems_;
  const ForeignTree tree_;
  int root_ = -1;
  std::vector<int> left_out_;  // links that are left out with all below them
};

}  // namespace

std::vector<bool> FixEmptyEnds(const std::vector<bool>& touches, const ForeignTree& tree,
                               const std::string& file, Diagnostics& problems, ForeignHand& hand) {
  std::vector<bool> has_body = touches;
  const auto is_followed = [&](int joint) {
    return std::any_of(hand.joints.begin(), hand.joints.end(),
                       [&](const ForeignJoint& j) { return j.mimic && j.mimic->joint == joint; });
  };
  for (size_t i = tree.order.size(); i-- > 0;) {
    const int link = tree.order[i], joint = tree.joint_of[link];
    if (joint < 0) continue;
    if (has_body[link]) {
      has_body[hand.joints[joint].parent] = true;
    } else if (IsMoving(hand.joints[joint]) && !is_followed(joint)) {
      problems.Warn(
          file, hand.joints[joint].line,
          "joint \"" + hand.joints[joint].name + "\" moves nothing that could touch; fixed");
      FixJoint(hand, joint, 0.0);
    }
  }
  return has_body;
}

int SelectHand(const std::string& palm, const std::function<bool(const ForeignLink&)>& lacks_mesh,
               const std::string& file, Diagnostics& problems, ForeignHand& hand) {
  return HandSelector(hand, file, problems).Select(palm, lacks_mesh);
}

}  // namespace graspbench
