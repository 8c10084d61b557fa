#include "core/hand/import/shapes/load_shapes.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/files/files.h"
#include "core/shape/mass_properties.h"
#include "core/shape/primitives.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class LoadShapesTest : public testing::Test {
 protected:
  void SetUp() override {
    MakeFolder(folder_);
    for (const char* name : {"tip.stl", "broken.stl"}) WriteFile(folder_ / name, "x");
    source_.file = "h.urdf";
    source_.folder = folder_;
    source_.load_mesh = [this](const fs::path& path) -> TriMesh {
      if (path.filename() == "broken.stl") throw Error(ErrorKind::kFormat, "it is broken");
      TriMesh mesh = MakeSphere(0.01, 32);
      for (Eigen::Vector3d& p : mesh.vertices) p *= unit_;
      return mesh;
    };
  }
  void TearDown() override { fs::remove_all(folder_); }
  static ForeignShape Mesh(const std::string& address) {
    ForeignShape shape;
    shape.kind = ForeignShape::Kind::kMesh;
    shape.mesh = address;
    shape.line = 7;
    return shape;
  }
  LoadedShapes Load(const ForeignLink& link) {
    problems_ = {};
    return ShapeLoader(source_, problems_).Load(link);
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("load_shapes_test_" + std::to_string(::getpid()));
  double unit_ = 1.0;  // of the mesh, per metre
  HandSource source_;
  Diagnostics problems_;
};

TEST_F(LoadShapesTest, ACollisionMeshBecomesABall) {
  ForeignLink link;
  link.name = "tip";
  link.collisions = {Mesh("tip.stl")};
  link.collisions[0].X_LS.translation() = Eigen::Vector3d(0, 0, 0.02);
  const LoadedShapes loaded = Load(link);
  EXPECT_EQ(problems_.Format(), "");
  ASSERT_EQ(loaded.collisions.size(), 1u);
  EXPECT_EQ(loaded.collisions[0].kind, CollisionShape::Kind::kSphere);
  EXPECT_NEAR(loaded.collisions[0].size.x(), 0.02, 0.0002);
  EXPECT_LT((loaded.collisions[0].X_LS.translation() - Eigen::Vector3d(0, 0, 0.02)).norm(), 3e-4);
  EXPECT_TRUE(loaded.collisions[0].is_fitted);
}

TEST_F(LoadShapesTest, MoreThanAHundredShapesAreRefusedWithTheirCount) {
  ForeignShape box;
  box.kind = ForeignShape::Kind::kBox;
  box.size.setConstant(0.01);
  for (const bool is_seen : {false, true}) {
    ForeignLink link;
    link.name = "tip";
    link.line = 3;
    std::vector<ForeignShape>& shapes = is_seen ? link.visuals : link.collisions;
    shapes.assign(100, box);
    EXPECT_EQ(Load(link).solids.size(), 100u);
    shapes.push_back(box);
    EXPECT_TRUE(Load(link).solids.empty());
    ASSERT_FALSE(problems_.entries().empty());
    EXPECT_EQ(problems_.entries().back().severity, Severity::kError);
    EXPECT_EQ(problems_.entries().back().text,
              "link \"tip\" would touch with 101 shapes; at most 100 can be used; join them into "
              "fewer meshes");
  }
}

TEST_F(LoadShapesTest, MillimetresAndAScaleTooManyAreSeen) {
  ForeignLink link;
  link.name = "tip";
  link.visuals = {Mesh("tip.stl")};
  unit_ = 1000.0;
  EXPECT_NEAR(CalcVolume(Load(link).visuals[0].mesh), 4.1e-6, 1e-7);
  EXPECT_EQ(problems_.entries()[0].text,
            "link \"tip\", visual: mesh \"tip.stl\" would be 20 m across; taken as 20 mm, so its "
            "unit is the millimetre");
  unit_ = 1.0;
  link.visuals[0].scale.setConstant(0.001);
  EXPECT_NEAR(CalcVolume(Load(link).visuals[0].mesh), 4.1e-6, 1e-7);
  EXPECT_EQ(problems_.entries()[0].text,
            "link \"tip\", visual: mesh \"tip.stl\" would be 2e-05 m across; taken as 20 mm, so "
            "its scale counts twice");
}

