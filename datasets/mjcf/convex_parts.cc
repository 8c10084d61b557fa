#include "datasets/mjcf/convex_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "core/base/units.h"

namespace graspbench {

std::set<std::pair<int, int>> FindLinksTouchingAtRest(const Hand& hand) {
  constexpr int kBalls = 64;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  const auto touch = [&](const LinkCapsule& a, const LinkCapsule& b) {
    const Eigen::Vector3d a0 = X_HL[a.link] * a.p_LA, a1 = X_HL[a.link] * a.p_LB;
    const Eigen::Vector3d b0 = X_HL[b.link] * b.p_LA, axis = X_HL[b.link] * b.p_LB - b0;
    const double length2 = axis.squaredNorm();
    for (int k = 0; k <= kBalls; ++k) {
      const Eigen::Vector3d p = a0 + (a1 - a0) * k / kBalls - b0;
      const double share = length2 > 0.0 ? std::clamp(p.dot(axis) / length2, 0.0, 1.0) : 0.0;
      if ((p - share * axis).norm() <= a.radius + b.radius) return true;
    }
    return false;
  };
  std::set<std::pair<int, int>> touching;
  for (const LinkCapsule& a : hand.capsules) {
    for (const LinkCapsule& b : hand.capsules) {
      if (a.link >= b.link || hand.FindDigitOfLink(a.link) == hand.FindDigitOfLink(b.link))
        continue;
      if (touch(a, b)) touching.insert({a.link, b.link});
    }
  }
  return touching;
}

namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/** Directions in which the outermost points of a part are looked for: to measure, to keep. */
constexpr int kMeasuredDirections = 48;
constexpr int kKeptDirections = 1500;
constexpr double kSliver = 1e-4;  ///< parts thinner than this are dropped [m]
constexpr double kLook = 0.002;   ///< distance of the places looked at along a chord [m]

using Polygon = std::vector<Vector3d>;

/** What the mesh has inside an axis-parallel box. */
struct Region {
  Vector3d lower, upper;
  std::vector<Polygon> surface;  // the triangles, cut to the box
  std::vector<Vector3d> points;  // corners of the surface, and the box's own inside the solid
  double excess = 0.0;
  Vector3d deepest = Vector3d::Zero();  // where the hull reaches farthest out of the solid
};

/** The part of a polygon on the side of a plane where sign * (x[axis] - place) >= 0. */
Polygon Clip(const Polygon& polygon, int axis, double place, double sign) {
  Polygon result;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = sign * (a[axis] - place), db = sign * (b[axis] - place);
    if (da >= 0.0) result.push_back(a);
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
      Vector3d p = a + da / (da - db) * (b - a);
      p[axis] = place;
      result.push_back(p);
    }
  }
  return result;
}

/** Points evenly over the unit sphere (Fibonacci lattice). */
std::vector<Vector3d> MakeDirections(int number) {
  const double golden_angle = kPi * (3.0 - std::sqrt(5.0));
  std::vector<Vector3d> directions;
  for (int k = 0; k < number; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / number, r = std::sqrt(1.0 - z * z);
    directions.emplace_back(r * std::cos(golden_angle * k), r * std::sin(golden_angle * k), z);
  }
  return directions;
}

std::vector<Vector3d> FindOutermost(const std::vector<Vector3d>& points,
                                    const std::vector<Vector3d>& directions) {
  std::set<size_t> chosen;
  for (const Vector3d& direction : directions) {
    size_t best = 0;
    double most = -kInfinity;
    for (size_t i = 0; i < points.size(); ++i) {
      if (const double extent = direction.dot(points[i]); extent > most) {
        most = extent;
        best = i;
      }
    }
    chosen.insert(best);
  }
  std::vector<Vector3d> outermost;
  for (const size_t i : chosen) outermost.push_back(points[i]);
  return outermost;
}

/** Looks out of the solid along the chords between outermost points and in triangles of them. */
void MeasureExcess(const SignedDistanceField& field, Region& region) {
  static const std::vector<Vector3d> directions = MakeDirections(kMeasuredDirections);
  const std::vector<Vector3d> outermost = FindOutermost(region.points, directions);
  const auto look = [&](const Vector3d& p) {
    const double distance = field.CalcDistance(p);
    if (distance <= region.excess) return;
    region.excess = distance;
    region.deepest = p;
  };
  region.excess = 0.0;
  const size_t n = outermost.size();
  const auto look_along = [&](const Vector3d& a, const Vector3d& b) {
    const int num_gaps = 1 + static_cast<int>(std::ceil((b - a).norm() / kLook));
    for (int k = 1; k < num_gaps; ++k) look(a + (b - a) * k / num_gaps);
  };
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < i; ++j) {
      look_along(outermost[i], outermost[j]);
      look_along(0.5 * (outermost[i] + outermost[j]), outermost[(7 * i + 3 * j) % n]);
    }
  }
}

