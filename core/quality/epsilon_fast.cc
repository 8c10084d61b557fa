#include "core/quality/epsilon_fast.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/quality/wrench_space.h"

namespace graspbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** A simplicial polytope of some of the points, grown point by point (beneath and beyond). */
template <int kDim>
class ExpandingPolytope {
 public:
  using Vector = Eigen::Matrix<double, kDim, 1>;
  using Points = Eigen::Matrix<double, kDim, Eigen::Dynamic>;

  /** `simplex`: kDim + 1 affinely independent points. Points within `tolerance` of a plane count as
  on it. */
  ExpandingPolytope(const Points& points, const std::vector<int>& simplex, double tolerance)
      : points_(points), tolerance_(tolerance) {
    // Row k of the inverse holds the affine function that is 1 at vertex k and 0 at the others;
    // it falls towards the outside of the facet opposite to k.
    Eigen::Matrix<double, kDim + 1, kDim + 1> corners;
    for (int k = 0; k <= kDim; ++k) corners.col(k) << points.col(simplex[k]), 1.0;
    const Eigen::Matrix<double, kDim + 1, kDim + 1> functions = corners.fullPivLu().inverse();
    facets_.resize(kDim + 1);
    for (int k = 0; k <= kDim; ++k) {
      Facet& facet = facets_[k];
      const Vector slope = functions.row(k).template head<kDim>().transpose();
      facet.normal = -slope.normalized();
      facet.offset = functions(k, kDim) / slope.norm();
      for (int slot = 0; slot < kDim; ++slot) {
        // The vertices in order without k; the neighbour across a slot lacks that vertex, and our
        // vertex k takes this facet's place there.
        const int other = slot < k ? slot : slot + 1;
        facet.vertices[slot] = simplex[other];
        facet.neighbours[slot] = {other, k < other ? k : k - 1};
      }
    }
  }

  /** The facet nearest to the origin; -1 if rounding has left none. */
  int FindNearestFacet() const {
    int nearest = -1;
    for (size_t i = 0; i < facets_.size(); ++i) {
      if (!facets_[i].is_removed && std::isfinite(facets_[i].offset) &&
          (nearest < 0 || facets_[i].offset < facets_[nearest].offset)) {
        nearest = static_cast<int>(i);
      }
    }
    return nearest;
  }
  const Vector& normal(int facet) const { return facets_[facet].normal; }
  double offset(int facet) const { return facets_[facet].offset; }

  /** Adds a point that lies beyond the facet `start`. */
  void AddPoint(int point, int start) {
    FindHorizon(point, start);
    fresh_.clear();
    for (const Side& ridge : horizon_) fresh_.push_back(MakeFacet(point, ridge));
    for (size_t i = 0; i < horizon_.size(); ++i) LinkFacet(fresh_[i], horizon_[i]);
    for (const int facet : visible_) {
      facets_[facet].is_removed = true;
      free_.push_back(facet);
    }
  }

 private:
  /** One side of a facet: the ridge opposite to the vertex in `slot`. */
  struct Side {
    int facet = -1;
    int slot = -1;
  };
  struct Facet {
    Vector normal;
    double offset = 0.0;
    std::array<int, kDim> vertices;
    std::array<Side, kDim> neighbours;  // the same ridge as seen from the facet behind it
    int visit = 0;                      // number of the last AddPoint that looked at this facet
    bool is_visible = false;            // and what it saw
    bool is_removed = false;
  };

  double CalcHeight(const Facet& facet, int point) const {
    return facet.normal.dot(points_.col(point)) - facet.offset;
  }

  /** Facets the point sees, connected to `start`, and the ridges (their inner sides) around them.
   */
  void FindHorizon(int point, int start) {
    ++num_visits_;
    visible_.assign(1, start);
    horizon_.clear();
    facets_[start].visit = num_visits_;
    facets_[start].is_visible = true;
    for (size_t i = 0; i < visible_.size(); ++i) {
      for (int slot = 0; slot < kDim; ++slot) {
        const int behind = facets_[visible_[i]].neighbours[slot].facet;
        Facet& facet = facets_[behind];
        if (facet.visit != num_visits_) {
          facet.visit = num_visits_;
          facet.is_visible = CalcHeight(facet, point) > tolerance_;
          if (facet.is_visible) visible_.push_back(behind);
        }
        if (!facet.is_visible) horizon_.push_back({visible_[i], slot});
      }
    }
  }