// 10 mm of radius in metres, a thousand times as large by its scale.
TEST_F(LoadShapesTest, AnAbsurdScaleIsLeftOut) {
  ForeignLink link;
  link.name = "tip";
  link.visuals = {Mesh("tip.stl")};
  link.visuals[0].scale = {1000.0, -1000.0, 1000.0};
  EXPECT_NEAR(CalcVolume(Load(link).visuals[0].mesh), 4.1e-6, 1e-7);
  ASSERT_FALSE(problems_.entries().empty());
  EXPECT_EQ(problems_.entries()[0].text,
            "link \"tip\", visual: a scale of 1e+03 makes mesh \"tip.stl\" 20 m long, which is no "
            "part of a hand; taken without it");
  EXPECT_EQ(problems_.entries()[0].line, 7);
  unit_ = 1e-3;  // a mesh in kilometres, if there were one: the scale converts it
  EXPECT_NEAR(CalcVolume(Load(link).visuals[0].mesh), 4.1e-6, 1e-7);
  EXPECT_EQ(problems_.Format().find("scale"), std::string::npos);
}

// A ball and a box of given masses: their sum by hand.
TEST_F(LoadShapesTest, ShapesThatWeighMakeTheInertia) {
  ForeignLink link;
  ForeignShape ball, box;
  ball.size.setConstant(0.02);
  ball.weight = ForeignShape::Weight{0.1, 0.0};
  box.kind = ForeignShape::Kind::kBox;
  box.size = {0.02, 0.03, 0.05};
  box.X_LS.translation().x() = 0.06;
  box.weight = ForeignShape::Weight{{}, 10000.0};  // 0.3 kg
  link.weights = {ball, box};
  ShapeLoader(source_, problems_).Weigh(link);
  ASSERT_TRUE(link.inertia);
  EXPECT_TRUE(link.inertia->is_of_geoms);
  EXPECT_NEAR(link.inertia->mass, 0.4, 1e-15);
  EXPECT_NEAR(link.inertia->X_LI.translation().x(), 0.3 * 0.06 / 0.4, 1e-15);
  const double of_ball = 0.4 * 0.1 * 1e-4, apart = 0.1 * 0.3 / 0.4 * 0.06 * 0.06;
  const Eigen::Vector3d of_box = 0.3 / 12.0 * Eigen::Vector3d(34e-4, 29e-4, 13e-4);
  const Eigen::Vector3d expected =
      of_box + Eigen::Vector3d(of_ball, of_ball + apart, of_ball + apart);
  EXPECT_LT((link.inertia->I_I - Eigen::Matrix3d(expected.asDiagonal())).norm(), 1e-15);
  ForeignLink published;
  published.inertia.emplace().mass = 1.0;
  published.weights = {ball};
  ShapeLoader(source_, problems_).Weigh(published);
  EXPECT_EQ(published.inertia->mass, 1.0);
}

TEST_F(LoadShapesTest, AMirroredMeshStillFacesOutwards) {
  ForeignLink link;
  link.visuals = {Mesh("tip.stl")};
  link.visuals[0].scale = {1, -1, 1};
  EXPECT_GT(CalcVolume(Load(link).visuals[0].mesh), 0.0);
}

TEST_F(LoadShapesTest, AMissingMeshIsNamedWithWhatWasTried) {
  ForeignLink link;
  link.name = "tip";
  link.collisions = {Mesh("package://p/none.stl")};
  Load(link);
  ASSERT_EQ(problems_.num_errors(), 1);
  const std::string text = problems_.entries()[0].text;
  EXPECT_EQ(problems_.entries()[0].line, 7);
  EXPECT_EQ(text.find("link \"tip\", collision: mesh not found: \"package://p/none.stl\"; give the "
                      "folder of its package with --package-path. Tried: "),
            0u)
      << text;
  EXPECT_NE(text.find((folder_ / "p/none.stl").string()), std::string::npos) << text;
  // A picture is not needed, and stands in for a collision mesh that is not there.
  link.visuals = {Mesh("tip.stl")};
  EXPECT_EQ(Load(link).collisions.size(), 1u);
  EXPECT_EQ(problems_.num_errors(), 0);
  EXPECT_EQ(problems_.entries().size(), 2u);
}

TEST_F(LoadShapesTest, ABrokenMeshIsAProblemOfTheLink) {
  ForeignLink link;
  link.name = "tip";
  link.collisions = {Mesh("broken.stl")};
  Load(link);
  EXPECT_EQ(problems_.Format(), "h.urdf:7: error: link \"tip\", collision: it is broken");
}

TEST_F(LoadShapesTest, AThinPlateIsMadeThicker) {
  ForeignLink link;
  link.name = "plate";
  ForeignShape& plate = link.collisions.emplace_back();
  plate.kind = ForeignShape::Kind::kBox;
  plate.size = {0.1, 0.1, 0.001};
  const LoadedShapes loaded = Load(link);
  EXPECT_NEAR(loaded.collisions[0].size.z(), 0.004, 1e-12);
  EXPECT_EQ(problems_.entries().size(), 1u);
}

}  // namespace
}  // namespace graspbench
