#include "core/hand/import/shapes/fit_capsules.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int kMostCells = 100;   // along the longest side
constexpr int kFewestCells = 32;  // along the longest side
constexpr int kThinCells = 8;     // aimed at along the shortest side
constexpr int kMostSamples = 3000;
constexpr int kIterations = 15;
constexpr double kMostBeside = 0.1;  // share of the mesh's diagonal, beyond its box

enum Cell : uint8_t { kUnknown, kSurface, kOutside };

struct Sample {
  Vector3d p;
  int cell = 0;
};

/** The solid on a grid, and points of its outer surface. */
struct Solid {
  std::vector<Vector3d> cells;  // centres
  std::vector<double> weights;  // 1, or 1/2 on the surface
  std::vector<Sample> samples;  // `cell` an index into cells
  double cell_size = 0.0;
  Eigen::AlignedBox3d box;  // of the mesh
};

class Voxels {
 public:
  explicit Voxels(const TriMesh& mesh) {
    for (const Eigen::Vector3i& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) box_.extend(mesh.vertices[t[k]]);
    }
    const Vector3d extent = box_.sizes();
    const double longest = std::max(extent.maxCoeff(), 1e-6);
    size_ =
        std::clamp(extent.minCoeff() / kThinCells, longest / kMostCells, longest / kFewestCells);
    lower_ = box_.min() - Vector3d::Constant(1.5 * size_);
    for (int k = 0; k < 3; ++k) num_[k] = static_cast<int>(extent[k] / size_) + 4;
    kind_.assign(static_cast<size_t>(num_.cast<int64_t>().prod()), kUnknown);
  }

  void MarkSurface(const TriMesh& mesh) {
    for (const Eigen::Vector3i& t : mesh.triangles) {
      const Vector3d a = mesh.vertices[t[0]], u = mesh.vertices[t[1]] - a,
                     v = mesh.vertices[t[2]] - a;
      const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
      const int n = std::max(1, static_cast<int>(std::ceil(longest / (0.5 * size_))));
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j + i < n; ++j) {
          // Centres of the small triangles that are upright, so that none lies on an edge.
          const Vector3d p = a + ((i + 1.0 / 3.0) / n) * u + ((j + 1.0 / 3.0) / n) * v;
          const int cell = Find(p);
          kind_[static_cast<size_t>(cell)] = kSurface;
          if (surface_.empty() || (p - surface_.back().p).norm() > 0.25 * size_) {
            surface_.push_back({p, cell});
          }
        }
      }
    }
  }

  void Flood() {
    std::vector<int> open = {0};
    kind_[0] = kOutside;
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      ForNeighbours(cell, false, [&](int other) {
        if (kind_[static_cast<size_t>(other)] != kUnknown) return;
        kind_[static_cast<size_t>(other)] = kOutside;
        open.push_back(other);
      });
    }
  }

  Solid MakeSolid() const {
    Solid solid;
    solid.cell_size = size_;
    solid.box = box_;
    std::vector<int> index(kind_.size(), -1);
    for (size_t i = 0; i < kind_.size(); ++i) {
      if (kind_[i] == kOutside) continue;
      index[i] = static_cast<int>(solid.cells.size());
      solid.cells.push_back(Centre(static_cast<int>(i)));
      solid.weights.push_back(kind_[i] == kSurface ? 0.5 : 1.0);
    }
    std::vector<Sample> outer;
    for (const Sample& sample : surface_) {
      bool is_outer = false;
      ForNeighbours(sample.cell, true,
                    [&](int other) { is_outer |= kind_[static_cast<size_t>(other)] == kOutside; });
      if (is_outer) outer.push_back({sample.p, index[static_cast<size_t>(sample.cell)]});
    }
    const size_t stride = outer.size() / kMostSamples + 1;
    for (size_t i = 0; i < outer.size(); i += stride) solid.samples.push_back(outer[i]);
    return solid;
  }

 private:
  int Find(const Vector3d& p) const {
    const Vector3i at = ((p - lower_) / size_).cast<int>();
    return at.x() + num_.x() * (at.y() + num_.y() * at.z());
  }
  Vector3d Centre(int cell) const {
    const Vector3i at(cell % num_.x(), cell / num_.x() % num_.y(), cell / (num_.x() * num_.y()));
    return lower_ + size_ * (at.cast<double>() + Vector3d::Constant(0.5));
  }
  template <class Visit>
  void ForNeighbours(int cell, bool diagonal, Visit&& visit) const {
    const Vector3i at(cell % num_.x(), cell / num_.x() % num_.y(), cell / (num_.x() * num_.y()));
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const int steps = std::abs(x) + std::abs(y) + std::abs(z);
          if (steps == 0 || (steps > 1 && !diagonal)) continue;
          const Vector3i to = at + Vector3i(x, y, z);
          if (to.minCoeff() < 0 || (to.array() >= num_.array()).any()) continue;
          visit(to.x() + num_.x() * (to.y() + num_.y() * to.z()));
        }
      }
    }
  }

  Eigen::AlignedBox3d box_;
  double size_ = 0.0;
  Vector3d lower_ = Vector3d::Zero();
  Vector3i num_ = Vector3i::Zero();
  std::vector<uint8_t> kind_;
  std::vector<Sample> surface_;
};

