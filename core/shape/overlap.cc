#include "core/shape/overlap.h"

#include <Eigen/Geometry>

#include "core/shape/line_crossings.h"

namespace graspbench {
namespace {

constexpr int kNumLines = 512;  // per side

}  // namespace

Overlap CalcOverlap(const TriMesh& mesh) {
  Overlap overlap;
  if (mesh.triangles.empty()) return overlap;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  const Eigen::Vector3d p_MR = mesh.vertices[mesh.triangles.front()[0]];
  const LineCrossings lines(mesh, 2);
  const double dx = box.sizes().x() / kNumLines, dy = box.sizes().y() / kNumLines;
  std::vector<LineCrossings::Crossing> crossings;
  for (int j = 0; j < kNumLines; ++j) {
    for (int i = 0; i < kNumLines; ++i) {
      const double x = box.min().x() + (i + 0.5) * dx, y = box.min().y() + (j + 0.5) * dy;
      lines.Find(x, y, crossings);
      int winding = 0;
      for (size_t k = 0; k + 1 < crossings.size(); ++k) {
        winding += crossings[k].winding;
        const int excess = winding - (winding >= 1 ? 1 : 0);
        if (excess == 0) continue;
        const double a = crossings[k].at - p_MR.z(), b = crossings[k + 1].at - p_MR.z();
        const double size = excess * dx * dy;
        const double length = b - a, z = (b * b - a * a) / 2.0, zz = (b * b * b - a * a * a) / 3.0;
        const double px = x - p_MR.x(), py = y - p_MR.y();
        overlap.volume += size * length;
        overlap.absolute_volume += std::abs(size) * length;
        overlap.first += size * Eigen::Vector3d(px * length, py * length, z);
        Eigen::Matrix3d second;
        second << px * px * length, px * py * length, px * z,  //
            px * py * length, py * py * length, py * z,        //
            px * z, py * z, zz;
        overlap.second += size * second;
      }
    }
  }
  return overlap;
}

}  // namespace graspbench
