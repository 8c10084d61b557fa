#include "human_study/study/design/study_config.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/support/processor_time.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

/** A folder of files for one test. */
class StudyFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    Write("study.yaml", kGood);
    Write("trials.csv", kTrials);
    Write("objects.csv", kObjects);
    Write("hypotheses.csv", "measure,slope,equal_within\npeak_opening_m,0.82,\n");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  /** What a person is told, with the folder's name taken out. */
  std::string FindFault() const {
    try {
      LoadStudy(folder_ / "study.yaml");
      return "";
    } catch (const Error& error) {
      std::string text = error.what();
      for (size_t at; (at = text.find(folder_.string() + "/")) != std::string::npos;) {
        text.erase(at, folder_.string().size() + 1);
      }
      return text;
    }
  }
  void ExpectFault(const std::string& part) const {
    const std::string fault = FindFault();
    EXPECT_NE(fault.find(part), std::string::npos) << "\"" << part << "\" is missing in:\n"
                                                   << fault;
  }

  static constexpr char kGood[] =
      "name: Test\n"
      "objects: objects.csv\n"
      "hypotheses: hypotheses.csv\n"
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

  fs::path folder_;
};

TEST_F(StudyFolder, OneRecordingCountsOnce) {
  Write("study.yaml", "markers: {thumb: t, index: i}\n");
  const auto write = [&](const std::string& rows) {
    Write("trials.csv", "participant,trial,file,start_s,end_s,hand,remove\n" + rows);
  };
  write("01,1,a.c3d,,,,\n01,2,./a.c3d,,,,\n");
  ExpectFault("trials.csv:3: error: \"./a.c3d\" is already in line 2");
  write("01,1,a.c3d,,,,\n02,1,a.c3d,,,,\n");
  ExpectFault("trials.csv:3: error: \"a.c3d\" is already in line 2");
  write("01,1,a.c3d,0,4,,\n01,2,a.c3d,1,3,,\n");
  ExpectFault("trials.csv:3: error: \"a.c3d\" is already in line 2");
  // The same part, wherever the other one stands in the table.
  const std::string parts =
      "01,1,a.c3d,10,20,,\n01,2,a.c3d,0,4,,\n01,3,a.c3d,19,30,,\n01,4,a.c3d,3.5,9,,\n";
  for (const char* copy : {"12,13", "9,21", "17,21", "19.5,19.9", "0,3", "24,"}) {
    const std::string times(copy);
    write(parts + "01,5,a.c3d," + times + ",,\n");
    ExpectFault("trials.csv:6: error: \"a.c3d\" is already in line ");
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
                const Study study = LoadStudy(folder_ / "study.yaml");
                EXPECT_EQ(study.trials.size(), static_cast<size_t>(num_trials));
              }),
              8.0);
  }
}

TEST_F(StudyFolder, EveryThingWrittenArrives) {
  const Study study = LoadStudy(folder_ / "study.yaml", "elsewhere");
  EXPECT_EQ(study.config.name, "Test");
  EXPECT_EQ(study.config.markers.tips.thumb, (std::vector<std::string>{"thumb_tip", "RTTI"}));
  EXPECT_EQ(study.config.markers.tips.index, (std::vector<std::string>{"index_tip"}));
  EXPECT_TRUE(study.config.markers.tips.little.empty());
  EXPECT_EQ(study.config.analysis.contact.cutoff, 15.0);
  EXPECT_EQ(study.config.pad_offsets.thumb, 0.01);
  EXPECT_TRUE(std::isnan(study.config.pad_offsets.index));
  EXPECT_EQ(study.marker_lines.index, 7);
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
  EXPECT_EQ(study.trials[1].levels, (std::vector<std::string>{"0.02", "right"}));

  ASSERT_EQ(study.factors.size(), 2u);  // numbers by size, names as they come
  EXPECT_EQ(study.factors[0].levels, (std::vector<std::string>{"0.02", "0.1"}));
  EXPECT_EQ(study.factors[0].numbers, (std::vector<double>{0.02, 0.1}));
  EXPECT_EQ(study.factors[1].levels, (std::vector<std::string>{"left", "right"}));
  EXPECT_TRUE(study.factors[1].numbers.empty());

  const StudyObject* cup = study.FindObject("cup");
  ASSERT_NE(cup, nullptr);
  EXPECT_NEAR(cup->distance({0.05, 0.0, 0.0}), 0.01, 1e-12);
  EXPECT_EQ(cup->p_MO_L, Eigen::Vector3d(0.0, 0.0, -0.02));
  EXPECT_NEAR(study.FindObject("ball")->distance({0.0, 0.0, 0.05}), 0.02, 1e-12);
  EXPECT_EQ(study.FindObject("bowl"), nullptr);

  ASSERT_EQ(study.warnings.entries().size(), 1u);
  EXPECT_NE(study.warnings.Format().find("the column \"notes\" is not used"), std::string::npos);
}

