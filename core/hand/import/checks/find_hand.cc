#include "core/hand/import/checks/find_hand.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/base/text/text.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {
namespace {

constexpr double kLargestReach = 0.5;  // [m] of a digit's last joint from the palm
constexpr double kApart = 0.2;         // [m] between two objects that are not one hand

class HandFinder {
 public:
  HandFinder(const ForeignHand& foreign, const ForeignTree& tree, const std::vector<bool>& has_body,
             const std::string& file, Diagnostics& problems)
      : foreign_(foreign), tree_(tree), file_(file), problems_(problems) {
    CountEnds(has_body);
    PlaceLinks();
  }

  HandCandidate Find() {
    int top = tree_.order.front();
    if (num_ends_[top] == 0) {
      problems_.Fail(file_, 0,
                     "no joint moves anything that could touch: this is not a hand description");
      return {};
    }
    for (;;) {
      const int palm = FindParting(top);
      const std::vector<int> branches = ListBranches(palm);
      std::vector<int> hands;
      std::copy_if(branches.begin(), branches.end(), std::back_inserter(hands),
                   [&](int branch) { return IsHand(branch); });
      if (num_ends_[palm] < 2) {
        problems_.Fail(
            file_, 0,
            "the joints form one chain without digits: an arm, one finger, or one jaw. A hand has "
            "two digits at least; one may be a fixed jaw, the only link with a shape that is fixed "
            "to the palm");
        return {};
      }
      if (!IsScene(palm, branches, hands)) {
        std::vector<int> fixed = ListHandsFixedTo(palm);
        if (!fixed.empty()) {
          fixed.insert(fixed.begin(), palm);
          FailOfSeveral("", fixed);
          return {};
        }
        WarnOfCarrier(palm);
        return {palm, top, {}};
      }
      if (hands.empty()) {
        problems_.Fail(
            file_, 0,
            "found " + ListNames(branches) + ", each on its own at \"" + NameOf(palm) +
                "\", which is no palm: no hand. A hand has two digits at least that part "
                "from a palm with a shape or a mass");
        return {};
      }
      if (hands.size() > 1) {
        FailOfSeveral("", hands);
        return {};
      }
      std::vector<int> others;
      for (const int branch : branches) {
        if (branch != hands[0]) others.push_back(branch);
      }
      if (!others.empty()) {
        problems_.Warn(file_, foreign_.links[others[0]].line,
                       ListNames(others) + ": not of the hand at \"" +
                           NameOf(FindParting(hands[0])) +
                           "\" but of the scene around it; left out");
      }
      top = hands[0];
    }
  }

  HandCandidate FindNamed(const std::string& name) {
    std::vector<std::string> known;
    int palm = -1;
    for (size_t link = 0; link < foreign_.links.size(); ++link) {
      if (NameOf(static_cast<int>(link)) == name) palm = static_cast<int>(link);
      known.push_back(NameOf(static_cast<int>(link)));
    }
    if (palm < 0) {
      problems_.Fail(file_, 0, "no link \"" + name + "\" for the palm" + SuggestNames(name, known));
      return {};
    }
    const std::vector<int> hands = ListHandsBelow(FindParting(palm));
    if (hands.size() > 1) {
      FailOfSeveral("below \"" + name + "\" ", hands);
      return {};
    }
    // If several parts are fixed to each other, any of them may be named.
    int own = palm;
    while (num_ends_[own] < 2 && tree_.joint_of[own] >= 0 && !Moves(own)) {
      own = foreign_.joints[tree_.joint_of[own]].parent;
    }
    const std::vector<int> fixed = ListHandsFixedTo(FindParting(palm));
    if (!fixed.empty()) {
      problems_.Warn(file_, foreign_.links[fixed[0]].line,
                     ListNames(fixed) + ": another hand, fixed to \"" + name + "\"; left out");
    }
    for (int at = own; tree_.joint_of[at] >= 0;) {
      const int above = foreign_.joints[tree_.joint_of[at]].parent;
      std::vector<int> others = ListBranches(above);
      others.erase(std::remove(others.begin(), others.end(), at), others.end());
      const bool are_separate =
          above == foreign_.world || IsHandFixedTo(above, at) ||
          std::all_of(others.begin(), others.end(), [&](int other) {
            return (p_RootLink_[FindParting(other)] - p_RootLink_[own]).norm() > kApart;
          });
      if (!others.empty() && are_separate) {
        problems_.Warn(file_, foreign_.links[others[0]].line,
                       ListNames(others) + ": not below the palm \"" + name + "\"; left out");
        return CutFromCarrier({palm, at, fixed}, own);
      }
      at = above;
    }
    return CutFromCarrier({palm, tree_.order.front(), fixed}, own);
  }