  /** The facet from a horizon ridge to the point. Its plane is the combination of the visible and
  the hidden plane that vanishes at the point; both weights are >= 0, so nothing cancels, and a
  point in the hidden plane continues that plane exactly. */
  int MakeFacet(int point, const Side& ridge) {
    int index = static_cast<int>(facets_.size());
    if (free_.empty()) {
      facets_.emplace_back();
    } else {
      index = free_.back();
      free_.pop_back();
    }
    Facet& visible = facets_[ridge.facet];
    const Side outside = visible.neighbours[ridge.slot];
    Facet& hidden = facets_[outside.facet];
    Facet& facet = facets_[index];
    const double above = CalcHeight(visible, point);
    const double below = std::max(0.0, -CalcHeight(hidden, point));
    const Vector normal = above * hidden.normal + below * visible.normal;
    const double length = normal.norm();
    facet.normal = normal / length;
    facet.offset = (above * hidden.offset + below * visible.offset) / length;
    facet.vertices = visible.vertices;
    facet.vertices[ridge.slot] = point;
    facet.neighbours.fill({});
    facet.neighbours[ridge.slot] = outside;
    facet.visit = 0;
    facet.is_removed = false;
    hidden.neighbours[outside.slot] = {index, ridge.slot};
    visible.neighbours[ridge.slot] = {~index, ridge.slot};  // the way out, for LinkFacet
    return index;
  }

  /** Joins a new facet to the other new ones: across each side that holds the point, turn through
  the visible facets around the subridge until the horizon is met again. */
  void LinkFacet(int index, const Side& ridge) {
    for (int slot = 0; slot < kDim; ++slot) {
      if (slot == ridge.slot || facets_[index].neighbours[slot].facet >= 0) continue;
      int at = ridge.facet, leave = slot;
      int pivot = facets_[at].vertices[ridge.slot];  // outside the ridge by which we came
      while (facets_[at].neighbours[leave].facet >= 0) {
        const Side next = facets_[at].neighbours[leave];
        leave = FindSlot(facets_[next.facet], pivot);
        pivot = facets_[next.facet].vertices[next.slot];
        at = next.facet;
      }
      const int other = ~facets_[at].neighbours[leave].facet;
      const int other_slot = FindSlot(facets_[other], pivot);
      facets_[index].neighbours[slot] = {other, other_slot};
      facets_[other].neighbours[other_slot] = {index, slot};
    }
  }

  static int FindSlot(const Facet& facet, int vertex) {
    const auto found = std::find(facet.vertices.begin(), facet.vertices.end(), vertex);
    GRASPBENCH_DEMAND(found != facet.vertices.end(), "vertex: " + std::to_string(vertex));
    return static_cast<int>(found - facet.vertices.begin());
  }

  const Points& points_;
  double tolerance_;
  std::vector<Facet> facets_;
  std::vector<int> free_, visible_, fresh_;  // indices of facets
  std::vector<Side> horizon_;
  int num_visits_ = 0;
};

template <int kDim>
EpsilonBounds CalcBounds(const Eigen::Matrix<double, kDim, Eigen::Dynamic>& points) {
  EpsilonBounds bounds;
  const std::vector<int> simplex = FindAffineBasis(points);
  if (simplex.size() <= kDim) return bounds;
  const double scale = std::sqrt(points.colwise().squaredNorm().maxCoeff());
  constexpr double kRounding = 1e-12;
  ExpandingPolytope<kDim> polytope(points, simplex, kRounding * scale);

  std::vector<bool> is_vertex(points.cols(), false);
  for (const int vertex : simplex) is_vertex[vertex] = true;
  bounds.lower = -kInfinity;
  bounds.upper = kInfinity;
  for (;;) {
    const int nearest = polytope.FindNearestFacet();
    if (nearest < 0) break;
    bounds.lower = std::max(bounds.lower, polytope.offset(nearest));
    Eigen::Index farthest = 0;
    const double height = (polytope.normal(nearest).transpose() * points).maxCoeff(&farthest);
    if (height < bounds.upper) {
      bounds.upper = height;
      bounds.weakest_direction = polytope.normal(nearest);
    }
    if (bounds.upper <= kNegligibleShare * scale) break;
    // A vertex that seems to lie beyond a facet does so by rounding alone.
    if (height - polytope.offset(nearest) <= kRounding * scale || is_vertex[farthest]) break;
    is_vertex[farthest] = true;
    polytope.AddPoint(static_cast<int>(farthest), nearest);
  }
  if (bounds.upper <= kNegligibleShare * scale) bounds.lower = bounds.upper = 0.0;
  bounds.lower = std::clamp(bounds.lower, 0.0, bounds.upper);
  return bounds;
}

}  // namespace

EpsilonBounds CalcEpsilonBounds(const Eigen::MatrixXd& points) {
  GRASPBENCH_DEMAND(points.rows() == 3 || points.rows() == 6,
                    "dimensions: " + std::to_string(points.rows()));
  return points.rows() == 3 ? CalcBounds<3>(points) : CalcBounds<6>(points);
}

}  // namespace graspbench
