#include <gtest/gtest.h>

#include "reports/kind_pages.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

std::vector<BasinSample> MakeSamples() {
  std::vector<BasinSample> samples = MakeBasinSamples(4);
  for (BasinSample& sample : samples) {
    sample.outcome = Outcome::kSuccess;
    sample.sigma = 1.25;
  }
  samples[3].outcome = Outcome::kNumericalFailure;
  return samples;
}

TEST(BasinPage, BeginsWithTheResultAndHasEverySample) {
  const std::string page =
      MakeBasinPage({"Hand, <can>, g1", "graspbench basin --hand x", MakeSamples()});
  ExpectSoundPage(page);
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const tinyxml2::XMLElement& root = *document.RootElement();
  EXPECT_EQ(ListText(*FindById(root, "result")).rfind("Result Hand, <can>, g1: basin radius", 0),
            0u);
  const std::string samples = ListText(*FindById(root, "samples"));
  ExpectParts(samples, {"All values of 4 samples", "numerical failure"});
  EXPECT_NE(ListText(*FindById(root, "findings")).find("1 sample failed numerically; "),
            std::string::npos);
  EXPECT_NE(ListText(*FindById(root, "provenance")).find("graspbench basin --hand x"),
            std::string::npos);
}

TEST(BasinPage, AGraspThatFailsWithoutOffsetIsAFinding) {
  std::vector<BasinSample> samples = MakeSamples();
  samples[0].outcome = Outcome::kPushedAway;
  const std::string page = MakeBasinPage({"t", "c", samples});
  ExpectParts(page, {"The grasp fails even without an offset"});
}

}  // namespace
}  // namespace graspbench