 private:
  bool Moves(int link) const {
    const int joint = tree_.joint_of[link];
    return joint >= 0 && foreign_.joints[joint].kind != ForeignJoint::Kind::kFixed;
  }
  bool IsFixedJaw(int link) const {
    const int joint = tree_.joint_of[link];
    return joint >= 0 && foreign_.joints[joint].bears_jaw;
  }
  const std::string& NameOf(int link) const { return foreign_.links[link].name; }
  bool HasOwnBody(int link) const {
    const ForeignLink& own = foreign_.links[link];
    return own.inertia || !own.collisions.empty() || !own.visuals.empty();
  }

  void CountEnds(const std::vector<bool>& has_body) {
    num_ends_.assign(foreign_.links.size(), 0);
    for (size_t i = tree_.order.size(); i-- > 0;) {
      const int link = tree_.order[i], joint = tree_.joint_of[link];
      const bool can_end = Moves(link) || IsFixedJaw(link);
      if (can_end && has_body[link]) num_ends_[link] = std::max(num_ends_[link], 1);
      if (joint >= 0) num_ends_[foreign_.joints[joint].parent] += num_ends_[link];
    }
  }

  void PlaceLinks() {
    std::vector<Pose> X_RL(foreign_.links.size(), Pose::Identity());
    p_RootLink_.assign(foreign_.links.size(), Eigen::Vector3d::Zero());
    for (const int link : tree_.order) {
      if (const int j = tree_.joint_of[link]; j >= 0) {
        X_RL[link] = X_RL[foreign_.joints[j].parent] * foreign_.joints[j].X_PJ;
      }
      p_RootLink_[link] = X_RL[link].translation();
    }
  }

  /** Returns the lowest link that all chains at or below this one have in common. */
  int FindParting(int link) const {
    for (size_t i = 0; i < tree_.joints[link].size();) {
      const int child = foreign_.joints[tree_.joints[link][i]].child;
      const bool has_all = num_ends_[child] == num_ends_[link] && num_ends_[child] > 1;
      link = has_all ? child : link;
      i = has_all ? 0 : i + 1;
    }
    return link;
  }

  std::vector<int> ListBranches(int link) const {
    std::vector<int> branches;
    for (const int joint : tree_.joints[link]) {
      if (num_ends_[foreign_.joints[joint].child] > 0) {
        branches.push_back(foreign_.joints[joint].child);
      }
    }
    return branches;
  }

  bool IsHand(int branch) const {
    if (num_ends_[branch] < 2) return false;
    const int palm = FindParting(branch);
    std::vector<int> below = {palm};
    for (size_t i = 0; i < below.size(); ++i) {
      for (const int joint : tree_.joints[below[i]]) below.push_back(foreign_.joints[joint].child);
    }
    return std::all_of(below.begin(), below.end(), [&](int link) {
      return (p_RootLink_[link] - p_RootLink_[palm]).norm() < kLargestReach;
    });
  }

  bool AreApart(int a, int b) const {
    return (p_RootLink_[FindParting(a)] - p_RootLink_[FindParting(b)]).norm() > kApart;
  }

  /** Whether the link carries separate objects and is not a palm. */
  bool IsScene(int link, const std::vector<int>& branches, const std::vector<int>& hands) const {
    if (link == foreign_.world) return !HasOwnBody(link) || !hands.empty();
    for (const int a : hands) {
      for (const int b : hands) {
        if (a != b && AreApart(a, b)) return true;
      }
    }
    return hands.size() == 1 && !HasOwnBody(link) &&
           std::all_of(branches.begin(), branches.end(), [&](int branch) {
             return branch == hands[0] || AreApart(branch, hands[0]);
           });
  }

