#include "core/hand/import/mjcf/mjcf_couplings.h"

#include <tinyxml2.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/import/checks/joint_limits.h"
#include "core/hand/import/close_loops.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {
namespace {

using tinyxml2::XMLElement;

constexpr double kLeastReached = 0.5;  // share of a joint's range that the goals of its servo cover
constexpr double kMostGoals = 3.0;     // range of the goals over that of the joint

/** Length of a fixed tendon, or of a joint: sum of coefficient times displacement. */
using Terms = std::vector<std::pair<int, double>>;  // joint, coefficient

std::string TextOf(const MjcfDocument& document, const MjcfNode& node, const char* attribute) {
  const char* text = document.Find(node, attribute);
  return text ? text : "";
}

class MjcfCouplingReader {
 public:
  MjcfCouplingReader(MjcfDocument& document, const std::map<std::string, MjcfBody>& bodies,
                     const std::string& file, Diagnostics& problems, ForeignHand& hand)
      : document_(document), bodies_(bodies), file_(file), problems_(problems), hand_(hand) {}

  void Read() {
    ReadTendons();
    ReadEqualities();
    ResolveMimics(mimics_, "<equality>", file_, problems_, hand_);
    ReadActuators();
    CloseLoops(loops_, driven_, file_, problems_, hand_);
    FixUnlimited(file_, problems_, hand_);
    TellUnusedTendons();
    WarnOfPassive();
  }

 private:
  int FindJoint(const std::string& name) const {
    for (size_t j = 0; j < hand_.joints.size(); ++j) {
      const bool moves = hand_.joints[j].kind != ForeignJoint::Kind::kFixed;
      if (moves && hand_.joints[j].name == name) return static_cast<int>(j);
    }
    return -1;
  }

  Terms ReadTerms(XMLElement& tendon, const std::string& where) {
    Terms terms;
    for (XMLElement* element : document_.ListChildren(tendon)) {
      const MjcfNode node = {element, nullptr};
      const std::string name = TextOf(document_, node, "joint");
      const int joint = FindJoint(name);
      const double coefficient = document_.FindNumber(node, "coef", 0.0, where);
      if (joint < 0) document_.Warn(*element, where + ": no joint \"" + name + "\" that moves");
      if (joint >= 0 && coefficient == 0.0) {
        document_.Warn(*element, where + ": joint \"" + name + "\" counts 0 times; left out of it");
      }
      if (joint >= 0 && coefficient != 0.0) terms.emplace_back(joint, coefficient);
    }
    return terms;
  }

  void ReadTendons() {
    for (XMLElement* section : document_.FindSections("tendon")) {
      for (XMLElement* element : document_.ListChildren(*section)) {
        const char* name = element->Attribute("name");
        const std::string kind = element->Name();
        if (kind == "fixed") {
          if (!name) continue;
          const auto [tendon, is_new] =
              tendons_.emplace(name, ReadTerms(*element, "tendon \"" + std::string(name) + "\""));
          if (!is_new) continue;
          unused_tendons_.emplace(name, element);
          TieByLimits(*element, name, tendon->second);
        } else {
          document_.Warn(*element, "tendon \"" + std::string(name ? name : "") + "\" of kind <" +
                                       kind + "> is not read; its joints get drives of their own");
        }
      }
    }
  }

