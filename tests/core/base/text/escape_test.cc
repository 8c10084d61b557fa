#include "core/base/text/escape.h"

#include <gtest/gtest.h>

#include "core/base/text/text.h"

namespace graspbench {
namespace {

TEST(EscapeForTerminal, LeavesHarmlessTextAlone) {
  for (const std::string text : {"", "plain, \"quoted\" \\n", "two\nlines\tand a tab",
                                 "Gr\u00f6\u00dfe \u03c3 \u4e2d \U0001F91A", "no\u00a0break"}) {
    EXPECT_EQ(EscapeForTerminal(text), text);
  }
}

TEST(EscapeForTerminal, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(EscapeForTerminal("\x1b[31mred"), "\\u001b[31mred");
  EXPECT_EQ(EscapeForTerminal("bell\a, return\r, delete\x7f"),
            "bell\\u0007, return\\u000d, delete\\u007f");
  EXPECT_EQ(EscapeForTerminal(std::string_view("nul\0", 4)), "nul\\u0000");
  EXPECT_EQ(EscapeForTerminal("\u009b31m"), "\\u009b31m");  // CSI in one character
  EXPECT_EQ(EscapeForTerminal("\u202ecod.exe"), "\\u202ecod.exe");
  EXPECT_EQ(EscapeForTerminal("\u2066\u2069\u200f\u061c\u2028"),
            "\\u2066\\u2069\\u200f\\u061c\\u2028");
}

TEST(EscapeForTerminal, ShowsBytesThatAreNoUtf8) {
  EXPECT_EQ(EscapeForTerminal("a\xff\xfe z"), "a\\xff\\xfe z");
  EXPECT_EQ(EscapeForTerminal("\x9b"
                              "31m"),
            "\\x9b31m");                                           // an 8-bit terminal's CSI
  EXPECT_EQ(EscapeForTerminal("\xc0\x9b"), "\\xc0\\x9b");          // overlong
  EXPECT_EQ(EscapeForTerminal("cut \xe4\xb8"), "cut \\xe4\\xb8");  // half a character
}

TEST(EscapeForTerminal, KeepsACellOnItsLine) {
  EXPECT_EQ(EscapeForTerminal("a\nb\tc", LineFeeds::kEscape), "a\\u000ab\tc");
}

// Whatever the bytes: valid text comes out, and no byte that a terminal obeys.
TEST(EscapeForTerminal, NothingGetsThrough) {
  unsigned state = 1;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes;
    for (int k = 0; k < 20; ++k) {
      state = state * 1664525u + 1013904223u;
      bytes += static_cast<char>(state >> 24);
    }
    const std::string safe = EscapeForTerminal(bytes);
    EXPECT_TRUE(IsUtf8(safe));
    for (const char c : safe) {
      EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') << safe;
      EXPECT_NE(c, '\x7f');
    }
    EXPECT_EQ(EscapeForTerminal(safe), safe);
  }
}

}  // namespace
}  // namespace graspbench
