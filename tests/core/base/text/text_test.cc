#include "core/base/text/text.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/random.h"

namespace graspbench {
namespace {

TEST(Format, DecimalsAreFixed) {
  EXPECT_EQ(FormatFixed(0.5, 3), "0.500");
  EXPECT_EQ(FormatFixed(1234567.0, 0), "1234567");
  EXPECT_EQ(FormatFixed(-2.345, 1), "-2.3");
  EXPECT_EQ(FormatFixed(1e300, 1).size(), 303u);
}

TEST(Format, ZeroHasNoSign) {
  EXPECT_EQ(FormatFixed(-0.0, 2), "0.00");
  EXPECT_EQ(FormatFixed(-0.0004, 3), "0.000");
  EXPECT_EQ(FormatFixed(-0.0006, 3), "-0.001");
}

TEST(Format, WhatIsMissingIsNoNumber) {
  EXPECT_EQ(FormatFixed(std::nan(""), 3), "n/a");
  EXPECT_EQ(FormatSignificant(INFINITY, 3), "n/a");
  EXPECT_EQ(FormatPercent(std::nan("")), "n/a");
}

TEST(Format, SignificantDigits) {
  EXPECT_EQ(FormatSignificant(0.0012345, 3), "0.00123");
  EXPECT_EQ(FormatSignificant(123456.0, 3), "1.23e+05");
  EXPECT_EQ(FormatSignificant(0.0, 3), "0");
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

}  // namespace
}  // namespace graspbench
