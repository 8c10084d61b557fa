#include "core/quality/wrench_space.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <limits>
#include <string>

#include "tests/core/quality/grasp_samples.h"

namespace graspbench {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A contact on the right of the origin pushes to the left. A sign error of all normals together
// does not change epsilon, so signs are checked on the forces.
TEST(WrenchSpace, GeneratorsByHand) {
  WrenchSpace space;
  space.num_edges = 4;
  space.torque_scale = 0.5;
  space.p_OR = {0.0, 0.1, 0.0};
  const GraspContact contact{
      {0.2, 0.1, 0.0}, {-1.0, 0.0, 0.0}, 0.5, 0.02, Eigen::Vector3d(0.0, 3.0, 0.0)};
  const ConeWrenches cones = CalcConeWrenches({contact}, space);
  WrenchMatrix expected(6, 6);
  // Edges along y, n x y = -z, -y, z; then torsion + and -. Lever 0.2 m along x, moments / 0.5 m.
  expected.col(0) << -1.0, 0.5, 0.0, 0.0, 0.0, 0.2;
  expected.col(1) << -1.0, 0.0, -0.5, 0.0, 0.2, 0.0;
  expected.col(2) << -1.0, -0.5, 0.0, 0.0, 0.0, -0.2;
  expected.col(3) << -1.0, 0.0, 0.5, 0.0, -0.2, 0.0;
  expected.col(4) << -1.0, 0.0, 0.0, -0.04, 0.0, 0.0;
  expected.col(5) << -1.0, 0.0, 0.0, 0.04, 0.0, 0.0;
  ASSERT_EQ(cones.wrenches.cols(), 6);
  EXPECT_LT((cones.wrenches - expected).cwiseAbs().maxCoeff(), 1e-15) << cones.wrenches;
}

// Every cone opens at atan(mu): a tool that scales rim and height alike opens all of them at 45
// deg.
TEST(WrenchSpace, ConesOpenByTheirFriction) {
  RandomStream stream("wrench space", "cones");
  for (const UnitForce unit_force : {UnitForce::kNormal, UnitForce::kTotal}) {
    for (const double mu : {0.1, 0.5, 2.0}) {
      const GraspContact contact{Eigen::Vector3d::Ones(), MakeRandomDirection(stream), mu, 0.0,
                                 std::nullopt};
      WrenchSpace space;
      space.unit_force = unit_force;
      const ConeWrenches cones = CalcConeWrenches({contact}, space);
      ASSERT_EQ(cones.wrenches.cols(), 8);
      for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d f = cones.wrenches.col(i).head<3>();
        const double normal = f.dot(contact.nhat_O);
        EXPECT_NEAR((f - normal * contact.nhat_O).norm() / normal, mu, 1e-14);
        EXPECT_NEAR(unit_force == UnitForce::kNormal ? normal : f.norm(), 1.0, 1e-14);
        EXPECT_LT((Eigen::Vector3d(cones.wrenches.col(i).tail<3>()) - contact.p_OC.cross(f)).norm(),
                  1e-14);
      }
    }
  }
}

TEST(WrenchSpace, GraspMatrixMapsContactForcesToTheWrench) {
  const GraspContact contact{
      {0.2, 0.0, 0.0}, {-1.0, 0.0, 0.0}, 0.5, 0.02, Eigen::Vector3d(0.0, 1.0, 0.0)};
  WrenchSpace space;
  space.torque_scale = 0.1;
  const WrenchMatrix matrix = CalcGraspMatrix({contact}, space);
  ASSERT_EQ(matrix.cols(), 4);
  const Eigen::Matrix<double, 6, 1> wrench = matrix * Eigen::Vector4d(3.0, 1.0, 2.0, 0.05);
  const Eigen::Vector3d force(-3.0, 1.0, -2.0);  // 3 n + 1 y + 2 (n x y)
  const Eigen::Vector3d moment = contact.p_OC.cross(force) + 0.05 * contact.nhat_O;
  EXPECT_LT((wrench.head<3>() - force).norm(), 1e-15);
  EXPECT_LT((wrench.tail<3>() - moment / 0.1).norm(), 1e-14);
  EXPECT_EQ(CalcGraspMatrix(MakeCubeGrasp(1.0, 0.0), {}).cols(), 6);
  EXPECT_EQ(CalcGraspMatrix(MakeCubeGrasp(1.0, 0.3), {}).cols(), 18);
}

TEST(WrenchSpace, TellsWhatIsWrongWithAContact) {
  const GraspContact good{
      {0.1, 0.0, 0.0}, {-0.6, 0.8, 0.0}, 0.5, 0.0, Eigen::Vector3d(0.0, 0.0, 2.0)};
  EXPECT_EQ(FindProblem(good), "");
  const std::string edge =
      "the direction of the first cone edge is zero or along the normal; expected a tangent";
  const std::pair<std::function<void(GraspContact&)>, std::string> cases[] = {
      {[](auto& c) { c.p_OC.y() = kNaN; },
       "the position is (0.1, nan, 0); expected three numbers within 100 m"},
      {[](auto& c) { c.nhat_O *= 0.9; },
       "the normal's length is 0.9; expected 1 within 1e-6 (a unit vector into the object)"},
      {[](auto& c) { c.nhat_O.setConstant(kNaN); },
       "the normal's length is nan; expected 1 within 1e-6 (a unit vector into the object)"},
      {[](auto& c) { c.mu = -0.1; }, "the friction coefficient is -0.1; expected 0 to 100"},
      {[](auto& c) { c.mu = kNaN; }, "the friction coefficient is nan; expected 0 to 100"},
      {[](auto& c) { c.torsion = -1.0; }, "the torsion is -1 m; expected 0 to 100 m"},
      {[](auto& c) { c.first_edge_O = Eigen::Vector3d::Zero(); }, edge},
      {[](auto& c) { c.first_edge_O = 2.0 * c.nhat_O; }, edge}};
  for (const auto& [spoil, problem] : cases) {
    GraspContact bad = good;
    spoil(bad);
    EXPECT_EQ(FindProblem(bad), problem);
  }
}

}  // namespace
}  // namespace graspbench