  /** Couples two joints by tendon limits that leave them little play: c0 q0 + c1 q1 = middle. Here
positions count from the joints' `ref` (MuJoCo, "Computation", tendons), unlike those of
equalities. */
  void TieByLimits(XMLElement& tendon, const std::string& name, const Terms& terms) {
    constexpr double kNarrow = 0.25;  // share of the tendon motion that either joint causes
    const MjcfNode node = document_.Resolve(tendon, nullptr);
    const std::string where = "tendon \"" + name + "\"";
    const auto range = document_.FindNumbers(node, "range", 2, 2, where);
    if (terms.size() != 2 || !range || TextOf(document_, node, "limited") == "false") return;
    const auto& [upper, lower] = std::minmax(terms[0], terms[1]);
    const ForeignJoint &leader = hand_.joints[upper.first], &follower = hand_.joints[lower.first];
    const double width = (*range)[1] - (*range)[0];
    const double moves = std::min(std::abs(upper.second) * (leader.upper - leader.lower),
                                  std::abs(lower.second) * (follower.upper - follower.lower));
    if (leader.kind != follower.kind || width < 0.0 || width > kNarrow * moves) return;
    const double play = 0.5 * width / std::abs(lower.second);
    const bool slides = follower.kind == ForeignJoint::Kind::kPrismatic;
    const double ratio = -upper.second / lower.second;
    const double middle = 0.5 * ((*range)[0] + (*range)[1]) - upper.second * leader.reference -
                          lower.second * follower.reference;
    const double offset = middle / lower.second;
    const auto format = [&](double position) {
      return slides ? FormatFixed(MmFromM(position), 2) + " mm"
                    : FormatFixed(DegFromRad(position), 2) + " deg";
    };
    mimics_.push_back({lower.first, document_.LineOf(tendon), leader.name, ratio, offset});
    unused_tendons_.erase(name);
    document_.Warn(tendon, where + ": its narrow limits tie joint \"" + follower.name + "\" to " +
                               FormatSignificant(ratio, 3) + " times \"" + leader.name + "\"" +
                               (std::abs(offset) > 1e-9 ? " plus " + format(offset) : "") +
                               "; the play of " + format(play) + " each way is left out");
  }

  /** Reports tendons that neither couple nor drive anything here. */
  void TellUnusedTendons() {
    for (const auto& [name, element] : unused_tendons_) {
      std::vector<std::string> joints;
      for (const auto& [joint, coefficient] : tendons_[name]) {
        joints.push_back(hand_.joints[joint].name);
      }
      document_.Warn(*element, "tendon \"" + name + "\"" +
                                   (joints.empty() ? " of no joint" : " of " + JoinSome(joints)) +
                                   ": no actuator pulls it, no equality holds it, and it is no tie "
                                   "of two joints by narrow limits; left out");
    }
  }

  void ReadEqualities() {
    for (XMLElement* section : document_.FindSections("equality")) {
      for (XMLElement* element : document_.ListChildren(*section)) {
        const MjcfNode node = document_.Resolve(*element, nullptr);
        const std::string kind = element->Name();
        if (TextOf(document_, node, "active") == "false") continue;
        if (kind == "connect" && ReadConnect(node)) continue;
        if (kind != "joint" && kind != "tendon") {
          document_.Warn(*element, "equality <" + kind +
                                       "> is not read: what it holds together is not; joints that "
                                       "nothing else ties get drives of their own");
          continue;
        }
        const std::string names[2] = {TextOf(document_, node, (kind + "1").c_str()),
                                      TextOf(document_, node, (kind + "2").c_str())};
        Terms terms[2];
        for (int k = 0; k < 2; ++k) {
          if (kind == "tendon" && tendons_.count(names[k]) != 0) terms[k] = tendons_[names[k]];
          if (kind == "tendon") unused_tendons_.erase(names[k]);
          if (kind == "joint" && FindJoint(names[k]) >= 0) terms[k] = {{FindJoint(names[k]), 1.0}};
        }
        const std::string where = "equality of \"" + names[0] + "\"";
        if (terms[0].empty() || (!names[1].empty() && terms[1].empty())) {
          document_.Warn(*element, where + ": no " + kind + " \"" +
                                       (terms[0].empty() ? names[0] : names[1]) +
                                       "\" that moves; left out");
        } else {
          ReadEquality(node, terms[0], terms[1], where);
        }
      }
    }
  }