struct Nearness {
  double t = 0.0;         // position on the axis, 0 at A
  double distance = 0.0;  // from the axis
  Vector3d away = Vector3d::Zero();
};
Nearness CalcNearness(const FittedCapsule& capsule, const Vector3d& p) {
  const Vector3d axis = capsule.p_B - capsule.p_A;
  Nearness nearness;
  const double square = axis.squaredNorm();
  if (square > 0.0) {
    nearness.t = std::clamp((p - capsule.p_A).dot(axis) / square, 0.0, 1.0);
  }
  const Vector3d to_p = p - capsule.p_A - nearness.t * axis;
  nearness.distance = to_p.norm();
  if (nearness.distance > 0.0) nearness.away = to_p / nearness.distance;
  return nearness;
}
double CalcGap(const FittedCapsule& capsule, const Vector3d& p) {
  return CalcNearness(capsule, p).distance - capsule.radius;
}

/** A part of the solid, with its capsule. */
struct Piece {
  std::vector<int> cells, samples;
  FittedCapsule capsule;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns, the longest first
  Vector3d middle = Vector3d::Zero();
  double squares = 0.0;  // sum of the samples' squared errors
};

/** Error of a sample: for the piece's own, the gap in both directions; for another's, only the part
by which the capsule protrudes. */
double CalcError(const FittedCapsule& capsule, const Vector3d& p, bool is_own) {
  const double gap = CalcGap(capsule, p);
  return is_own ? gap : std::min(gap, 0.0);
}
double CalcSquares(const Solid& solid, const std::vector<bool>& is_own,
                   const FittedCapsule& capsule) {
  double squares = 0.0;
  for (size_t s = 0; s < solid.samples.size(); ++s) {
    squares += std::pow(CalcError(capsule, solid.samples[s].p, is_own[s]), 2);
  }
  return squares;
}

