#include "core/hand/import/import_record.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "core/base/text/json.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {

// SHA-256 of "abc": FIPS 180-4, example B.1.
TEST(ImportRecordTest, SaysWhatWasReadWithWhatAndWhatWasRepaired) {
  HandSource source;
  source.file = "/somebody/elsewhere/claw.urdf";
  source.palm_normal = Eigen::Vector3d(0, 0, 2);
  source.unit = 0.0254;
  source.folder = "/somebody/elsewhere/./urdf/";
  source.package_path = {"/somebody/ros/", "/somebody/elsewhere/urdf/own"};
  ImportedHand imported;
  Hand& hand = imported.hand;
  hand.links.resize(1);
  hand.links[0].name = "palm";
  imported.protrusions = {{"palm", 0.0123456}};
  Diagnostics problems;
  problems.Warn("claw.urdf", 12, "a limit is reversed; exchanged");
  const std::filesystem::path folder = testing::TempDir();
  const std::filesystem::path palm = folder / "a" / "palm.obj";
  const std::filesystem::path other = folder / "b" / "palm.obj";
  for (const auto& path : {palm, other}) {
    MakeFolder(path.parent_path());
    WriteFile(path, path == palm ? "abc" : "other");
  }
  const Json record = Json::parse(FormatImportRecord("abc", {palm, other}, source, "palm", imported,
                                                     problems, {{"hand.yaml", "abc"}}));
  const std::string hash = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  EXPECT_EQ(record["source"]["file"], "claw.urdf");
  EXPECT_EQ(record["source"]["sha256"], hash);
  EXPECT_EQ(record["files"]["hand.yaml"], hash);
  EXPECT_EQ(record["read"].size(), 2u);
  EXPECT_EQ(record["read"]["palm.obj"], hash);
  EXPECT_NE(record["read"]["palm.obj (2)"], hash);
  EXPECT_EQ(record["options"]["palm"], "palm");
  EXPECT_EQ(record["options"]["palm_normal"], Json::array({0.0, 0.0, 2.0}));
  EXPECT_EQ(record["options"]["unit_m"], 0.0254);
  EXPECT_EQ(record["options"]["package_path"], Json::array({"../../ros", "own"}));
  EXPECT_EQ(record["repairs"][0]["line"], 12);
  EXPECT_EQ(record["repairs"][0]["text"], "a limit is reversed; exchanged");
  EXPECT_EQ(record["guesses"]["palm"]["link"], "palm");
  EXPECT_EQ(record["protrusion"], Json::parse(R"([{"link": "palm", "outside_hull_mm": 12.35}])"));
}

TEST(ImportRecordTest, OfAnImportHasEveryRepairAndNoPath) {
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(kSmallGripper, MakeSourceWithoutMeshes(), "", problems);
  const Json record = Json::parse(imported.files.at("import.json"));
  EXPECT_EQ(record["repairs"].size(), problems.entries().size());
  EXPECT_EQ(record["files"].size() + 1, imported.files.size());
  EXPECT_EQ(record["guesses"]["digits"].size(), 2u);
}

}  // namespace
}  // namespace graspbench
