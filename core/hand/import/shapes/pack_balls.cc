#include "core/hand/import/shapes/pack_balls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "core/hand/contact_fit.h"
#include "core/hand/import/shapes/point_grid.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using BoundaryPoint = LinkSolid::BoundaryPoint;

constexpr size_t kNumCandidates = 3500;                  // approximately
constexpr size_t kManyBalls = 600;                       // of a link
constexpr double kSlack = 0.00015, kOut = 0.00035;       // [m]
constexpr double kLargestBall = 0.03;                    // radius [m]
constexpr double kThinnest = 0.0001;                     // radius of a ball in a sheet [m]
constexpr double kNearSink = 0.00065, kFarSink = 0.003;  // [m]
constexpr double kLeftOver = 0.02;                       // share of points beyond the near sink

std::vector<Vector3d> ListPlaces(const std::vector<BoundaryPoint>& points) {
  std::vector<Vector3d> places;
  for (const BoundaryPoint& point : points) places.push_back(point.p);
  return places;
}

class LargestBalls {
 public:
  explicit LargestBalls(const LinkSolid& solid)
      : solid_(solid), grid_(ListPlaces(solid.boundary())) {}

  /** Largest ball inside the solid at the point, without its protrusion. */
  Ball Find(const BoundaryPoint& point) const {
    double rho = kLargestBall;
    // Points farther away than twice rho are outside the ball.
    for (double reach = 0.0; reach < 2.0 * rho;) {
      reach = std::min(2.0 * rho, std::max(kSearch, 2.0 * reach));
      grid_.Visit(point.p, reach, [&](size_t k) {
        const Vector3d d = point.p - solid_.boundary()[k].p;
        const double along = d.dot(point.nhat) - kSlack;
        if (along <= 0.0) return;
        rho = std::min(rho, std::max(0.0, d.squaredNorm() - kSlack * kSlack) / (2.0 * along));
      });
    }
    while (rho > kThinnest && solid_.IsOutside(point.p - rho * point.nhat)) rho *= 0.7;
    rho = std::max(rho, kThinnest);
    return {point.p - rho * point.nhat, rho};
  }

 private:
  static constexpr double kSearch = 0.005;  // [m]
  const LinkSolid& solid_;
  PointGrid grid_;
};

class GreedyCover {
 public:
  GreedyCover(const LinkSolid& solid, const std::vector<BoundaryPoint>& points,
              std::vector<Ball> candidates, size_t points_by_candidate)
      : solid_(solid),
        points_(points),
        grid_(ListPlaces(points)),
        candidates_(std::move(candidates)),
        points_by_candidate_(points_by_candidate),
        is_trimmed_(candidates_.size(), false),
        sinks_(points.size(), 1.0) {}

  void Add(const Ball& ball) {
    VisitNear(ball, [&](size_t k, double sink) { sinks_[k] = std::min(sinks_[k], sink); });
  }

  /** Adds candidates until all but a share of the points are within `sink`. */
  void Cover(double sink, double left_over, double smallest, size_t most_balls,
             std::vector<Ball>& taken) {
    const auto most_open = static_cast<size_t>(left_over * static_cast<double>(points_.size()));
    std::vector<std::vector<int>> covers(candidates_.size());
    std::priority_queue<std::pair<size_t, int>> queue;  // by the last known gain
    for (size_t c = 0; c < candidates_.size(); ++c) {
      if (candidates_[c].radius < smallest) continue;
      covers[c] = ListCovered(c, sink);
      if (!covers[c].empty()) queue.emplace(covers[c].size(), -static_cast<int>(c));
    }
    const auto count_open = [&](const std::vector<int>& of) {
      return static_cast<size_t>(std::count_if(
          of.begin(), of.end(), [&](int k) { return sinks_[static_cast<size_t>(k)] > sink; }));
    };
    size_t num_open = static_cast<size_t>(
        std::count_if(sinks_.begin(), sinks_.end(), [&](double s) { return s > sink; }));
    while (taken.size() < most_balls && num_open > most_open && !queue.empty()) {
      const auto [gain, minus_c] = queue.top();
      queue.pop();
      const auto c = static_cast<size_t>(-minus_c);
      if (!is_trimmed_[c] && Trim(c)) covers[c] = ListCovered(c, sink);
      const size_t now = candidates_[c].radius < smallest ? 0 : count_open(covers[c]);
      if (now < gain) {
        if (now > 0) queue.emplace(now, minus_c);
        continue;
      }
      taken.push_back(candidates_[c]);
      Add(candidates_[c]);
      num_open -= now;
    }
  }

