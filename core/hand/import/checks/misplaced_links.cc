#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/closing.h"
#include "core/hand/import/checks/find_implausible.h"
#include "core/hand/import/shapes/shape_distance.h"

namespace graspbench {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr int kLinkCellsAlong = 24;     // grid points of a link along its longest side
constexpr double kFinestCell = 0.001;   // [m]
constexpr double kRootOfDigit = 0.025;  // [m] of a joint from the digit's first one
constexpr double kHub = 0.015;          // [m] between the axes of a knuckle
constexpr double kDeep = 0.006;         // [m] of one link in another, to be reported
constexpr double kMostInside = 0.5;     // of a link's volume in another of its own digit
constexpr double kFarthestGap = 0.025;  // [m] between a link and the one before it in its digit
constexpr double kFarthestBase = 0.05;  // [m] between a digit and the palm, which is often a mere
                                        // box
constexpr double kOtherSize = 2.5;      // ratio of the longest sides of shapes and visuals

class MisplacedFinder {
 public:
  MisplacedFinder(const std::string& file, const ImportedHand& imported, Diagnostics& problems)
      : file_(file),
        imported_(imported),
        hand_(imported.hand),
        problems_(problems),
        X_HL_(CalcLinkPoses(hand_, CalcClosedPosture(hand_, FindClosing(hand_), 0.0))) {
    for (int link = 0; link < static_cast<int>(hand_.links.size()); ++link) AddBody(link);
  }

  void Find() {
    FindInOtherDigits();
    FindInPalm();
    FindFoldedBack();
    FindInTheAir();
    FindBesidePictures();
  }

 private:
  struct Body {
    std::vector<CollisionShape> shapes;    // contact shapes
    std::vector<Vector3d> inside;          // grid points inside them, in the link's frame
    AlignedBox3d bounds_H;                 // bounds of the shapes, in H
    AlignedBox3d touched, seen;            // bounds of shapes and of visuals, in the link's frame
    std::vector<CollisionShape> pictures;  // solids that are visual only
    std::vector<Vector3d> vertices;        // of visual meshes
  };
  struct Overlap {
    double depth = 0.0;  // [m]
    double share = 0.0;  // share of a's points
  };

  void AddBody(int link) {
    Body& body = bodies_.emplace_back();
    for (const CollisionShape& shape : imported_.shapes) {
      if (shape.link == link && !shape.is_cover) body.shapes.push_back(shape);
    }
    for (const auto& [of_link, visual] : imported_.visuals) {
      if (of_link != link) continue;
      if (visual.mesh.triangles.empty()) {
        body.pictures.push_back(visual.solid);
        body.pictures.back().link = link;
      }
      body.vertices.insert(body.vertices.end(), visual.mesh.vertices.begin(),
                           visual.mesh.vertices.end());
    }
    if (!body.pictures.empty()) body.seen = CalcBounds(body.pictures);
    for (const Vector3d& p : body.vertices) body.seen.extend(p);
    if (body.shapes.empty()) return;
    body.touched = CalcBounds(body.shapes);
    const double cell = std::max(body.touched.sizes().maxCoeff() / kLinkCellsAlong, kFinestCell);
    const Eigen::Vector3i num =
        (body.touched.sizes() / cell).array().ceil().cwiseMax(1.0).cast<int>();
    for (int i = 0; i < num.prod(); ++i) {
      const Eigen::Array3d at(i % num.x() + 0.5, i / num.x() % num.y() + 0.5,
                              i / (num.x() * num.y()) + 0.5);
      const Vector3d p = body.touched.min() +
                         (at / num.cast<double>().array() * body.touched.sizes().array()).matrix();
      if (CalcLinkDistance(body.shapes, link, p) <= 0.0) body.inside.push_back(p);
    }
    for (const Vector3d& p : body.inside) body.bounds_H.extend(X_HL_[link] * p);
  }

  /** Whether a link has almost no length between two axes: a knuckle, inside its neighbours. */
  bool IsHub(const Digit& digit, size_t i) const {
    return i + 1 < digit.links.size() &&
           hand_.links[digit.links[i + 1]].X_PJ.translation().norm() < kHub;
  }

  Overlap CalcOverlap(int a, int b) const {
    Overlap overlap;
    const Body &of_a = bodies_[a], &of_b = bodies_[b];
    if (of_a.inside.empty() || !of_a.bounds_H.intersects(of_b.bounds_H)) return overlap;
    const Pose X_BA = X_HL_[b].inverse() * X_HL_[a];
    int num_inside = 0;
    for (const Vector3d& p : of_a.inside) {
      const double depth = -CalcLinkDistance(of_b.shapes, b, X_BA * p);
      num_inside += depth > 0.0;
      overlap.depth = std::max(overlap.depth, depth);
    }
    overlap.share = static_cast<double>(num_inside) / static_cast<double>(of_a.inside.size());
    return overlap;
  }

  /** Gap between all shapes and visuals of a and b, where one of each pair is a solid. */
  double CalcGap(int a, int b) const {
    double gap = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      const Pose X_ToFrom = X_HL_[to].inverse() * X_HL_[from];
      const auto approach = [&, to = to](const Vector3d& p_From) {
        const Vector3d p = X_ToFrom * p_From;
        gap = std::min({gap, CalcLinkDistance(bodies_[to].shapes, to, p),
                        CalcLinkDistance(bodies_[to].pictures, to, p)});
      };
      for (const Vector3d& p : bodies_[from].inside) approach(p);
      for (const Vector3d& p : bodies_[from].vertices) approach(p);
      for (const CollisionShape& picture : bodies_[from].pictures)
        approach(picture.X_LS.translation());
    }
    return gap;
  }