  /** Returns the branches that are hands and apart from another hand. */
  std::vector<int> ListHandsBelow(int link) const {
    const std::vector<int> branches = ListBranches(link);
    std::vector<int> hands;
    for (const int branch : branches) {
      if (!IsHand(branch)) continue;
      const bool is_apart = std::any_of(branches.begin(), branches.end(), [&](int other) {
        return other != branch && IsHand(other) && AreApart(other, branch);
      });
      if (is_apart) hands.push_back(branch);
    }
    return hands;
  }

  /** Returns the last links of the chains at or below a link. @param left_out  branch to skip. */
  std::vector<int> ListDigits(int link, int left_out) const {
    std::vector<int> ends;
    std::vector<int> open = {link};
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      const std::vector<int> branches = ListBranches(at);
      if (branches.empty()) ends.push_back(at);
      for (const int branch : branches) {
        if (branch != left_out) open.push_back(branch);
      }
    }
    return ends;
  }

  /** Whether not all of the digits point in the same direction. */
  bool HasThumb(const std::vector<int>& ends) const {
    constexpr double kSameWay = 0.9;  // cosine
    std::vector<Eigen::Vector3d> along;
    for (const int end : ends) {
      int base = end;
      for (int at = end; num_ends_[at] == 1 && tree_.joint_of[at] >= 0;) {
        base = at;
        at = foreign_.joints[tree_.joint_of[at]].parent;
      }
      along.push_back((p_RootLink_[end] - p_RootLink_[base]).stableNormalized());
    }
    return std::any_of(along.begin(), along.end(), [&](const Eigen::Vector3d& each) {
      return each.norm() > 0.5 && along[0].norm() > 0.5 && each.dot(along[0]) < kSameWay;
    });
  }

  /** Whether a branch is a second hand that is fixed to one with its own digits. It must be far
  from
the first. Since a palm may consist of several parts, a nearer one must have as many digits, at
least three, and a thumb like the first. */
  bool IsHandFixedTo(int link, int branch) const {
    if (!HasOwnBody(link) || !IsHand(branch)) return false;
    const int palm = FindParting(branch);
    for (int at = palm; at != link; at = foreign_.joints[tree_.joint_of[at]].parent) {
      if (Moves(at)) return false;
    }
    const std::vector<int> own = ListDigits(link, branch), others = ListDigits(branch, -1);
    if (own.size() < 2) return false;
    const bool is_far = (p_RootLink_[palm] - p_RootLink_[link]).norm() > kApart &&
                        std::none_of(own.begin(), own.end(), [&](int end) {
                          return (p_RootLink_[palm] - p_RootLink_[end]).norm() < kApart;
                        });
    return is_far ||
           (own.size() >= 3 && own.size() == others.size() && HasThumb(own) && HasThumb(others));
  }

  std::vector<int> ListHandsFixedTo(int link) const {
    std::vector<int> hands;
    for (const int branch : ListBranches(link)) {
      if (IsHandFixedTo(link, branch)) hands.push_back(branch);
    }
    return hands;
  }

  void FailOfSeveral(const std::string& where, const std::vector<int>& hands) {
    std::vector<int> palms;
    for (const int hand : hands) palms.push_back(FindParting(hand));
    problems_.Fail(file_, 0,
                   where + "found " + std::to_string(hands.size()) + " hands, with the palms " +
                       ListNames(palms) + "; choose one with --palm");
  }

  std::string ListNames(const std::vector<int>& links) const {
    std::string text;
    for (const int link : links) text += (text.empty() ? "\"" : ", \"") + NameOf(link) + "\"";
    return text;
  }

  /** Returns a body, such as a table, that hangs on a mere frame beside a link and outweighs it;
  -1:
none. */
  int FindHeavyNeighbour(int frame, int link) const {
    for (const int joint : tree_.joints[frame]) {
      const int beside = foreign_.joints[joint].child;
      if (beside != link && num_ends_[beside] == 0 && CalcMass(beside) > CalcMass(link)) {
        return beside;
      }
    }
    return -1;
  }

  HandCandidate CutFromCarrier(HandCandidate hand, int own) const {
    for (int at = own; tree_.joint_of[at] >= 0 && !Moves(at);) {
      const int above = foreign_.joints[tree_.joint_of[at]].parent;
      if (num_ends_[above] != num_ends_[own] || above == foreign_.world) break;
      hand.carrier = HasOwnBody(above) ? above : FindHeavyNeighbour(above, at);
      if (hand.carrier >= 0) {
        hand.root = at;
        break;
      }
      at = above;
    }
    return hand;
  }

