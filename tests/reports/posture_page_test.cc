#include <gtest/gtest.h>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "reports/kind_pages.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

PosturePageData MakePostureData() {
  PosturePageData data;
  Hand hand = LoadHand("tum");
  hand.name = "TUM <Hand>";
  data.hand = std::make_shared<const Hand>(hand);
  data.config.seed = 7;
  data.config.budget = 1234;
  for (const Grasp& grasp : LoadStandardGrasps(hand)) {
    if (grasp.id != "g2" && grasp.id != "g3") continue;
    DevelopedGrasp& one = data.developed.emplace_back();
    one.grasp = one.proposed.grasp = grasp;
    one.proposed.aim.digits = grasp.digits;
    one.proposed.aim.opening = 0.0873;
    one.num_trials = 345;
    one.num_numerical_failures = 2;  // 0.6 %
    one.proposed_score = 0.61;
    one.score = 1.07;
  }
  DevelopmentStage race, check;
  race.name = "race";
  race.num_requests = 56;
  race.best_score = 0.91;
  race.tally.finished = 200;
  race.tally.outcomes[0] = 150;  // the first of all outcomes is success
  check.name = "check";
  check.num_requests = 1;
  check.tally.finished = 12;
  check.tally.outcomes[0] = 11;
  data.stages = {{race, check}};
  return data;
}

TEST(PosturePage, ShowsThePosturesAndWhy) {
  const PosturePageData data = MakePostureData();
  ASSERT_EQ(data.developed.size(), 2u);
  const std::string page = MakePosturePage(data);
  ExpectSoundPage(page);
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const std::string text = ListText(*document.RootElement());
  const double opening = CalcPreGraspWidth(*data.hand, data.developed[0].grasp);
  for (const std::string& expected :
       {std::string("TUM <Hand>"), std::string("Seed 7, budget 1234 trials"),
        std::string("345 2 0.61 1.07 11 of 12 trials"),
        std::string("race 56 200 150 of 200 trials"),
        "opening [mm] pre-grasp 87.3, at contact 8.0 " + FormatFixed(MmFromM(opening), 1)}) {
    EXPECT_NE(text.find(expected), std::string::npos) << expected << "\n\n" << text;
  }
  // Of the grasp whose trials are not known nothing is made up.
  ExpectParts(text, {"345 2 0.61 1.07 n/a"});
  // Two pictures of each grasp, or a note that there are none.
  const size_t num_pictures = ListAttribute(*document.RootElement(), "src").size();
  EXPECT_TRUE(num_pictures == 4 || text.find("No pictures") != std::string::npos);
  EXPECT_EQ(page, MakePosturePage(data));
}

TEST(PosturePage, NamesGraspsThatAreNotToBeReliedOn) {
  PosturePageData data = MakePostureData();
  EXPECT_EQ(MakePosturePage(data).find("Grasps to check"), std::string::npos);
  data.developed[1].check.assign(24, {Outcome::kNoContact, 0.2});
  data.developed[1].num_numerical_failures = 6;
  const std::string page = MakePosturePage(data);
  ExpectSoundPage(page);
  ExpectParts(page, {"g3: it held 0 of 24 shapes", "g3: 6 of 345 trials (1.7 %)"});
  EXPECT_EQ(page.find("g2: it held"), std::string::npos);
  data.developed[0].check.assign(24, {Outcome::kNoContact, 0.2});
  ExpectParts(MakePosturePage(data), {"g2, g3: it held 0 of 24 shapes", "g3: 6 of 345 trials"});
}

// A hand from elsewhere may have shapes to touch with and no pictures.
TEST(PosturePage, DrawsWhatTouchesOfAHandWithoutPictures) {
  PosturePageData data = MakePostureData();
  Hand bare = *data.hand;
  bare.visuals.clear();
  data.hand = std::make_shared<const Hand>(bare);
  data.developed.resize(1);
  const std::string page = MakePosturePage(data);
  ExpectSoundPage(page);
  if (page.find("No pictures") != std::string::npos) return;
  ExpectParts(page, {"so the contact shapes are drawn: balls of the pads (blue)"});
}

}  // namespace
}  // namespace graspbench
