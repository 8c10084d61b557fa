#include "reports/study/trial_figures.h"

#include <gtest/gtest.h>

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
  EXPECT_NE(text.find("removed: no hold"), std::string::npos) << text;
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
  EXPECT_NE(onset.find("Speed of the wrist, trial P1-2"), std::string::npos);
  EXPECT_NE(onset.find("threshold"), std::string::npos);
  MovementOptions regression;
  regression.rule = "regression";
  EXPECT_EQ(DrawDecidingCurve(MakeTrial("no_onset"), regression).markup().find("threshold"),
            std::string::npos)
      << "that rule has none";
  const std::string contact =
      DrawDecidingCurve(MakeTrial("detectors_disagree"), MovementOptions()).markup();
  EXPECT_NE(contact.find("Hand opening, trial P1-2"), std::string::npos);
  EXPECT_NE(contact.find("thumb"), std::string::npos);
}

TEST(TrialFigures, SignsOfDetectorsAreExplainedInWords) {
  const std::string chart = DrawTrialContacts(MakeTrial("")).markup();
  for (const ContactDetector& detector : ContactDetectorList()) {
    EXPECT_NE(chart.find(std::string(" ") + detector.id + "<"), std::string::npos) << detector.id;
  }
}

}  // namespace
}  // namespace graspbench
