#include "objects/check_mesh_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

class CheckMeshFileTest : public testing::Test {
 protected:
  fs::path Write(const TriMesh& mesh) {
    const fs::path path =
        fs::path(testing::TempDir()) /
        (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".obj");
    WriteFileAtomically(path, FormatObj(mesh, 1e3));
    return path;
  }
  TriMesh box_ = MakeRoundedBox({0.04, 0.03, 0.02}, 0.0);
};

TEST_F(CheckMeshFileTest, ReportsAGoodMesh) {
  for (Eigen::Vector3d& p : box_.vertices) p += Eigen::Vector3d(0.01, 0.02, 0.03);
  const Json json = FormatMeshReport(CheckMeshFile(Write(box_), LengthUnit::kMm).report);
  EXPECT_EQ(json["closed"], true);
  EXPECT_EQ(json["triangles"], 16);
  EXPECT_EQ(json["open_edges"], 0);
  EXPECT_NEAR(json["volume_m3"].get<double>(), 2.4e-5, 1e-11);
  EXPECT_LT((VectorFrom(json["centroid_m"]) - Eigen::Vector3d(0.01, 0.02, 0.03)).norm(), 1e-8);
  EXPECT_LT((VectorFrom(json["extent_m"]) - Eigen::Vector3d(0.04, 0.03, 0.02)).norm(), 1e-8);
  EXPECT_TRUE(json["problems"].empty());
  EXPECT_EQ(json["usable"], true);
}

TEST_F(CheckMeshFileTest, AnOpenMeshHasNoVolumeAndIsRepaired) {
  box_.triangles.erase(box_.triangles.begin());
  const fs::path path = Write(box_);
  const Json json = FormatMeshReport(CheckMeshFile(path, LengthUnit::kMm).report);
  EXPECT_EQ(json["closed"], false);
  EXPECT_EQ(json["open_edges"], 3);
  EXPECT_TRUE(json["volume_m3"].is_null());
  EXPECT_TRUE(json["centroid_m"].is_null());
  EXPECT_EQ(json["problems"].size(), 1u);

  fs::path repaired = path;
  repaired.replace_extension(".repaired.obj");
  // The hole is 97 mm around, more than the box is long.
  const MeshFileRepair left_open = RepairMeshFile(CheckMeshFile(path, LengthUnit::kMm), repaired);
  EXPECT_TRUE(left_open.actions.empty());
  EXPECT_FALSE(left_open.report.is_closed);

  TriMesh ball = MakeSphere(0.02, 24);
  for (Eigen::Vector3i& t : ball.triangles) std::swap(t[0], t[1]);
  const MeshFileRepair turned =
      RepairMeshFile(CheckMeshFile(Write(ball), LengthUnit::kMm), repaired);
  EXPECT_EQ(turned.actions, std::vector<std::string>{"1 shell turned the right way round"});
  EXPECT_TRUE(turned.is_written);
  EXPECT_EQ(FormatProblems(CheckMeshFile(repaired, LengthUnit::kMm).report), "");
}

// A file is written only if it can be used: half a ball with one face turned is no better turned
// back.
TEST_F(CheckMeshFileTest, NoFileIsWrittenThatCannotBeUsed) {
  TriMesh half = MakeSphere(0.02, 24);
  half.triangles.resize(half.triangles.size() / 2);
  std::swap(half.triangles[7][0], half.triangles[7][1]);
  const fs::path path = Write(half);
  fs::path repaired = path;
  repaired.replace_extension(".repaired.obj");
  fs::remove(repaired);
  const MeshFileRepair repair = RepairMeshFile(CheckMeshFile(path, LengthUnit::kMm), repaired);
  EXPECT_FALSE(repair.actions.empty());
  EXPECT_FALSE(repair.is_written);
  EXPECT_FALSE(repair.report.problems.empty());
  EXPECT_FALSE(fs::exists(repaired));
}

