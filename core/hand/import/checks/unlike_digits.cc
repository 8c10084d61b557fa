#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/closing.h"
#include "core/hand/import/checks/find_implausible.h"
#include "core/hand/import/shapes/shape_distance.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kOneDirection = 0.9,
                 kOtherDirection = 0.8;  // cosines of the same direction, of different ones
constexpr double kLikeLimits = 0.05;     // difference of limits of similar joints [rad]
constexpr double kOffLine = 0.02, kFarOffLine = 0.03, kAnywhere = 1.0;  // of a base off its row [m]
constexpr double kLikePlace = 0.002;    // difference of positions of similar joints [m]
constexpr double kBend = 0.3;           // test motion of a joint [rad]
constexpr double kMoves = 0.001;        // least motion of a tip that counts [m]
constexpr double kLeastLength = 0.005;  // least length to be compared [m]

/** A property that similar joints or links share. */
struct Trait {
  std::string what;  // "joint \"a\" turns by"
  std::string noun;  // "joints"
  std::function<double(const DigitRow&)> calc;
  double alike, unlike;  // ratios: up to which the others agree; from which one is reported
  std::function<std::string(double)> format;
  std::string question;
};

class UnlikeFinder {
 public:
  UnlikeFinder(const std::string& file, const ImportedHand& imported, Diagnostics& problems)
      : file_(file),
        imported_(imported),
        hand_(imported.hand),
        problems_(problems),
        rows_(MakeDigitRows(imported.hand)) {}

  std::set<int> Find() {
    FindMirroredAxes();
    FindOutwardCopies();
    FindBentBack();
    FindOtherAxes();
    FindOtherAxisOfCopy();
    FindOffLine();
    FindOtherRanges();
    FindOtherLinks();
    return told_;
  }

 private:
  std::vector<const DigitRow*> ListBeside(const DigitRow& row) const {
    std::vector<const DigitRow*> beside;
    for (const DigitRow& other : rows_) {
      if (&other != &row && AreSideBySide(row, other)) beside.push_back(&other);
    }
    return beside;
  }

  /** Distance by which a digit's tip approaches the mean of the others when one joint closes
  [m]. */
  double CalcApproach(const Digit& digit, int joint, int closing) const {
    Eigen::VectorXd q = CalcClosedPosture(hand_, {}, 0.0);
    const auto calc_distance = [&] {
      const std::vector<Pose> X_HL = CalcLinkPoses(hand_, q);
      Vector3d middle = Vector3d::Zero(), own = Vector3d::Zero();
      for (const Digit& each : hand_.digits) {
        const Vector3d p_HTip = X_HL[each.distal_link] * each.p_LTip;
        if (&each == &digit) {
          own = p_HTip;
        } else {
          middle += p_HTip / (static_cast<double>(hand_.digits.size()) - 1.0);
        }
      }
      return (own - middle).norm();
    };
    const double before = calc_distance();
    q[joint] += closing * kBend;
    return before - calc_distance();
  }

  /** Longest side of the contact shapes. */
  double CalcLength(int link) const {
    const auto shapes = ListShapesOf(imported_.shapes, link);
    return shapes.empty() ? 0.0 : CalcBounds(shapes).sizes().maxCoeff();
  }

  /** Ratio by which the link's joint follows another; 1: it does not. */
  double CalcRatio(int link) const {
    const int j = hand_.links[link].joint;
    return j >= 0 && hand_.joints[j].is_mimic ? std::abs(hand_.joints[j].mimic_ratio) : 1.0;
  }

  void FindMirroredAxes() {
    for (const DigitRow& row : rows_) {
      for (size_t k = 0; k < row.joints.size(); ++k) {
        int num_alike = 0;
        std::string opposed;
        for (const DigitRow* other : ListBeside(row)) {
          if (other->joints.size() != row.joints.size()) continue;
          const double cosine = row.turns[k].dot(other->turns[k]);
          num_alike += cosine > kOneDirection;
          if (cosine < -kOneDirection) {
            opposed += (opposed.empty() ? "\"" : ", \"") + NameOf(other->joints[k]) + "\"";
          }
        }
        if (opposed.empty() || num_alike > 0) continue;
        told_.insert(row.joints[k]);
        Warn("joint \"" + NameOf(row.joints[k]) + "\": its axis is the mirror image of that of " +
             opposed +
             " beside it, with limits of the same sign: it opens where they close; is the sign of "
             "its axis wrong?");
      }
    }
  }

