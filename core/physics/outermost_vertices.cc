#include "core/physics/outermost_vertices.h"

#include <algorithm>

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

}  // namespace graspbench