  /** Reads first = polynomial(second) as a line between two joints. */
  void ReadEquality(const MjcfNode& node, const Terms& first, const Terms& second,
                    const std::string& where) {
    std::vector<double> a = {0.0, 1.0, 0.0, 0.0, 0.0};
    if (const auto given = document_.FindNumbers(node, "polycoef", 1, 5, where)) {
      std::copy(given->begin(), given->end(), a.begin());
    }
    if (first.size() == 1 && second.empty()) {
      FixJoint(hand_, first[0].first, a[0] / first[0].second);
      return;
    }
    if (first.size() == 2 && second.empty()) {  // c0 q0 + c1 q1 = a
      const auto& [upper, lower] = std::minmax(first[0], first[1]);
      mimics_.push_back({lower.first, document_.LineOf(*node.xml), hand_.joints[upper.first].name,
                         -upper.second / lower.second, a[0] / lower.second});
      return;
    }
    if (first.size() != 1 || second.size() != 1) {
      document_.Warn(*node.xml, where + ": ties more than two joints; left out");
      return;
    }
    const ForeignJoint& other = hand_.joints[second[0].first];
    constexpr int kNumPoints = 65;
    Eigen::MatrixX2d basis(kNumPoints, 2);
    Eigen::VectorXd values(kNumPoints);
    for (int i = 0; i < kNumPoints; ++i) {
      const double q = other.lower + (other.upper - other.lower) * i / (kNumPoints - 1);
      const double x = second[0].second * q;
      basis.row(i) << 1.0, q;
      values[i] = (a[0] + x * (a[1] + x * (a[2] + x * (a[3] + x * a[4])))) / first[0].second;
    }
    Eigen::Vector2d line(a[0] / first[0].second, a[1] * second[0].second / first[0].second);
    if (a[2] != 0.0 || a[3] != 0.0 || a[4] != 0.0) {
      line = basis.colPivHouseholderQr().solve(values);
      const double error = (basis * line - values).cwiseAbs().maxCoeff();
      const bool slides = hand_.joints[first[0].first].kind == ForeignJoint::Kind::kPrismatic;
      document_.Warn(*node.xml, where + ": a polynomial; the line nearest to it is taken, off by " +
                                    (slides ? FormatFixed(MmFromM(error), 2) + " mm"
                                            : FormatFixed(DegFromRad(error), 2) + " deg") +
                                    " at most");
    }
    mimics_.push_back({first[0].first, document_.LineOf(*node.xml), other.name, line[1], line[0]});
  }

  void ReadActuators() {
    for (XMLElement* section : document_.FindSections("actuator")) {
      for (XMLElement* element : document_.ListChildren(*section)) {
        ReadActuator(document_.Resolve(*element, nullptr));
      }
    }
  }

  /** Compares the goals to which a servo is limited with the range of its joint. The joint is
  driven
over its range in any case. @param arm  goal per position. */
  void CheckGoals(const MjcfNode& node, const std::string& where, int joint, double arm) {
    const ForeignJoint& moved = hand_.joints[joint];
    const auto goals = document_.FindNumbers(node, "ctrlrange", 2, 2, where);
    if (!goals || TextOf(document_, node, "ctrllimited") == "false") return;
    if (!moved.no_limits.empty() || (*goals)[0] >= (*goals)[1]) return;
    const double a = (*goals)[0] / arm, b = (*goals)[1] / arm;
    const double first = std::min(a, b), last = std::max(a, b), range = moved.upper - moved.lower;
    const double reached = std::min(last, moved.upper) - std::max(first, moved.lower);
    if (reached > kLeastReached * range && last - first < kMostGoals * range) return;
    const bool slides = moved.kind == ForeignJoint::Kind::kPrismatic;
    const auto format = [&](double from, double to) {
      return slides ? FormatFixed(MmFromM(from), 1) + " to " + FormatFixed(MmFromM(to), 1) + " mm"
                    : FormatFixed(DegFromRad(from), 0) + " to " + FormatFixed(DegFromRad(to), 0) +
                          " deg";
    };
    document_.Warn(*node.xml, where + ": its goals lie from " + format(first, last) + ", joint \"" +
                                  moved.name + "\" moves from " + format(moved.lower, moved.upper) +
                                  "; driven over the joint's range. Is ctrlrange or gear wrong?");
  }

