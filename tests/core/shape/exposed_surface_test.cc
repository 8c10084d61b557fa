#include "core/shape/exposed_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/shape/primitives.h"
#include "tests/core/shape/join_meshes.h"

namespace graspbench {
namespace {

double CalcArea(const TriMesh& mesh) {
  double area = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const auto& v = mesh.vertices;
    area += 0.5 * (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).norm();
  }
  return area;
}

TEST(ExposedSurfaceTest, HiddenFacesGoAndTheRestStays) {
  const TriMesh box = MakeRoundedBox({0.04, 0.03, 0.02}, 0.0);
  const double area = 2.0 * (0.04 * 0.03 + 0.03 * 0.02 + 0.02 * 0.04);
  EXPECT_NEAR(CalcArea(FindExposedSurface(box, 1e-3)), area, 1e-12);
  // End to end: each loses the face that touches.
  EXPECT_NEAR(CalcArea(FindExposedSurface(JoinMeshes(box, box, {0.04, 0.0, 0.0}), 1e-3)),
              2.0 * (area - 0.03 * 0.02), 1e-9);
  // Shifted: the parts of the faces that touch, to within a cell along their rim.
  EXPECT_NEAR(CalcArea(FindExposedSurface(JoinMeshes(box, box, {0.04, 0.01, 0.004}), 5e-4)),
              2.0 * (area - 0.02 * 0.016), 4.0 * 0.036 * 5e-4);
  // A box within another is hidden.
  TriMesh inner = box;
  for (Eigen::Vector3d& p : inner.vertices) p *= 0.5;
  EXPECT_NEAR(CalcArea(FindExposedSurface(JoinMeshes(box, inner, {0.0, 0.0, 0.0}), 1e-3)), area,
              1e-12);
}

}  // namespace
}  // namespace graspbench