  void FindInOtherDigits() {
    for (size_t d = 0; d < hand_.digits.size(); ++d) {
      for (size_t e = 0; e < d; ++e) {
        double deepest = 0.0;
        int link = -1, other = -1;
        for (size_t i = 0; i < hand_.digits[d].links.size(); ++i) {
          for (size_t k = 0; k < hand_.digits[e].links.size(); ++k) {
            if (IsHub(hand_.digits[d], i) || IsHub(hand_.digits[e], k)) continue;
            const int a = hand_.digits[d].links[i], b = hand_.digits[e].links[k];
            const double depth = std::max(CalcOverlap(a, b).depth, CalcOverlap(b, a).depth);
            if (depth <= deepest) continue;
            deepest = depth;
            link = a;
            other = b;
          }
        }
        if (deepest < kDeep) continue;
        Warn("link " + NameOf(link) + " lies " + FormatFixed(MmFromM(deepest), 0) + " mm deep in " +
             NameOf(other) +
             " of another digit when the hand is open; is the place of a joint or the size of a "
             "shape wrong?");
      }
    }
  }

  void FindInPalm() {
    for (const Digit& digit : hand_.digits) {
      const Vector3d p_HBase = X_HL_[digit.links.front()].translation();
      for (size_t i = 0; i < digit.links.size(); ++i) {
        const int link = digit.links[i];
        const double from_base = (X_HL_[link].translation() - p_HBase).norm();
        if (from_base < kRootOfDigit || IsHub(digit, i)) continue;
        const double depth = std::max(CalcOverlap(link, hand_.palm_link).depth,
                                      CalcOverlap(hand_.palm_link, link).depth);
        if (depth < kDeep) continue;
        Warn("link " + NameOf(link) + " lies " + FormatFixed(MmFromM(depth), 0) +
             " mm deep in the palm when the hand is open; is the place or the direction of a joint "
             "wrong?");
        break;
      }
    }
  }

  void FindFoldedBack() {
    for (const Digit& digit : hand_.digits) {
      for (size_t i = 1; i < digit.links.size(); ++i) {
        if (IsHub(digit, i)) continue;
        for (size_t k = 0; k < i; ++k) {
          const int link = digit.links[i], inner = digit.links[k];
          if (CalcOverlap(link, inner).share < kMostInside) continue;
          Warn("link " + NameOf(link) + " lies within " + NameOf(inner) +
               " of its own digit when the hand is open; is the place of its joint wrong?");
          break;
        }
      }
    }
  }

  void FindInTheAir() {
    for (const Digit& digit : hand_.digits) {
      for (const int link : digit.links) {
        if (bodies_[link].shapes.empty()) continue;
        int carrier = hand_.links[link].parent;
        const auto is_empty = [&](int at) {
          return bodies_[at].shapes.empty() && bodies_[at].seen.isEmpty();
        };
        while (carrier >= 0 && is_empty(carrier)) carrier = hand_.links[carrier].parent;
        if (carrier < 0) continue;
        const double gap = CalcGap(link, carrier);
        const bool is_base = link == digit.links.front();
        if (gap < (is_base ? kFarthestBase : kFarthestGap)) continue;
        Warn("link " + NameOf(link) + " hangs in the air, " + FormatFixed(MmFromM(gap), 0) +
             " mm from " + NameOf(carrier) +
             ", which carries it; is the place of its joint wrong, or are its shapes?");
      }
    }
  }

  void FindBesidePictures() {
    for (int link = 0; link < static_cast<int>(bodies_.size()); ++link) {
      const Body& body = bodies_[link];
      if (body.shapes.empty() || body.seen.isEmpty()) continue;
      const double touched = body.touched.sizes().maxCoeff(), seen = body.seen.sizes().maxCoeff();
      const double apart = std::sqrt(body.touched.squaredExteriorDistance(body.seen));
      if (apart > 0.0) {
        Warn("link " + NameOf(link) + ": what it touches with lies " +
             FormatFixed(MmFromM(apart), 0) +
             " mm beside its picture; is the origin of one of them wrong?");
      } else if (touched > kOtherSize * seen || seen > kOtherSize * touched) {
        Warn("link " + NameOf(link) + ": what it touches with is " +
             FormatFixed(MmFromM(touched), 0) + " mm long, its picture " +
             FormatFixed(MmFromM(seen), 0) + " mm; is the scale of a mesh wrong?");
      }
    }
  }

  std::string NameOf(int link) const { return "\"" + hand_.links[link].name + "\""; }
  void Warn(const std::string& text) { problems_.Warn(file_, 0, text); }

  const std::string& file_;
  const ImportedHand& imported_;
  const Hand& hand_;
  Diagnostics& problems_;
  const std::vector<Pose> X_HL_;
  std::vector<Body> bodies_;  // by link
};

}  // namespace

void FindMisplacedLinks(const std::string& file, const ImportedHand& imported,
                        Diagnostics& problems) {
  MisplacedFinder(file, imported, problems).Find();
}

}  // namespace graspbench