  void ReadActuator(const MjcfNode& node) {
    const std::string kind = node.xml->Name(), name = TextOf(document_, node, "name");
    const std::string moved = TextOf(document_, node, "joint");
    const std::string where = name.empty() && !moved.empty() ? "actuator of joint \"" + moved + "\""
                                                             : "actuator \"" + name + "\"";
    if (kind == "plugin" || kind == "adhesion") {
      document_.Warn(*node.xml, where + " of kind <" + kind + "> is not read; left out");
      return;
    }
    const Terms leaders = ProjectOnLeaders(FindTransmission(node, where));
    if (leaders.empty()) return;
    double gear = 1.0;
    if (const auto given = document_.FindNumbers(node, "gear", 1, 6, where)) gear = (*given)[0];
    if (gear == 0.0) gear = 1.0;
    const double arm = gear * ShareDrive(*node.xml, where, leaders);
    const bool is_driven = !driven_.insert(leaders[0].first).second;
    ForeignDrive drive;
    if (kind == "position") {
      drive.stiffness = document_.FindNumber(node, "kp", 1.0, where);
      drive.damping = document_.FindNumber(node, "kv", 0.0, where);
      if (drive.stiffness <= 0.0 || drive.damping < 0.0) {
        document_.Warn(*node.xml, where + ": a gain kp of " +
                                      FormatSignificant(drive.stiffness, 3) + " and kv of " +
                                      FormatSignificant(drive.damping, 3) +
                                      " drive away from the goal; guessed instead");
        drive = {};
      }
    } else if (kind == "general" && TextOf(document_, node, "biastype") == "affine") {
      const auto bias = document_.FindNumbers(node, "biasprm", 1, 10, where);
      if (bias && bias->size() > 1) drive.stiffness = -(*bias)[1];
      if (bias && bias->size() > 2) drive.damping = -(*bias)[2];
    }
    if (drive.stiffness > 0.0 && leaders.size() == 1) {
      CheckGoals(node, where, leaders[0].first, arm);
      if (is_driven && hand_.joints[leaders[0].first].drive.stiffness > 0.0) {
        document_.Warn(*node.xml, where + ": a second servo for joint \"" +
                                      hand_.joints[leaders[0].first].name +
                                      "\"; the stiffer counts. Is another joint meant?");
      }
    }
    auto force = document_.FindNumbers(node, "forcerange", 2, 2, where);
    const bool is_torque = kind == "motor" || (kind == "general" && drive.stiffness == 0.0);
    if (!force && is_torque) force = document_.FindNumbers(node, "ctrlrange", 2, 2, where);
    if (force && (*force)[0] > (*force)[1]) {
      document_.Warn(*node.xml, where + ": the forcerange or ctrlrange is reversed; exchanged");
    }
    if (force) drive.effort = std::max(std::abs((*force)[0]), std::abs((*force)[1]));
    if (force && drive.effort == 0.0) {
      document_.Warn(*node.xml, where + ": a force of 0 moves nothing; guessed instead");
    }
    // Joint force is arm times the actuator's; actuator position is arm times the joint's.
    ForeignDrive& of_joint = hand_.joints[leaders[0].first].drive;
    const double effort = std::abs(arm) * drive.effort;
    if (effort > 0.0) {
      of_joint.effort = of_joint.effort > 0.0 ? std::min(of_joint.effort, effort) : effort;
    }
    of_joint.stiffness = std::max(of_joint.stiffness, arm * arm * std::max(0.0, drive.stiffness));
    of_joint.damping += arm * arm * std::max(0.0, drive.damping);
  }

  Terms FindTransmission(const MjcfNode& node, const std::string& where) {
    for (const char* attribute : {"joint", "jointinparent"}) {
      const std::string name = TextOf(document_, node, attribute);
      if (name.empty()) continue;
      if (const int joint = FindJoint(name); joint >= 0) return {{joint, 1.0}};
      document_.Warn(*node.xml, where + ": joint \"" + name + "\" does not move; left out");
      return {};
    }
    const std::string name = TextOf(document_, node, "tendon");
    unused_tendons_.erase(name);
    if (const auto found = tendons_.find(name); found != tendons_.end()) return found->second;
    document_.Warn(*node.xml,
                   where + ": acts on no joint and no fixed tendon of the hand; left out");
    return {};
  }

  /** Expresses the length by the joints that follow no other. */
  Terms ProjectOnLeaders(const Terms& terms) const {
    std::map<int, double> sums;
    for (const auto& [joint, coefficient] : terms) {
      if (hand_.joints[joint].kind == ForeignJoint::Kind::kFixed) continue;  // fixed by an equality
      const auto& mimic = hand_.joints[joint].mimic;
      sums[mimic ? mimic->joint : joint] += coefficient * (mimic ? mimic->ratio : 1.0);
    }
    Terms leaders;
    for (const auto& [joint, sum] : sums) {
      if (std::abs(sum) > 1e-9) leaders.emplace_back(joint, sum);
    }
    return leaders;
  }