// Scanned household objects, with volumes computed by another program where it could.
TEST(WildObjectsTest, ScannedObjectsCanBeUsed) {
  const char* root = std::getenv("GRASPBENCH_DATA");
  const fs::path folder =
      (root != nullptr && *root != '\0' ? fs::path(root)
                                        : FindDataRoot().parent_path() / "shared" / "data") /
      "objects";
  if (!fs::exists(folder)) {
    GTEST_SKIP() << "no objects at " << folder << "; GRASPBENCH_DATA names the folder above";
  }
  const std::map<std::string, double> volumes_cm3 = {{"002_master_chef_can", 0.0},
                                                     {"003_cracker_box", 2173.29},
                                                     {"005_tomato_soup_can", 0.0},
                                                     {"011_banana", 171.53},
                                                     {"016_pear", 0.0},
                                                     {"021_bleach_cleanser", 972.34},
                                                     {"048_hammer", 258.94},
                                                     {"065-d_cups", 0.0}};
  for (const auto& [name, volume_cm3] : volumes_cm3) {
    const CheckedMeshFile file = CheckMeshFile(folder / name / "mesh.obj", std::nullopt);
    EXPECT_EQ(FormatProblems(file.report), "") << name;
    EXPECT_EQ(file.unit, LengthUnit::kM) << name;
    EXPECT_GT(file.report.volume, 1e-5) << name;
    if (volume_cm3 > 0.0) {
      EXPECT_NEAR(file.report.volume, 1e-6 * volume_cm3, 1e-9 * volume_cm3) << name;
    }
  }
}

TEST_F(CheckMeshFileTest, MillimetresReadAsMetresAreTold) {
  const MeshReport report = CheckMeshFile(Write(box_), LengthUnit::kM).report;
  ASSERT_EQ(report.problems.size(), 1u);
  EXPECT_EQ(report.problems[0].fault, MeshFault::kSize);
}

TEST_F(CheckMeshFileTest, TheUnitIsInferredWhereTheSizeTellsIt) {
  // Numbers that mean 2 mm to 1 m in one unit and in no other.
  const std::pair<double, std::optional<LengthUnit>> sizes[] = {
      {0.0019, std::nullopt},   {0.0021, LengthUnit::kM}, {0.999, LengthUnit::kM},
      {1.01, std::nullopt},     {1.99, std::nullopt},     {2.01, LengthUnit::kMm},
      {999.0, LengthUnit::kMm}, {1001.0, std::nullopt},   {NAN, std::nullopt},
      {INFINITY, std::nullopt}};
  for (const auto& [size, unit] : sizes) EXPECT_EQ(InferLengthUnit(size), unit) << size;

  const CheckedMeshFile in_mm = CheckMeshFile(Write(box_), std::nullopt);
  EXPECT_TRUE(in_mm.is_unit_inferred);
  EXPECT_EQ(in_mm.unit, LengthUnit::kMm);
  EXPECT_NEAR(in_mm.report.volume, 2.4e-5, 1e-11);
  EXPECT_EQ(FormatProblems(in_mm.report), "");
  const CheckedMeshFile given = CheckMeshFile(Write(box_), LengthUnit::kMm);
  EXPECT_FALSE(given.is_unit_inferred);
  EXPECT_LT((given.report.extent - in_mm.report.extent).norm(), 1e-12);

  for (Eigen::Vector3d& p : box_.vertices) p *= 50.0;  // 2 m: no unit fits
  const CheckedMeshFile neither = CheckMeshFile(Write(box_), std::nullopt);
  EXPECT_FALSE(neither.is_unit_inferred);
  ASSERT_FALSE(neither.report.problems.empty());
  EXPECT_EQ(neither.report.problems[0].fault, MeshFault::kSize);
  EXPECT_NE(neither.report.problems[0].text.find("neither metres nor millimetres"),
            std::string::npos)
      << neither.report.problems[0].text;
}

TEST_F(CheckMeshFileTest, AMissingFileIsNamed) {
  try {
    CheckMeshFile("nowhere/mug.stl", LengthUnit::kM);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kNotFound);
    EXPECT_EQ(std::string(e.what()), "no file \"nowhere/mug.stl\"");
  }
}

}  // namespace
}  // namespace graspbench