  /** Finds outward joints of copies of one digit about a hub. Their joints are described alike
  except
for the sign of an axis, which makes one of them close away from the others. Digits that face each
other may have opposite axes, since both close towards each other. */
  void FindOutwardCopies() {
    const std::vector<int> closing = FindClosing(hand_);
    const auto is_of_one_build = [&](int a, int b) {
      const HandJoint &ja = hand_.joints[a], &jb = hand_.joints[b];
      return hand_.links[ja.link].axis.dot(hand_.links[jb.link].axis) < -kOneDirection &&
             std::abs(ja.lower - jb.lower) < kLikeLimits &&
             std::abs(ja.upper - jb.upper) < kLikeLimits;
    };
    for (const DigitRow& row : rows_) {
      for (size_t k = 0; k < row.joints.size(); ++k) {
        std::string inward;
        int num_outward = 0;
        for (const DigitRow& other : rows_) {
          if (&other == &row || other.joints.size() != row.joints.size()) continue;
          const int j = other.joints[k];
          if (!is_of_one_build(row.joints[k], j)) continue;
          const double approach = CalcApproach(*other.digit, j, closing[j]);
          num_outward += approach < kMoves;
          if (approach > kMoves) inward += (inward.empty() ? "\"" : ", \"") + NameOf(j) + "\"";
        }
        const int j = row.joints[k];
        if (inward.empty() || num_outward > 0 || told_.count(j) > 0) continue;
        if (CalcApproach(*row.digit, j, closing[j]) > -kMoves) continue;
        told_.insert(j);
        Warn("joint \"" + NameOf(j) + "\": its axis is the mirror image of that of " + inward +
             " of another digit of its build, and it closes away from the other digits, which they "
             "do not; is the sign of its axis wrong?");
      }
    }
  }

  /** Joints that follow others are ignored: the pad of a linkage stays parallel. */
  void FindBentBack() {
    for (const DigitRow& row : rows_) {
      for (size_t k = 0; k < row.turns.size(); ++k) {
        const auto num_against = std::count_if(
            row.turns.begin(), row.turns.end(),
            [&](const Vector3d& turn) { return turn.dot(row.turns[k]) < -kOneDirection; });
        const bool is_alone =
            num_against >= 2 && num_against + 1 == static_cast<int64_t>(row.turns.size());
        if (!is_alone || !told_.insert(row.joints[k]).second) continue;
        Warn("joint \"" + NameOf(row.joints[k]) + "\" bends its digit the other way than the " +
             FormatCount(num_against, "other joint") +
             " of the digit; is the sign of its axis wrong, or are its limits?");
      }
    }
  }

  /** Returns two other similar digits of its row; nullopt: there are none. */
  std::optional<std::pair<const DigitRow*, const DigitRow*>> FindTwoBeside(const DigitRow& row,
                                                                           double off_line) const {
    for (const DigitRow& a : rows_) {
      for (const DigitRow& b : rows_) {
        if (&a >= &b || &a == &row || &b == &row) continue;
        if (IsInRowOf(row, a, b, off_line)) return std::pair(&a, &b);
      }
    }
    return {};
  }

  /** Finds, among three fingers in a row, a joint with another axis than the two that agree. */
  void FindOtherAxes() {
    for (const DigitRow& row : rows_) {
      const auto beside = FindTwoBeside(row, kOffLine);
      if (!beside) continue;
      const auto& [first, second] = *beside;
      for (size_t k = 0; k < row.axes.size(); ++k) {
        const double cosine = std::abs(row.axes[k].dot(first->axes[k]));
        const int joint = hand_.links[row.digit->links[k]].joint;
        if (joint < 0 || told_.count(joint) > 0 || cosine > kOtherDirection ||
            std::abs(first->axes[k].dot(second->axes[k])) < kOneDirection) {
          continue;
        }
        told_.insert(joint);
        Warn("joint \"" + NameOf(joint) + "\": its axis is " +
             FormatFixed(DegFromRad(std::acos(std::min(1.0, cosine))), 0) +
             " deg from those of the like joints beside it; is its axis wrong, or how its digit is "
             "turned?");
      }
    }
  }

