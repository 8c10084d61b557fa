#include "core/hand/import/palm_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hand/closing.h"
#include "core/hand/coupling.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kHalfOpen = 0.5;      // of the open distance
constexpr double kNearEnough = 0.025;  // [m], near enough whatever the open distance
constexpr int kMeetingShares = 24, kMeetingSamples = 3000;

struct Nearest {
  double gap = std::numeric_limits<double>::infinity();
  Vector3d p_H = Vector3d::Zero();
};

class MeetingFinder {
 public:
  explicit MeetingFinder(const Hand& hand)
      : hand_(hand), closing_(FindClosing(hand)), open_(CalcClosedPosture(hand, closing_, 0.0)) {}

  /** Nothing: the two do not meet. */
  std::optional<Nearest> Find(const Digit& a, const Digit& b) const {
    Nearest open;
    Try(a, b, open_, open);
    Nearest best = open;
    for (int i = 0; i <= kMeetingShares; ++i) {
      for (int k = 0; k <= kMeetingShares; ++k) {
        Eigen::VectorXd q = open_;
        CloseDigit(hand_, closing_, a, static_cast<double>(i) / kMeetingShares, q);
        CloseDigit(hand_, closing_, b, static_cast<double>(k) / kMeetingShares, q);
        ApplyCoupling(hand_, q);
        Try(a, b, q, best);
      }
    }
    const double enough = std::max(kHalfOpen * open.gap, kNearEnough);
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

std::optional<DigitMeeting> FindMeeting(const Hand& hand, const std::vector<bool>& left_out) {
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
    const auto nearest = finder.Find(*thumb, digit);
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

}  // namespace graspbench
