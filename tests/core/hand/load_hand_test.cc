#include "core/hand/load_hand.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace graspbench {
namespace {

TEST(LoadHandTest, EveryHandOfTheProjectIsFreeOfProblems) {
  EXPECT_EQ(ListHands(), (std::vector<std::string>{"shadow", "tum", "tum-original"}));
  for (const std::string& id : ListHands()) {
    Diagnostics problems;
    CheckHand(id, problems);
    EXPECT_EQ(problems.Format(), "") << id;
  }
}

TEST(LoadHandTest, SuggestsTheNameOfAMisspeltHand) {
  try {
    LoadHand("shadw");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kNotFound);
    EXPECT_STREQ(e.what(),
                 "no hand and no folder \"shadw\"; did you mean \"shadow\"? Known: shadow, tum, "
                 "tum-original");
  }
}

}  // namespace
}  // namespace graspbench
