#include "core/vision/silhouette.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/error.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDirectionStep = 2.0 * kPi / kNumDirections;
constexpr int kNumHullDirections = 4000;
constexpr int kNumSteps = 5;
constexpr int kSameTurn = kNumDirections / 18;  // within 20 degrees: one and the same
constexpr size_t kMaxTurns = 6;                 // a square has four
constexpr int kNumRoundTurns = 7;               // no symmetry of anything but the round
constexpr double kSurelyNotRound = 0.001;       // misfit of another turn [m]

/** Unit vectors spread evenly over the sphere (a Fibonacci lattice). */
Vector3d HullDirection(int i) {
  const double z = 1.0 - (2.0 * i + 1.0) / kNumHullDirections;
  const double turn = 2.399963229728653 * i;
  const double level = std::sqrt(1.0 - z * z);
  return Vector3d(level * std::cos(turn), level * std::sin(turn), z);
}

double CalcTurn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - b).y() - (b - a).y() * (c - b).x();
}

/** What is left of `seen` less `thrown` turned by `shift` directions: mean square after a shift and
a thickness [m^2]. */
double CalcMisfit(const Silhouette& seen, const Silhouette& thrown, int shift) {
  double sum = 0.0, square = 0.0;
  Vector2d harmonic = Vector2d::Zero();
  for (int i = 0; i < kNumDirections; ++i) {
    const int from = (i - shift + kNumDirections) % kNumDirections;
    const double difference = seen.reach[i] - thrown.reach[from];
    sum += difference;
    square += difference * difference;
    harmonic += difference * SilhouetteDirection(i);
  }
  const double n = kNumDirections;
  return std::max(0.0,
                  square / n - std::pow(sum / n, 2.0) - 2.0 * harmonic.squaredNorm() / (n * n));
}

/** Its directions counted from its own middle, so that a turn of it is a shift of the array. */
Silhouette Centre(const Silhouette& silhouette, const Vector2d& middle) {
  Silhouette result = silhouette;
  for (int i = 0; i < kNumDirections; ++i) {
    result.reach[i] -= middle.dot(SilhouetteDirection(i));
  }
  return result;
}

int CountFromZero(int shift) { return std::min(shift, kNumDirections - shift); }

/** Turns worth a closer look: the best of the local minima, each away from the better ones. */
std::vector<int> FindTurns(const std::array<double, kNumDirections>& misfit) {
  std::vector<int> minima;
  for (int i = 0; i < kNumDirections; ++i) {
    const double before = misfit[(i + kNumDirections - 1) % kNumDirections];
    const double after = misfit[(i + 1) % kNumDirections];
    if (misfit[i] <= before && misfit[i] < after) minima.push_back(i);
  }
  std::stable_sort(minima.begin(), minima.end(),
                   [&](int a, int b) { return misfit[a] < misfit[b]; });
  std::vector<int> turns;
  for (const int i : minima) {
    const bool is_new = std::all_of(turns.begin(), turns.end(), [&](int other) {
      return CountFromZero((i - other + kNumDirections) % kNumDirections) > kSameTurn;
    });
    if (is_new && turns.size() < kMaxTurns) turns.push_back(i);
  }
  if (turns.empty()) turns.push_back(0);  // all misfits are equal
  return turns;
}

/** One Gauss-Newton step of shift, turn and thickness; the turn stays where it tells nothing. */
void Improve(const Silhouette& seen, const Silhouette& thrown, OutlineFit& fit) {
  const bool turns = fit.direction != KnownDirection::kNone;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  const Vector2d middle(fit.pose.x, fit.pose.y);
  double square = 0.0;
  for (int i = 0; i < kNumDirections; ++i) {
    const Vector2d u = SilhouetteDirection(i);
    const Vector2d arm = thrown.extreme[i] - middle;
    const double sweep = turns ? arm.x() * u.y() - arm.y() * u.x() : 0.0;
    const Eigen::Vector4d row(u.x(), u.y(), sweep, 1.0);
    const double difference = seen.reach[i] - thrown.reach[i];
    normal += row * row.transpose();
    right += difference * row;
    square += difference * difference;
  }
  if (!turns) normal(2, 2) = 1.0;
  const Eigen::Vector4d change = normal.ldlt().solve(right);
  fit.pose.x += change[0];
  fit.pose.y += change[1];
  fit.pose.yaw += change[2];
  fit.thickness = change[3];
  fit.residual = std::sqrt(std::max(0.0, square - right.dot(change)) / kNumDirections);
}

