#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hand/closing.h"
#include "core/hand/hand.h"
#include "core/hand/import/checks/find_implausible.h"
#include "core/hand/import/guess_hand.h"
#include "core/hand/import/shapes/shape_distance.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kPadMoves = 0.001;  // least motion of a pad that counts [m]
/** Shares of the ranges of the digit and of the others: fully closed digits pass each other. */
constexpr double kOwnShare = 0.4, kOthersShare = 0.25;
constexpr int kNumShares = 5;
constexpr double kMostNearer = 0.2;  // share of the distance by which it recedes

class OutwardFinder {
 public:
  explicit OutwardFinder(const Hand& hand)
      : hand_(hand), closing_(FindClosing(hand)), open_(CalcClosedPosture(hand, closing_, 0.0)) {}

  /** Whether it recedes from all others, open or slightly closed, and approaches none. */
  bool IsOutward(const Digit& digit) const {
    bool recedes = false;
    for (const Digit& other : hand_.digits) {
      if (&other == &digit) continue;
      for (const double of_other : {0.0, kOthersShare}) {
        double nearer = 0.0, farther = 0.0;  // largest change relative to the open digit
        const double before = CalcGap(digit, 0.0, other, of_other);
        for (int i = 1; i <= kNumShares; ++i) {
          const double share = kOwnShare * i / kNumShares;
          const double gap = CalcGap(digit, share, other, of_other);
          nearer = std::max(nearer, before - gap);
          farther = std::max(farther, gap - before);
        }
        if (nearer >= std::max(kPadMoves, kMostNearer * farther)) return false;
        recedes = recedes || farther > kPadMoves;
      }
    }
    return recedes;
  }

 private:
  /** Distance of the pads. */
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

namespace {

constexpr int kShares = 16, kSamples = 1500;
constexpr double kFaces = 0.342;               // cosine of 70 degrees
constexpr double kNear = 0.04, kNearer = 0.5;  // [m], share of the open distance
constexpr double kTipsNear = 0.04, kMeet = 0.015, kLeastApproach = 0.002;  // [m]
constexpr double kAlike = 0.8;                                             // cosine
constexpr int kPointsBetween = 6;  // on the line from pad to pad

class OppositionFinder {
 public:
  explicit OppositionFinder(const ImportedHand& imported)
      : hand_(imported.hand),
        closing_(FindClosing(hand_)),
        open_(CalcClosedPosture(hand_, closing_, 0.0)),
        palm_(ListShapesOf(imported.shapes, hand_.palm_link)),
        shapes_(imported.shapes),
        rows_(MakeDigitRows(hand_)) {
    for (const Digit& digit : hand_.digits) {
      const auto shapes = ListShapesOf(imported.shapes, digit.distal_link);
      normals_.push_back(Vector3d::Zero());
      std::vector<Ball>& ends = ends_.emplace_back();
      for (const CollisionShape& shape : shapes) {
        if (!shape.is_cover)
          ends.push_back({shape.X_LS.translation(), 0.5 * shape.size.minCoeff()});
      }
      if (shapes.empty()) continue;
      const Vector3d middle = CalcBounds(shapes).center();
      const Vector3d along = (digit.p_LTip - middle).stableNormalized();
      const Vector3d to_pad = digit.p_LPad - middle;
      normals_.back() = (to_pad - to_pad.dot(along) * along).stableNormalized();
    }
  }

  bool HasPad(size_t digit) const { return normals_[digit].norm() > 0.5; }
  /** Whether two fingers are side by side and bend the same way: they do not oppose, whatever their
  pads. */
  bool CloseAlike(size_t a, size_t b) const {
    return AreSideBySide(rows_[a], rows_[b]) && !rows_[a].turns.empty() &&
           !rows_[b].turns.empty() && rows_[a].turns.back().dot(rows_[b].turns.back()) > kAlike;
  }
  bool DoOppose(size_t a, size_t b) const {
    if (CloseAlike(a, b)) return false;
    const double enough = std::max(kNear, kNearer * Place(a, b, open_).gap);
    for (int i = 0; i <= kShares; ++i) {
      for (int k = 0; k <= kShares; ++k) {
        const double of_a = static_cast<double>(i) / kShares,
                     of_b = static_cast<double>(k) / kShares;
        if (Opposes(a, b, CloseTo(a, b, of_a, of_b), enough)) return true;
        if (DoTipsMeet(a, b, of_a, of_b)) return true;
      }
    }
    for (int k = 1; k <= kSamples; ++k) {
      if (Opposes(a, b, MakePairSample(hand_, open_, hand_.digits[a], hand_.digits[b], k), enough))
        return true;
    }
    return false;
  }

