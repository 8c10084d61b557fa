#include "workbench/shell/live_display.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "workbench/shell/shell_commands.h"

namespace graspbench {
namespace {

TEST(LiveDisplay, InAPipeNothingIsShownAndNothingWaits) {
  Shell shell;
  for (const std::string& card : ListLiveCards()) {
    testing::internal::CaptureStdout();
    EXPECT_EQ(shell.Execute("live " + card), Shell::Reply::kDone) << card;
    EXPECT_EQ(shell.live_card, card == "off" ? "" : card);
    {
      LiveDisplay display(shell);
      for (int i = 0; i < 50; ++i) {
        shell.scene().Advance();
        display.Tick();
      }
      display.Say("so far\n");
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "so far\n") << card;
  }
}

TEST(LiveDisplay, ItsCardsAreThoseOfTheCommand) {
  Shell shell;
  const std::vector<std::string> known = FindCompletions(shell, "live ");
  std::vector<std::string> cards = ListLiveCards();
  std::sort(cards.begin(), cards.end());
  EXPECT_EQ(known, cards);
}

}  // namespace
}  // namespace graspbench