bool IsAsGood(const OutlineFit& fit, const OutlineFit& best, double tolerance) {
  return fit.residual * fit.residual <= best.residual * best.residual + tolerance * tolerance;
}

const OutlineFit& FindBest(const std::vector<OutlineFit>& fits) {
  return *std::min_element(fits.begin(), fits.end(), [](const OutlineFit& a, const OutlineFit& b) {
    return a.residual < b.residual;
  });
}

double CalcAngleBetween(double yaw, double other) {
  return std::abs(std::remainder(yaw - other, 2.0 * kPi));
}

/** Of fits that are as good as the best the one nearest to `yaw`, and what the others make of it. */
OutlineFit ChooseFit(std::vector<OutlineFit> fits, double yaw, double tolerance) {
  const OutlineFit best = FindBest(fits);
  fits.erase(std::remove_if(fits.begin(), fits.end(),
                            [&](const OutlineFit& fit) { return !IsAsGood(fit, best, tolerance); }),
             fits.end());
  std::stable_sort(fits.begin(), fits.end(), [&](const OutlineFit& a, const OutlineFit& b) {
    return CalcAngleBetween(a.pose.yaw, yaw) < CalcAngleBetween(b.pose.yaw, yaw);
  });
  OutlineFit chosen = fits[0];
  constexpr double kSameAngle = kSameTurn * kDirectionStep;
  const OutlineFit* half_turned = nullptr;
  for (const OutlineFit& other : fits) {
    const double apart = CalcAngleBetween(other.pose.yaw, fits[0].pose.yaw);
    if (apart >= kPi - kSameAngle) {
      half_turned = &other;
    } else if (apart > kSameAngle) {
      chosen.direction = KnownDirection::kSeveral;
    }
  }
  if (half_turned && chosen.direction == KnownDirection::kFull) {
    chosen.direction = KnownDirection::kHalfTurns;
    chosen.pose.x = 0.5 * (fits[0].pose.x + half_turned->pose.x);
    chosen.pose.y = 0.5 * (fits[0].pose.y + half_turned->pose.y);
  }
  return chosen;
}

}  // namespace

Vector2d SilhouetteDirection(int i) {
  static const auto directions = [] {
    std::array<Vector2d, kNumDirections> all;
    for (int k = 0; k < kNumDirections; ++k) {
      all[k] = Vector2d(std::cos(kDirectionStep * k), std::sin(kDirectionStep * k));
    }
    return all;
  }();
  return directions[i];
}

std::vector<Vector2d> FindHull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Vector2d> hull;
  const auto add = [&hull](const Vector2d& p, size_t fewest) {
    while (hull.size() > fewest && CalcTurn(hull[hull.size() - 2], hull.back(), p) <= 0.0) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Vector2d& p : points) add(p, 1);
  const size_t lower = hull.size();
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  if (hull.size() > 1) hull.pop_back();  // the first point again
  return hull;
}

double CalcArea(const std::vector<Vector2d>& polygon) {
  double twice = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * std::abs(twice);
}

