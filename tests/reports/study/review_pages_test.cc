#include "reports/study/review_pages.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/files/files.h"
#include "human_study/study/synthetic/demo_study.h"
#include "reports/study/trial_figures.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

TEST(ReviewPages, EveryTrialHasAPageAndEveryDigitARow) {
  const fs::path folder = fs::path(::testing::TempDir()) / "review_pages_test";
  fs::remove_all(folder);
  SyntheticOptions options;
  options.seed = "review_pages_test";
  options.num_people = 1;
  options.trials_per_size = 1;
  options.diameters = {0.03, 0.06};
  WriteDemoStudy(MakeSyntheticStudy(options), folder / "input");
  const Study study = LoadStudy(folder / "input" / "study.yaml", {}, {"bias_trials=0"});
  ReviewPages pages(folder / "out");
  StudyWatch watch;
  watch.on_analysed = [&](const StudyTrial& trial, const ReachTrial& reach) {
    pages.WriteTrial(trial, reach, study.factors, study.config.analysis);
  };
  const StudyResult result = RunStudy(study, watch);
  pages.Finish(result);
  int num_pages = 0;
  for (const auto& entry : fs::directory_iterator(folder / "out" / "trials")) {
    const std::string page = ReadFile(entry.path());
    tinyxml2::XMLDocument document;
    ParsePage(page, document);
    for (const char* part : {"Speed of the tips against the object",
                             "Distance of the markers from the surface", "breakpoint"}) {
      EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    ++num_pages;
  }
  EXPECT_EQ(num_pages, 2);
  const std::string verdicts = ReadFile(folder / "out" / "reviews.csv");
  EXPECT_EQ(verdicts.substr(0, verdicts.find('\n')),
            "trial,digit,verdict,contact_s,uncertainty_s,by,note");
  EXPECT_EQ(std::count(verdicts.begin(), verdicts.end(), '\n'), 1 + 2 * 5);
  // The file as it is names no verdict, and so changes nothing.
  fs::copy_file(folder / "out" / "reviews.csv", folder / "input" / "reviews.csv");
  const Study again =
      LoadStudy(folder / "input" / "study.yaml", {}, {"bias_trials=0", "reviews=reviews.csv"});
  EXPECT_TRUE(again.reviews.empty());
  fs::remove_all(folder);
}

}  // namespace
}  // namespace graspbench
