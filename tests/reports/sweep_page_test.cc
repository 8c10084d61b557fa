#include <gtest/gtest.h>

#include "reports/kind_pages.h"
#include "reports/page/paper.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

/** Three factors of two levels, all combinations; under the second level of the third nobody
fails. */
Session MakeCubeSession() {
  Session session;
  const char* settings[] = {"model.mass_scale=2.0", "model.friction_scale=0.8", "sim.step_s=0.001"};
  for (int c = 1; c < 8; ++c) {
    Condition condition;
    for (int f = 0; f < 3; ++f) {
      if (c & (1 << f)) condition.settings.push_back(settings[f]);
    }
    condition.name = "condition " + std::to_string(c);
    session.config.conditions.push_back(condition);
  }
  for (int object = 0; object < 6; ++object) {
    for (int c = 0; c < 8; ++c) {
      TrialRecord record;
      record.plan = {"id" + std::to_string(session.plan.size()),
                     "tum",
                     "<object" + std::to_string(object) + ">",
                     "g1",
                     0,
                     std::nullopt};
      if (c > 0) record.plan.condition = "condition " + std::to_string(c);
      record.result.outcome = (c & 4) || object > c % 4 ? Outcome::kSuccess : Outcome::kNoContact;
      record.result.stability.sigma = 1.0 + c + 0.1 * object * (c & 3);
      session.plan.push_back(record.plan);
      session.records.push_back(record);
    }
  }
  return session;
}

TEST(SweepPage, ShowsAMapForEachLevelOfTheThirdFactorAndSaysWhatCannotBeDecided) {
  const Session session = MakeCubeSession();
  const std::string page = MakeSweepPage(session, SummariseSweep(session, {}));
  ExpectParts(page,
              {"3 factors, 8 conditions, 48 of 48 planned trials finished", "sim.step_s=0.002",
               "sim.step_s=0.001", "success [%], tum: model.mass_scale by model.friction_scale",
               "tum: success from 33.3 % (condition 3) to 100.0 % (condition 4), 83.3 % (base); ",
               "success not testable: all 6 trials succeed", "sigma [N]", "Interactions"});
  EXPECT_EQ(page.find("breaking force [N], tum:"), std::string::npos) << "nobody judged";
}

// The first figure is the effects', maps come behind it.
TEST(SweepPage, LeadsWithAPictureOfTheEffects) {
  const Session session = MakeCubeSession();
  const std::string page = MakeSweepPage(session, SummariseSweep(session, {}));
  const size_t effects =
      page.find("Change of success [%] by each level, tum, relative to the base level");
  const size_t maps = page.find("model.mass_scale by model.friction_scale");
  EXPECT_LT(effects, maps);
  EXPECT_NE(page.find("6 pairs of 6 objects"), std::string::npos);
  const std::vector<PaperFile> files = MakePaperFiles(page, PaperParts::kShown);
  EXPECT_EQ(files.front().name, "figures/fig-01-change-of-success-by.svg");
  for (const PaperFile& file : files) {
    EXPECT_EQ(file.name.find("versions"), std::string::npos) << file.name;
  }
}

TEST(SweepPage, BearsASweepInWhichNothingHasRun) {
  Session session = MakeCubeSession();
  session.records.clear();
  EXPECT_NE(MakeSweepPage(session, SummariseSweep(session, {})).find("no trial is finished"),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