/** Study.yaml with other factors, without tables beside trials.csv. */
std::string MakeDesignYaml(const std::string& design, const std::string& thumb = "t") {
  return design + "markers: {thumb: \"" + thumb + "\", index: i}\n";
}

TEST_F(StudyFolder, GroupsSessionsAndHandsArrive) {
  Write("study.yaml",
        MakeDesignYaml("factors: [hand]\ngroups: [group]\nsession: day\n", "{hand}_thumb"));
  Write("trials.csv",
        "participant,file,hand,group,day\n01,a,left,old,10\n01,b,right,old,9\n"
        "02,c,left,young,9\n");
  const Study study = LoadStudy(folder_ / "study.yaml");
  ASSERT_EQ(study.groups.size(), 1u);
  EXPECT_EQ(study.groups[0].levels, (std::vector<std::string>{"old", "young"}));
  EXPECT_EQ(study.sessions, (std::vector<std::string>{"9", "10"}));  // by number
  EXPECT_EQ(study.trials[1].groups, (std::vector<std::string>{"old"}));
  EXPECT_EQ(study.trials[1].session, "9");
  EXPECT_EQ(study.trials[1].hand, "right");
  EXPECT_EQ(MarkersOfHand(study.config.markers, "right").tips.thumb,
            (std::vector<std::string>{"right_thumb"}));
}

TEST_F(StudyFolder, FaultsOfTheDesignHaveTheirLine) {
  const auto expect = [&](const std::string& design, const std::string& trials,
                          const std::string& part) {
    Write("study.yaml", MakeDesignYaml(design));
    Write("trials.csv", trials);
    ExpectFault(part);
  };
  expect("groups: [grup]\n", "participant,file,group\n01,a,old\n",
         "the column \"grup\" is missing; did you mean \"group\"?");
  expect("groups: [group]\n", "participant,file,group\n01,a,old\n01,b,young\n",
         "trials.csv:3: error: group: participant 01 is \"young\" here and \"old\" in line 2");
  expect("groups: [group]\n", "participant,file,group\n01,a,\n",
         "trials.csv:2: error: group: empty");
  expect("session: day\n", "participant,file,day\n01,a,\n", "trials.csv:2: error: day: empty");
  expect("factors: [group]\ngroups: [group]\n", "participant,file,group\n01,a,old\n",
         "groups: \"group\" is listed twice");
  expect("groups: [=group]\n", "participant,file,=group\n01,a,old\n", "begins like a formula");
  Write("study.yaml", MakeDesignYaml("", "{hand}_thumb"));
  Write("trials.csv", "participant,file\n01,a\n");
  ExpectFault("trials.csv:2: error: hand: empty; the labels under markers contain {hand}");
  // A group that was named as a factor is said, not refused.
  Write("study.yaml", MakeDesignYaml("factors: [group]\n"));
  Write("trials.csv", "participant,file,group\n01,a,old\n02,b,young\n");
  EXPECT_NE(LoadStudy(folder_ / "study.yaml").warnings.Format().find("name it under groups"),
            std::string::npos);
}