  /** Finds, among three copies of one digit in any position, a joint that turns about another axis
  of
its own frame. */
  void FindOtherAxisOfCopy() {
    const auto is_alike = [&](int link, int other) {
      const HandLink &a = hand_.links[link], &b = hand_.links[other];
      return std::abs(a.axis.dot(b.axis)) > kOneDirection;
    };
    const auto is_of_one_build = [&](const DigitRow& a, const DigitRow& b) {
      if (a.axes.size() != b.axes.size()) return false;
      for (size_t k = 0; k < a.axes.size(); ++k) {
        const int la = a.digit->links[k], lb = b.digit->links[k];
        const int ja = hand_.links[la].joint, jb = hand_.links[lb].joint;
        if (ja < 0 || jb < 0) return false;
        const bool has_its_limits =
            std::abs(hand_.joints[ja].lower - hand_.joints[jb].lower) < kLikeLimits &&
            std::abs(hand_.joints[ja].upper - hand_.joints[jb].upper) < kLikeLimits;
        const double apart =
            (hand_.links[la].X_PJ.translation() - hand_.links[lb].X_PJ.translation()).norm();
        if (!has_its_limits || (k > 0 && apart > kLikePlace)) return false;
      }
      return true;
    };
    for (const DigitRow& row : rows_) {
      std::vector<const DigitRow*> copies;
      for (const DigitRow& other : rows_) {
        if (&other != &row && is_of_one_build(row, other)) copies.push_back(&other);
      }
      if (copies.size() < 2) continue;
      std::vector<size_t> unlike;
      for (size_t k = 0; k < row.axes.size(); ++k) {
        const int own = row.digit->links[k], first = copies[0]->digit->links[k];
        const bool do_agree = std::all_of(copies.begin(), copies.end(), [&](const DigitRow* copy) {
          return is_alike(copy->digit->links[k], first);
        });
        if (!do_agree || !is_alike(own, first)) unlike.push_back(do_agree ? k : row.axes.size());
      }
      // All axes differ: frames of another convention.
      if (unlike.size() != 1 || unlike[0] == row.axes.size()) continue;
      if (row.axes.size() < 2 && copies.size() < 3) continue;
      const int joint = hand_.links[row.digit->links[unlike[0]]].joint;
      if (!told_.insert(joint).second) continue;
      Warn("joint \"" + NameOf(joint) +
           "\" turns about another axis of its frame than the like joints of the other digits of "
           "its build; is its axis wrong?");
    }
  }

  /** Finds a finger that bends like a row of fingers but stands in front of it or behind. */
  void FindOffLine() {
    for (const DigitRow& row : rows_) {
      if (FindTwoBeside(row, kFarOffLine)) continue;
      const auto beside = FindTwoBeside(row, kAnywhere);
      if (!beside || row.turns.empty()) continue;
      const auto& [first, second] = *beside;
      if (row.turns.back().dot(first->turns.back()) < kOneDirection) continue;
      const Vector3d line = (second->base - first->base).stableNormalized();
      const Vector3d from = row.base - first->base;
      Warn("digit with link \"" + hand_.links[row.digit->distal_link].name + "\" stands " +
           FormatFixed(MmFromM((from - from.dot(line) * line).norm()), 0) +
           " mm off the row of the like digits beside it; is the place of its first joint wrong?");
    }
  }

