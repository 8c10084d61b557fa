#include "objects/catalogue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "catalogue_table.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/physics/table_support.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

constexpr char kYaml[] =
    "name: my box\nmesh: box.obj\nmesh_unit: mm\nmass_kg: 0.06\nfriction_static: 0.5\n"
    "friction_dynamic: 0.4\n";

class CatalogueTest : public testing::Test {
 protected:
  CatalogueTest() {
    folder_ = fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::create_directories(folder_);
  }
  // A box away from its file's origin.
  void Write(const std::string& yaml, const TriMesh& mesh) {
    TriMesh moved = mesh;
    for (Eigen::Vector3d& p : moved.vertices) p += Eigen::Vector3d(0.1, 0.2, 0.3);
    WriteFileAtomically(folder_ / "object.yaml", yaml);
    WriteFileAtomically(folder_ / "box.obj", FormatObj(moved, 1e3));
  }
  std::string FindMessage(const std::string& id, ErrorKind kind) {
    try {
      LoadObject(id);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), kind);
      return e.what();
    }
    return "no error";
  }
  fs::path folder_;
  TriMesh box_ = MakeRoundedBox({0.04, 0.03, 0.02}, 0.0);
};

TEST_F(CatalogueTest, ListsTheTableInItsOrder) {
  std::vector<std::string> expected;
  for (const CatalogueRow& row : ListCatalogueRows()) expected.push_back(row.id);
  EXPECT_EQ(ListObjects(), expected);
}

TEST_F(CatalogueTest, AUsersFolderIsCentredAndHomogeneous) {
  Write(kYaml, box_);
  const auto object = LoadObject(folder_.string());
  EXPECT_EQ(object->id, folder_.filename().string());
  EXPECT_LT((object->size - Eigen::Vector3d(0.04, 0.03, 0.02)).norm(), 1e-7);
  EXPECT_FALSE(object->compressible);
  EXPECT_LT(object->mass_properties.p_OOcm.norm(), 1e-7);
  EXPECT_NEAR(object->mass_properties.I_OOcm(0, 0), 0.06 / 12.0 * (0.0009 + 0.0004), 1e-10);
  EXPECT_NEAR(object->field->Query({0.0, 0.0, 0.015}).distance, 0.005, 1e-6);
  // The same by its yaml and with a slash at the end.
  EXPECT_EQ(LoadObject((folder_ / "object.yaml").string())->content_hash, object->content_hash);
  EXPECT_EQ(LoadObject(folder_.string() + "/")->id, object->id);
}

TEST_F(CatalogueTest, TheFieldMayComeLater) {
  Write(kYaml, box_);
  const auto light = LoadObject(folder_.string(), FieldUse::kLater);
  EXPECT_EQ(light->field, nullptr);
  EXPECT_EQ(light->content_hash, LoadObject(folder_.string())->content_hash);
  const auto complete = CompleteObject(light);
  EXPECT_NEAR(complete->field->Query({0.0, 0.0, 0.015}).distance, 0.005, 1e-6);
  EXPECT_EQ(CompleteObject(complete), complete);
}

TEST_F(CatalogueTest, DensityGivesTheMassAndAGivenCentreOfMassIsTaken) {
  std::string yaml = kYaml;
  yaml.replace(yaml.find("mass_kg: 0.06"), 13, "density_kg_per_m3: 500");
  Write(yaml + "centre_of_mass_m: [0.01, 0, -0.002]\n", box_);
  const auto object = LoadObject(folder_.string());
  EXPECT_NEAR(object->mass_properties.mass, 500.0 * 2.4e-5, 1e-8);
  EXPECT_EQ(object->mass_properties.p_OOcm, Eigen::Vector3d(0.01, 0.0, -0.002));
}

TEST_F(CatalogueTest, TheHashFollowsThePhysicsNotTheLooks) {
  Write(kYaml, box_);
  const std::string plain = LoadObject(folder_.string())->content_hash;
  Write(std::string(kYaml) + "colour: [0, 1, 0]\n", box_);
  EXPECT_EQ(LoadObject(folder_.string())->content_hash, plain);
  std::string rougher = kYaml;
  rougher.replace(rougher.find("friction_static: 0.5"), 20, "friction_static: 0.6");
  Write(rougher, box_);
  EXPECT_NE(LoadObject(folder_.string())->content_hash, plain);
}

TEST_F(CatalogueTest, ABrokenMeshIsRefusedWithItsProblems) {
  box_.triangles.pop_back();
  Write(kYaml, box_);
  const std::string message = FindMessage(folder_.string(), ErrorKind::kFormat);
  EXPECT_EQ(message.find("the mesh \"" + (folder_ / "box.obj").string() +
                         "\" (unit mm) cannot be used:\nthe surface is open: 3 edges"),
            0u)
      << message;
}