// The middle of markers on a solid's surface is not its centre.
TEST_F(StudyFolder, AShapeWithoutItsCentreIsWarnedOf) {
  const auto count = [&] {
    const Study study = LoadStudy(folder_ / "study.yaml");
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
  const std::string text = LoadStudy(folder_ / "study.yaml").warnings.Format();
  EXPECT_NE(text.find("objects.csv:2: warning: the shape is not used: markers.object is empty"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("centre_x_m"), std::string::npos) << text;
}

TEST_F(StudyFolder, FaultsOfStudyYamlHaveTheirLine) {
  const auto expect = [&](const std::string& yaml, const std::string& part) {
    Write("study.yaml", yaml);
    ExpectFault(part);
  };
  const std::string markers = "markers: {thumb: t, index: i}\n";
  expect(markers + "contct: {cutoff_hz: 10}\n",
         "study.yaml:2: error: study: unknown key \"contct\"; did you mean \"contact\"?");
  expect(markers + "contact: {detector: brekpoint}\n", "study.yaml:2: error: contact.detector");
  expect(markers + "contact: {detector: brekpoint}\n", "did you mean \"breakpoint\"?");
  expect("markers: {index: i, middle: m}\n",
         "study.yaml:1: error: markers: name the marker of the "
         "thumb's tip and of at least one other digit");
  expect("markers: {thumb: t, index: [i, t]}\n",
         "study.yaml:1: error: markers.index: \"t\" is already markers.thumb");
  expect(markers + "cleaning:\n  max_gap_s: -1\n",
         "study.yaml:3: error: cleaning.max_gap_s: -1 is out of range; expected 0 to 5");
  expect(markers + "task: reach to grasp\n",
         "task: \"reach to grasp\"; expected letters and digits");
  expect(markers + "cut: {near_m: 0.1, far_m: 0.05}\n",
         "cut.far_m: must be larger than cut.near_m");
  expect(markers + "measures: [grasp_forming_tim_s]\n", "did you mean \"grasp_forming_time_s\"?");
  expect(markers + "multiverse: {opening: [apertur]}\n", "did you mean \"aperture\"?");
  expect(markers + "lift_off:\n  up_z: 0\n",
         "study.yaml:3: error: lift_off.up_z: is 0, up_x 0 and up_y 0, which is no direction; "
         "expected the one of the lift in the recording, for instance up_z: 1");
  expect(markers + "trials: nothing.csv\n", "study.yaml:2: error: trials: ");
  expect("markers: [", "study.yaml:1: error: not valid YAML");
}

TEST_F(StudyFolder, FaultsOfTheTablesHaveTheirLine) {
  const auto expect = [&](const std::string& name, const std::string& text,
                          const std::string& part) {
    SetUp();
    Write(name, text);
    ExpectFault(part);
  };
  expect(
      "trials.csv", "participnt,file,diameter_m,side\n01,a,1,l\n",
      "trials.csv:1: error: the column \"participant\" is missing; did you mean \"participnt\"?");
  expect("trials.csv", "participant,file,side\n01,a,l\n",
         "trials.csv:1: error: the column \"diameter_m\" is missing");
  expect("trials.csv", "participant,file,diameter_m,side\n01,a,1\n",
         "trials.csv:2: error: 3 cells; expected 4");
  expect("trials.csv", "participant,file,diameter_m,side\n01,a,1,\n",
         "trials.csv:2: error: side: empty; expected the trial's condition");
  expect("trials.csv", "participant,file,diameter_m,side,start_s,end_s\n01,a,1,l,2,1\n",
         "trials.csv:2: error: end_s must be later than start_s");
  expect("trials.csv", "participant,file,diameter_m,side,start_s\n01,a,1,l,soon\n",
         "trials.csv:2: error: start_s: \"soon\" is not a number");
  expect("trials.csv", "participant,file,diameter_m,side,object\n01,a,1,l,cupp\n",
         "trials.csv:2: error: object \"cupp\" is not in objects.csv; did you mean \"cup\"?");
  expect("trials.csv", "participant,trial,file,diameter_m,side\n01,7,a,1,l\n01,7,b,1,l\n",
         "trials.csv:3: error: participant 01 has trial 7 already in line 2");
  expect("trials.csv", "participant,file,diameter_m,side\n", "trials.csv: error: holds no rows");
  expect("trials.csv", std::string("\xff\xfep\0,\0\n\0", 8), "trials.csv: error: is UTF-16");
  EXPECT_EQ(FindFault().find("is missing"), std::string::npos) << "one fault is said once";
  expect("objects.csv", "object,shape,length_m\ncup,cylindre,0.1\n",
         "objects.csv:2: error: shape \"cylindre\" is not known; did you mean \"cylinder\"?");
  expect("objects.csv", "object,shape,length_m\ncup,box,0.1\n",
         "objects.csv:2: error: box needs width_m, a length above 0 and below 10");
  expect("objects.csv", "object,shape\nmugg,catalogue\n", "objects.csv:2: error: ");
  expect("hypotheses.csv", "slope\n1\n",
         "hypotheses.csv:1: error: the column \"measure\" is missing");
  expect("hypotheses.csv", "measure,slope\npeak_opening,1\n",
         "hypotheses.csv:2: error: measure \"peak_opening\" is not known; did you mean "
         "\"peak_opening_m\"?");
  expect("hypotheses.csv", "measure,slope\npeak_opening_m,1\npeak_opening_m,2\n",
         "hypotheses.csv:3: error: \"peak_opening_m\" is listed twice");
  expect("hypotheses.csv", "measure,equal_within\npeak_opening_m,0\n",
         "hypotheses.csv:2: error: equal_within: expected more than 0");
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
    EXPECT_NE(
        problems.Format().find(key.key + ": -1 is out of range; expected " + FormatRange(key)),
        std::string::npos)
        << problems.Format();
    ++num_checked;
  }
  EXPECT_GT(num_checked, 30);
}

TEST(ParseStudyConfig, SettingsGoOverTheFile) {
  Diagnostics problems;
  const std::string text = "markers: {thumb: t, index: i}\ncontact: {detector: speed}\n";
  const StudyConfig config =
      ParseStudyConfig(text, "study.yaml", problems, {"contact.detector=surface"});
  EXPECT_EQ(problems.num_errors(), 0);
  EXPECT_EQ(config.analysis.contact.detector, "surface");
}

TEST(ParseStudyConfig, AFactorThatBeginsLikeAFormulaIsRefused) {
  Diagnostics problems;
  ParseStudyConfig("factors: [\"=A1\"]\nmarkers: {thumb: t, index: i}\n", "study.yaml", problems);
  EXPECT_NE(problems.Format().find("begins like a formula"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
