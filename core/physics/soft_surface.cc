#include "core/physics/soft_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/** A ball that does not press yet has the surface share of a ball at this depth [m]. */
constexpr double kLeastDepth = 1e-6;
/** A ball hidden by others keeps this share of its own force, so that it does not become rigid. */
constexpr double kHiddenShare = 1e-4;
/** Number of directions in which a ball's own part of the surface is measured. */
constexpr int kNumRays = 64;

double CalcYield(const Compressibility& object, const Vector3d& nhat_O) {
  return nhat_O.dot(object.yield * nhat_O);
}

const std::array<Vector2d, kNumRays>& ListRays() {
  static const std::array<Vector2d, kNumRays> kRays = [] {
    std::array<Vector2d, kNumRays> rays;
    for (int i = 0; i < kNumRays; ++i) {
      const double angle = 2.0 * kPi * i / kNumRays;
      rays[i] = {std::cos(angle), std::sin(angle)};
    }
    return rays;
  }();
  return kRays;
}

/** Border where a neighbour's sphere cuts the sphere of a ball. A point of the ball's sphere at the
angle alpha from its deepest point, in direction `ray`, is inside the neighbour where radius
(distance towards.ray sin(alpha) + below cos(alpha)) > cut. */
struct Border {
  Vector2d towards;       ///< unit, along the surface
  double distance = 0.0;  ///< between the centres, along the surface [m]
  double below = 0.0;     ///< excess depth of the neighbour's centre [m]
  double cut = 0.0;       ///< [m^2]

  /** Narrows the part of a ray that belongs to the ball. */
  void Cut(const Vector2d& ray, double radius, double& from, double& to) const {
    const double a = radius * distance * towards.dot(ray), b = radius * below;
    const double square = a * a + b * b, rest = square - cut * cut;
    const bool is_hidden = b > cut;  // whether the deepest point is hidden
    if (rest <= 0.0) {
      if (is_hidden) to = 0.0;
      return;
    }
    const double root = std::sqrt(rest);
    if (!is_hidden) {
      const double sine = (a * cut - b * root) / square, cosine = (a * root + b * cut) / square;
      if (sine >= 0.0 && cosine >= 0.0) to = std::min(to, radius * sine);
    } else {
      const double sine = (a * cut + b * root) / square, cosine = (b * cut - a * root) / square;
      if (a >= 0.0 || cosine < 0.0) {
        to = 0.0;
      } else {
        from = std::max(from, radius * sine);
      }
    }
  }
};

/** Finds the borders of ball i along its own tangents; false when another ball at the same point
hides it. */
bool FindBorders(const std::vector<PressingBall>& balls, size_t i, std::vector<Border>& borders) {
  const PressingBall& ball = balls[i];
  Eigen::Index least;
  ball.nhat_O.cwiseAbs().minCoeff(&least);
  const Vector3d tangent1 = ball.nhat_O.cross(Vector3d::Unit(least)).normalized();
  const Vector3d tangent2 = ball.nhat_O.cross(tangent1);
  const double depth = std::max(ball.depth, kLeastDepth);
  borders.clear();
  for (size_t j = 0; j < balls.size(); ++j) {
    const PressingBall& other = balls[j];
    if (j == i || !(other.depth > 0.0) || other.nhat_O.dot(ball.nhat_O) <= 0.0) continue;
    const Vector3d apart = other.p_OCentre - ball.p_OCentre;
    const Vector2d along(tangent1.dot(apart), tangent2.dot(apart));
    const double distance = along.norm();
    if (distance >= ball.radius + other.radius) continue;
    const double below = (other.depth - other.radius) - (depth - ball.radius);
    if (distance < kLeastDepth) {
      if (other.depth > depth || (other.depth == depth && j < i)) return false;
      continue;
    }
    borders.push_back({along / distance, distance, below,
                       0.5 * (distance * distance + below * below + ball.radius * ball.radius -
                              other.radius * other.radius)});
  }
  return true;
}

/** Volume that ball i alone displaces within its borders [m^3]. */
double CalcOwnVolume(const std::vector<PressingBall>& balls, size_t i,
                     std::vector<Border>& borders) {
  if (!FindBorders(balls, i, borders)) return 0.0;
  const double radius = balls[i].radius, depth = std::max(balls[i].depth, kLeastDepth);
  if (borders.empty()) return CalcDisplacedVolume(radius, depth);
  const double patch = depth < radius ? std::sqrt(depth * (2.0 * radius - depth)) : radius;
  const auto integrate = [&](double r) {
    const double flat = std::max(radius * radius - r * r, 0.0);
    return 0.5 * (depth - radius) * r * r +
           (radius * radius * radius - flat * std::sqrt(flat)) / 3.0;
  };
  double volume = 0.0;
  for (const Vector2d& ray : ListRays()) {
    double from = 0.0, to = patch;
    for (const Border& border : borders) border.Cut(ray, radius, from, to);
    if (from < to) volume += integrate(to) - integrate(from);
  }
  return volume * 2.0 * kPi / kNumRays;
}

}  // namespace

double CalcDisplacedVolume(double radius, double depth) {
  const double round = std::min(depth, radius);
  return kPi * round * round * (radius - round / 3.0) + kPi * radius * radius * (depth - round);
}

double CalcStiffnessPerVolume(const Compressibility& object, const Vector3d& nhat_O) {
  const double yield = CalcYield(object, nhat_O);
  if (yield < kLeastYield) return std::numeric_limits<double>::infinity();
  return object.force / CalcDisplacedVolume(kReferenceRadius, yield);
}

void CalcSurfaceYields(const Compressibility& object, const std::vector<PressingBall>& balls,
                       std::vector<SurfaceYield>& yields) {
  yields.assign(balls.size(), SurfaceYield());
  std::vector<Border> borders;
  for (size_t i = 0; i < balls.size(); ++i) {
    const double yield = CalcYield(object, balls[i].nhat_O);
    if (yield < kLeastYield) continue;
    const double depth = std::max(balls[i].depth, kLeastDepth);
    const double alone = CalcDisplacedVolume(balls[i].radius, depth);
    const double own = std::max(CalcOwnVolume(balls, i, borders), kHiddenShare * alone);
    yields[i] = {CalcStiffnessPerVolume(object, balls[i].nhat_O) * own / (depth * depth),
                 kMostYield * yield};
  }
}

}  // namespace graspbench
