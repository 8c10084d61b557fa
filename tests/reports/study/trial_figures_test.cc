#include "reports/study/trial_figures.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/files/files.h"
#include "human_study/study/synthetic/demo_study.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {

namespace {

TEST(TrialFigures, ATrialIsSaidWithItsConditionAndWhyItWasRemoved) {
  StudyTrial trial;
  trial.id = "P1-2";
  trial.levels = {"0.03"};
  trial.analysis.emplace();
  trial.removed = "no hold";
  const std::string text = DescribeTrial(trial, {{"diameter_m", {"0.03"}, {0.03}, ""}});
  EXPECT_EQ(text.substr(0, text.find(": GFT")), "P1-2, diameter 30\u00A0mm");
  ExpectParts(text, {"removed: no hold"});
}

/** A trial whose speed and opening rise over a second. */
StudyTrial MakeTrial(const std::string& code) {
  StudyTrial trial;
  trial.id = "P1-2";
  trial.removed_code = code;
  trial.removed = code;
  trial.analysis.emplace();
  for (ScalarCurve* curve : {&trial.analysis->speed, &trial.analysis->opening}) {
    for (int i = 0; i <= 100; ++i) curve->times.push_back(0.01 * i);
    curve->values = Eigen::VectorXd::LinSpaced(101, 0.0, 0.1);
    curve->states.assign(101, SampleState::kMeasured);
  }
  DigitContactEvents thumb;
  thumb.digit = "TH";
  thumb.contact.time = 0.8;
  thumb.by_detector.assign(ContactDetectorList().size(), thumb.contact);
  trial.analysis->contacts = {thumb};
  return trial;
}

// The curve is that of the reason: speed with its threshold, or opening with the contacts.
TEST(TrialFigures, TheCurveThatRemovedATrialIsDrawn) {
  const std::string onset = DrawDecidingCurve(MakeTrial("no_onset"), MovementOptions()).markup();
  ExpectParts(onset, {"Speed of the wrist, trial P1-2", "threshold"});
  MovementOptions regression;
  regression.rule = "regression";
  EXPECT_EQ(DrawDecidingCurve(MakeTrial("no_onset"), regression).markup().find("threshold"),
            std::string::npos)
      << "that rule has none";
  const std::string contact =
      DrawDecidingCurve(MakeTrial("detectors_disagree"), MovementOptions()).markup();
  ExpectParts(contact, {"Hand opening, trial P1-2", "thumb"});
}

TEST(TrialFigures, SignsOfDetectorsAreExplainedInWords) {
  const std::string chart = DrawTrialContacts(MakeTrial("")).markup();
  for (const ContactDetector& detector : ContactDetectorList()) {
    EXPECT_NE(chart.find(std::string(" ") + detector.id + "<"), std::string::npos) << detector.id;
  }
}

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
    ExpectParts(page, {"Speed of the tips relative to the object",
                       "Distance of the markers from the surface", "breakpoint"});
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
