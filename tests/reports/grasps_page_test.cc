#include <gtest/gtest.h>

#include "reports/kind_pages.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

const Json kConfig = {
    {"hand", "shadow"},
    {"unread", {{{"name", "b.npy"}, {"reason", "unknown joint <X>"}}}},
    {"profiles",
     {{{"name", "own"},
       {"values", {{"about", "ours"}, {"max_shift_m", 0.05}, {"max_turn_deg", 15.0}}}}}}};

TEST(GraspsPage, ShowsVerdictsWithTheirProfileAndReason) {
  std::vector<JudgedGrasp> judged(2);
  for (size_t i = 0; i < judged.size(); ++i) {
    judged[i].source = "a.npy";
    judged[i].index = static_cast<int>(i);
    judged[i].profile = "own";
    judged[i].label = "success";
    judged[i].result.passed = i == 0;
    judged[i].result.worst_shift = 0.04;
  }
  judged[1].result.failed_stage = "push -y";
  judged[1].result.reason = "0.2 s into the push -y the object has moved 51.0 mm";
  const std::string page =
      MakeGraspsPage(kConfig, judged, SummariseJudged(judged, FindLimits(kConfig)));
  EXPECT_NE(page.find("9.5 to 90.5"), std::string::npos) << "Wilson's interval of 1 of 2";
  ExpectParts(page, {"0.2 s into the push -y the object has moved 51.0 mm", "a.npy, grasp 1",
                     "unknown joint &lt;X&gt;"});
}

TEST(GraspsPage, BearsAnEmptyStore) {
  const std::vector<JudgedGrasp> none;
  const std::string page =
      MakeGraspsPage(kConfig, none, SummariseJudged(none, FindLimits(kConfig)));
  ExpectParts(page, {"No grasp was tested."});
}

}  // namespace
}  // namespace graspbench
