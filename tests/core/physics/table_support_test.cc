#include "core/physics/table_support.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Contacts of a mesh that is turned and then put 1 um deep into the table. */
struct Laid {
  std::vector<TableSupport::Contact> contacts;
  double face_factor = 1.0;

  Laid(const TriMesh& mesh, const Eigen::Matrix3d& R_WO) {
    const TableSupport support(mesh);
    Pose X_WO = MakePose(R_WO, Vector3d(0.1, -0.2, 0.0));
    X_WO.pretranslate(Vector3d(0.0, 0.0, -1e-6 - support.CalcLowestPoint(X_WO)));
    support.FindContacts(X_WO, 0.002, contacts, face_factor);
    for (const TableSupport::Contact& contact : contacts) {
      EXPECT_NEAR(contact.p_W.z(), -1e-6, 2e-4);
    }
  }
};

// However it is turned, a ball of any mesh touches once, straight below its middle.
TEST(TableSupport, ABallTouchesInOnePointBelowItsMiddle) {
  for (const int segments : {32, 64, 128}) {
    const TriMesh ball = MakeSphere(0.03, segments);
    for (const double turn : {0.0, 0.07, 0.4, 1.3, 2.9}) {
      const Laid laid(ball, MakeRotationRpy(turn, 0.3 * turn, -turn));
      ASSERT_EQ(laid.contacts.size(), 1u) << segments << " segments, turned by " << turn;
      EXPECT_TRUE(laid.contacts[0].is_round);
      EXPECT_LT((laid.contacts[0].p_W - Vector3d(0.1, -0.2, -1e-6)).norm(), 1e-6);
    }
  }
}

// The corners of a cube lie on a sphere too, and so does a coarse die's.
TEST(TableSupport, ABoxStandsOnItsCorners) {
  const TriMesh box = MakeRoundedBox(Vector3d(0.06, 0.06, 0.06), 0.0);
  const Laid flat(box, Eigen::Matrix3d::Identity());
  EXPECT_EQ(flat.contacts.size(), 4u);
  for (const TableSupport::Contact& contact : flat.contacts) EXPECT_FALSE(contact.is_round);
  EXPECT_EQ(Laid(box, MakeRotationRpy(kPi / 4.0, 0.0, 0.0)).contacts.size(), 2u);
}

// A cylinder that ends in a half ball of its radius, as a light bulb, lies on its line: the ball of
// its end reaches no deeper, and there is none where the flat begins.
TEST(TableSupport, ACylinderThatEndsInABallLiesOnItsLine) {
  for (const double length : {0.002, 0.008, 0.015, 0.06}) {
    std::vector<Eigen::Vector2d> profile = {{0.0, -length}, {0.03, -length}};
    for (int i = 0; i <= 12; ++i) {
      const double angle = kPi / 24.0 * i;
      profile.emplace_back(i == 12 ? 0.0 : 0.03 * std::cos(angle), 0.03 * std::sin(angle));
    }
    const TriMesh mesh = MakeRevolution(profile, 48);
    double lowest = 0.0;
    const Eigen::Matrix3d R_WO = MakeRotationRpy(kPi / 2.0, 0.0, 0.0);
    for (const Vector3d& p : mesh.vertices) lowest = std::min(lowest, (R_WO * p).z());
    const double carried = TableSupport(mesh).CalcLowestPoint(MakePose(R_WO, Vector3d::Zero()));
    EXPECT_NEAR(carried, lowest, 1e-6) << length;
  }
}

// Mean distance from the middle under uniform pressure over that of the contacts: a disc 2/3; a
// square of side s (sqrt(2) + asinh(1)) s / 6 over s / sqrt(2); an edge 1/2; a thin ring 1.
TEST(TableSupport, FacesPressEvenly) {
  const TriMesh disc = MakeRevolution({{0.0, -0.01}, {0.03, -0.01}, {0.03, 0.01}, {0.0, 0.01}}, 64);
  EXPECT_NEAR(Laid(disc, Eigen::Matrix3d::Identity()).face_factor, 2.0 / 3.0, 0.002);
  const TriMesh box = MakeRoundedBox(Vector3d(0.04, 0.04, 0.06), 0.0);
  EXPECT_NEAR(Laid(box, Eigen::Matrix3d::Identity()).face_factor,
              (std::sqrt(2.0) + std::asinh(1.0)) / 6.0 * std::sqrt(2.0), 1e-6);
  EXPECT_EQ(Laid(box, MakeRotationRpy(0.5, 0.0, 0.0)).face_factor, 0.5);
  const TriMesh cup = MakeRevolution(
      {{0.0, 0.002}, {0.0295, 0.002}, {0.03, 0.0}, {0.0305, 0.002}, {0.03, 0.05}, {0.0, 0.05}}, 64);
  EXPECT_EQ(Laid(cup, Eigen::Matrix3d::Identity()).face_factor, 1.0);
}

// Normals that differ by 3e-5 in every direction across the axis are one.
TEST(TableSupport, ABaseThatBulgesByAMicrometreIsOneFace) {
  const TriMesh disc =
      MakeRevolution({{0.0, -0.010001}, {0.03, -0.01}, {0.03, 0.01}, {0.0, 0.01}}, 64);
  EXPECT_NEAR(Laid(disc, Eigen::Matrix3d::Identity()).face_factor, 2.0 / 3.0, 0.002);
}

TEST(TableSupport, NothingTouchesOutOfReach) {
  const TableSupport support(MakeSphere(0.03, 32));
  std::vector<TableSupport::Contact> contacts;
  double face_factor = 0.0;
  support.FindContacts(MakePose(Vector3d(0.0, 0.0, 0.0325)), 0.002, contacts, face_factor);
  EXPECT_TRUE(contacts.empty());
  support.FindContacts(MakePose(Vector3d(0.0, 0.0, 0.0315)), 0.002, contacts, face_factor);
  EXPECT_EQ(contacts.size(), 1u);
}

}  // namespace
}  // namespace graspbench
