#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/closing.h"
#include "core/hand/hand.h"
#include "core/hand/import/checks/find_implausible.h"
#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/guess_hand.h"
#include "core/hand/import/shapes/shape_distance.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kHalfOpen = 0.5;      // share of the open distance
constexpr double kNearEnough = 0.025;  // [m], sufficient whatever the open distance
constexpr int kMeetingShares = 24, kMeetingSamples = 3000;
constexpr double kAsNear = 0.01;  // [m] in excess of the least distance

struct Nearest {
  double gap = std::numeric_limits<double>::infinity();
  Vector3d p_H = Vector3d::Zero();
};

class MeetingFinder {
 public:
  explicit MeetingFinder(const Hand& hand)
      : hand_(hand), closing_(FindClosing(hand)), open_(CalcClosedPosture(hand, closing_, 0.0)) {}

  /** Returns nullopt if the two do not meet. @param is_first  where they meet first, instead of
  where they are nearest. */
  std::optional<Nearest> Find(const Digit& a, const Digit& b, bool is_first) const {
    Nearest open;
    Try(a, b, open_, open);
    Nearest best = open;
    std::vector<Nearest> by_closing;  // by the sum of both shares
    for (int sum = 0; sum <= 2 * kMeetingShares; ++sum) {
      Nearest& nearest = by_closing.emplace_back();
      for (int i = std::max(0, sum - kMeetingShares); i <= std::min(sum, kMeetingShares); ++i) {
        Eigen::VectorXd q = open_;
        CloseDigit(hand_, closing_, a, static_cast<double>(i) / kMeetingShares, q);
        CloseDigit(hand_, closing_, b, static_cast<double>(sum - i) / kMeetingShares, q);
        ApplyCoupling(hand_, q);
        Try(a, b, q, nearest);
      }
      if (nearest.gap < best.gap) best = nearest;
    }
    const double enough = std::max(kHalfOpen * open.gap, kNearEnough);
    for (const Nearest& nearest : by_closing) {
      if (is_first && nearest.gap <= std::min(enough, best.gap + kAsNear)) return nearest;
    }
    if (best.gap > enough) {
      for (int k = 1; k <= kMeetingSamples; ++k)
        Try(a, b, MakePairSample(hand_, open_, a, b, k), best);
    }
    if (best.gap > enough) return {};
    return best;
  }

 private:
  void Try(const Digit& a, const Digit& b, const Eigen::VectorXd& q, Nearest& best) const {
    const Vector3d pad_a = CalcLinkPose(hand_, q, a.distal_link) * a.p_LPad;
    const Vector3d pad_b = CalcLinkPose(hand_, q, b.distal_link) * b.p_LPad;
    const double gap = (pad_a - pad_b).norm();
    if (gap < best.gap) best = {gap, Vector3d(0.5 * (pad_a + pad_b))};
  }

  const Hand& hand_;
  const std::vector<int> closing_;
  const Eigen::VectorXd open_;
};

}  // namespace

Eigen::VectorXd MakePairSample(const Hand& hand, const Eigen::VectorXd& open, const Digit& a,
                               const Digit& b, int number) {
  Eigen::VectorXd q = open;
  int dimension = 1;
  for (int j = 0; j < hand.num_joints(); ++j) {
    if (!MovesDigit(hand, j, a) && !MovesDigit(hand, j, b)) continue;
    const double turn = number * std::exp(1.0 / ++dimension);
    const HandJoint& joint = hand.joints[j];
    q[j] = joint.lower + (turn - std::floor(turn)) * (joint.upper - joint.lower);
  }
  ApplyCoupling(hand, q);
  return q;
}

