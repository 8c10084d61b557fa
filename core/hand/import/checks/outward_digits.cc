#include "core/hand/import/checks/outward_digits.h"

#include <algorithm>

#include "core/hand/closing.h"
#include "core/hand/coupling.h"

namespace graspbench {
namespace {

constexpr double kPadMoves = 0.001;  // [m] of a pad, to count
/** Of the range, the digit's own and the others': one that closes all the way passes them. */
constexpr double kOwnShare = 0.4, kOthersShare = 0.25;
constexpr int kNumShares = 5;
constexpr double kMostNearer = 0.2;  // of how far it recedes

class OutwardFinder {
 public:
  explicit OutwardFinder(const Hand& hand)
      : hand_(hand), closing_(FindClosing(hand)), open_(CalcClosedPosture(hand, closing_, 0.0)) {}

  bool IsOutward(const Digit& digit) const {
    double nearer = 0.0, farther = 0.0;  // than when it is open, at most
    for (const Digit& other : hand_.digits) {
      if (&other == &digit) continue;
      for (const double of_other : {0.0, kOthersShare}) {
        const double before = CalcGap(digit, 0.0, other, of_other);
        for (int i = 1; i <= kNumShares; ++i) {
          const double share = kOwnShare * i / kNumShares;
          const double gap = CalcGap(digit, share, other, of_other);
          nearer = std::max(nearer, before - gap);
          farther = std::max(farther, gap - before);
        }
      }
    }
    return farther > kPadMoves && nearer < std::max(kPadMoves, kMostNearer * farther);
  }

 private:
  /** Of the pads. */
  double CalcGap(const Digit& a, double of_a, const Digit& b, double of_b) const {
    Eigen::VectorXd q = open_;
    CloseDigit(hand_, closing_, b, of_b, q);
    CloseDigit(hand_, closing_, a, of_a, q);
    ApplyCoupling(hand_, q);
    return (CalcLinkPose(hand_, q, a.distal_link) * a.p_LPad -
            CalcLinkPose(hand_, q, b.distal_link) * b.p_LPad)
        .norm();
  }

  const Hand& hand_;
  const std::vector<int> closing_;
  const Eigen::VectorXd open_;
};

}  // namespace

std::vector<bool> FindOutwardDigits(const Hand& hand) {
  const OutwardFinder finder(hand);
  std::vector<bool> is_outward;
  for (const Digit& digit : hand.digits) is_outward.push_back(finder.IsOutward(digit));
  return is_outward;
}

}  // namespace graspbench
