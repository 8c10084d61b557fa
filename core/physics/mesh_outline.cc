#include "core/physics/mesh_outline.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr size_t kBlockSize = 32;

struct VertexBlock {
  size_t begin, end;
  Vector3d lower, upper;
};

std::vector<VertexBlock> MakeBlocks(const std::vector<Vector3d>& vertices) {
  std::vector<VertexBlock> blocks;
  for (size_t begin = 0; begin < vertices.size(); begin += kBlockSize) {
    VertexBlock block = {begin, std::min(begin + kBlockSize, vertices.size()), vertices[begin],
                         vertices[begin]};
    for (size_t i = block.begin; i < block.end; ++i) {
      block.lower = block.lower.cwiseMin(vertices[i]);
      block.upper = block.upper.cwiseMax(vertices[i]);
    }
    blocks.push_back(block);
  }
  return blocks;
}

constexpr double kLeastTurn = RadFromDeg(0.4);  ///< turn from one side of a ring to the next
constexpr double kMostTurn = RadFromDeg(19.0);
constexpr double kMostOfATurn = RadFromDeg(300.0);
/** Tolerance of a ring's sides, turns, and distances of vertices from the centre. */
constexpr double kSameShare = 0.01;
/** Tolerance between the planes through three successive vertices of a ring. */
const double kSamePlane = std::cos(RadFromDeg(3.0));
/** Circles whose axes differ by less have a common axis. */
const double kSameAxis = std::cos(RadFromDeg(1.0));
constexpr double kSameLine = 0.02;  ///< distance of axes, as a share of the radius
/** Only an axis with at least this share of the outermost vertices about it counts. */
constexpr double kAxisShare = 0.1;

std::vector<std::vector<size_t>> FindNeighbours(const TriMesh& mesh) {
  std::vector<std::set<size_t>> sets(mesh.vertices.size());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const auto a = static_cast<size_t>(t[k]), b = static_cast<size_t>(t[(k + 1) % 3]);
      sets[a].insert(b);
      sets[b].insert(a);
    }
  }
  std::vector<std::vector<size_t>> neighbours;
  for (const std::set<size_t>& set : sets) neighbours.emplace_back(set.begin(), set.end());
  return neighbours;
}

class RingWalker {
 public:
  RingWalker(const TriMesh& mesh, const std::vector<bool>& outermost)
      : vertices_(mesh.vertices), outermost_(outermost), neighbours_(FindNeighbours(mesh)) {}

  /** Returns the ring that continues from a to b, each vertex once; empty when there is none. */
  std::vector<size_t> Walk(size_t a, size_t b) const {
    std::vector<size_t> ring = {a, b};
    std::optional<Corner> first;
    double turned = 0.0;
    while (ring.size() <= vertices_.size()) {
      const std::optional<Corner> corner = GoOn(ring[ring.size() - 2], ring.back(), first);
      if (!corner) break;
      if (!first) first = corner;
      turned += corner->turn;
      if (corner->next == a) return turned > kMostOfATurn ? ring : std::vector<size_t>();
      if (turned > 2.0 * kPi) return {};  // a helix
      ring.push_back(corner->next);
    }
    return turned > kMostOfATurn ? ring : std::vector<size_t>();
  }

  const std::vector<size_t>& neighbours(size_t vertex) const { return neighbours_[vertex]; }

 private:
  struct Corner {
    size_t next;
    double turn;
    Vector3d normal;
  };

  std::optional<Corner> GoOn(size_t a, size_t b, const std::optional<Corner>& first) const {
    const Vector3d side = vertices_[b] - vertices_[a];
    const double length = side.norm();
    std::optional<Corner> best;
    double least = kMostTurn;
    for (const size_t c : neighbours_[b]) {
      if (c == a || !outermost_[c]) continue;
      const Vector3d next = vertices_[c] - vertices_[b];
      if (std::abs(next.norm() - length) > kSameShare * length) continue;
      const Vector3d cross = side.cross(next);
      const double turn = std::atan2(cross.norm(), side.dot(next));
      if (turn < kLeastTurn || turn > kMostTurn) continue;
      const Vector3d normal = cross.normalized();
      // The side lengths of fine rings are more accurate than their turns.
      if (first && (normal.dot(first->normal) < kSamePlane ||
                    std::abs(turn - first->turn) > 0.1 * first->turn)) {
        continue;
      }
      if (turn < least) {
        least = turn;
        best = Corner{c, turn, normal};
      }
    }
    return best;
  }

