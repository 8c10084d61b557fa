#include "core/hand/import/write_hand.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/base/text/json.h"
#include "core/hand/hand.h"
#include "core/hand/import/guess_hand.h"
#include "core/hand/import/read_foreign_urdf.h"
#include "core/hand/import/select_hand.h"
#include "core/hand/load_hand.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {

TEST(WriteHandTest, WhatIsWrittenIsTheHand) {
  Diagnostics problems;
  std::string urdf = ReplaceOnce(kSmallGripper, "name=\"left\"", "name=\"l: #&quot;&lt;\"");
  urdf = ReplaceOnce(urdf, "child link=\"left\"", "child link=\"l: #&quot;&lt;\"");
  urdf = ReplaceOnce(urdf, "xyz=\"0 0 0.06\"", "xyz=\"0.001 0.002 0.06\" rpy=\"0.1 -0.2 0.3\"");
  urdf = ReplaceOnce(urdf, "<mimic joint=\"slide_left\"/>",
                     "<mimic joint=\"slide_left\" multiplier=\"0.5\" offset=\"0.002\"/>");
  ForeignHand foreign = ReadForeignUrdf(urdf, "g.urdf", problems);
  const int palm_link = SelectHand("", {}, "g.urdf", problems, foreign);
  const HandSource source = MakeSourceWithoutMeshes();
  ShapeLoader loader(source, problems);
  std::vector<LoadedShapes> shapes;
  for (const ForeignLink& link : foreign.links) shapes.push_back(loader.Load(link));
  ImportedHand imported = WeldLinks(foreign, palm_link, shapes, "g.urdf", problems);
  imported.hand.name = foreign.name;
  GuessHand("g.urdf", {}, imported, problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  const auto files = FormatHandFiles(imported, "g.urdf", problems);
  Diagnostics of_loading;
  const Hand hand = ParseHand(files.at("hand.urdf"), files.at("hand.yaml"), "x", of_loading);
  ASSERT_EQ(of_loading.Format(), "");

  EXPECT_EQ(hand.name, "parallel gripper ü");
  EXPECT_GE(hand.FindLink("l: #\"<"), 0);
  RandomStream random("write_hand_test", "q");
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd before(2), after(2);
    before[0] = random.NextUniform(0.0, 0.04);
    ApplyCoupling(imported.hand, before);
    EXPECT_NEAR(before[1], 0.002 + 0.5 * before[0], 1e-12);
    for (int j = 0; j < 2; ++j) {
      after[hand.FindJoint(imported.hand.joints[j].name)] = before[j];
    }
    for (const HandLink& link : hand.links) {
      const Pose X = CalcLinkPose(hand, after, hand.FindLink(link.name));
      const Pose Y = CalcLinkPose(imported.hand, before, imported.hand.FindLink(link.name));
      EXPECT_LT((X.matrix() - Y.matrix()).norm(), 1e-8) << link.name;
    }
  }
  for (const HandLink& link : hand.links) {
    const HandLink& other = imported.hand.links[imported.hand.FindLink(link.name)];
    EXPECT_NEAR(link.mass, other.mass, 1e-9);
    EXPECT_LT((link.I_LLcm - other.I_LLcm).norm(), 1e-9 * other.I_LLcm.norm() + 1e-15);
  }
}

TEST(WriteHandTest, MarksWhatIsAGuessAndTellsWhatWasRepaired) {
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(kSmallGripper, MakeSourceWithoutMeshes(), "", problems);
  const std::string& yaml = imported.files.at("hand.yaml");
  size_t num_guesses = 0;
  for (size_t at = yaml.find("guess"); at != std::string::npos; at = yaml.find("guess", at + 1)) {
    ++num_guesses;
  }
  EXPECT_GE(num_guesses, 10u);
  EXPECT_NE(imported.files.at("README.md").find("line 26: link \"right\": no <inertial>"),
            std::string::npos)
      << imported.files.at("README.md");
}

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
  ContactFit fit;
  fit.link = "palm";
  fit.num_balls = 12;
  fit.out = {0.0003, 0.0123456};
  imported.fits = {fit};
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
  EXPECT_EQ(record["contact"][0]["balls"], 12);
  EXPECT_EQ(record["contact"][0]["out"], Json::parse(R"({"at_95_mm": 0.3, "most_mm": 12.35})"));
}

TEST(ImportRecordTest, ItsContactHoldsWhileTheHandIsTheImportedOne) {
  const std::filesystem::path folder = testing::TempDir() + "/imported_fits";
  std::filesystem::remove_all(folder);
  MakeFolder(folder);
  EXPECT_TRUE(ReadContactFits(folder).empty());
  const ContactFit fit{"palm",       12, {3e-4, 5e-4}, {1e-4, 2e-4}, {6e-4, 7e-4},
                       {8e-4, 9e-4}, 8,  0.625};
  const Json record = {{"files", {{"hand.urdf", CalcSha256("<robot/>")}}},
                       {"contact", MakeContactJson({fit})}};
  WriteFile(folder / "import.json", FormatJson(record));
  WriteFile(folder / "hand.urdf", "<robot/>");
  const std::vector<ContactFit> fits = ReadContactFits(folder);
  ASSERT_EQ(fits.size(), 1u);
  EXPECT_EQ(fits[0].link, "palm");
  EXPECT_EQ(MakeContactJson(fits), record["contact"]);
  EXPECT_EQ(record["contact"][0]["self_contact"],
            Json::parse(R"({"capsules": 8, "within_5_mm": 0.625})"));
  WriteFile(folder / "hand.urdf", "<robot name='edited'/>");
  EXPECT_TRUE(ReadContactFits(folder).empty());
  WriteFile(folder / "import.json", "{}");
  EXPECT_THROW(ReadContactFits(folder), Error);
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
