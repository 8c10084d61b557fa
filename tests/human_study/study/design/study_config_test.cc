#include "human_study/study/design/study_config.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/config.h"
#include "core/base/text/yaml.h"
#include "tests/human_study/faults.h"
#include "tests/support/processor_time.h"

namespace graspbench {
namespace {

using Names = std::vector<std::string>;

/** A good study of five files. */
class StudyFolder : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    WriteGood();
  }
  void WriteGood() const {
    Write("study.yaml", kGood);
    Write("trials.csv", kTrials);
    Write("objects.csv", kObjects);
    Write("hypotheses.csv", "measure,slope,equal_within\npeak_opening_m,0.82,\n");
    Write("reviews.csv", "trial,digit,verdict\n01-1,index,\n01-1,thumb,confirmed\n");
  }
  Study Load() const { return LoadStudy(folder_ / "study.yaml"); }
  /** What a person is told, with the folder's name taken out. */
  std::string FindFault() const {
    std::string text = FaultOf([&] { Load(); });
    for (size_t at; (at = text.find(folder_.string() + "/")) != std::string::npos;) {
      text.erase(at, folder_.string().size() + 1);
    }
    return text;
  }

  static constexpr char kGood[] =
      "name: Test\n"
      "objects: objects.csv\n"
      "hypotheses: hypotheses.csv\n"
      "reviews: reviews.csv\n"
      "factors: [diameter_m, side]\n"
      "markers:\n"
      "  thumb: [thumb_tip, RTTI]\n"
      "  index: index_tip\n"
      "  object: top\n"
      "contact:\n"
      "  cutoff_hz: 15\n"
      "pad_offsets_m: {thumb: 0.01}\n";
  static constexpr char kTrials[] =
      "participant,file,object,diameter_m,side,start_s,remove,notes\n"
      "01,a.c3d,cup,0.1,left,0.5,,x\n"
      "01,b.c3d,ball,0.02,right,,looked away,x\n"
      "02,c.c3d,,0.02,left,,,x\n";
  static constexpr char kObjects[] =
      "object,shape,length_m,height_m,centre_x_m,centre_y_m,centre_z_m\n"
      "cup,cylinder,0.08,0.1,0,0,-0.02\n"
      "ball,sphere,0.06,,0,0,0\n";
};