std::optional<DigitMeeting> FindMeeting(const Hand& hand, const std::vector<bool>& left_out,
                                        bool is_first) {
  const auto thumb = std::find_if(hand.digits.begin(), hand.digits.end(),
                                  [](const Digit& digit) { return digit.is_thumb; });
  if (thumb == hand.digits.end()) return {};
  const MeetingFinder finder(hand);
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosedPosture(hand, {}, 0.0));
  const auto base = [&](const Digit& digit) -> Vector3d {
    return X_HL[digit.links.front()].translation();
  };
  DigitMeeting meeting;
  meeting.gap = std::numeric_limits<double>::infinity();
  Vector3d others = Vector3d::Zero();
  int num_meet = 0;
  int num_others = 0;
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    const Digit& digit = hand.digits[d];
    if (&digit == &*thumb || left_out[d]) continue;
    others += base(digit);
    ++num_others;
    const auto nearest = finder.Find(*thumb, digit, is_first);
    if (!nearest) continue;
    meeting.p_H += nearest->p_H;
    meeting.gap = std::min(meeting.gap, nearest->gap);
    ++num_meet;
  }
  if (num_meet == 0) return {};
  meeting.p_H /= num_meet;
  others /= num_others;
  meeting.direction = (meeting.p_H - 0.5 * (base(*thumb) + others)).stableNormalized();
  return meeting;
}

namespace {

constexpr double kAgreement = 0.5;                        // mean length of the pads' directions
constexpr double kPointAway = -0.1;                       // cosine of the thumb and the others
constexpr double kRises = 0.4, kAcross = 0.25;            // cosines
constexpr double kSameSide = 0.5;                         // cosine
constexpr double kSameDirection = 0.8;                    // cosine
constexpr double kNearlyAxis = 0.985;                     // cosine
constexpr double kLeastHeight = 0.01, kMostDepth = 0.02;  // [m] behind the palm's surface
constexpr double kFarNormal = kPi / 3.0;                  // [rad] of a given normal from the guess

/** Snaps a direction to an axis that it nearly meets. */
Vector3d SnapToAxis(const Vector3d& direction, double least_cosine) {
  int longest = 0;
  direction.cwiseAbs().maxCoeff(&longest);
  if (std::abs(direction[longest]) < least_cosine) return direction;
  return std::copysign(1.0, direction[longest]) * Vector3d::Unit(longest);
}

class PalmGuesser {
 public:
  PalmGuesser(const std::string& file, const std::optional<Vector3d>& given,
              const std::vector<Vector3d>& facing, ImportedHand& imported)
      : file_(file),
        given_(given),
        facing_(facing),
        imported_(imported),
        hand_(imported.hand),
        is_outward_(FindOutwardDigits(imported.hand)) {}

  void Guess(Diagnostics& problems) {
    const std::string failure = GuessFromDigits();
    const std::string& palm = hand_.links[hand_.palm_link].name;
    if (!given_) {
      if (failure.empty() && height_ < -kLeastHeight) {
        problems.Warn(
            file_, 0,
            "the digits meet " + FormatFixed(MmFromM(-height_), 0) +
                " mm behind the palm's surface; is the place of a joint wrong, or an axis?");
      }
      if (failure.empty()) return;
      problems.Fail(
          file_, 0,
          failure +
              "; is an axis or a limit reversed? If all of it is meant, say which way the "
              "palm faces with --palm-normal X,Y,Z, in the frame of \"" +
              palm + "\"");
      return;
    }
    const Vector3d guess = hand_.palm_normal;
    hand_.palm_normal = given_->normalized();
    PlacePalm();
    if (!failure.empty()) {
      problems.Warn(file_, 0, failure + "; the palm faces as --palm-normal says");
      return;
    }
    const double angle = std::acos(std::clamp(guess.dot(hand_.palm_normal), -1.0, 1.0));
    if (angle < kFarNormal) return;
    problems.Warn(file_, 0,
                  "--palm-normal is " + FormatFixed(DegFromRad(angle), 0) +
                      " degrees from where the digits of \"" + palm + "\" meet, about " +
                      FormatSignificant(guess.x(), 2) + "," + FormatSignificant(guess.y(), 2) +
                      "," + FormatSignificant(guess.z(), 2) +
                      "; taken as it is said, and the hand approaches along it");
  }