  void FindOtherRanges() {
    for (const DigitRow& row : rows_) {
      std::vector<const DigitRow*> beside = ListBeside(row);
      beside.erase(std::remove_if(beside.begin(), beside.end(),
                                  [&](const DigitRow* other) {
                                    return other->joints.size() != row.joints.size();
                                  }),
                   beside.end());
      for (size_t k = 0; k < row.joints.size(); ++k) {
        const auto calc_effort = [&](const DigitRow& each) {
          return imported_.drives[static_cast<size_t>(each.joints[k])].effort;
        };
        const auto calc_range = [&](const DigitRow& each) {
          const HandJoint& joint = hand_.joints[each.joints[k]];
          return joint.upper - joint.lower;
        };
        const auto format = [](double range) { return FormatFixed(DegFromRad(range), 0) + " deg"; };
        TellIfUnlike(row, beside,
                     {"joint \"" + NameOf(row.joints[k]) + "\" turns by", "joints", calc_range, 1.1,
                      1.8, format, "is a limit wrong?"});
        if (imported_.drives.empty()) continue;
        TellIfUnlike(
            row, beside,
            {"joint \"" + NameOf(row.joints[k]) + "\" has an effort of", "joints", calc_effort, 1.1,
             5.0, [](double effort) { return FormatSignificant(effort, 3) + " N m"; },
             "is it in another unit?"});
      }
    }
  }

  void FindOtherLinks() {
    const auto format_mm = [](double length) { return FormatFixed(MmFromM(length), 0) + " mm"; };
    const auto format_g = [](double mass) { return FormatSignificant(GFromKg(mass), 3) + " g"; };
    for (const DigitRow& row : rows_) {
      const std::vector<const DigitRow*> beside = ListBeside(row);
      for (size_t k = 0; k < row.digit->links.size(); ++k) {
        const std::string link = "link \"" + hand_.links[row.digit->links[k]].name + "\" ";
        TellIfUnlike(row, beside,
                     {link + "weighs", "links",
                      [&](const DigitRow& each) { return hand_.links[each.digit->links[k]].mass; },
                      1.5, 3.0, format_g, "is its mass in another unit?"});
        TellIfUnlike(row, beside,
                     {link + "has a length of", "links",
                      [&](const DigitRow& each) {
                        return std::max(kLeastLength, CalcLength(each.digit->links[k]));
                      },
                      1.3, 1.8, format_mm, "is the size of its shape or mesh wrong?"});
        TellIfUnlike(row, beside,
                     {link + "follows another by", "links",
                      [&](const DigitRow& each) { return CalcRatio(each.digit->links[k]); }, 1.1,
                      3.0, [](double ratio) { return FormatSignificant(ratio, 3); },
                      "is the ratio of its coupling wrong?"});
        if (k == 0) continue;
        TellIfUnlike(row, beside,
                     {link + "has its joint from the one before by", "links",
                      [&](const DigitRow& each) {
                        const Pose& X_PJ = hand_.links[each.digit->links[k]].X_PJ;
                        return std::max(kLeastLength, X_PJ.translation().norm());
                      },
                      1.3, 1.8, format_mm, "is the place of a joint wrong?"});
      }
    }
  }

  void TellIfUnlike(const DigitRow& row, const std::vector<const DigitRow*>& beside,
                    const Trait& trait) {
    if (beside.size() < 2) return;
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (const DigitRow* other : beside) {
      least = std::min(least, trait.calc(*other));
      most = std::max(most, trait.calc(*other));
    }
    const double own = trait.calc(row);
    const bool is_unlike = own > trait.unlike * most || own < least / trait.unlike;
    if (most > trait.alike * least || !is_unlike) return;
    Warn(trait.what + " " + trait.format(own) + ", the like " + trait.noun + " beside it " +
         trait.format(most) + "; " + trait.question);
  }

  const std::string& NameOf(int joint) const { return hand_.joints[joint].name; }
  void Warn(const std::string& text) { problems_.Warn(file_, 0, text); }

  const std::string& file_;
  const ImportedHand& imported_;
  const Hand& hand_;
  Diagnostics& problems_;
  const std::vector<DigitRow> rows_;
  std::set<int> told_;  // joints whose axes were reported
};

}  // namespace

std::set<int> FindUnlikeDigits(const std::string& file, const ImportedHand& imported,
                               Diagnostics& problems) {
  return UnlikeFinder(file, imported, problems).Find();
}

}  // namespace graspbench