TEST_F(CatalogueTest, AWrongSizeAndACentreOfMassOutsideAreRefused) {
  Write(std::string(kYaml) + "size_m: [0.04, 0.03, 0.0205]\n", box_);
  EXPECT_EQ(FindMessage(folder_.string(), ErrorKind::kFormat),
            (folder_ / "object.yaml").string() +
                ": size_m says 40.00 x 30.00 x 20.50 mm, but \"box.obj\" measures 40.00 x 30.00 x "
                "20.00 mm if its unit is mm; correct size_m or mesh_unit");
  Write(std::string(kYaml) + "centre_of_mass_m: [0.03, 0, 0]\n", box_);
  EXPECT_NE(FindMessage(folder_.string(), ErrorKind::kRange)
                .find("centre_of_mass_m lies outside the object, which measures 40.00 x 30.00"),
            std::string::npos);
}

TEST_F(CatalogueTest, UnknownNamesAndBareMeshesAreExplained) {
  EXPECT_EQ(FindMessage("tenis_ball", ErrorKind::kNotFound)
                .find("no object and no folder \"tenis_ball\"; did you mean \"tennis_ball\"?"),
            0u);
  Write(kYaml, box_);
  EXPECT_NE(FindMessage((folder_ / "box.obj").string(), ErrorKind::kUsage)
                .find("a mesh alone gives neither unit, mass nor friction. Put it into a folder "
                      "with an object.yaml"),
            std::string::npos);
  fs::remove(folder_ / "object.yaml");
  EXPECT_EQ(FindMessage(folder_.string(), ErrorKind::kNotFound),
            "no file \"" + (folder_ / "object.yaml").string() + "\"");
}

// The lowest vertex carries an object on the table. A round side of n equal sides lies on one of
// them and is carried by the circle through its corners, lower by r (1 - cos(pi / n)).
TEST(SyntheticObjects, TheIdDecidesTheObject) {
  const auto first = LoadObject("synthetic_7_g3_0", FieldUse::kLater);
  EXPECT_EQ(first->id, "synthetic_7_g3_0");
  EXPECT_EQ(first->name, "cylinder g3-0");
  EXPECT_EQ(first->approach, Approach::kSide);
  EXPECT_EQ(LoadObject("synthetic_7_g3_0", FieldUse::kLater)->content_hash, first->content_hash);
  EXPECT_NE(LoadObject("synthetic_8_g3_0", FieldUse::kLater)->content_hash, first->content_hash);
  EXPECT_NE(LoadObject("synthetic_7_g3_4", FieldUse::kLater)->content_hash, first->content_hash);
  // The limits of the row "cylinder" of grasp g3, and its density.
  EXPECT_GE(first->size.y(), 0.045 - 1e-9);
  EXPECT_LE(first->size.y(), 0.084);
  EXPECT_GE(first->size.z(), 0.072);
  EXPECT_LE(first->size.z(), 0.125);
  const double density = first->mass_properties.mass / CalcVolume(first->mesh);
  EXPECT_GE(density, 200.0);
  EXPECT_LE(density, 800.0);
  EXPECT_EQ(ChangeSyntheticSeed("synthetic_7_g3_0", 12), "synthetic_12_g3_0");
  EXPECT_EQ(ChangeSyntheticSeed("can", 12), "can");
}

TEST(SyntheticObjects, AnIdIsWrittenInOneWay) {
  EXPECT_TRUE(ComesWithProgram("can"));
  EXPECT_TRUE(ComesWithProgram("synthetic_2147483647_g6_99"));
  for (const char* id :
       {"synthetic_07_g3_0", "synthetic_7_g3_00", "synthetic_7_g7_0", "synthetic_2147483648_g3_0",
        "synthetic_-1_g3_0", "synthetic_7_g3_100", "synthetic_7_g3_0/object.yaml", "all"}) {
    EXPECT_FALSE(ComesWithProgram(id)) << id;
    EXPECT_THROW(LoadObject(id, FieldUse::kLater), Error) << id;
  }
}

TEST(Catalogue, EveryObjectRestsOnItsMesh) {
  const std::map<std::string, int> num_sides = {{"board_marker", 32}, {"light_bulb", 48}};
  for (const std::string& id : ListObjects()) {
    const auto object = LoadObject(id);
    double lowest = 0.0;
    for (const Eigen::Vector3d& p : object->mesh.vertices) lowest = std::min(lowest, p.z());
    const double carried = TableSupport(object->mesh).CalcLowestPoint(Pose::Identity());
    const auto sides = num_sides.find(id);
    const double part = sides == num_sides.end() ? 1.0 : std::cos(M_PI / sides->second);
    EXPECT_NEAR(carried * part, lowest, 1e-8) << id;
  }
}

}  // namespace
}  // namespace graspbench
