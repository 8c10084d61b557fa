#include "datasets/grasps/map_to_hand.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>

#include "core/base/error.h"
#include "core/hand/hand.h"
#include "datasets/grasps/multigripper_table.h"

namespace graspbench {

namespace {

/** A joint in the frame of the one before it, all frames parallel at zero but the thumb's. */
struct PublishedJoint {
  Eigen::Vector3d p;  ///< [m]
  Eigen::Vector3d axis;
};

/** shadow_hand/right_hand.xml of MuJoCo Menagerie; the first joint of each digit in the palm. */
std::vector<std::vector<PublishedJoint>> ListPublishedDigits() {
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), none(0, 0, 0);
  const auto finger = [&](double side, double height, double sign) {
    return std::vector<PublishedJoint>{
        {{side, 0, height}, sign * y}, {none, x}, {{0, 0, 0.045}, x}, {{0, 0, 0.025}, x}};
  };
  std::vector<PublishedJoint> little = finger(0.0, 0.06579, 1.0);
  little.insert(little.begin(), {{-0.033, 0, 0.02071}, {0.573576, 0, 0.819152}});
  // The thumb's base is turned by 45 degrees about y.
  return {finger(0.033, 0.095, -1.0),
          finger(0.011, 0.099, -1.0),
          finger(-0.011, 0.095, 1.0),
          little,
          {{{0.034, -0.00858, 0.029}, {0, 0, -1}},
           {none, x},
           {{0, 0, 0.038}, x},
           {none, -y},
           {{0, 0, 0.032}, -y}}};
}

/** Centres of the joints in the palm's frame, all joints at the same angle. */
std::vector<Eigen::Vector3d> CalcPublishedCentres(double angle) {
  std::vector<Eigen::Vector3d> centres;
  const std::vector<std::vector<PublishedJoint>> digits = ListPublishedDigits();
  for (const std::vector<PublishedJoint>& digit : digits) {
    const bool is_thumb = &digit == &digits.back();
    Pose X_PJ = Pose::Identity();
    for (const PublishedJoint& joint : digit) {
      X_PJ = X_PJ * MakePose(joint.p);
      if (is_thumb && &joint == &digit.front())
        X_PJ = X_PJ * MakePose(MakeRotationRpy(0, M_PI / 4, 0), Eigen::Vector3d::Zero());
      centres.push_back(X_PJ.translation());
      X_PJ = X_PJ * Pose(Eigen::AngleAxisd(angle, joint.axis.normalized()));
    }
  }
  return centres;
}

constexpr double kFullTurn = 6.2832;           // [rad]
constexpr double kMaxShadowDifference = 1e-3;  // [m]

/** "rh_FFJ4" ends in "FFJ4" behind a separator. */
bool IsPrefixed(const std::string& full, const std::string& name) {
  return full.size() > name.size() &&
         full.compare(full.size() - name.size(), name.size(), name) == 0 &&
         std::string_view("_:/-.").find(full[full.size() - name.size() - 1]) !=
             std::string_view::npos;
}

/** Index of the only element of that name, or with it behind a prefix; -1: none or several. */
template <class Element>
int FindByName(const std::vector<Element>& elements, const std::string& name) {
  int found = -1;
  for (size_t i = 0; i < elements.size(); ++i) {
    if (elements[i].name == name) return static_cast<int>(i);
    if (!IsPrefixed(elements[i].name, name)) continue;
    if (found >= 0) return -1;
    found = static_cast<int>(i);
  }
  return found;
}

template <class Element>
std::vector<std::string> NamesOf(const std::vector<Element>& elements) {
  std::vector<std::string> names;
  for (const Element& element : elements) names.push_back(element.name);
  return names;
}

struct MappedJoint {
  int index = -1;
  double sign = 1.0;
};

MappedJoint FindJointOf(const ForeignGrasp& grasp, const Hand& hand, const std::string& name) {
  MappedJoint joint{FindByName(hand.joints, name), 1.0};
  if (joint.index < 0 && grasp.format == "dexgraspnet") {
    for (const DexgraspnetJoint& foreign : ListDexgraspnetJoints()) {
      if (foreign.name == name) joint = {FindByName(hand.joints, foreign.maker), foreign.sign};
    }
  }
  return joint;
}

std::vector<MappedJoint> FindJoints(const ForeignGrasp& grasp, const Hand& hand) {
  std::vector<MappedJoint> joints;
  std::vector<bool> is_taken(hand.joints.size(), false);
  for (const std::string& name : grasp.joint_names) {
    const MappedJoint joint = FindJointOf(grasp, hand, name);
    if (joint.index < 0) {
      throw Error(
          ErrorKind::kFormat,
          fmt::format("{}: the hand {} has no joint \"{}\" (or several behind prefixes){}",
                      grasp.source, hand.id, name, SuggestNames(name, NamesOf(hand.joints))));
    }
    if (is_taken[static_cast<size_t>(joint.index)]) {
      throw Error(ErrorKind::kFormat,
                  fmt::format("{}: two of the file's joints are {} of the hand {}", grasp.source,
                              hand.joints[static_cast<size_t>(joint.index)].name, hand.id));
    }
    is_taken[static_cast<size_t>(joint.index)] = true;
    joints.push_back(joint);
  }
  return joints;
}

/** Between root and palm. */
bool IsOfWrist(const Hand& hand, int joint) {
  for (int link = hand.palm_link; link >= 0; link = hand.links[static_cast<size_t>(link)].parent) {
    if (hand.links[static_cast<size_t>(link)].joint == joint) return true;
  }
  return false;
}

/** Positions of what the file does not state. */
class UnstatedJoints {
 public:
  UnstatedJoints(const ForeignGrasp& grasp, const Hand& hand,
                 const std::vector<MappedJoint>& stated)
      : hand_(&hand) {
    std::string missing, wrist, coupled;
    for (int j = 0; j < hand.num_joints(); ++j) {
      const auto is_j = [&](const MappedJoint& joint) { return joint.index == j; };
      if (std::any_of(stated.begin(), stated.end(), is_j)) continue;
      const HandJoint& joint = hand.joints[static_cast<size_t>(j)];
      const bool is_coupled = joint.coupled_to >= 0;
      std::string& names = is_coupled ? coupled : IsOfWrist(hand, j) ? wrist : missing;
      names += (names.empty() ? "" : ", ") + joint.name;
      if (is_coupled) coupled_.push_back(j);
    }
    if (!missing.empty()) {
      throw Error(ErrorKind::kFormat,
                  fmt::format("{}: the file states no position of {}, which the hand {} has{}",
                              grasp.source, missing, hand.id,
                              stated.empty() ? "; give those of the open hand by --open" : ""));
    }
    if (!wrist.empty()) assumptions_.push_back("joints of the wrist at 0: " + wrist);
    if (!coupled.empty()) assumptions_.push_back("joints that follow their coupling: " + coupled);
  }
  void Fill(Eigen::VectorXd& q) const {
    Eigen::VectorXd followed = q;
    ApplyCoupling(*hand_, followed);
    for (const int j : coupled_) q[j] = followed[j];
  }
  const std::vector<std::string>& assumptions() const { return assumptions_; }