  const std::vector<Vector3d>& vertices_;
  const std::vector<bool>& outermost_;
  std::vector<std::vector<size_t>> neighbours_;
};

/** Fits a circle; returns nothing when the ring is not one. */
std::optional<RimCircle> FitCircle(const TriMesh& mesh, const std::vector<size_t>& ring) {
  RimCircle circle{Vector3d::Zero(), Vector3d::Zero(), 0.0, ring};
  for (const size_t i : ring) {
    circle.p_OCentre += mesh.vertices[i] / static_cast<double>(ring.size());
  }
  for (size_t k = 0; k < ring.size(); ++k) {
    const Vector3d a = mesh.vertices[ring[k]] - circle.p_OCentre;
    circle.axis_O += a.cross(mesh.vertices[ring[(k + 1) % ring.size()]] - circle.p_OCentre);
    circle.radius += a.norm() / static_cast<double>(ring.size());
  }
  circle.axis_O.normalize();
  for (const size_t i : ring) {
    const Vector3d a = mesh.vertices[i] - circle.p_OCentre;
    const double off = std::hypot(a.norm() - circle.radius, a.dot(circle.axis_O));
    if (!(off < kSameShare * circle.radius)) return std::nullopt;
  }
  return circle;
}

bool HaveOneAxis(const RimCircle& a, const RimCircle& b) {
  if (std::abs(a.axis_O.dot(b.axis_O)) < kSameAxis) return false;
  return (b.p_OCentre - a.p_OCentre).cross(a.axis_O).norm() <
         kSameLine * std::max(a.radius, b.radius);
}

}  // namespace

std::vector<size_t> FindOutermostVertices(const std::vector<Vector3d>& vertices,
                                          const std::vector<Vector3d>& directions, size_t stride) {
  const std::vector<VertexBlock> blocks = MakeBlocks(vertices);
  std::vector<size_t> outermost;
  outermost.reserve(directions.size());
  for (const Vector3d& direction : directions) {
    const size_t k = outermost.size();
    size_t best = k < stride ? 0 : outermost[k - stride];
    double most = direction.dot(vertices[best]);
    for (const VertexBlock& block : blocks) {
      const Vector3d corner = (direction.array() > 0.0).select(block.upper, block.lower);
      if (direction.dot(corner) < most) continue;
      for (size_t i = block.begin; i < block.end; ++i) {
        const double extent = direction.dot(vertices[i]);
        if (extent < most || (extent == most && i >= best)) continue;
        most = extent;
        best = i;
      }
    }
    outermost.push_back(best);
  }
  return outermost;
}

std::vector<RimCircle> FindRimCircles(const TriMesh& mesh, const std::vector<bool>& outermost) {
  const RingWalker walker(mesh, outermost);
  std::vector<RimCircle> circles;
  std::set<std::pair<size_t, size_t>> walked;  // sides of rings already found
  for (size_t a = 0; a < mesh.vertices.size(); ++a) {
    if (!outermost[a]) continue;
    for (const size_t b : walker.neighbours(a)) {
      if (!outermost[b] || walked.count({a, b}) > 0) continue;
      const std::vector<size_t> ring = walker.Walk(a, b);
      if (ring.empty()) continue;
      for (size_t k = 0; k < ring.size(); ++k) {
        const size_t next = ring[(k + 1) % ring.size()];
        walked.insert({ring[k], next});
        walked.insert({next, ring[k]});
      }
      if (std::optional<RimCircle> circle = FitCircle(mesh, ring)) circles.push_back(*circle);
    }
  }
  const auto num_outermost = std::count(outermost.begin(), outermost.end(), true);
  std::vector<RimCircle> kept;
  for (const RimCircle& circle : circles) {
    size_t about_axis = 0;
    for (const RimCircle& other : circles) {
      if (HaveOneAxis(circle, other)) about_axis += other.vertices.size();
    }
    if (static_cast<double>(about_axis) >= kAxisShare * static_cast<double>(num_outermost)) {
      kept.push_back(circle);
    }
  }
  return kept;
}

}  // namespace graspbench
