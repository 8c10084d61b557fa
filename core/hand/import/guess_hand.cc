#include "core/hand/import/guess_hand.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/closing.h"
#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/shapes/shape_distance.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kSmallestHand = 0.015, kLargestHand = 2.0;  // [m] across
constexpr double kLongestDigit = 0.4;                        // [m]
constexpr size_t kMostDigits = 20;
constexpr double kPadPlace = 0.6;  // share of the distance from the last joint to the tip

class Guesser {
 public:
  Guesser(const std::string& file, const std::optional<Vector3d>& palm_normal,
          ImportedHand& imported, Diagnostics& problems)
      : file_(file),
        palm_normal_(palm_normal),
        imported_(imported),
        hand_(imported.hand),
        problems_(problems) {}

  void Guess() {
    hand_.links[0].X_PJ = Pose::Identity();
    hand_.links[0].X_PJ =
        CalcLinkPoses(hand_, Eigen::VectorXd::Zero(hand_.num_joints()))[hand_.palm_link].inverse();
    if (!CheckSize()) return;
    FindDigits();
    PlaceTips();
    DropLinkages();
    if (hand_.digits.size() < 2) {
      Fail("only " + FormatCount(static_cast<int64_t>(hand_.digits.size()), "digit") +
           " found below \"" + hand_.links[hand_.palm_link].name +
           "\": an arm, or a tool. Name the palm with --palm if it is another link");
      return;
    }
    if (hand_.digits.size() > kMostDigits) {
      Fail("link \"" + hand_.links[hand_.palm_link].name + "\" carries " +
           std::to_string(hand_.digits.size()) + " digits; expected a hand, which has at most " +
           std::to_string(kMostDigits) + ". Name the palm with --palm if it is another link");
      return;
    }
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, CalcClosedPosture(hand_, {}, 0.0));
    for (const Digit& digit : hand_.digits) {
      const double length =
          (X_HL[digit.distal_link] * digit.p_LTip - X_HL[digit.links.front()].translation()).norm();
      if (length <= kLongestDigit) continue;
      Fail("the digit that ends with \"" + hand_.links[digit.distal_link].name + "\" is " +
           FormatSignificant(length, 3) +
           " m long: a robot with several arms, not a hand. Name the palm with --palm");
      return;
    }
    DriveDigits();
    PlacePads();
    FindThumb();
    NameDigits(hand_);
    PlacePads();  // again, in the final order of digits
    GuessPalm(file_, palm_normal_, facing_, imported_, problems_);
    GuessDrives(file_, imported_, problems_);
  }

 private:
  std::vector<int> PathFromPalm(int link) const {
    std::vector<int> path;
    for (int at = link; at >= 0 && at != hand_.palm_link; at = hand_.links[at].parent) {
      path.insert(path.begin(), at);
    }
    return path;
  }

  bool HasShape(int link) const { return !ListShapesOf(imported_.shapes, link).empty(); }

  void FindDigits() {
    std::vector<int> num_ends(hand_.links.size(), 0);
    std::vector<int> ends;
    for (size_t i = hand_.links.size(); i-- > 0;) {
      const int link = static_cast<int>(i), parent = hand_.links[i].parent;
      const std::vector<int> path = PathFromPalm(link);
      const bool is_below_palm =
          !path.empty() && hand_.links[path.front()].parent == hand_.palm_link;
      if (num_ends[i] == 0 && is_below_palm && HasShape(link)) {
        num_ends[i] = 1;
        ends.push_back(link);
      }
      if (parent >= 0) num_ends[parent] += num_ends[i];
    }
    std::reverse(ends.begin(), ends.end());
    for (const int end : ends) {
      Digit digit;
      for (const int link : PathFromPalm(end)) {
        if (num_ends[link] == 1) digit.links.push_back(link);
      }
      if (digit.links.empty()) continue;
      digit.distal_link = end;
      hand_.digits.push_back(digit);
    }
  }

  bool Leads(int joint, const Digit& digit) const {
    return std::any_of(digit.links.begin(), digit.links.end(), [&](int link) {
      const int own = hand_.links[link].joint;
      return own >= 0 && hand_.joints[own].coupled_to == joint;
    });
  }

  void DropLinkages() {
    constexpr double kNeighbour = 0.04, kShorter = 0.9;
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, CalcClosedPosture(hand_, {}, 0.0));
    const auto base = [&](const Digit& digit) { return X_HL[digit.links.front()].translation(); };
    const auto reach = [&](const Digit& digit) {
      return (X_HL[digit.distal_link] * digit.p_LTip - X_HL[hand_.palm_link].translation()).norm();
    };
    std::vector<Digit> kept;
    for (const Digit& digit : hand_.digits) {
      // Each joint follows another, or leads one of the neighbour's: a crank.
      const auto only_follows = [&](const Digit& neighbour) {
        return std::all_of(digit.links.begin(), digit.links.end(), [&](int link) {
          const int joint = hand_.links[link].joint;
          return joint < 0 || hand_.joints[joint].coupled_to >= 0 || Leads(joint, neighbour);
        });
      };
      const bool is_linkage =
          std::any_of(hand_.digits.begin(), hand_.digits.end(), [&](const Digit& d) {
            return only_follows(d) && d.distal_link != digit.distal_link &&
                   d.links.size() > digit.links.size() &&
                   (base(d) - base(digit)).norm() < kNeighbour &&
                   reach(digit) < kShorter * reach(d);
          });
      if (is_linkage) {
        Warn("link \"" + hand_.links[digit.distal_link].name +
             "\" moves with a digit beside it and reaches less far: part of its linkage, no digit");
      } else {
        kept.push_back(digit);
      }
    }
    hand_.digits = std::move(kept);
  }

  /** A crank is a joint outside the digits that moves some of them. It becomes a follower of the
digits' joint that it moves most. */
  void DriveDigits() {
    for (int j = 0; j < hand_.num_joints(); ++j) {
      HandJoint& crank = hand_.joints[j];
      if (crank.coupled_to >= 0 || hand_.FindDigitOfLink(crank.link) >= 0) continue;
      int most = -1;
      for (int k = 0; k < hand_.num_joints(); ++k) {
        const HandJoint& joint = hand_.joints[k];
        const bool is_led = joint.is_mimic && joint.coupled_to == j;
        if (!is_led || joint.is_prismatic != crank.is_prismatic) continue;
        if (hand_.FindDigitOfLink(joint.link) < 0) continue;
        const double best = most < 0 ? 0.0 : std::abs(hand_.joints[most].mimic_ratio);
        if (std::abs(joint.mimic_ratio) > best + 1e-3) most = k;
      }
      if (most < 0) continue;
      // q_most = a + b q_crank, so q_crank = (q_most - a) / b.
      HandJoint& driven = hand_.joints[most];
      const double a = driven.mimic_offset, b = driven.mimic_ratio;
      const double ends[] = {a + b * crank.lower, a + b * crank.upper};
      driven.lower = std::min(ends[0], ends[1]);
      driven.upper = std::max(ends[0], ends[1]);
      driven.coupled_to = -1;
      driven.is_mimic = false;
      ForeignDrive& drive = imported_.drives[static_cast<size_t>(most)];
      drive = imported_.drives[static_cast<size_t>(j)];
      drive.effort /= std::abs(b);
      drive.stiffness /= b * b;
      drive.damping /= b * b;
      for (HandJoint& other : hand_.joints) {
        if (other.coupled_to != j) continue;
        other.coupled_to = most;
        other.mimic_offset -= other.mimic_ratio * a / b;
        other.mimic_ratio /= b;
      }
      crank.coupled_to = most;
      crank.is_mimic = true;
      crank.mimic_ratio = 1.0 / b;
      crank.mimic_offset = -a / b;
      Warn("joint \"" + crank.name + "\" belongs to no digit and moves \"" + driven.name +
           "\"; that one has the drive and the others follow it");
    }
  }

  /** Places tips: the farthest point of the last link along the line from its joint to its
  centre. */
  void PlaceTips() {
    for (Digit& digit : hand_.digits) {
      const auto shapes = ListShapesOf(imported_.shapes, digit.distal_link);
      const Vector3d middle = CalcBounds(shapes).center();
      Vector3d along = middle.stableNormalized();
      const int joint = hand_.links[digit.distal_link].joint;
      if (middle.norm() < 1e-4 || joint < 0 || hand_.joints[joint].is_prismatic) {
        int longest = 2;
        CalcBounds(shapes).sizes().maxCoeff(&longest);
        along = std::copysign(1.0, middle[longest]) * Vector3d::Unit(longest);
      }
      digit.p_LTip = FindSurface(shapes, digit.distal_link, middle, along);
    }
  }

  void PlacePads() {
    const std::vector<int> closing = FindClosing(hand_);
    const Eigen::VectorXd half_closed = CalcClosedPosture(hand_, closing, 0.4);
    const Eigen::VectorXd open = CalcClosedPosture(hand_, {}, 0.0);
    facing_.clear();
    for (Digit& digit : hand_.digits) {
      const auto shapes = ListShapesOf(imported_.shapes, digit.distal_link);
      const Vector3d along = (digit.p_LTip - CalcBounds(shapes).center()).stableNormalized();
      const Vector3d motion = CalcClosing(digit, half_closed);
      const Eigen::Matrix3d R_HL = CalcLinkPose(hand_, half_closed, digit.distal_link).linear();
      Vector3d facing = R_HL.transpose() * motion;
      facing -= facing.dot(along) * along;
      const bool is_known = facing.norm() >= 1e-6;
      if (!is_known) {
        Warn("digit with \"" + hand_.links[digit.distal_link].name +
             "\": no joint closes it; look at its pad_m");
        facing = along.norm() > 0.5 ? along.unitOrthogonal() : Vector3d(Vector3d::UnitZ());
      }
      facing.normalize();
      // From the centre of the shapes' cross-section at this height.
      const Vector3d middle = CalcBounds(shapes).center();
      const Vector3d from = middle + (kPadPlace * digit.p_LTip - middle).dot(along) * along;
      const bool is_inside = CalcLinkDistance(shapes, digit.distal_link, from) <= 0.0;
      digit.p_LPad = FindSurface(shapes, digit.distal_link, is_inside ? from : middle, facing);
      if (!is_known) facing.setZero();
      facing_.push_back(CalcLinkPose(hand_, open, digit.distal_link).linear() * facing);
    }
  }

  void FindThumb() {
    NameByVotes(hand_);
    int thumb = -1, num_named = 0;
    for (size_t d = 0; d < hand_.digits.size(); ++d) {
      if (hand_.digits[d].id != "TH") continue;
      thumb = static_cast<int>(d);
      ++num_named;
    }
    if (num_named != 1) {
      double most = -10.0;
      for (size_t d = 0; d < hand_.digits.size(); ++d) {
        double against = 0.0;
        for (const Vector3d& other : facing_) against -= facing_[d].dot(other);
        // Ties keep the earlier digit, so that rounding does not decide.
        if (against <= most + 0.05) continue;
        most = against;
        thumb = static_cast<int>(d);
      }
      for (Digit& digit : hand_.digits) {
        if (digit.id == "TH") digit.id.clear();
      }
    }
    hand_.digits[static_cast<size_t>(thumb)].is_thumb = true;
    hand_.digits[static_cast<size_t>(thumb)].id = "TH";
  }

  bool CheckSize() {
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, CalcClosedPosture(hand_, {}, 0.0));
    Eigen::AlignedBox3d bounds;
    for (const CollisionShape& shape : imported_.shapes) {
      const Vector3d p = X_HL[shape.link] * shape.X_LS.translation();
      const Vector3d half = Vector3d::Constant(0.5 * shape.size.maxCoeff());
      bounds.extend(Vector3d(p - half));
      bounds.extend(Vector3d(p + half));
    }
    for (const HandLink& link : hand_.links) {
      double farthest = std::max(link.p_LLcm.norm(), link.X_PJ.translation().norm());
      for (const CollisionShape& shape : imported_.shapes) {
        if (&hand_.links[static_cast<size_t>(shape.link)] != &link) continue;
        farthest = std::max(farthest, shape.X_LS.translation().norm());
      }
      if (farthest <= kLargestHand) continue;
      Fail("link \"" + link.name + "\": its joint, its mass or a shape is " +
           FormatSignificant(farthest, 3) + " m from its frame; no hand is larger than 2 m");
      return false;
    }
    const double size = bounds.isEmpty() ? 0.0 : bounds.sizes().maxCoeff();
    if (size < kSmallestHand || size > kLargestHand) {
      Fail("the hand is " + FormatSignificant(size, 3) +
           " m across; a hand is 15 mm to 2 m with its forearm. Descriptions are in metres: if "
           "the unit is another, say it with --unit");
      return false;
    }
    return true;
  }

  /** Velocity in H of a point of the digit's last link when all joints close at the same rate. */
  Vector3d CalcClosingMotion(const Digit& digit, const Eigen::VectorXd& q, const Vector3d& p_L) {
    const std::vector<int> closing = FindClosing(hand_);
    const auto calc_point = [&](const Eigen::VectorXd& at) -> Vector3d {
      return CalcLinkPose(hand_, at, digit.distal_link) * p_L;
    };
    constexpr double kStep = 1e-4;  // of the range
    const Eigen::VectorXd step =
        CalcClosedPosture(hand_, closing, kStep) - CalcClosedPosture(hand_, closing, 0.0);
    return (calc_point(q + step) - calc_point(q)) / kStep;
  }

  /** Velocity of its tip in H; a fixed jaw moves opposite to the other jaw. */
  Vector3d CalcClosing(const Digit& digit, const Eigen::VectorXd& q) {
    if (hand_.links[digit.distal_link].joint >= 0) {
      return CalcClosingMotion(digit, q, digit.p_LTip);
    }
    const Digit& other = hand_.digits[&digit == &hand_.digits[0] ? 1 : 0];
    return -CalcClosingMotion(other, q, other.p_LTip);
  }

  void Warn(const std::string& text) { problems_.Warn(file_, 0, text); }
  void Fail(const std::string& text) { problems_.Fail(file_, 0, text); }

  const std::string& file_;
  const std::optional<Vector3d>& palm_normal_;
  ImportedHand& imported_;
  Hand& hand_;
  Diagnostics& problems_;
  std::vector<Vector3d> facing_;  // by digit: direction of its pad in H, with the hand open; 0:
                                  // unknown
};

}  // namespace

void GuessHand(const std::string& file, const std::optional<Vector3d>& palm_normal,
               ImportedHand& imported, Diagnostics& problems) {
  Guesser(file, palm_normal, imported, problems).Guess();
}

}  // namespace graspbench