 private:
  std::vector<int> ListCovered(size_t c, double sink) const {
    std::vector<int> covered;
    VisitNear(candidates_[c], [&](size_t k, double own) {
      if (sinks_[k] > sink && own <= sink) covered.push_back(static_cast<int>(k));
    });
    return covered;
  }
  /** Calls `visit` with every point whose probe meets the ball before it sinks in by its radius. */
  template <class F>
  void VisitNear(const Ball& ball, F&& visit) const {
    grid_.Visit(ball.centre, ball.radius + 2.0 * kProbeRadius, [&](size_t k) {
      visit(k, CalcSink(points_[k].p, points_[k].nhat, ball.centre, ball.radius));
    });
  }
  /** Shrinks a ball at the same point if it protrudes too far between boundary points. */
  bool Trim(size_t c) {
    is_trimmed_[c] = true;
    Ball& ball = candidates_[c];
    const BoundaryPoint& point = points_[points_by_candidate_ * c];
    bool is_smaller = false;
    for (double rho = ball.radius - kOut; rho > kThinnest; is_smaller = true) {
      double most = 0.0;
      for (const Vector3d& direction : SpreadOnSphere(0.6 * ball.radius)) {
        most = std::max(most, solid_.CalcOutside(ball.centre + ball.radius * direction));
      }
      if (most <= kSlack + kOut) break;
      rho = std::max(kThinnest, 0.8 * rho);
      ball = {point.p - rho * point.nhat, rho + kOut};
    }
    return is_smaller;
  }

  const LinkSolid& solid_;
  const std::vector<BoundaryPoint>& points_;
  const PointGrid grid_;
  std::vector<Ball> candidates_;
  size_t points_by_candidate_;
  std::vector<bool> is_trimmed_;
  std::vector<double> sinks_;
};

}  // namespace

namespace {

std::vector<Ball> Pack(const LinkSolid& solid, const std::vector<ContactSphere>& present,
                       double smallest, int num_points, size_t num_candidates, size_t most_balls) {
  const std::vector<BoundaryPoint> points = solid.ListOpen(static_cast<size_t>(num_points));
  const LargestBalls largest(solid);
  std::vector<Ball> candidates;
  const size_t step = std::max<size_t>(2, points.size() / num_candidates);
  for (size_t k = 0; k < points.size(); k += step) {
    Ball ball = largest.Find(points[k]);
    ball.radius += kOut;
    candidates.push_back(ball);
  }
  GreedyCover cover(solid, points, std::move(candidates), step);
  for (const ContactSphere& ball : present) cover.Add({ball.p_LS, ball.radius});
  std::vector<Ball> taken;
  cover.Cover(kNearSink, kLeftOver, smallest, most_balls, taken);
  cover.Cover(kNearSink, kLeftOver, 0.0, most_balls, taken);
  cover.Cover(kFarSink, 0.0, 0.0, most_balls, taken);
  return taken;
}

}  // namespace

std::vector<Ball> PackBalls(const LinkSolid& solid, const std::vector<ContactSphere>& present,
                            double smallest, int num_points) {
  const std::vector<Ball> taken =
      Pack(solid, present, smallest, num_points, kNumCandidates, kManyBalls + 1);
  if (taken.size() <= kManyBalls) return taken;
  // A large sheet: its points are too far apart to show where it is covered.
  return Pack(solid, present, smallest, 3 * num_points, 3 * kNumCandidates, kMostBalls);
}