/** Gauss-Newton with Levenberg's damping on A, B and r; r stays within (0, most_radius]. */
void Refine(const Solid& solid, const std::vector<bool>& is_own, double most_radius,
            FittedCapsule& capsule) {
  double squares = CalcSquares(solid, is_own, capsule), damping = 1e-3;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::Matrix<double, 7, 7> H = Eigen::Matrix<double, 7, 7>::Zero();
    Eigen::Matrix<double, 7, 1> g = Eigen::Matrix<double, 7, 1>::Zero();
    double num_counted = 1.0;
    for (size_t s = 0; s < solid.samples.size(); ++s) {
      const Nearness near = CalcNearness(capsule, solid.samples[s].p);
      const double gap = near.distance - capsule.radius;
      if (!is_own[s] && gap >= 0.0) continue;
      Eigen::Matrix<double, 7, 1> J;
      J << -(1.0 - near.t) * near.away, -near.t * near.away, -1.0;
      H += J * J.transpose();
      g += J * gap;
      num_counted += 1.0;
    }
    H.diagonal().array() += damping * num_counted;
    const Eigen::Matrix<double, 7, 1> step = H.ldlt().solve(-g);
    FittedCapsule next = capsule;
    next.p_A += step.head<3>();
    next.p_B += step.segment<3>(3);
    next.radius = std::clamp(next.radius + step[6], 0.5 * solid.cell_size, most_radius);
    const double next_squares = CalcSquares(solid, is_own, next);
    if (next_squares < squares) {
      const bool is_done = next_squares > 0.999 * squares;
      capsule = next;
      squares = next_squares;
      damping *= 0.3;
      if (is_done) return;
    } else {
      damping *= 10.0;
    }
  }
}

/** By least squares alone, a capsule may extend far through the opening of a bent piece. */
bool IsNearBox(const Solid& solid, const FittedCapsule& capsule) {
  const double beside = kMostBeside * solid.box.diagonal().norm();
  const auto reaches = [&](const Vector3d& end) {
    const Eigen::Array3d out = (solid.box.min() - end).cwiseMax(end - solid.box.max()).array();
    return out.maxCoeff() + capsule.radius;
  };
  return std::max(reaches(capsule.p_A), reaches(capsule.p_B)) <= beside;
}

void FitPiece(const Solid& solid, Piece& piece) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double weight = 0.0;
  piece.middle.setZero();
  for (int c : piece.cells) {
    piece.middle += solid.weights[c] * solid.cells[c];
    weight += solid.weights[c];
  }
  piece.middle /= weight;
  for (int c : piece.cells) {
    const Vector3d d = solid.cells[c] - piece.middle;
    spread += solid.weights[c] * d * d.transpose();
  }
  piece.axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().rowwise().reverse();
  Vector3d lower = Vector3d::Zero(), upper = Vector3d::Zero();
  for (int c : piece.cells) {
    const Vector3d d = piece.axes.transpose() * (solid.cells[c] - piece.middle);
    lower = lower.cwiseMin(d);
    upper = upper.cwiseMax(d);
  }
  const Vector3d half = (0.5 * (upper - lower)).cwiseMax(0.5 * solid.cell_size);
  const double radius = half[2];
  // An end on the surface is round; one where the solid was cut extends to the cut.
  std::array<int, 2> num_caps = {0, 0};
  for (int s : piece.samples) {
    const Vector3d d = piece.axes.transpose() * (solid.samples[s].p - piece.middle);
    if (std::hypot(d[1], d[2]) > 0.6 * radius) continue;
    num_caps[0] += d[0] < lower[0] + 2.0 * solid.cell_size;
    num_caps[1] += d[0] > upper[0] - 2.0 * solid.cell_size;
  }
  const double from = std::min(0.0, lower[0] + (num_caps[0] > 0 ? radius : 0.0));
  const double to = std::max(0.0, upper[0] - (num_caps[1] > 0 ? radius : 0.0));
  piece.capsule = {piece.middle + from * piece.axes.col(0), piece.middle + to * piece.axes.col(0),
                   radius};
  std::vector<bool> is_own(solid.samples.size(), false);
  for (int s : piece.samples) is_own[static_cast<size_t>(s)] = true;
  const FittedCapsule start = piece.capsule;
  Refine(solid, is_own, std::max(1.5 * half[1], solid.cell_size), piece.capsule);
  if (!IsNearBox(solid, piece.capsule)) piece.capsule = start;
  piece.squares = CalcSquares(solid, is_own, piece.capsule);
}

