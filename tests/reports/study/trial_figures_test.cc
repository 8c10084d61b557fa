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

TEST(TrialFigures, CodesOfDetectorsDiffer) {
  std::vector<std::string> codes;
  for (const ContactDetector& detector : ContactDetectorList()) {
    for (const std::string& other : codes) EXPECT_NE(CodeOfDetector(detector), other);
    codes.push_back(CodeOfDetector(detector));
  }
}

}  // namespace
}  // namespace graspbench