namespace {

constexpr size_t kNumEnds = 30, kMostSelfCapsules = 8, kMostOfThin = 48;
constexpr double kNearCapsule = 0.002;  // [m] of a point that it covers
constexpr double kThin = 1.0 / 3.0;     // share of points near a capsule (contact_fit.h)
constexpr double kEnough = 0.9;         // share of points
constexpr size_t kPerCapsule = 50, kPerCapsuleOfThin = 200;     // least gain: one of so many points
constexpr double kMostSlender = 40.0, kThinnestSlender = 56.0;  // length over radius; loader: 58

double CalcDistance(const FittedCapsule& capsule, const Vector3d& p) {
  const Vector3d axis = capsule.p_B - capsule.p_A;
  const double square = axis.squaredNorm();
  const double t = square > 0.0 ? std::clamp((p - capsule.p_A).dot(axis) / square, 0.0, 1.0) : 0.0;
  return (p - capsule.p_A - t * axis).norm();
}

/** Chooses balls far from each other, the largest first. */
std::vector<Ball> ChooseEnds(std::vector<Ball> balls) {
  std::stable_sort(balls.begin(), balls.end(),
                   [](const Ball& a, const Ball& b) { return a.radius > b.radius; });
  std::vector<Ball> ends;
  std::vector<double> apart(balls.size(), 1.0);
  while (ends.size() < std::min(kNumEnds, balls.size())) {
    size_t best = 0;
    for (size_t k = 1; k < balls.size(); ++k) {
      // Half the distance counts as much as twice the radius.
      if (apart[k] * balls[k].radius > apart[best] * balls[best].radius) best = k;
    }
    if (apart[best] <= 0.0) break;
    ends.push_back(balls[best]);
    for (size_t k = 0; k < balls.size(); ++k) {
      apart[k] = std::min(apart[k], (balls[k].centre - ends.back().centre).norm());
    }
  }
  return ends;
}

/** Inscribes capsules between the balls, as far as the solid allows. */
std::vector<FittedCapsule> InscribeBetween(const LinkSolid& solid, const std::vector<Ball>& ends) {
  // Between two boundary points it may cross a wall and the hollow behind it.
  const auto stays_inside = [&](const FittedCapsule& capsule) {
    constexpr double kStep = 0.0005;  // [m]
    const Vector3d axis = capsule.p_B - capsule.p_A;
    const int num_steps = static_cast<int>(std::ceil(axis.norm() / kStep));
    for (int i = 1; i < num_steps; ++i) {
      const Vector3d p = capsule.p_A + static_cast<double>(i) / num_steps * axis;
      if (solid.IsOutside(p) && solid.CalcOutside(p) > kSlack) return false;
    }
    return true;
  };
  std::vector<FittedCapsule> candidates;
  for (size_t a = 0; a < ends.size(); ++a) {
    for (size_t b = a; b < ends.size(); ++b) {
      const double length = (ends[a].centre - ends[b].centre).norm();
      const double least =
          std::max(0.5 * std::min(ends[a].radius, ends[b].radius), length / kMostSlender);
      FittedCapsule capsule{ends[a].centre, ends[b].centre, kLargestBall};
      for (const BoundaryPoint& wall : solid.boundary()) {
        if (capsule.radius <= least) break;
        capsule.radius = std::min(capsule.radius, CalcDistance(capsule, wall.p));
      }
      if (capsule.radius > least && stays_inside(capsule)) candidates.push_back(capsule);
    }
  }
  return candidates;
}

/** Greedy cover of boundary points by capsules near them. */
class CapsuleCover {
 public:
  CapsuleCover(const LinkSolid& solid, const std::vector<BoundaryPoint>& points, double near,
               const std::vector<FittedCapsule>& taken = {})
      : solid_(solid), points_(points), near_(near), is_open_(points.size(), true) {
    for (const FittedCapsule& capsule : taken) Take(capsule);
  }