/** Splits a piece; one half has no cells if the piece cannot be cut. */
std::array<Piece, 2> Cut(const Solid& solid, const Piece& piece, int axis) {
  std::array<Piece, 2> halves;
  const Vector3d normal = piece.axes.col(axis);
  const auto side = [&](int c) {
    return (solid.cells[c] - piece.middle).dot(normal) > 0.0 ? 1 : 0;
  };
  for (int c : piece.cells) halves[side(c)].cells.push_back(c);
  for (int s : piece.samples) halves[side(solid.samples[s].cell)].samples.push_back(s);
  for (Piece& half : halves) {
    if (!half.cells.empty()) FitPiece(solid, half);
  }
  return halves;
}

void MeasureFit(const Solid& solid, CapsuleFit& fit) {
  std::vector<double> errors;
  double squares = 0.0;
  for (const Sample& sample : solid.samples) {
    double gap = CalcGap(fit.capsules.front(), sample.p);
    for (const FittedCapsule& capsule : fit.capsules) {
      gap = std::min(gap, CalcGap(capsule, sample.p));
    }
    errors.push_back(std::abs(gap));
    squares += gap * gap;
  }
  if (errors.empty()) return;
  fit.rms_error = std::sqrt(squares / static_cast<double>(errors.size()));
  const auto twentieth = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 19 / 20);
  std::nth_element(errors.begin(), twentieth, errors.end());
  fit.largest_error = *twentieth;
}

}  // namespace

CapsuleFit FitCapsules(const TriMesh& mesh, double tolerance, int most_capsules) {
  Voxels voxels(mesh);
  voxels.MarkSurface(mesh);
  voxels.Flood();
  const Solid solid = voxels.MakeSolid();
  std::vector<Piece> pieces(1);
  for (size_t c = 0; c < solid.cells.size(); ++c) pieces[0].cells.push_back(static_cast<int>(c));
  for (size_t s = 0; s < solid.samples.size(); ++s) {
    pieces[0].samples.push_back(static_cast<int>(s));
  }
  FitPiece(solid, pieces[0]);
  CapsuleFit fit;
  for (;;) {
    fit.capsules.clear();
    for (const Piece& piece : pieces) fit.capsules.push_back(piece.capsule);
    MeasureFit(solid, fit);
    if (fit.largest_error <= tolerance || static_cast<int>(pieces.size()) >= most_capsules) break;
    const auto worst =
        std::max_element(pieces.begin(), pieces.end(),
                         [](const Piece& a, const Piece& b) { return a.squares < b.squares; });
    std::array<Piece, 2> best;
    double least = worst->squares;
    for (int axis = 0; axis < 3; ++axis) {
      std::array<Piece, 2> halves = Cut(solid, *worst, axis);
      const double squares = halves[0].squares + halves[1].squares;
      if (halves[0].cells.empty() || halves[1].cells.empty() || squares >= least) continue;
      least = squares;
      best = std::move(halves);
    }
    if (best[0].cells.empty()) {
      worst->squares = 0.0;  // no cut improves it
      const bool is_any_left =
          std::any_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.squares > 0.0; });
      if (!is_any_left) break;
      continue;
    }
    *worst = std::move(best[0]);
    pieces.push_back(std::move(best[1]));
  }
  for (FittedCapsule& capsule : fit.capsules) {
    if ((capsule.p_B - capsule.p_A).norm() > 0.1 * capsule.radius) continue;
    capsule.p_A = capsule.p_B = 0.5 * (capsule.p_A + capsule.p_B);  // a ball
  }
  return fit;
}

CollisionShape MakeCapsuleShape(const FittedCapsule& capsule) {
  CollisionShape shape;
  const Vector3d axis = capsule.p_B - capsule.p_A;
  shape.X_LS.translation() = 0.5 * (capsule.p_A + capsule.p_B);
  shape.size.setConstant(2.0 * capsule.radius);
  if (axis.norm() == 0.0) return shape;
  shape.kind = CollisionShape::Kind::kCylinder;
  shape.size.z() += axis.norm();
  shape.X_LS.linear() =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix();
  return shape;
}

}  // namespace graspbench