  /** Merges the drives of several joints. @returns the length per position of the driven joint. */
  double ShareDrive(const XMLElement& at, const std::string& where, const Terms& leaders) {
    const auto [first, coefficient] = leaders[0];
    double sum = coefficient;
    const bool by_rule = MayShareByRule(leaders);
    for (size_t i = 1; i < leaders.size(); ++i) {
      const auto [joint, own] = leaders[i];
      document_.Warn(at, where + " moves several joints: \"" + hand_.joints[joint].name +
                             "\" follows \"" + hand_.joints[first].name + "\"" +
                             (by_rule ? " by the hand's coupling rule"
                                      : " " + FormatSignificant(own / coefficient, 3) + " times"));
      FollowJoint(hand_, joint, first, own / coefficient, 0.0);
      hand_.joints[joint].mimic->is_distal = by_rule;
      if (!by_rule) sum += own * own / coefficient;
    }
    return sum;
  }

  bool ReadConnect(const MjcfNode& node) {
    const std::string names[2] = {TextOf(document_, node, "body1"),
                                  TextOf(document_, node, "body2")};
    const auto first = bodies_.find(names[0]);
    const auto second = bodies_.find(names[1].empty() ? "world" : names[1]);
    const auto anchor = document_.FindNumbers(node, "anchor", 3, 3, "equality <connect>");
    if (first == bodies_.end() || second == bodies_.end() || !anchor) return false;
    LoopPoint& point = loops_.emplace_back();
    point.line = document_.LineOf(*node.xml);
    point.link_A = first->second.link;
    point.link_B = second->second.link;
    point.p_AP = first->second.X_LB * Eigen::Vector3d((*anchor)[0], (*anchor)[1], (*anchor)[2]);
    return true;
  }

  bool MayShareByRule(const Terms& leaders) const {
    if (leaders.size() != 2) return false;
    const ForeignJoint &middle = hand_.joints[leaders[0].first],
                       &distal = hand_.joints[leaders[1].first];
    const auto is_bending = [](const ForeignJoint& joint) {
      return joint.kind == ForeignJoint::Kind::kRevolute && joint.lower > -0.02 &&
             joint.upper > 0.5;
    };
    const auto is_followed = [&](int index) {
      return std::any_of(hand_.joints.begin(), hand_.joints.end(), [&](const ForeignJoint& joint) {
        return joint.mimic && joint.mimic->joint == index;
      });
    };
    return std::abs(leaders[0].second - leaders[1].second) < 1e-6 &&
           distal.parent == middle.child && is_bending(middle) && is_bending(distal) &&
           !is_followed(leaders[0].first) && !is_followed(leaders[1].first);
  }

  void WarnOfPassive() {
    if (driven_.empty()) return;
    std::string names;
    for (size_t j = 0; j < hand_.joints.size(); ++j) {
      const ForeignJoint& joint = hand_.joints[j];
      if (joint.kind == ForeignJoint::Kind::kFixed || joint.mimic) continue;
      if (driven_.count(static_cast<int>(j)) != 0) continue;
      names += (names.empty() ? "\"" : ", \"") + joint.name + "\"";
    }
    if (names.empty()) return;
    problems_.Warn(file_, 0,
                   "no actuator moves " + names +
                       ", and no other joint; each gets a "
                       "drive of its own, as no joint is loose here");
  }

  MjcfDocument& document_;
  const std::map<std::string, MjcfBody>& bodies_;
  const std::string& file_;
  Diagnostics& problems_;
  ForeignHand& hand_;
  std::map<std::string, Terms> tendons_;
  std::map<std::string, XMLElement*> unused_tendons_;
  std::vector<NamedMimic> mimics_;
  std::vector<LoopPoint> loops_;
  std::set<int> driven_;
};

}  // namespace

void ReadMjcfCouplings(MjcfDocument& document, const std::map<std::string, MjcfBody>& bodies,
                       const std::string& file, Diagnostics& problems, ForeignHand& hand) {
  MjcfCouplingReader(document, bodies, file, problems, hand).Read();
}

}  // namespace graspbench