  const std::vector<FittedCapsule>& taken() const { return taken_; }
  double CalcOpenShare() const {
    const auto num_open = std::count(is_open_.begin(), is_open_.end(), true);
    return static_cast<double>(num_open) / static_cast<double>(std::max<size_t>(1, points_.size()));
  }
  /** Returns those balls, in order, whose points are not near a capsule. */
  std::vector<Ball> ListOpen(const std::vector<Ball>& balls) const {
    std::vector<Ball> open;
    for (size_t k = 0; k < balls.size(); ++k) {
      if (is_open_[k]) open.push_back(balls[k]);
    }
    return open;
  }
  /** @param most  total number. @param least_gain  points gained; the first capsule may gain
  less. */
  void Add(const std::vector<Ball>& ends, size_t most, size_t least_gain) {
    std::vector<FittedCapsule> candidates = InscribeBetween(solid_, ends);
    while (taken_.size() < most && CalcOpenShare() > 1.0 - kEnough) {
      auto best = candidates.end();
      size_t most_near = 0;
      for (auto candidate = candidates.begin(); candidate != candidates.end(); ++candidate) {
        size_t gain = 0;
        for (size_t k = 0; k < points_.size(); ++k) gain += is_open_[k] && IsNear(*candidate, k);
        if (gain <= most_near) continue;
        most_near = gain;
        best = candidate;
      }
      if (best == candidates.end() || (!taken_.empty() && most_near < least_gain)) break;
      Take(*best);
      candidates.erase(best);  // trimmed, it may not be near all points that it seemed to be
    }
  }
  void AddLargest(const std::vector<Ball>& balls) {
    const std::vector<Ball> ends = ChooseEnds(balls);
    if (!ends.empty()) Take({ends[0].centre, ends[0].centre, ends[0].radius});
  }

 private:
  void Take(FittedCapsule capsule) {
    Trim(capsule);
    taken_.push_back(capsule);
    for (size_t k = 0; k < points_.size(); ++k) {
      if (IsNear(capsule, k)) is_open_[k] = false;
    }
  }
  /** Makes a capsule thinner if it protrudes between boundary points, which are apart. */
  void Trim(FittedCapsule& capsule) const {
    const Vector3d axis = capsule.p_B - capsule.p_A;
    const auto sticks_out = [&] {
      const int num_steps = 2 + static_cast<int>(axis.norm() / capsule.radius);
      for (const Vector3d& direction : SpreadOnSphere(0.0)) {
        for (int i = 0; i <= num_steps; ++i) {
          const double share = static_cast<double>(i) / num_steps;
          const Vector3d p = capsule.p_A + share * axis + capsule.radius * direction;
          if (solid_.CalcOutside(p) > kSlack + kOut) return true;
        }
      }
      return false;
    };
    const double least = std::max(kThinnest, axis.norm() / kThinnestSlender);
    while (0.9 * capsule.radius > least && sticks_out()) capsule.radius *= 0.9;
  }
  bool IsNear(const FittedCapsule& capsule, size_t k) const {
    return CalcDistance(capsule, points_[k].p) - capsule.radius <= near_;
  }

  const LinkSolid& solid_;
  const std::vector<BoundaryPoint>& points_;
  const double near_;  // distance of a point that a capsule covers [m]
  std::vector<bool> is_open_;
  std::vector<FittedCapsule> taken_;
};

}  // namespace

std::vector<FittedCapsule> InscribeCapsules(const LinkSolid& solid) {
  const std::vector<BoundaryPoint> points = solid.ListOpen(600);
  const LargestBalls largest(solid);
  std::vector<Ball> balls;
  for (const BoundaryPoint& point : points) balls.push_back(largest.Find(point));
  CapsuleCover cover(solid, points, kNearCapsule);
  cover.Add(ChooseEnds(balls), kMostSelfCapsules, points.size() / kPerCapsule);
  if (cover.taken().empty()) cover.AddLargest(balls);
  // Thin plates and shells get shorter capsules, between balls of the remaining points.
  CapsuleCover wider(solid, points, kNearSelfContact, cover.taken());
  if (wider.CalcOpenShare() <= 1.0 - kThin) return cover.taken();
  while (wider.CalcOpenShare() > 1.0 - kEnough && wider.taken().size() < kMostOfThin) {
    const size_t num_before = wider.taken().size();
    wider.Add(ChooseEnds(wider.ListOpen(balls)), kMostOfThin, points.size() / kPerCapsuleOfThin);
    if (wider.taken().size() == num_before) break;
  }
  return wider.taken();
}

}  // namespace graspbench