 private:
  bool Tells(size_t digit) const { return facing_[digit].norm() > 0.5 && !is_outward_[digit]; }
  double CountTelling() const {
    double num_telling = 0.0;
    for (size_t d = 0; d < hand_.digits.size(); ++d) num_telling += Tells(d);
    return num_telling;
  }

  Vector3d GuessNormal(const DigitMeeting& meeting) const {
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, CalcClosedPosture(hand_, {}, 0.0));
    Vector3d all_facing = Vector3d::Zero(), facing = Vector3d::Zero(), along = Vector3d::Zero();
    Vector3d thumb_facing = Vector3d::Zero(), thumb_along = Vector3d::Zero();
    Vector3d bases = Vector3d::Zero(), thumb_base = Vector3d::Zero();
    const std::vector<DigitRow> rows = MakeDigitRows(hand_);
    for (size_t d = 0; d < hand_.digits.size(); ++d) {
      if (!Tells(d)) continue;
      const Digit& digit = hand_.digits[d];
      const Vector3d p_HBase = X_HL[digit.links.front()].translation();
      const Vector3d p_HTip = X_HL[digit.distal_link] * digit.p_LTip;
      all_facing += facing_[d] / CountTelling();
      (digit.is_thumb ? thumb_facing : facing) += facing_[d];
      (digit.is_thumb ? thumb_along : along) += (p_HTip - p_HBase).stableNormalized();
      // Where it bends, since a spread joint before it may be elsewhere.
      const Vector3d p_HBend = rows[d].joints.empty()
                                   ? p_HBase
                                   : X_HL[hand_.joints[rows[d].joints.front()].link].translation();
      if (digit.is_thumb) {
        thumb_base = p_HBend;
      } else {
        bases += p_HBend / (static_cast<double>(hand_.digits.size()) - 1.0);
      }
    }
    facing.stableNormalize();
    along.stableNormalize();
    // The palm faces with the digits in two cases: they point away from each other when open, all
    // around the palm, or they spread out while they rise from the plane of their bases.
    const Vector3d both = (facing + thumb_facing).stableNormalized();
    const double apart = thumb_along.stableNormalized().dot(along);
    const bool do_rise = std::min(thumb_along.dot(both), along.dot(both)) > kRises;
    const bool do_face_each_other =
        std::abs((thumb_base - bases).stableNormalized().dot(both)) < kAcross;
    const bool is_star =
        apart < -kAgreement || (apart < kPointAway && do_rise && do_face_each_other);
    Vector3d normal = facing;
    if (is_star) {
      normal = facing + thumb_facing;
    } else if (std::abs(normal.dot(along)) < 0.8) {
      normal -= normal.dot(along) * along;
    }
    normal.stableNormalize();
    // The pads of a gripper face each other.
    const bool is_gripper = all_facing.norm() < kAgreement;
    if (is_gripper || normal.dot(meeting.direction) < kSameSide) {
      return SnapToAxis(LeaveOutFixed(meeting.direction), kSameDirection);
    }
    return SnapToAxis(normal, kNearlyAxis);
  }

  /** Digits meet at a fixed jaw, not between the bases, so its direction is removed. */
  Vector3d LeaveOutFixed(Vector3d direction) const {
    for (size_t d = 0; d < hand_.digits.size(); ++d) {
      if (hand_.links[hand_.digits[d].distal_link].joint >= 0) continue;
      direction = (direction - direction.dot(facing_[d]) * facing_[d]).stableNormalized();
    }
    return direction;
  }