/** Finds the points of a region and its excess. */
void Complete(const SignedDistanceField& field, Region& region) {
  for (const Polygon& polygon : region.surface) {
    region.points.insert(region.points.end(), polygon.begin(), polygon.end());
  }
  for (int corner = 0; corner < 8; ++corner) {
    Vector3d p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = (corner >> axis & 1) != 0 ? region.upper[axis] : region.lower[axis];
    }
    if (field.CalcDistance(p) < 0.0) region.points.push_back(p);
  }
  if (!region.points.empty()) MeasureExcess(field, region);
}

std::array<Region, 2> Cut(const SignedDistanceField& field, const Region& region, int axis,
                          double place) {
  std::array<Region, 2> halves;
  for (int side = 0; side < 2; ++side) {
    Region& half = halves[static_cast<size_t>(side)];
    half.lower = region.lower;
    half.upper = region.upper;
    (side == 0 ? half.upper : half.lower)[axis] = place;
    for (const Polygon& polygon : region.surface) {
      Polygon clipped = Clip(polygon, axis, place, side == 0 ? -1.0 : 1.0);
      if (clipped.size() > 2) half.surface.push_back(std::move(clipped));
    }
    Complete(field, half);
  }
  return halves;
}

/** Cuts through the deepest notch, or through the nearest corners of the surface beside it, in
whichever way leaves least. */
std::array<Region, 2> CutBest(const SignedDistanceField& field, const Region& region) {
  std::array<Region, 2> best;
  double least = kInfinity, least_sum = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double through = region.deepest[axis];
    double below = -kInfinity, above = kInfinity;
    for (const Vector3d& p : region.points) {
      if (p[axis] < through) below = std::max(below, p[axis]);
      if (p[axis] > through) above = std::min(above, p[axis]);
    }
    for (const double place : {below, through, above}) {
      if (!(place > region.lower[axis] + kSliver && place < region.upper[axis] - kSliver)) continue;
      std::array<Region, 2> halves = Cut(field, region, axis, place);
      const double worse = std::max(halves[0].excess, halves[1].excess);
      const double sum = halves[0].excess + halves[1].excess;
      if (worse > least || (worse == least && sum >= least_sum)) continue;
      least = worse;
      least_sum = sum;
      best = std::move(halves);
    }
  }
  return best;
}

bool IsSliver(const std::vector<Vector3d>& points) {
  Vector3d lower = Vector3d::Constant(kInfinity), upper = -lower;
  for (const Vector3d& p : points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  return !((upper - lower).minCoeff() > kSliver);
}

}  // namespace

std::vector<ConvexPart> CutIntoConvexParts(const TriMesh& mesh, const SignedDistanceField& field,
                                           const ConvexPartsConfig& config) {
  Region whole;
  whole.lower = Vector3d::Constant(kInfinity);
  whole.upper = -whole.lower;
  for (const Vector3d& p : mesh.vertices) {
    whole.lower = whole.lower.cwiseMin(p);
    whole.upper = whole.upper.cwiseMax(p);
  }
  for (const Eigen::Vector3i& t : mesh.triangles) {
    whole.surface.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  }
  Complete(field, whole);

  const auto is_better = [](const Region& a, const Region& b) { return a.excess < b.excess; };
  std::priority_queue<Region, std::vector<Region>, decltype(is_better)> open(is_better);
  open.push(std::move(whole));
  std::vector<Region> done;
  while (!open.empty()) {
    Region region = open.top();
    open.pop();
    const bool is_full = static_cast<int>(open.size() + done.size()) + 1 >= config.max_parts;
    if (region.excess <= config.tolerance || is_full) {
      done.push_back(std::move(region));
      continue;
    }
    std::array<Region, 2> halves = CutBest(field, region);
    if (halves[0].points.empty() && halves[1].points.empty()) {  // too thin to be cut
      done.push_back(std::move(region));
      continue;
    }
    for (Region& half : halves) {
      if (!half.points.empty()) open.push(std::move(half));
    }
  }

  const std::vector<Vector3d> directions = MakeDirections(kKeptDirections);
  std::vector<ConvexPart> parts;
  for (const Region& region : done) {
    if (IsSliver(region.points)) continue;
    parts.push_back({FindOutermost(region.points, directions), region.excess});
  }
  return parts;
}

}  // namespace graspbench