  void WarnOfCarrier(int palm) {
    const int carrier = CutFromCarrier({}, palm).carrier;
    if (carrier < 0) return;
    const double below = CalcMass(palm);
    const auto& inertia = foreign_.links[carrier].inertia;
    const double own = inertia ? std::max(0.0, inertia->mass) : 0.0;
    if (own <= below) return;
    problems_.Warn(
        file_, foreign_.links[carrier].line,
        "link \"" + NameOf(carrier) + "\" weighs " + FormatSignificant(own, 3) +
            " kg and is fixed to \"" + NameOf(palm) + "\", which weighs " +
            FormatSignificant(below, 3) +
            " kg with its digits; taken as a part of the palm. If it carries the hand, say "
            "--palm " +
            NameOf(palm));
  }

  /** Mass of the link and all links below it [kg]. */
  double CalcMass(int link) const {
    const auto& inertia = foreign_.links[link].inertia;
    double mass = inertia ? std::max(0.0, inertia->mass) : 0.0;
    for (const int joint : tree_.joints[link]) mass += CalcMass(foreign_.joints[joint].child);
    return mass;
  }

  const ForeignHand& foreign_;
  const ForeignTree& tree_;
  const std::string& file_;
  Diagnostics& problems_;
  std::vector<int> num_ends_;                // by link: number of chains at or below it
  std::vector<Eigen::Vector3d> p_RootLink_;  // by link, with all joints at zero
};

}  // namespace

ForeignTree MakeForeignTree(const ForeignHand& foreign) {
  ForeignTree tree;
  tree.joint_of.assign(foreign.links.size(), -1);
  tree.joints.resize(foreign.links.size());
  for (size_t j = 0; j < foreign.joints.size(); ++j) {
    tree.joint_of[foreign.joints[j].child] = static_cast<int>(j);
    tree.joints[foreign.joints[j].parent].push_back(static_cast<int>(j));
  }
  for (size_t link = 0; link < foreign.links.size(); ++link) {
    if (tree.joint_of[link] < 0) tree.order.push_back(static_cast<int>(link));
  }
  for (size_t i = 0; i < tree.order.size(); ++i) {
    for (int joint : tree.joints[tree.order[i]]) tree.order.push_back(foreign.joints[joint].child);
  }
  return tree;
}

void MarkFixedJaw(const ForeignTree& tree, const std::vector<bool>& has_body,
                  const std::vector<bool>& is_asked, const std::string& file, Diagnostics& problems,
                  ForeignHand& foreign) {
  const auto has_shape = [&](int link) {
    return !foreign.links[link].collisions.empty() || !foreign.links[link].visuals.empty();
  };
  std::vector<int> moving, fixed;
  for (int j = 0; j < static_cast<int>(foreign.joints.size()); ++j) {
    const bool moves = foreign.joints[j].kind != ForeignJoint::Kind::kFixed;
    if (moves && is_asked[foreign.joints[j].child] && has_body[foreign.joints[j].child]) {
      moving.push_back(j);
    }
  }
  if (moving.size() != 1) return;
  const int palm = foreign.joints[moving[0]].parent, jaw = foreign.joints[moving[0]].child;
  for (const int j : tree.joints[palm]) {
    if (j != moving[0] && has_body[foreign.joints[j].child]) fixed.push_back(j);
  }
  if (fixed.size() != 1 || !has_shape(palm) || !has_shape(foreign.joints[fixed[0]].child)) return;
  ForeignJoint& joint = foreign.joints[fixed[0]];
  joint.bears_jaw = true;
  problems.Warn(file, joint.line,
                "link \"" + foreign.links[joint.child].name + "\" is fixed to \"" +
                    foreign.links[palm].name + "\": the jaw on which \"" + foreign.links[jaw].name +
                    "\" closes, taken as a digit");
}

HandCandidate FindHand(const ForeignHand& foreign, const ForeignTree& tree,
                       const std::vector<bool>& has_body, const std::string& palm,
                       const std::string& file, Diagnostics& problems) {
  HandFinder finder(foreign, tree, has_body, file, problems);
  return palm.empty() ? finder.Find() : finder.FindNamed(palm);
}

}  // namespace graspbench
