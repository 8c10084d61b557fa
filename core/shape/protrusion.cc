#include "core/shape/protrusion.h"

#include <Eigen/Dense>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kLeftOut = 5e-5;    // [m] of a point outside the hull of the corners
constexpr double kConverged = 1e-8;  // [m] of a distance
constexpr int kMostSteps = 100;
constexpr int kNumDirections = 400;

/** Corners of the hull, at most four, relative to the point whose distance is sought. */
struct Simplex {
  Vector3d corners[4];
  size_t indices[4] = {};
  int size = 0;
};

/** The point of a simplex nearest to the origin; the simplex keeps the corners of its face. */
Vector3d Reduce(Simplex& simplex) {
  Vector3d nearest = simplex.corners[0];
  int best = 1;
  for (int face = 1; face < 1 << simplex.size; ++face) {
    int at[4], size = 0;
    for (int k = 0; k < simplex.size; ++k) {
      if (face >> k & 1) at[size++] = k;
    }
    // The edges from the face's first corner a; unused columns stay unit vectors.
    const Vector3d a = simplex.corners[at[0]];
    Eigen::Matrix3d edges = Eigen::Matrix3d::Zero(), G = Eigen::Matrix3d::Identity();
    for (int i = 1; i < size; ++i) edges.col(i - 1) = simplex.corners[at[i]] - a;
    for (int i = 0; i < size - 1; ++i) {
      for (int k = 0; k < size - 1; ++k) G(i, k) = edges.col(i).dot(edges.col(k));
    }
    if (G.determinant() <= 1e-12 * G.diagonal().prod()) continue;  // flat: a smaller face has it
    const Vector3d shares = G.inverse() * (-edges.transpose() * a);
    if (shares.minCoeff() < 0.0 || shares.sum() > 1.0) continue;
    const Vector3d p = a + edges * shares;
    if (p.squaredNorm() >= nearest.squaredNorm()) continue;
    nearest = p;
    best = face;
  }
  int size = 0;
  for (int k = 0; k < simplex.size; ++k) {
    if ((best >> k & 1) == 0) continue;
    simplex.corners[size] = simplex.corners[k];
    simplex.indices[size++] = simplex.indices[k];
  }
  simplex.size = size;
  return nearest;
}

class Hull {
 public:
  explicit Hull(const std::vector<Vector3d>& points) {
    corners_ = {points.front()};
    for (const Vector3d& p : points) {
      for (;;) {
        const Vector3d out = FindWayOut(p, kLeftOut);
        if (out.norm() <= kLeftOut) break;
        const size_t farthest = FindFarthest(points, out);
        const size_t corner = FindFarthest(corners_, out);
        const bool is_new = out.dot(points[farthest] - corners_[corner]) > 0.0;
        corners_.push_back(is_new ? points[farthest] : p);
        if (!is_new) break;
      }
    }
  }

  /** From the hull's nearest point to p; any vector of at most `enough` where the distance is not
  more. Starts from the face that the last call found. */
  Vector3d FindWayOut(const Vector3d& p, double enough) {
    for (int k = 0; k < simplex_.size; ++k) {
      simplex_.corners[k] = corners_[simplex_.indices[k]] - p;
    }
    if (simplex_.size == 0) Add(0, p);
    Vector3d nearest = Reduce(simplex_);
    for (int step = 0; step < kMostSteps && nearest.norm() > enough; ++step) {
      const size_t farthest = FindFarthest(corners_, -nearest);
      const double gain = nearest.squaredNorm() - nearest.dot(corners_[farthest] - p);
      if (gain <= kConverged * nearest.norm() || simplex_.size == 4) break;
      Add(farthest, p);
      const Vector3d nearer = Reduce(simplex_);
      if (nearer.norm() >= nearest.norm()) break;
      nearest = nearer;
    }
    return -nearest;
  }

 private:
  void Add(size_t corner, const Vector3d& p) {
    simplex_.indices[simplex_.size] = corner;
    simplex_.corners[simplex_.size++] = corners_[corner] - p;
  }
  static size_t FindFarthest(const std::vector<Vector3d>& points, const Vector3d& direction) {
    size_t farthest = 0;
    double most = direction.dot(points[0]);
    for (size_t i = 1; i < points.size(); ++i) {
      const double extent = direction.dot(points[i]);
      if (extent <= most) continue;
      most = extent;
      farthest = i;
    }
    return farthest;
  }

  std::vector<Vector3d> corners_;
  Simplex simplex_;
};

/** Unit vectors, evenly spread: a Fibonacci lattice. */
std::vector<Vector3d> SpreadDirections() {
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  std::vector<Vector3d> directions;
  for (int i = 0; i < kNumDirections; ++i) {
    const double z = (2.0 * i + 1.0) / kNumDirections - 1.0, across = std::sqrt(1.0 - z * z);
    directions.emplace_back(across * std::cos(golden * i), across * std::sin(golden * i), z);
  }
  return directions;
}

}  // namespace

double CalcProtrusion(const std::vector<Vector3d>& points, const std::vector<Ball>& balls) {
  Hull hull(points);
  const std::vector<Vector3d> directions = SpreadDirections();
  double most = 0.0;
  for (const Ball& ball : balls) {
    for (const Vector3d& direction : directions) {
      Vector3d out = hull.FindWayOut(ball.centre + ball.radius * direction, most);
      while (out.norm() > most + kConverged) {
        most = out.norm();
        out = hull.FindWayOut(ball.centre + ball.radius / most * out, most);
      }
    }
  }
  return most;
}

}  // namespace graspbench
