#include "core/base/text/text.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "core/base/random.h"

namespace graspbench {
namespace {

TEST(Format, RoundsWithoutASignOfZeroAndNamesWhatIsMissing) {
  EXPECT_EQ(FormatFixed(1234567.0, 0), "1234567");
  EXPECT_EQ(FormatFixed(-2.345, 1), "-2.3");
  EXPECT_EQ(FormatFixed(-0.0004, 3), "0.000");
  EXPECT_EQ(FormatFixed(std::nan(""), 3), "n/a");
  EXPECT_EQ(FormatSignificant(123456.0, 3), "1.23e+05");
  EXPECT_EQ(FormatSignificant(-0.0, 3), "0");
  EXPECT_EQ(FormatPercent(INFINITY), "n/a");
}

// The standard library's own conversion, of doubles of every magnitude.
TEST(Format, EveryDigitIsThatOfTheStandardLibrary) {
  RandomStream random("text_test", "doubles");
  int num_compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const double value = std::ldexp(random.NextUniform(1.0, 2.0), random.NextIndex(160) - 80);
    const int digits = 1 + random.NextIndex(17);
    char text[128];
    const char* end =
        std::to_chars(text, text + sizeof text, -value, std::chars_format::general, digits).ptr;
    ASSERT_EQ(FormatSignificant(-value, digits),
              std::string(text, static_cast<size_t>(end - text)));
    end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, digits).ptr;
    ASSERT_EQ(FormatFixed(value, digits), std::string(text, static_cast<size_t>(end - text)));
    ++num_compared;
  }
  EXPECT_EQ(num_compared, 20000);
}

TEST(Format, CountsKnowTheirPlural) {
  EXPECT_EQ(FormatCount(1, "trial"), "1 trial");
  EXPECT_EQ(FormatCount(0, "trial"), "0 trials");
  EXPECT_EQ(FormatCount(2, "vertex is", "vertices are"), "2 vertices are");
  EXPECT_EQ(FormatCount(5'000'000'000, "byte"), "5000000000 bytes");
}

TEST(PlainKey, IsReadableAndNeverShared) {
  EXPECT_EQ(MakePlainKey({"tum", "adhesive_tape", "g3"}), "tum-adhesive_tape-g3");
  const std::string hostile = MakePlainKey({"/home/me/My Hand", "\"><b>", "g1"});
  EXPECT_EQ(hostile.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_"), std::string::npos)
      << hostile;
  EXPECT_NE(MakePlainKey({"a-b", "c"}), MakePlainKey({"a", "b-c"}));
  EXPECT_NE(MakePlainKey({"A"}), MakePlainKey({"a"}));
  EXPECT_NE(MakePlainKey({"", "a"}), MakePlainKey({"a"}));
}

/** The bytes of a code point by the table in RFC 3629, section 3. */
std::string Encode(char32_t c) {
  const auto byte = [](char32_t bits) { return static_cast<char>(bits); };
  if (c < 0x80) return {byte(c)};
  if (c < 0x800) return {byte(0xC0 | c >> 6), byte(0x80 | (c & 0x3F))};
  if (c < 0x10000) {
    return {byte(0xE0 | c >> 12), byte(0x80 | (c >> 6 & 0x3F)), byte(0x80 | (c & 0x3F))};
  }
  return {byte(0xF0 | c >> 18), byte(0x80 | (c >> 12 & 0x3F)), byte(0x80 | (c >> 6 & 0x3F)),
          byte(0x80 | (c & 0x3F))};
}

TEST(Utf8, EveryCodePointIsReadAndNoSurrogate) {
  for (char32_t c = 1; c < 0x110000; ++c) {
    const std::string bytes = Encode(c);
    const bool is_surrogate = c >= 0xD800 && c <= 0xDFFF;
    const CodePoint read = ReadCodePoint(bytes + "\xFF");  // what follows does not count
    ASSERT_EQ(read.size, is_surrogate ? 0u : bytes.size()) << std::hex << static_cast<uint32_t>(c);
    if (is_surrogate) continue;
    ASSERT_EQ(read.value, c);
    ASSERT_TRUE(IsUtf8(bytes));
    // Every part of it alone is broken.
    ASSERT_EQ(ReadCodePoint(bytes.substr(0, bytes.size() - 1) + "a").size,
              bytes.size() == 1 ? 1u : 0u);
  }
}

TEST(Utf8, WhatTheStandardForbidsIsNotRead) {
  for (const char* bytes :
       {"\x80", "\xBF", "\xC0\xAF", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF",
        "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80", "\xFF"}) {
    EXPECT_EQ(ReadCodePoint(bytes).size, 0u) << bytes;
    EXPECT_FALSE(IsUtf8(std::string("before ") + bytes)) << bytes;
  }
  EXPECT_TRUE(IsUtf8(""));
  EXPECT_TRUE(IsUtf8("Gr\u00F6\u00DFe \u2264 5 \U0001F600"));
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

TEST(RangeText, NamesTheRangeBehindTheValue) {
  EXPECT_EQ(FormatRange(-0.001, 0.25, 2), "0.00 to 0.25");
  EXPECT_EQ(FormatWithRange(0.5, 0.25, 1.0, 1), "0.5 (0.2 to 1.0)");
  EXPECT_EQ(FormatWithRange(0.5, std::nan(""), std::nan(""), 1), "0.5");
}

using namespace std::string_literals;

TEST(IsUtf16, ByItsMarkOrByTheZerosBesideItsLetters) {
  EXPECT_TRUE(IsUtf16("\xff\xfep\0"s));
  EXPECT_TRUE(IsUtf16("\xfe\xff\0p"s));
  EXPECT_TRUE(IsUtf16("f\0i\0l\0e\0"s));
  EXPECT_TRUE(IsUtf16("\0f\0i\0l\0e"s));
  EXPECT_FALSE(IsUtf16("file"));
  EXPECT_FALSE(IsUtf16(""));
  EXPECT_FALSE(
      IsUtf16("\xef\xbb\xbf"
              "file,participant"));  // UTF-8 with its mark
  EXPECT_FALSE(IsUtf16("\0\0\0\0\0\0\0\0"s));
  EXPECT_FALSE(IsUtf16("\x02P\0\0\x01\0\x10\0"s));  // C3D
}

}  // namespace
}  // namespace graspbench
