#include "objects/object_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/grasp/standard_grasp.h"

namespace graspbench {
namespace {

class ObjectFileTest : public testing::Test {
 protected:
  ObjectFile Load(const std::string& text) {
    const auto path =
        std::filesystem::path(testing::TempDir()) /
        (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".yaml");
    WriteFileAtomically(path, text);
    path_ = path.string();
    return LoadObjectFile(path);
  }
  std::string FindMessage(const std::string& text) {
    try {
      Load(text);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kFormat);
      return e.what();
    }
    return "no error";
  }
  std::string path_;
};

constexpr char kSmallest[] =
    "name: mug\nmesh: mug.stl\nmesh_unit: mm\nmass_kg: 0.3\nfriction_static: 0.5\n"
    "friction_dynamic: 0.4\n";

TEST_F(ObjectFileTest, TheSmallestFileLeavesTheRestUnset) {
  const ObjectFile file = Load(kSmallest);
  EXPECT_EQ(file.name, "mug");
  EXPECT_EQ(file.mesh_unit, LengthUnit::kMm);
  EXPECT_EQ(file.mass, 0.3);
  EXPECT_TRUE(std::isnan(file.density));
  EXPECT_TRUE(file.size.array().isNaN().all());
  EXPECT_TRUE(file.p_OOcm.array().isNaN().all());
  EXPECT_TRUE(file.best_grasp.empty());
}

TEST_F(ObjectFileTest, ReadsEveryKey) {
  const ObjectFile file =
      Load(std::string(kSmallest) +
           "compressible: {force_n: 0.7, sight_m: [0.1, 0.08, 0.06],\n"
           "  grasp_m: [0.1, 0.07, 0.05], sight_guessed: true}\n"
           "centre_of_mass_m: [0.01, 0, 0]\nbest_grasp: {tum: g3, my_hand: g2}\n"
           "grasp_order: [g2, g1]\ncolour: [1, 0.5, 0]\n");
  EXPECT_EQ(file.size, Eigen::Vector3d(0.1, 0.08, 0.06));
  ASSERT_TRUE(file.compression);
  EXPECT_EQ(file.compression->force, 0.7);
  EXPECT_EQ(file.compression->size_of_grasp, Eigen::Vector3d(0.1, 0.07, 0.05));
  EXPECT_TRUE(file.compression->is_sight_guessed);
  EXPECT_EQ(file.p_OOcm.x(), 0.01);
  EXPECT_EQ(file.best_grasp.at("my_hand"), "g2");
  EXPECT_EQ(file.grasp_order, (std::vector<std::string>{"g2", "g1"}));
}

TEST_F(ObjectFileTest, GraspsMayHaveTheirNames) {
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    const ObjectFile file = Load(std::string(kSmallest) + "best_grasp: {tum: " + taxon.name +
                                 "}\ngrasp_order: [" + "G" + taxon.id.substr(1) + "]\n");
    EXPECT_EQ(file.best_grasp.at("tum"), taxon.id);
    EXPECT_EQ(file.grasp_order, std::vector<std::string>{taxon.id});
  }
}

TEST_F(ObjectFileTest, TellsEveryProblemAtItsLine) {
  const std::string message = FindMessage(
      "name: mug\nmesh: mug.stl\nmesh_unit: inch\nmass_kg: -1\ndensity_kg_per_m3: 800\n"
      "friction_static: 0.3\nfriction_dynamic: 0.4\nbest_grasp: {tum: g7}\nfrictoin: 1\n");
  const auto expect = [&](int line, const std::string& text) {
    const std::string wanted = path_ + ":" + std::to_string(line) + ": error: " + text;
    EXPECT_NE(message.find(wanted), std::string::npos) << message << "\nlacks\n" << wanted;
  };
  expect(3, "object, mesh_unit: expected m or mm, found \"inch\"");
  expect(4, "object, mass_kg: give either mass_kg or density_kg_per_m3");
  expect(4, "object, mass_kg: -1 is out of range; expected 0.0001 to 100");
  expect(7, "object, friction_dynamic: is larger than friction_static; swap the two?");
  expect(8, "best_grasp, tum: no standard grasp \"g7\"; did you mean \"g1\"?");
  expect(9, "object: unknown key \"frictoin\"");
}

TEST_F(ObjectFileTest, RefusesWhatNoFingertipsCompress) {
  for (const char* grasp : {"[0.1, 0.09, 0.06]", "[0.1, 0.08, 0.03]"}) {
    const std::string message =
        FindMessage(std::string(kSmallest) + "compressible: {force_n: 0.7, sight_m: " +
                    "[0.1, 0.08, 0.06], grasp_m: " + grasp + "}\n");
    EXPECT_NE(message.find("compressible, grasp_m: each size must be from 0.6 of sight_m to "
                           "sight_m; correct one of the two"),
              std::string::npos)
        << message;
  }
  EXPECT_NE(FindMessage(std::string(kSmallest) + "size_m: [0.1, 0.08, 0.06]\n" +
                        "compressible: {force_n: 0.7, sight_m: [0.1, 0.08, 0.06], " +
                        "grasp_m: [0.1, 0.08, 0.05]}\n")
                .find("size_m: leave it out: compressible states it as sight_m"),
            std::string::npos);
  EXPECT_NE(FindMessage(std::string(kSmallest) + "compressible: {sight_m: [0.1, 0.08, 0.06]}\n")
                .find("the key \"force_n\" is missing"),
            std::string::npos);
}

TEST_F(ObjectFileTest, AnUnitIsNeverGuessed) {
  EXPECT_NE(FindMessage("name: mug\nmesh: mug.stl\nmass_kg: 1\nfriction_static: 0.3\n"
                        "friction_dynamic: 0.3\n")
                .find("the key \"mesh_unit\" is missing"),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