  std::string ExplainNoClosing() const {
    const auto is_outward = std::find(is_outward_.begin(), is_outward_.end(), true);
    if (is_outward != is_outward_.end()) return "the digits close away from each other";
    const bool all_slide =
        std::all_of(hand_.joints.begin(), hand_.joints.end(), [&](const HandJoint& joint) {
          return joint.is_prismatic || hand_.FindDigitOfLink(joint.link) < 0;
        });
    if (!all_slide) {
      return "no limit says to which side a digit closes: which way the palm faces cannot be "
             "guessed";
    }
    std::vector<std::string> names;
    for (const Digit& digit : hand_.digits) names.push_back(hand_.links[digit.distal_link].name);
    return "the jaws " + JoinSome(names) +
           " run the same way: they keep their distance and do not close";
  }

  /** @returns why there is no guess; empty: normal and centre are set. */
  std::string GuessFromDigits() {
    if (CountTelling() == 0.0) return ExplainNoClosing();
    const auto meeting = FindMeeting(hand_, is_outward_);
    if (!meeting || meeting->direction.norm() < 0.5) {
      const auto thumb = std::find_if(hand_.digits.begin(), hand_.digits.end(),
                                      [](const Digit& digit) { return digit.is_thumb; });
      std::vector<std::string> outward;
      for (size_t d = 0; d < hand_.digits.size(); ++d) {
        if (is_outward_[d]) outward.push_back(hand_.links[hand_.digits[d].distal_link].name);
      }
      return (outward.empty() ? "" : JoinSome(outward) + " close away from the others, and ") +
             "no digit approaches the thumb, \"" + hand_.links[thumb->distal_link].name +
             "\", however they close";
    }
    TakeMeeting(*meeting);
    // Digits that bend far pass each other and meet again inside the palm.
    if (height_ <= -kLeastHeight) {
      const auto first = FindMeeting(hand_, is_outward_, true);
      if (first && first->direction.norm() > 0.5) TakeMeeting(*first);
      if (height_ <= -kLeastHeight) TakeMeeting(*meeting);
    }
    if (height_ > -kMostDepth) return "";
    return "the digits meet " + FormatFixed(MmFromM(-height_), 0) + " mm behind the palm's surface";
  }

  void TakeMeeting(const DigitMeeting& meeting) {
    hand_.palm_normal = GuessNormal(meeting);
    PlacePalm();
    height_ = hand_.palm_normal.dot(meeting.p_H - hand_.p_HCentre);
  }

  /** Places the centre of the palm's surface. */
  void PlacePalm() {
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, CalcClosedPosture(hand_, {}, 0.0));
    const auto shapes = ListShapesOf(imported_.shapes, hand_.palm_link);
    Vector3d middle = Vector3d::Zero();
    if (shapes.empty()) {
      for (const Digit& digit : hand_.digits) {
        middle +=
            X_HL[digit.links.front()].translation() / static_cast<double>(hand_.digits.size());
      }
      hand_.p_HCentre = middle;
      return;
    }
    hand_.p_HCentre =
        FindSurface(shapes, hand_.palm_link, CalcBounds(shapes).center(), hand_.palm_normal);
    // Fitted shapes may protrude from the mesh.
    double top = -std::numeric_limits<double>::infinity();
    for (const TriMesh& mesh : imported_.solids[static_cast<size_t>(hand_.palm_link)]) {
      for (const Vector3d& p : mesh.vertices) top = std::max(top, hand_.palm_normal.dot(p));
    }
    const double above = hand_.palm_normal.dot(hand_.p_HCentre) - top;
    if (std::isfinite(top) && above > 0.0) hand_.p_HCentre -= above * hand_.palm_normal;
  }

  const std::string& file_;
  const std::optional<Vector3d>& given_;
  const std::vector<Vector3d>& facing_;
  ImportedHand& imported_;
  Hand& hand_;
  const std::vector<bool> is_outward_;  // by digit
  double height_ = 0.0;                 // of the meeting point above the palm's surface [m]
};

}  // namespace

void GuessPalm(const std::string& file, const std::optional<Vector3d>& given,
               const std::vector<Vector3d>& facing, ImportedHand& imported, Diagnostics& problems) {
  PalmGuesser(file, given, facing, imported).Guess(problems);
}

}  // namespace graspbench
