#include "human_study/study/run/analyse_study.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "human_study/study/synthetic/demo_study.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

TEST(AnalyseStudy, WritesTablesTidyDataAndBidsOfWhatItFinds) {
  const fs::path folder = fs::path(testing::TempDir()) / "analyse_study";
  fs::remove_all(folder);
  SyntheticOptions options;
  options.seed = "analyse_study_test";
  options.num_people = 2;
  options.trials_per_size = 1;
  options.diameters = {0.03, 0.06};
  WriteDemoStudy(MakeSyntheticStudy(options), folder / "in");
  const std::string yaml = ReadFile(folder / "in" / "study.yaml");
  WriteFileAtomically(folder / "in" / "study.yaml",
                      yaml +
                          "multiverse:\n  onset: []\n  cutoff_hz: []\n  detector: []\n"
                          "  opening: []\nbias_trials: 0\n");
  size_t num_rows = 0;
  const Study study = LoadStudy(folder / "in" / "study.yaml");
  const StudyResult result =
      AnalyseStudy(study, folder / "out", [&](size_t, size_t) { ++num_rows; });
  EXPECT_EQ(num_rows, 4u);
  ASSERT_EQ(result.trials.size(), 4u);
  const std::string measures = ReadFile(folder / "out" / "measures.csv");
  EXPECT_EQ(std::count(measures.begin(), measures.end(), '\n'), 1 + result.CountKept());
  EXPECT_TRUE(fs::exists(folder / "out" / "bids" / "dataset_description.json"));
  EXPECT_FALSE(fs::is_empty(folder / "out" / "tidy"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace graspbench
