#include "core/shape/triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace graspbench {
namespace {

constexpr int kLeafSize = 8;
constexpr int kMaxDepth = 64;  // halving reaches any mesh that fits into memory

// Eigen's squaredExteriorDistance branches on every side and takes twice as long.
double CalcSquaredDistance(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& p) {
  return (box.min() - p).cwiseMax(p - box.max()).cwiseMax(0.0).squaredNorm();
}

}  // namespace

TriangleTree::TriangleTree(const TriMesh& mesh)
    : order_(mesh.triangles.size()), slot_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Eigen::Vector3d> centres;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    corners_.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    const Corners& k = corners_.back();
    centres.push_back((k.a + k.b + k.c) / 3.0);
  }
  nodes_.reserve(mesh.triangles.size());
  nodes_.emplace_back();
  Split(0, 0, static_cast<int>(order_.size()), centres);

  std::vector<Corners> sorted;
  for (size_t i = 0; i < order_.size(); ++i) {
    sorted.push_back(corners_[order_[i]]);
    slot_[order_[i]] = static_cast<int>(i);
  }
  corners_ = std::move(sorted);
}

void TriangleTree::Split(int node, int begin, int end,
                         const std::vector<Eigen::Vector3d>& centres) {
  Eigen::AlignedBox3d box, centre_box;
  for (int i = begin; i < end; ++i) {
    const Corners& k = corners_[order_[i]];
    box.extend(k.a).extend(k.b).extend(k.c);
    centre_box.extend(centres[order_[i]]);
  }
  nodes_[node].box = box;
  if (end - begin <= kLeafSize) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  Eigen::Index axis = 0;
  centre_box.sizes().maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int i, int j) {
                     const double x = centres[i][axis], y = centres[j][axis];
                     return x != y ? x < y : i < j;
                   });
  const int children = static_cast<int>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children;
  Split(children, begin, middle, centres);
  Split(children + 1, middle, end, centres);
}

// Tests the seven regions of a triangle (Ericson, Real-Time Collision Detection, 2005, section
// 5.1.5).
TriangleTree::Nearest TriangleTree::FindNearestOn(const Corners& t, const Eigen::Vector3d& p) {
  const auto at = [&](const Eigen::Vector3d& point, Feature feature) {
    return Nearest{-1, feature, point, (p - point).squaredNorm()};
  };
  const Eigen::Vector3d ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return at(t.a, Feature::kVertex0);
  const Eigen::Vector3d bp = p - t.b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return at(t.b, Feature::kVertex1);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    return at(t.a + d1 / (d1 - d3) * ab, Feature::kEdge01);
  }
  const Eigen::Vector3d cp = p - t.c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return at(t.c, Feature::kVertex2);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    return at(t.a + d2 / (d2 - d6) * ac, Feature::kEdge20);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return at(t.b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t.c - t.b), Feature::kEdge12);
  }
  const double scale = 1.0 / (va + vb + vc);
  return at(t.a + vb * scale * ab + vc * scale * ac, Feature::kFace);
}

TriangleTree::Nearest TriangleTree::FindNearest(const Eigen::Vector3d& p, int hint) const {
  Nearest nearest = FindNearestOn(corners_[slot_[hint]], p);
  nearest.triangle = hint;

  struct Pending {
    int node;
    double squared_distance;
  };
  Pending stack[kMaxDepth];
  int depth = 0;
  stack[depth++] = {0, CalcSquaredDistance(nodes_[0].box, p)};
  while (depth > 0) {
    const Pending pending = stack[--depth];
    if (pending.squared_distance >= nearest.squared_distance) continue;
    const Node& node = nodes_[pending.node];
    if (node.count > 0) {
      for (int i = node.first; i < node.first + node.count; ++i) {
        const Nearest candidate = FindNearestOn(corners_[i], p);
        if (candidate.squared_distance < nearest.squared_distance) {
          nearest = candidate;
          nearest.triangle = order_[i];
        }
      }
      continue;
    }
    Pending near{node.first, CalcSquaredDistance(nodes_[node.first].box, p)};
    Pending far{node.first + 1, CalcSquaredDistance(nodes_[node.first + 1].box, p)};
    if (far.squared_distance < near.squared_distance) std::swap(near, far);
    if (far.squared_distance < nearest.squared_distance) stack[depth++] = far;
    if (near.squared_distance < nearest.squared_distance) stack[depth++] = near;
  }
  return nearest;
}

void TriangleTree::FindNear(const Eigen::AlignedBox3d& box, std::vector<int>& triangles) const {
  std::vector<int> stack = {0};
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    if (!node.box.intersects(box)) continue;
    if (node.count == 0) {
      stack.push_back(node.first + 1);
      stack.push_back(node.first);
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      const Eigen::AlignedBox3d triangle_box =
          Eigen::AlignedBox3d(corners_[i].a).extend(corners_[i].b).extend(corners_[i].c);
      if (triangle_box.intersects(box)) triangles.push_back(order_[i]);
    }
  }
}

}  // namespace graspbench
