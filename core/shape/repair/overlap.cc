#include "core/shape/repair/overlap.h"

#include <Eigen/Geometry>
#include <cstdint>

#include "core/shape/line_crossings.h"

namespace graspbench {
namespace {

constexpr int64_t kNumLines = 317811, kStride = 196418;  // neighbours in Fibonacci's sequence

}  // namespace

Overlap CalcOverlap(const TriMesh& mesh) {
  Overlap overlap;
  if (mesh.triangles.empty()) return overlap;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  const Eigen::Vector3d p_MR = mesh.vertices[mesh.triangles.front()[0]];
  const LineCrossings lines(mesh, 2);
  const Eigen::Vector3d sizes = box.sizes();
  const double area = sizes.x() * sizes.y() / kNumLines;  // of the box, that one line stands for
  std::vector<LineCrossings::Crossing> crossings;
  for (int64_t i = 0; i < kNumLines; ++i) {
    const double x = box.min().x() + (i + 0.5) / kNumLines * sizes.x();
    const double y = box.min().y() + (i * kStride % kNumLines + 0.5) / kNumLines * sizes.y();
    lines.Find(x, y, crossings);
    int winding = 0;
    for (size_t k = 0; k + 1 < crossings.size(); ++k) {
      winding += crossings[k].winding;
      const int excess = winding - (winding >= 1 ? 1 : 0);
      if (excess == 0) continue;
      const double a = crossings[k].at - p_MR.z(), b = crossings[k + 1].at - p_MR.z();
      const double size = excess * area;
      const double length = b - a, z = (b * b - a * a) / 2.0, zz = (b * b * b - a * a * a) / 3.0;
      const double px = x - p_MR.x(), py = y - p_MR.y();
      overlap.volume += size * length;
      overlap.absolute_volume += std::abs(size) * length;
      if (winding < 0) overlap.inverted_volume += area * length;
      overlap.first += size * Eigen::Vector3d(px * length, py * length, z);
      Eigen::Matrix3d second;
      second << px * px * length, px * py * length, px * z,  //
          px * py * length, py * py * length, py * z,        //
          px * z, py * z, zz;
      overlap.second += size * second;
    }
  }
  return overlap;
}

}  // namespace graspbench
