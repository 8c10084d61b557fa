#include "core/hand/import/shapes/cover_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/shape/line_crossings.h"
#include "core/shape/mass_properties.h"
#include "core/shape/triangle_tree.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr size_t kMostBalls = 200;
constexpr double kCovered = 0.0012;       // [m] of a covered point; less than what is asked
constexpr double kLeftOver = 0.03;        // of the points may stay uncovered; fewer than is asked
constexpr double kTold = 0.05;            // of the points are not reported
constexpr double kSmallestBall = 0.0005;  // [m]
constexpr double kLargestBall = 0.025;    // [m]
constexpr double kGrowth = 1.2;           // from one radius that is tried to the next
constexpr double kSlack = 0.03;           // of a radius, for facets of a round surface
constexpr double kOffSurface = 0.0001;    // [m]

struct SurfacePoint {
  Vector3d p, nhat;
  size_t solid = 0;
};

class CoveredSolid {
 public:
  explicit CoveredSolid(const TriMesh& mesh)
      : mesh_(mesh),
        tree_(mesh),
        crossings_{LineCrossings(mesh, 0), LineCrossings(mesh, 1), LineCrossings(mesh, 2)},
        outwards_(CalcVolume(mesh) < 0.0 ? -1.0 : 1.0) {}

  /** By two of three lines, so that a hole in the surface does not decide. */
  bool Contains(const Vector3d& p) const {
    int num_inside = 0;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<LineCrossings::Crossing> found;
      crossings_[axis].Find(p[(axis + 1) % 3], p[(axis + 2) % 3], found);
      int winding = 0;
      for (const LineCrossings::Crossing& crossing : found) {
        if (crossing.at < p[axis]) winding += crossing.winding;
      }
      num_inside += winding != 0;
    }
    return num_inside >= 2;
  }
  double CalcDistance(const Vector3d& p) const {
    return std::sqrt(tree_.FindNearest(p).squared_distance);
  }
  const TriMesh& mesh() const { return mesh_; }
  double outwards() const { return outwards_; }

 private:
  const TriMesh& mesh_;
  TriangleTree tree_;
  LineCrossings crossings_[3];
  double outwards_;  // -1: its triangles face inwards
};

bool IsInside(const std::vector<CoveredSolid>& solids, const Vector3d& p) {
  return std::any_of(solids.begin(), solids.end(),
                     [&](const CoveredSolid& solid) { return solid.Contains(p); });
}

/** Evenly by area: every A / n along the triangles, within one by a Kronecker sequence. */
std::vector<SurfacePoint> SpreadPoints(const std::vector<CoveredSolid>& solids, int num_points) {
  double all = 0.0;
  for (const CoveredSolid& solid : solids) {
    for (const Eigen::Vector3i& t : solid.mesh().triangles) all += CalcArea(solid.mesh(), t);
  }
  const double share = all / num_points;
  double until = 0.5 * share, area = 0.0;
  std::vector<SurfacePoint> points;
  double u = 0.0, v = 0.0;
  for (size_t s = 0; s < solids.size(); ++s) {
    const TriMesh& mesh = solids[s].mesh();
    for (const Eigen::Vector3i& t : mesh.triangles) {
      const Vector3d a = mesh.vertices[t[0]], ab = mesh.vertices[t[1]] - a,
                     ac = mesh.vertices[t[2]] - a;
      area += CalcArea(mesh, t);
      for (; until < area; until += share) {
        u = std::fmod(u + 0.7548776662466927, 1.0);
        v = std::fmod(v + 0.5698402909980532, 1.0);
        const bool is_beyond = u + v > 1.0;
        const Vector3d p = a + (is_beyond ? 1.0 - u : u) * ab + (is_beyond ? 1.0 - v : v) * ac;
        const Vector3d nhat = solids[s].outwards() * ab.cross(ac).normalized();
        if (!IsInside(solids, p + kOffSurface * nhat)) points.push_back({p, nhat, s});
      }
    }
  }
  return points;
}

/** The largest that touches the surface at the point from inside; radius 0: none. */
SurfaceCover::Ball FindCandidate(const CoveredSolid& solid, const SurfacePoint& point) {
  SurfaceCover::Ball largest;
  for (double radius = kSmallestBall; radius <= kLargestBall; radius *= kGrowth) {
    const Vector3d centre = point.p - radius * point.nhat;
    if (solid.CalcDistance(centre) < (1.0 - kSlack) * radius) break;
    largest = {centre, radius};
  }
  return largest;
}

double CalcGap(const SurfaceCover::Ball& ball, const Vector3d& p) {
  return (p - ball.centre).norm() - ball.radius;
}

double FindQuantile(std::vector<double> gaps) {
  const auto num_told =
      static_cast<std::ptrdiff_t>((1.0 - kTold) * static_cast<double>(gaps.size()));
  const auto at = gaps.begin() + std::min(num_told, static_cast<std::ptrdiff_t>(gaps.size()) - 1);
  std::nth_element(gaps.begin(), at, gaps.end());
  return std::max(0.0, *at);
}

}  // namespace

SurfaceCover CoverSurface(const std::vector<TriMesh>& meshes,
                          const std::vector<ContactSphere>& present, int num_points) {
  std::vector<CoveredSolid> solids(meshes.begin(), meshes.end());
  const std::vector<SurfacePoint> points = SpreadPoints(solids, num_points);
  SurfaceCover cover;
  if (points.empty()) return cover;
  std::vector<double> gaps;
  for (const SurfacePoint& point : points) {
    double least = kLargestBall;
    for (const ContactSphere& ball : present) {
      least = std::min(least, CalcGap({ball.p_LS, ball.radius}, point.p));
    }
    gaps.push_back(least);
  }

  struct Candidate {
    SurfaceCover::Ball ball;
    std::vector<size_t> near;  // points
  };
  std::vector<Candidate> candidates;
  for (size_t k = 0; k < points.size(); ++k) {
    if (gaps[k] <= kCovered) continue;
    Candidate candidate{FindCandidate(solids[points[k].solid], points[k]), {}};
    if (candidate.ball.radius == 0.0 || !IsInside(solids, candidate.ball.centre)) continue;
    for (size_t other = 0; other < points.size(); ++other) {
      const bool is_open = gaps[other] > kCovered;
      if (is_open && CalcGap(candidate.ball, points[other].p) <= kCovered) {
        candidate.near.push_back(other);
      }
    }
    candidates.push_back(std::move(candidate));
  }

  const auto count_open = [&](const std::vector<size_t>& near) {
    return std::count_if(near.begin(), near.end(), [&](size_t k) { return gaps[k] > kCovered; });
  };
  std::vector<size_t> everywhere(points.size());
  std::iota(everywhere.begin(), everywhere.end(), size_t{0});
  const auto num_left_over =
      static_cast<std::ptrdiff_t>(kLeftOver * static_cast<double>(points.size()));
  while (cover.balls.size() < kMostBalls && count_open(everywhere) > num_left_over) {
    const Candidate* best = nullptr;
    std::ptrdiff_t most = 0;
    for (const Candidate& candidate : candidates) {
      const std::ptrdiff_t num_open = count_open(candidate.near);
      if (num_open <= most) continue;
      most = num_open;
      best = &candidate;
    }
    if (!best) break;
    cover.balls.push_back(best->ball);
    for (size_t k = 0; k < points.size(); ++k) {
      gaps[k] = std::min(gaps[k], CalcGap(best->ball, points[k].p));
    }
  }
  cover.uncovered = FindQuantile(gaps);
  return cover;
}

}  // namespace graspbench