 private:
  const Hand* hand_;
  std::vector<int> coupled_;
  std::vector<std::string> assumptions_;
};

/** The link R whose pose the file gives: the palm, what carries it, or what is fixed to it. */
int FindRoot(const ForeignGrasp& grasp, const Hand& hand) {
  const int root = FindByName(hand.links, grasp.root_link);
  if (grasp.root_link.empty() || root < 0) {
    throw Error(
        ErrorKind::kFormat,
        fmt::format("{}: the hand {} has no link \"{}\", whose pose the file gives; name it "
                    "by --hand-frame{}",
                    grasp.source, hand.id, grasp.root_link,
                    SuggestNames(grasp.root_link, NamesOf(hand.links))));
  }
  const auto parent_of = [&](int link) { return hand.links[static_cast<size_t>(link)].parent; };
  for (int link = hand.palm_link; link >= 0; link = parent_of(link)) {
    if (link == root) return root;
  }
  for (int link = root; link >= 0; link = parent_of(link)) {
    if (link == hand.palm_link) return root;
    if (hand.links[static_cast<size_t>(link)].joint >= 0) break;
  }
  throw Error(
      ErrorKind::kFormat,
      fmt::format("{}: link \"{}\" of the hand {} moves with a digit; a grasp's pose is that "
                  "of the palm or of a link that carries it",
                  grasp.source, grasp.root_link, hand.id));
}

void CheckShadow(const ForeignGrasp& grasp, const Hand& hand) {
  std::vector<int> indices;
  for (const std::string& name : ListDexgraspbenchJoints()) {
    indices.push_back(FindByName(hand.joints, name));
    if (indices.back() < 0) return;
  }
  const double difference = CalcShadowDifference(hand, indices);
  if (difference > kMaxShadowDifference) {
    throw Error(
        ErrorKind::kFormat,
        fmt::format("{}: a joint of the hand {} lies {:.1f} mm from where the hand of {} has "
                    "it; expected at most {:.0f} mm. Take the hand that the grasps were "
                    "made for",
                    grasp.source, hand.id, 1e3 * difference, grasp.format,
                    1e3 * kMaxShadowDifference));
  }
}

void DemandRadians(const ForeignGrasp& grasp, const GraspStage& stage, const HandJoint& joint,
                   double position) {
  if (joint.is_prismatic || std::abs(position) <= kFullTurn) return;
  throw Error(ErrorKind::kRange,
              fmt::format("{}: stage {} has {} at {:g} rad, more than a full turn; positions are "
                          "in radians, these look like degrees",
                          grasp.source, stage.name, joint.name, position));
}

/** "link_0.0" is "link_0_0" in its simulator. */
std::string MakeSimulatorName(std::string name) {
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

std::vector<bool> FindCountedLinks(const MultigripperGripper& gripper, const Hand& hand) {
  std::vector<bool> counts(hand.links.size(), false);
  for (const char* name : gripper.contact_links) {
    const auto link = std::find_if(hand.links.begin(), hand.links.end(), [&](const HandLink& l) {
      return MakeSimulatorName(l.name) == name;
    });
    if (link == hand.links.end()) return std::vector<bool>(hand.links.size(), true);
    counts[static_cast<size_t>(link - hand.links.begin())] = true;
  }
  return counts;
}

std::optional<ClosingTable> FindClosingTable(const ForeignGrasp& grasp, const Hand& hand,
                                             const std::vector<MappedJoint>& joints, int root) {
  if (grasp.format != "multigripper") return std::nullopt;
  const MultigripperGripper* gripper = FindMultigripperGripper(grasp.hand);
  if (gripper == nullptr || gripper->closing.size() != joints.size()) return std::nullopt;
  ClosingTable table;
  table.shares = Eigen::VectorXd::Zero(hand.num_joints());
  for (size_t i = 0; i < joints.size(); ++i) table.shares[joints[i].index] = gripper->closing[i];
  const Pose X_HR = CalcLinkPose(hand, Eigen::VectorXd::Zero(hand.num_joints()), root);
  table.down_H = (gripper->axis > 0 ? 1.0 : -1.0) * X_HR.linear().col(std::abs(gripper->axis) - 1);
  table.counts = FindCountedLinks(*gripper, hand);
  table.num_touching = gripper->num_touching;
  return table;
}

}  // namespace

const std::vector<std::string>& ListDexgraspbenchJoints() {
  static const std::vector<std::string> joints = {
      "FFJ4", "FFJ3", "FFJ2", "FFJ1", "MFJ4", "MFJ3", "MFJ2", "MFJ1", "RFJ4", "RFJ3", "RFJ2",
      "RFJ1", "LFJ5", "LFJ4", "LFJ3", "LFJ2", "LFJ1", "THJ5", "THJ4", "THJ3", "THJ2", "THJ1"};
  return joints;
}

const std::vector<DexgraspnetJoint>& ListDexgraspnetJoints() {
  static const std::vector<DexgraspnetJoint> joints = [] {
    std::vector<DexgraspnetJoint> made;
    for (const std::string& maker : ListDexgraspbenchJoints()) {
      const bool is_reversed =
          maker == "FFJ4" || maker == "MFJ4" || maker == "THJ2" || maker == "THJ1";
      std::string name = "robot0:" + maker;
      --name.back();
      made.push_back({name, maker, is_reversed ? -1.0 : 1.0});
    }
    return made;
  }();
  return joints;
}

double CalcShadowDifference(const Hand& hand, const std::vector<int>& joints) {
  double largest = 0.0;
  for (const double angle : {0.0, 0.3}) {
    const std::vector<Eigen::Vector3d> published = CalcPublishedCentres(angle);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(hand.num_joints());
    for (const int joint : joints) q[joint] = angle;
    for (size_t i = 0; i < joints.size(); ++i) {
      const int link = hand.joints[static_cast<size_t>(joints[i])].link;
      const Eigen::Vector3d centre = CalcLinkPose(hand, q, link).translation();
      largest = std::max(largest, (centre - published[i]).norm());
    }
  }
  return largest;
}

HandGrasp MapToHand(const ForeignGrasp& grasp, const Hand& hand) {
  const std::vector<MappedJoint> joints = FindJoints(grasp, hand);
  const UnstatedJoints unstated(grasp, hand, joints);
  if (grasp.format == "dexgraspbench") CheckShadow(grasp, hand);
  const int root = FindRoot(grasp, hand);

  HandGrasp mapped;
  mapped.table = FindClosingTable(grasp, hand, joints, root);
  mapped.assumptions = grasp.assumptions;
  mapped.assumptions.insert(mapped.assumptions.end(), unstated.assumptions().begin(),
                            unstated.assumptions().end());
  for (const GraspStage& stage : grasp.stages) {
    if (stage.joints.size() != joints.size()) {
      throw Error(ErrorKind::kFormat,
                  fmt::format("{}: stage {} has {} positions for {} joints", grasp.source,
                              stage.name, stage.joints.size(), joints.size()));
    }
    Eigen::VectorXd q = Eigen::VectorXd::Zero(hand.num_joints());
    for (size_t i = 0; i < joints.size(); ++i) {
      DemandRadians(grasp, stage, hand.joints[static_cast<size_t>(joints[i].index)],
                    stage.joints[i]);
      q[joints[i].index] = joints[i].sign * stage.joints[i];
    }
    unstated.Fill(q);
    mapped.stages.push_back({stage.name, stage.X_OR * CalcLinkPose(hand, q, root).inverse(), q});
  }
  return mapped;
}

}  // namespace graspbench
