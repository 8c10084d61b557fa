#include "human_study/study/design/study_freeze.h"

#include <gtest/gtest.h>

#include "human_study/study/design/study_config.h"
#include "tests/human_study/faults.h"

namespace graspbench {
namespace {

class StudyFreeze : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    Write("study.yaml",
          "name: Pilot\nmarkers: {thumb: t, index: i}\nhypotheses: hypotheses.csv\n"
          "contact: {cutoff_hz: 15}\n");
    Write("hypotheses.csv", "measure,equal_within\ngrasp_forming_time_s,0.01\n");
  }
  void WriteTrials() { Write("trials.csv", "participant,file\n01,a.tsv\n01,b.tsv\n"); }
  void Freeze() { Write("study.freeze.json", MakeFreeze(folder_ / "study.yaml")); }
  std::vector<std::string> Deviations(const std::vector<std::string>& settings = {}) {
    return ListDeviations(LoadStudy(folder_ / "study.yaml", {}, settings));
  }
  std::string Fault() {
    const std::string text = FaultOf([&] { LoadStudy(folder_ / "study.yaml"); });
    return text.empty() ? text : text.substr(text.find("study.freeze.json"));
  }
};

TEST_F(StudyFreeze, BeforeTheDataAndNothingChanged) {
  Freeze();  // there is no trials.csv yet
  const std::string before = Read("study.freeze.json");
  EXPECT_EQ(MakeFreeze(folder_ / "study.yaml"), before);
  WriteTrials();
  const Study study = LoadStudy(folder_ / "study.yaml");
  ASSERT_TRUE(study.freeze);
  EXPECT_TRUE(study.freeze->deviations.empty());
  EXPECT_EQ(DescribeFreeze(study), "Choices frozen before any recording (SHA-256 " +
                                       study.freeze->hash.substr(0, 12) + "): no deviation.");
  std::filesystem::remove(folder_ / "study.freeze.json");
  EXPECT_FALSE(LoadStudy(folder_ / "study.yaml").freeze);
}

TEST_F(StudyFreeze, EveryDeviationIsNamedWithBothValues) {
  WriteTrials();
  Write("a.tsv", "anything");
  Freeze();
  EXPECT_EQ(Deviations({"contact.cutoff_hz=12", "contact.detector=speed"}),
            (std::vector<std::string>{"contact.cutoff_hz: frozen 15.0, used 12.0",
                                      "contact.detector: frozen \"auto\", used \"speed\""}));
  Write("study.yaml",
        "name: Another title\nmarkers: {thumb: t, index: [i, j]}\nhypotheses: hypotheses.csv\n"
        "contact: {cutoff_hz: 15}\n");
  EXPECT_EQ(Deviations(),
            (std::vector<std::string>{"markers.index.1: frozen nothing, used \"j\""}));
  Write("hypotheses.csv", "measure,equal_within\ngrasp_forming_time_s,0.02\n");
  const std::vector<std::string> two = Deviations();
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[1].find("table hypotheses: frozen SHA-256 "), 0u) << two[1];
  const std::string text = DescribeFreeze(LoadStudy(folder_ / "study.yaml"));
  EXPECT_EQ(text.find("Choices frozen when 1 recording was there already (SHA-256 "), 0u) << text;
  ExpectHolds(text, "): 2 deviations.");
}

TEST_F(StudyFreeze, RowsThatChangeOrGoDeviateAndNewOnesDoNot) {
  Write("study.yaml",
        "markers: {thumb: t, index: i}\nfactors: [pace]\nrecording: {mapping: columns.yaml}\n");
  Write("columns.yaml", "unit: mm\n");
  const std::string head = "participant,file,pace,note\n";
  Write("trials.csv", head + "01,a.tsv,slow,\n01,b.tsv,fast,\n02,c.tsv,slow,\n02,d.tsv,fast,\n");
  Freeze();
  Write("trials.csv", head +
                          "01,a.tsv,slow,tired\n01,b.tsv,fast,\n02,c.tsv,slow,\n"
                          "02,d.tsv,fast,\n03,e.tsv,slow,\n");
  EXPECT_EQ(Deviations(), std::vector<std::string>{});
  Write("trials.csv", head + "01,a.tsv,fast,\n01,b.tsv,slow,\n02,c.tsv,slow,\n");
  EXPECT_EQ(Deviations(),
            (std::vector<std::string>{
                "trials.csv: frozen trial 02-2, used no such row",
                "trials.csv, pace of trial 01-1 and 1 more: frozen \"slow\", used \"fast\""}));
  Write("trials.csv", head + "01,a.tsv,slow,\n01,b.tsv,fast,\n02,c.tsv,slow,\n02,d.tsv,fast,\n");
  Write("columns.yaml", "unit: cm\n");
  const std::vector<std::string> mapping = Deviations();
  ASSERT_EQ(mapping.size(), 1u);
  EXPECT_EQ(mapping[0].find("table recording.mapping: frozen SHA-256 "), 0u) << mapping[0];
}

TEST_F(StudyFreeze, AFileThatIsNoFreezeOrWasTouchedIsRefused) {
  WriteTrials();
  Freeze();
  const std::string good = Read("study.freeze.json");
  const std::string none =
      "study.freeze.json: this is no file of \"graspbench study freeze\"; remove it, or bring the "
      "frozen one back";
  for (const char* bad : {"", "{", "[]", "{}", "{\"what\": 1, \"sha256\": \"x\"}"}) {
    Write("study.freeze.json", bad);
    EXPECT_EQ(Fault(), none) << bad;
  }
  std::string touched = good;
  touched.replace(touched.find("15.0"), 4, "12.0");
  Write("study.freeze.json", touched);
  EXPECT_EQ(Fault(),
            "study.freeze.json: the frozen choices were changed since they were written (their "
            "SHA-256 does not fit); bring the frozen file back, or remove it and say so");
  // Any other byte: refused with a message, or without weight (white space).
  for (size_t i = 0; i < good.size(); i += 41) {
    std::string damaged = good;
    damaged[i] = '\x01';
    Write("study.freeze.json", damaged);
    EXPECT_NE(Fault(), "") << i;
  }
  Write("study.yaml", "markers: {thumb: t}\n");
  EXPECT_THROW(MakeFreeze(folder_ / "study.yaml"), Error);
}

}  // namespace
}  // namespace graspbench
