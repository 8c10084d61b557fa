#include "core/base/error.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(SuggestNames, NamesTheClosestAndListsTheKnown) {
  EXPECT_EQ(SuggestNames("pencl", {"pencil", "cup"}),
            "; did you mean \"pencil\"? Known: pencil, cup");
}

TEST(SuggestNames, LettersExchangedAreOneFault) {
  EXPECT_EQ(SuggestNames("shwo", {"check", "show"}), "; did you mean \"show\"? Known: check, show");
  EXPECT_EQ(SuggestNames("hsow", {"show"}), "; did you mean \"show\"? Known: show");
  EXPECT_EQ(SuggestNames("hwso", {"show"}), ". Known: show");  // two exchanges
}

TEST(SuggestNames, ALongListDoesNotHideTheSuggestion) {
  const std::vector<std::string> nine = {"a1", "b2", "c3", "d4", "e5", "f6", "g7", "h8", "pencil"};
  EXPECT_EQ(SuggestNames("pencl", nine), "; did you mean \"pencil\"?");
  EXPECT_EQ(SuggestNames("cup", nine), ". Known: a1, b2, c3, d4, e5, f6, g7, h8, pencil");
}

TEST(SuggestNames, DoesNotGuessWhenNothingIsNear) {
  EXPECT_EQ(SuggestNames("xylophone", {"pencil", "cup"}), ". Known: pencil, cup");
  EXPECT_EQ(SuggestNames("a", {}), ". Known: none");
}

TEST(Diagnostics, TellsAllProblemsAtOnce) {
  Diagnostics problems;
  problems.Warn("hand.urdf", 3, "no visual");
  EXPECT_NO_THROW(problems.ThrowIfErrors(ErrorKind::kFormat, "bad hand"));
  problems.Fail("hand.urdf", 7, "zero mass");
  problems.Fail("hand.yaml", 0, "no digits");
  try {
    problems.ThrowIfErrors(ErrorKind::kFormat, "bad hand");
    FAIL() << "should have thrown";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kFormat);
    EXPECT_STREQ(e.what(),
                 "bad hand\nhand.urdf:3: warning: no visual\nhand.urdf:7: error: zero mass\n"
                 "hand.yaml: error: no digits");
  }
}

// An error within an error has lines of its own; none looks like an entry.
TEST(Diagnostics, LinesWithinAnEntryAreIndented) {
  Diagnostics problems;
  problems.Fail("a\nb.yaml", 2, "not found. Tried:\n    x.stl\ny.stl: error: \x1b");
  EXPECT_EQ(problems.Format(),
            "a\\u000ab.yaml:2: error: not found. Tried:\n    x.stl\n    y.stl: error: \\u001b");
}

}  // namespace
}  // namespace graspbench