Silhouette MakeSilhouette(const std::vector<Vector2d>& points) {
  GRASPBENCH_DEMAND(!points.empty(), "an outline without points");
  const std::vector<Vector2d> hull = FindHull(points);
  Silhouette result;
  for (int i = 0; i < kNumDirections; ++i) {
    const Vector2d u = SilhouetteDirection(i);
    size_t farthest = 0;
    double reach = hull[0].dot(u);
    for (size_t k = 1; k < hull.size(); ++k) {
      const double other = hull[k].dot(u);
      if (other <= reach) continue;
      reach = other;
      farthest = k;
    }
    result.extreme[i] = hull[farthest];
    result.reach[i] = reach;
  }
  return result;
}

OutlineModel::OutlineModel(const TriMesh& mesh) {
  GRASPBENCH_DEMAND(!mesh.vertices.empty(), "a mesh without vertices");
  Eigen::MatrixX3d vertices(mesh.vertices.size(), 3);
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    vertices.row(static_cast<Eigen::Index>(i)) = mesh.vertices[i].transpose();
  }
  std::set<size_t> chosen;
  for (int i = 0; i < kNumHullDirections; ++i) {
    Eigen::Index farthest = 0;
    (vertices * HullDirection(i)).maxCoeff(&farthest);
    chosen.insert(static_cast<size_t>(farthest));
  }
  double lowest = mesh.vertices.front().z();
  double highest = lowest;
  for (const Vector3d& p : mesh.vertices) {
    lowest = std::min(lowest, p.z());
    highest = std::max(highest, p.z());
  }
  middle_ = -lowest;
  height_ = highest - lowest;
  for (const size_t i : chosen) points_.push_back(mesh.vertices[i]);
}

Silhouette OutlineModel::Throw(const PlanarPose& pose, const Vector3d& p_WEye) const {
  const Eigen::Rotation2Dd turn(pose.yaw);
  std::vector<Vector2d> thrown;
  thrown.reserve(points_.size());
  for (const Vector3d& p_O : points_) {
    const Vector2d p_W = turn * Vector2d(p_O.head<2>()) + Vector2d(pose.x, pose.y);
    const double scale = (p_WEye.z() - middle_) / (p_WEye.z() - middle_ - p_O.z());
    thrown.push_back(p_WEye.head<2>() + scale * (p_W - p_WEye.head<2>()));
  }
  return MakeSilhouette(thrown);
}

OutlineFit FitOutline(const Silhouette& seen, const OutlineModel& model, const Vector3d& p_WEye,
                      const PlanarPose& supposed, double tolerance) {
  const auto fit_turned = [&](double angle, KnownDirection direction) {
    OutlineFit fit;
    fit.pose = supposed;
    fit.pose.yaw += angle;
    fit.direction = direction;
    for (int i = 0; i < kNumSteps; ++i) Improve(seen, model.Throw(fit.pose, p_WEye), fit);
    return fit;
  };
  const Silhouette first = Centre(model.Throw(supposed, p_WEye), Vector2d(supposed.x, supposed.y));
  std::array<double, kNumDirections> misfit;
  for (int i = 0; i < kNumDirections; ++i) misfit[i] = CalcMisfit(seen, first, i);

  std::vector<OutlineFit> fits;
  const auto [least, most] = std::minmax_element(misfit.begin(), misfit.end());
  if (std::sqrt(*most) - std::sqrt(*least) < kSurelyNotRound) {
    for (int i = 0; i < kNumRoundTurns; ++i) {
      fits.push_back(fit_turned(2.0 * kPi * i / kNumRoundTurns, KnownDirection::kNone));
    }
    const OutlineFit& best = FindBest(fits);
    const bool is_round = std::all_of(fits.begin(), fits.end(), [&](const OutlineFit& fit) {
      return IsAsGood(fit, best, tolerance);
    });
    if (is_round) return fits[0];
    fits.clear();
  }
  for (const int shift : FindTurns(misfit)) {
    fits.push_back(
        fit_turned(std::remainder(shift * kDirectionStep, 2.0 * kPi), KnownDirection::kFull));
  }
  return ChooseFit(std::move(fits), supposed.yaw, tolerance);
}

}  // namespace graspbench
