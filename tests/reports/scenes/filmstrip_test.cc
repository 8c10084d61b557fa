#include "reports/scenes/filmstrip.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

std::string Draw(Outcome outcome) {
  TrialResult result;
  result.outcome = outcome;
  return DrawFilmstrip({{Moment::kClosed, 1.25, "abc"}, {Moment::kLifted, 2.5, "def"}}, result,
                       "a <hand>")
      .markup();
}

TEST(Filmstrip, OnlyASuccessIsShownInItsHold) {
  EXPECT_NE(Draw(Outcome::kSuccess).find(">Hold, 2.50 s<"), std::string::npos);
  EXPECT_NE(Draw(Outcome::kPushedAway).find(">End, 2.50 s<"), std::string::npos);
  EXPECT_EQ(Draw(Outcome::kPushedAway).find("Hold"), std::string::npos);
  EXPECT_NE(Draw(Outcome::kPushedAway).find(">Stabilisation, 1.25 s<"), std::string::npos);
}

TEST(Filmstrip, EveryPictureHasWordsInItsPlace) {
  const std::string html = Draw(Outcome::kSuccess);
  EXPECT_NE(html.find("alt=\"a &lt;hand&gt;: Hold\""), std::string::npos) << html;
  EXPECT_NE(html.find("data:image/webp;base64,YWJj"), std::string::npos) << html;
}

}  // namespace
}  // namespace graspbench