TEST_F(StudyFolder, WrongFilesAreToldWithTheirLine) {
  Diagnostics problems;
  const YAML::Node cases =
      LoadYaml(FindDataRoot() / "tests/human_study/study/wrong_studies.yaml", problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  for (const YAML::Node& wrong : cases) {
    WriteGood();
    for (const auto& file : wrong) {
      const auto name = file.first.as<std::string>();
      if (name != "says") Write(name, file.second.as<std::string>());
    }
    ExpectHolds(FindFault(), wrong["says"].as<std::string>());
  }
  WriteGood();
  Write("trials.csv", std::string("\xff\xfep\0,\0\n\0", 8));
  ExpectHolds(FindFault(), "trials.csv: error: is UTF-16");
  EXPECT_EQ(FindFault().find("is missing"), std::string::npos) << "one fault is said once";
}

// Parts of one recording, wherever the same part stands in the table.
TEST_F(StudyFolder, OnePartOfARecordingCountsOnce) {
  Write("study.yaml", "markers: {thumb: t, index: i}\n");
  const auto write = [&](const std::string& rows) {
    Write("trials.csv", "participant,trial,file,start_s,end_s,hand,remove\n" + rows);
  };
  const std::string parts =
      "01,1,a.c3d,10,20,,\n01,2,a.c3d,0,4,,\n01,3,a.c3d,19,30,,\n01,4,a.c3d,3.5,9,,\n";
  for (const std::string copy : {"12,13", "9,21", "17,21", "19.5,19.9", "0,3", "24,"}) {
    write(parts + "01,5,a.c3d," + copy + ",,\n");
    ExpectHolds(FindFault(), "trials.csv:6: error: \"a.c3d\" is already in line ");
  }
  write(parts + "01,5,a.c3d,29,40,,\n");
  EXPECT_EQ(FindFault(), "");
  // Parts that follow each other, another hand, and what does not count.
  write(
      "01,1,a.c3d,,5,left,\n01,2,a.c3d,4.5,9,left,\n01,3,a.c3d,9,,left,\n"
      "01,4,a.c3d,,5,right,\n01,5,a.c3d,,5,left,a copy\n");
  EXPECT_EQ(FindFault(), "");
}

TEST_F(StudyFolder, TimeIsLinearInTrials) {
  Write("study.yaml", "markers: {thumb: t, index: i}\n");
  // Trials of one table, then parts of one recording.
  for (const bool is_table : {true, false}) {
    EXPECT_LT(FindTimeRatio([&](int num_trials) {
                std::string rows = "participant,file,table_trial,start_s,end_s\n";
                for (int i = 0; i < num_trials; ++i) {
                  const std::string number = std::to_string(i);
                  rows += is_table ? "01,a.csv," + number + ",,\n"
                                   : "01,a.csv,," + number + "," + number + ".9\n";
                }
                Write("trials.csv", rows);
                const Study study = Load();
                EXPECT_EQ(study.trials.size(), static_cast<size_t>(num_trials));
              }),
              8.0);
  }
}

TEST_F(StudyFolder, EveryThingWrittenArrives) {
  const Study study = LoadStudy(folder_ / "study.yaml", "elsewhere");
  EXPECT_EQ(study.config.name, "Test");
  EXPECT_EQ(study.config.markers.tips.thumb, (Names{"thumb_tip", "RTTI"}));
  EXPECT_EQ(study.config.markers.tips.index, (Names{"index_tip"}));
  EXPECT_TRUE(study.config.markers.tips.little.empty());
  EXPECT_EQ(study.config.analysis.contact.cutoff, 15.0);
  EXPECT_EQ(study.config.pad_offsets.thumb, 0.01);
  EXPECT_TRUE(std::isnan(study.config.pad_offsets.index));
  EXPECT_EQ(study.marker_lines.index, 8);
  EXPECT_EQ(study.FindHypothesis("peak_opening_m").slope, 0.82);
  EXPECT_TRUE(std::isnan(study.FindHypothesis("peak_opening_m").equal_within));
  EXPECT_EQ(study.FindHypothesis("movement_time_s").slope, 0.0);
  EXPECT_EQ(study.recordings, "elsewhere");

  ASSERT_EQ(study.trials.size(), 3u);
  EXPECT_EQ(study.trials[0].trial, "1");
  EXPECT_EQ(study.trials[1].trial, "2");
  EXPECT_EQ(study.trials[2].trial, "1");
  EXPECT_EQ(study.trials[1].remove, "looked away");
  EXPECT_EQ(study.trials[0].start, 0.5);
  EXPECT_TRUE(std::isinf(study.trials[0].end));
  EXPECT_EQ(study.trials[1].levels, (Names{"0.02", "right"}));

  ASSERT_EQ(study.factors.size(), 2u);  // numbers by size, names as they come
  EXPECT_EQ(study.factors[0].levels, (Names{"0.02", "0.1"}));
  EXPECT_EQ(study.factors[0].numbers, (std::vector<double>{0.02, 0.1}));
  EXPECT_EQ(study.factors[1].levels, (Names{"left", "right"}));
  EXPECT_TRUE(study.factors[1].numbers.empty());

  const StudyObject* cup = study.FindObject("cup");
  ASSERT_NE(cup, nullptr);
  EXPECT_NEAR(cup->distance({0.05, 0.0, 0.0}), 0.01, 1e-12);
  EXPECT_EQ(cup->p_MO_L, Eigen::Vector3d(0.0, 0.0, -0.02));
  EXPECT_NEAR(study.FindObject("ball")->distance({0.0, 0.0, 0.05}), 0.02, 1e-12);
  EXPECT_EQ(study.FindObject("bowl"), nullptr);

  ASSERT_EQ(study.warnings.entries().size(), 1u);
  ExpectHolds(study.warnings.Format(), "the column \"notes\" is not used");
}

TEST_F(StudyFolder, GroupsSessionsAndHandsArrive) {
  Write("study.yaml",
        "factors: [hand]\ngroups: [group]\nsession: day\n"
        "markers: {thumb: \"{hand}_thumb\", index: i}\n");
  Write("trials.csv",
        "participant,file,hand,group,day\n01,a,left,old,10\n01,b,right,old,9\n"
        "02,c,left,young,9\n");
  const Study study = Load();
  ASSERT_EQ(study.groups.size(), 1u);
  EXPECT_EQ(study.groups[0].levels, (Names{"old", "young"}));
  EXPECT_EQ(study.sessions, (Names{"9", "10"}));  // by number
  EXPECT_EQ(study.trials[1].groups, Names{"old"});
  EXPECT_EQ(study.trials[1].session, "9");
  EXPECT_EQ(study.trials[1].hand, "right");
  EXPECT_EQ(MarkersOfHand(study.config.markers, "right").tips.thumb, Names{"right_thumb"});
  // A group that was named as a factor is said, not refused.
  Write("study.yaml", "factors: [group]\nmarkers: {thumb: t, index: i}\n");
  Write("trials.csv", "participant,file,group\n01,a,old\n02,b,young\n");
  ExpectHolds(Load().warnings.Format(), "name it under groups");
}

TEST_F(StudyFolder, JointsOfADigitAreTwoOrMoreBesideItsTip) {
  Write("study.yaml",
        "markers:\n  thumb: t\n  index: \"{hand}_i\"\n  joints: {index: [\"{hand}_k\", d]}\n");
  Write("trials.csv", "participant,file,hand\n01,a.c3d,left\n");
  const Study study = Load();
  EXPECT_EQ(study.config.markers.joints.index, (Names{"{hand}_k", "d"}));
  EXPECT_EQ(MarkersOfHand(study.config.markers, "left").joints.index, (Names{"left_k", "d"}));
  Write("study.yaml", "markers: {thumb: t, index: i, joints: {index: [k], ring: [k, m]}}\n");
  const std::string text = FindFault();
  ExpectHolds(text, "markers.joints.index: expected two joints or more");
  ExpectHolds(text, "markers.joints.ring: the digit has no tip");
}

// The middle of markers on a solid's surface is not its centre.
TEST_F(StudyFolder, AShapeWithoutItsCentreIsWarnedOf) {
  const auto count = [&] {
    const Study study = Load();
    const std::string text = study.warnings.Format();
    return std::pair(study.warnings.entries().size(),
                     text.find("the centre of the solid is taken to be the middle of its markers"));
  };
  const auto [num_complete, nowhere] = count();
  EXPECT_EQ(nowhere, std::string::npos);
  Write("objects.csv",
        "object,shape,length_m,height_m,centre_z_m\ncup,cylinder,0.08,0.1,-0.02\n"
        "ball,sphere,0.06,,\n");
  const auto [num_incomplete, at] = count();
  EXPECT_NE(at, std::string::npos);
  EXPECT_EQ(num_incomplete, num_complete + 2);
  Write("objects.csv", "object\ncup\nball\n");  // no shape, no centre needed
  EXPECT_EQ(count().first, num_complete);
}

// Without a marker of the object its shape is nowhere, and a centre would not help.
TEST_F(StudyFolder, AShapeOfAnObjectWithoutMarkersIsNotUsed) {
  Write("study.yaml", "markers: {thumb: t, index: i}\nobjects: objects.csv\n");
  Write("objects.csv", "object,shape,length_m\ncup,sphere,0.08\nball,sphere,0.06\n");
  const std::string text = Load().warnings.Format();
  ExpectHolds(text, "objects.csv:2: warning: the shape is not used: markers.object is empty");
  EXPECT_EQ(text.find("centre_x_m"), std::string::npos) << text;
}

TEST(ParseStudyConfig, NoKeyLacksItsMeaning) {
  for (const FileKey& row : ListStudyKeys()) {
    EXPECT_NE(row.meaning, "") << row.key;
    EXPECT_NE(row.fallback, "") << row.key;
  }
  const FileKey* ring = FindFileKey(ListStudyKeys(), "pad_offsets_m.ring");
  ASSERT_NE(ring, nullptr);
  EXPECT_EQ(ring->meaning, "the same of the ring finger");
  EXPECT_EQ(ring->fallback, "learned from the holds");
  EXPECT_EQ(FormatRange(*ring), "0 to 0.05");
}

// What help says of a number's limits is what the reader keeps to.
TEST(ParseStudyConfig, EveryLimitIsChecked) {
  int num_checked = 0;
  for (const FileKey& key : ListStudyKeys()) {
    if (!std::isfinite(key.low) || key.key.find("multiverse") == 0) continue;
    Diagnostics problems;
    ParseStudyConfig("markers: {thumb: t, index: i, object: o}\n", "study.yaml", problems,
                     {key.key + "=-1"});
    ExpectHolds(problems.Format(), key.key + ": -1 is out of range; expected " + FormatRange(key));
    ++num_checked;
  }
  EXPECT_GT(num_checked, 30);
}

TEST_F(StudyFolder, EqualNumbersAreOneLevelAsFirstWritten) {
  Write("study.yaml", "factors: [size, pace]\nmarkers: {thumb: t, index: i}\n");
  Write("trials.csv",
        "participant,file,size,pace\nP00,a,10.0,10\nP01,b,0.030,1.0\np00,c,10,b\nP00,d,3e-2,1\n");
  const Study study = Load();
  EXPECT_EQ(study.factors[0].levels, (Names{"0.030", "10.0"}));
  EXPECT_EQ(study.factors[0].numbers, (std::vector<double>{0.03, 10.0}));
  EXPECT_EQ(study.trials[2].levels, (Names{"10.0", "b"}));
  // With one word among them they are names, and 1.0 and 1 two of them.
  EXPECT_EQ(study.factors[1].levels, (Names{"10", "1.0", "b", "1"}));
  EXPECT_TRUE(study.factors[1].numbers.empty());
  EXPECT_EQ(study.trials[3].levels, (Names{"0.030", "1"}));
  ExpectHolds(study.warnings.Format(),
              "trials.csv:4: warning: participant: \"p00\" and \"P00\" count as two; if they are "
              "one, spell them alike");
}

StudyConfig Parse(const std::string& text, const std::vector<std::string>& settings = {}) {
  Diagnostics problems;
  const StudyConfig config =
      ParseStudyConfig("markers: {thumb: t, index: i}\n" + text, "study.yaml", problems, settings);
  EXPECT_EQ(problems.num_errors(), 0) << problems.Format();
  return config;
}

TEST(StudyCutoffs, OnlyStatedKeysAreKept) {
  const StudyConfig config = Parse("contact: {cutoff_hz: 20}\n",
                                   {"multiverse.cutoff_hz=[8, 20]", "hold.rule=longest_rest"});
  EXPECT_EQ(config.analysis.stated_cutoffs,
            (std::set<std::string>{"contact.cutoff_hz", "multiverse.cutoff_hz"}));
  EXPECT_TRUE(Parse("opening: {measure: aperture}\n").analysis.stated_cutoffs.empty());
}

TEST(StudyCutoffs, WithoutAnyThatIsStatedEveryRateFits) {
  const StudyConfig config = Parse("");
  for (const double rate : {10.0, 25.0, 30.0, 50.0, 100.0, 240.0}) {
    EXPECT_EQ(FindCutoffFault(config, rate), "") << rate;
  }
  EXPECT_EQ(FitCutoffs(config, 100.0).multiverse.cutoff, config.multiverse.cutoff);
  for (const double cutoff : FitCutoffs(config, 30.0).multiverse.cutoff) EXPECT_LT(cutoff, 12.0);
}

// The filter allows less than 12 Hz at 30 Hz: all keys are named at once, and what is proposed fits.
TEST(StudyCutoffs, AStatedOneThatDoesNotFitIsRefusedWithAProposalThatFits) {
  StudyConfig config = Parse("contact: {cutoff_hz: 15}\nmultiverse: {cutoff_hz: [10, 20]}\n");
  EXPECT_EQ(FindCutoffFault(config, 30.0),
            "contact.cutoff_hz is 15, multiverse.cutoff_hz is 20; this recording of 30 Hz allows "
            "less than 12. Choose a lower one, or leave the key out: the cut-off then follows the "
            "rate");
  const std::vector<std::string> proposed = LowerStatedCutoffs(config, 30.0);
  EXPECT_EQ(proposed.size(), 2u);
  for (const std::string& setting : proposed) SetConfigValue(setting, config);
  EXPECT_EQ(FindCutoffFault(config, 30.0), "");
  // Rates counted from stamps and from their ends differ in the last digits: at the limit is above.
  const StudyConfig at_limit = Parse("contact: {cutoff_hz: 12}\n");
  EXPECT_NE(FindCutoffFault(at_limit, 30.000003), "");
  EXPECT_EQ(LowerStatedCutoffs(at_limit, 30.000003).size(), 1u);
}

}  // namespace
}  // namespace graspbench