 private:
  struct Ball {
    Vector3d p_L;
    double radius = 0.0;
  };
  struct Pads {
    Vector3d a, b;  // in H
    double gap = 0.0;
  };
  Pads Place(size_t a, size_t b, const Eigen::VectorXd& q) const {
    Pads pads;
    pads.a = CalcLinkPose(hand_, q, hand_.digits[a].distal_link) * hand_.digits[a].p_LPad;
    pads.b = CalcLinkPose(hand_, q, hand_.digits[b].distal_link) * hand_.digits[b].p_LPad;
    pads.gap = (pads.b - pads.a).norm();
    return pads;
  }
  Vector3d CalcNormal(size_t digit, const Eigen::VectorXd& q) const {
    return CalcLinkPose(hand_, q, hand_.digits[digit].distal_link).linear() * normals_[digit];
  }
  bool Opposes(size_t a, size_t b, const Eigen::VectorXd& q, double enough) const {
    const Pads pads = Place(a, b, q);
    if (pads.gap > enough) return false;
    const Vector3d between = (pads.b - pads.a).stableNormalized();
    if (CalcNormal(a, q).dot(between) < kFaces || CalcNormal(b, q).dot(between) > -kFaces) {
      return false;
    }
    const Pose X_PH = CalcLinkPose(hand_, q, hand_.palm_link).inverse();
    for (int i = 1; i <= kPointsBetween; ++i) {
      const double share = static_cast<double>(i) / (kPointsBetween + 1);
      const Vector3d p_P = X_PH * (pads.a + share * (pads.b - pads.a));
      if (CalcLinkDistance(palm_, hand_.palm_link, p_P) < 0.0) return false;
    }
    return true;
  }
  double CalcTipGap(size_t a, size_t b, double of_a, double of_b) const {
    const Eigen::VectorXd q = CloseTo(a, b, of_a, of_b);
    const Digit &da = hand_.digits[a], &db = hand_.digits[b];
    return (CalcLinkPose(hand_, q, da.distal_link) * da.p_LTip -
            CalcLinkPose(hand_, q, db.distal_link) * db.p_LTip)
        .norm();
  }
  /** Whether the last links meet in front of the palm because both close, or because one drive
  closes them. Their pads may have been guessed on another side. */
  bool DoTipsMeet(size_t a, size_t b, double of_a, double of_b) const {
    const double gap = CalcTipGap(a, b, of_a, of_b);
    if (gap > kTipsNear || gap > CalcTipGap(a, b, 0.0, 0.0) - kLeastApproach) return false;
    const bool do_both_close = gap < CalcTipGap(a, b, 0.0, of_b) - kLeastApproach &&
                               gap < CalcTipGap(a, b, of_a, 0.0) - kLeastApproach;
    if (!do_both_close && !ShareDrive(a, b)) return false;
    const Eigen::VectorXd q = CloseTo(a, b, of_a, of_b);
    const Digit &da = hand_.digits[a], &db = hand_.digits[b];
    const Pose X_HA = CalcLinkPose(hand_, q, da.distal_link);
    const Pose X_BA = CalcLinkPose(hand_, q, db.distal_link).inverse() * X_HA;
    const Pose X_PH = CalcLinkPose(hand_, q, hand_.palm_link).inverse();
    if (CalcLinkDistance(palm_, hand_.palm_link, X_PH * X_HA * da.p_LTip) < 0.0) return false;
    return std::any_of(ends_[a].begin(), ends_[a].end(), [&](const Ball& ball) {
      return CalcLinkDistance(shapes_, db.distal_link, X_BA * ball.p_L) - ball.radius < kMeet;
    });
  }
  bool ShareDrive(size_t a, size_t b) const {
    for (int j = 0; j < hand_.num_joints(); ++j) {
      if (closing_[j] != 0 && MovesDigit(hand_, j, hand_.digits[a]) &&
          MovesDigit(hand_, j, hand_.digits[b])) {
        return true;
      }
    }
    return false;
  }
  Eigen::VectorXd CloseTo(size_t a, size_t b, double of_a, double of_b) const {
    Eigen::VectorXd q = open_;
    CloseDigit(hand_, closing_, hand_.digits[a], of_a, q);
    CloseDigit(hand_, closing_, hand_.digits[b], of_b, q);
    ApplyCoupling(hand_, q);
    return q;
  }
  const Hand& hand_;
  const std::vector<int> closing_;
  const Eigen::VectorXd open_;
  const std::vector<CollisionShape> palm_;
  const std::vector<CollisionShape>& shapes_;
  const std::vector<DigitRow> rows_;
  std::vector<std::vector<Ball>> ends_;  // by digit: balls within the last link's shapes
  std::vector<Vector3d> normals_;        // by digit: pad normal in the distal link's frame
};

}  // namespace

std::vector<bool> FindOpposedDigits(const ImportedHand& imported) {
  const OppositionFinder finder(imported);
  const size_t num = imported.hand.digits.size();
  std::vector<bool> is_opposed(num, false);
  for (size_t a = 0; a < num; ++a) {
    is_opposed[a] = is_opposed[a] || !finder.HasPad(a);
    for (size_t b = 0; b < num && !is_opposed[a]; ++b) {
      if (a == b || !finder.DoOppose(a, b)) continue;
      is_opposed[a] = is_opposed[b] = true;
    }
  }
  return is_opposed;
}

}  // namespace graspbench
