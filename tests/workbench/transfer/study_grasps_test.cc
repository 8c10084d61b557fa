#include "workbench/transfer/study_grasps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/files/files.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"
#include "human_study/study/synthetic/demo_study.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

/** Two synthetic people, one reach to each of two standing cylinders. */
class StudyGraspsTest : public testing::Test {
 protected:
  void SetUp() override {
    SyntheticOptions options;
    options.seed = "transfer";
    options.num_people = 2;
    options.trials_per_size = 1;
    options.diameters = {0.045, 0.06};
    WriteDemoStudy(MakeSyntheticStudy(options), folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string study() const { return (folder_ / "study.yaml").string(); }

  fs::path folder_ = fs::path(testing::TempDir()) / "study_grasps_test";
};

TEST_F(StudyGraspsTest, TakesTheKeptTrialsAndTheirMedians) {
  const StudyGrasps grasps = LoadStudyGrasps(study(), "");
  ASSERT_EQ(grasps.trials.size() + grasps.removed.size(), 4u);
  ASSERT_GE(grasps.trials.size(), 3u);
  const std::vector<StudyGrasp> medians = CalcMediansByPerson(grasps.trials);
  EXPECT_EQ(medians.size(), grasps.trials.size());  // one trial each
  EXPECT_EQ(medians.front().id, medians.front().participant);
  ASSERT_TRUE(medians.front().places) << medians.front().places.reason();
  EXPECT_EQ(MakePersonGrasp(*medians.front().places).digits.size(), 5u);
}

TEST_F(StudyGraspsTest, AnObjectIsMadeOfItsSize) {
  const Study two = LoadStudy(study());
  const auto object = LoadStudyObject(two, "cylinder_60mm", folder_);
  EXPECT_EQ(object->id, "cylinder_60mm");
  EXPECT_NEAR(object->size.x(), 0.06, 1e-4);
  EXPECT_NEAR(object->size.z(), kSyntheticObjectHeight, 1e-6);
  EXPECT_NEAR(object->mass_properties.mass, 300.0 * M_PI * 0.03 * 0.03 * 0.11, 1e-3);
  EXPECT_THROW(LoadStudyObject(two, "cup", folder_), Error);
}

TEST_F(StudyGraspsTest, WritesAGraspFileThatReadsBack) {
  const NewTransfer made =
      MakeNewTransfer({study(), "", "shadow", "", "cylinder_60mm"}, folder_ / "made");
  ASSERT_NE(made.file, "") << made.summary;
  EXPECT_NE(made.summary.find("LF"), std::string::npos);
  EXPECT_NE(made.summary.find("not determined"), std::string::npos);
  const Hand hand = LoadHand("shadow");
  const GraspFile read = ParseGraspFile(made.file, "grasp.yaml", {&hand});
  EXPECT_EQ(read.grasp.object, "cylinder_60mm");
  ASSERT_TRUE(read.grasp.placement);
}

// Wrong by 15 mm in diameter the surface is 7.5 mm away from where it is on the other object.
TEST_F(StudyGraspsTest, AnObjectOfAWrongSizeIsDoubted) {
  EXPECT_TRUE(LoadStudyGrasps(study(), "").doubts.empty());
  std::string table = ReadFile(folder_ / "objects.csv");
  const std::string size = "cylinder,0.06,";
  ASSERT_NE(table.find(size), std::string::npos) << table;
  table.replace(table.find(size), size.size(), "cylinder,0.045,");
  WriteFile(folder_ / "objects.csv", table);
  const std::vector<StudyDoubt> doubts = LoadStudyGrasps(study(), "").doubts;
  ASSERT_EQ(doubts.size(), 2u);  // of two objects either may be the wrong one
  EXPECT_EQ(doubts[1].object, "cylinder_60mm");
  EXPECT_NE(doubts[1].text.find("mm too small"), std::string::npos) << doubts[1].text;
  EXPECT_NE(doubts[1].text.find(" 7."), std::string::npos) << doubts[1].text;
}

// The synthetic people are right-handed.
TEST_F(StudyGraspsTest, AHandOfTheOtherSideIsNamed) {
  const std::string table = ReadFile(folder_ / "trials.csv");
  const auto state = [&](const std::string& hand) {
    std::string stated;
    for (size_t at = 0, end; at < table.size(); at = end + 1) {
      end = table.find('\n', at);
      stated += table.substr(at, end - at) + "," + (at == 0 ? "hand" : hand) + "\n";
    }
    WriteFile(folder_ / "trials.csv", stated);
    return LoadStudyGrasps(study(), "").trials.front().places;
  };
  EXPECT_TRUE(state("right"));
  const Answer<HandPlaces> places = state("Left");
  ASSERT_FALSE(places);
  EXPECT_NE(places.reason().find("states the left hand"), std::string::npos) << places.reason();
  EXPECT_NE(places.reason().find("is a right one"), std::string::npos) << places.reason();
}

TEST_F(StudyGraspsTest, UnknownTrialsAndObjectsAreNamed) {
  const auto find = [&](const std::string& trial, const std::string& object) -> std::string {
    try {
      MakeNewTransfer({study(), "", "tum", trial, object}, folder_ / "made");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(find("09-1", "").find("keeps no trial \"09-1\""), std::string::npos);
  EXPECT_NE(find("", "cup").find("is on \"cup\""), std::string::npos);
  EXPECT_NE(find("", "").find("--object"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
