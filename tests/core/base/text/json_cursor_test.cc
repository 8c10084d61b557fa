#include "core/base/text/json_cursor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/base/text/json.h"

namespace graspbench {
namespace {

/** The numbers that two ways of reading must agree on to the last bit, by another library. */
TEST(JsonCursor, ReadsNumbersAsATreeDoes) {
  std::vector<std::string> numbers = {"0",
                                      "-0.0",
                                      "4",
                                      "5e-324",
                                      "2.2250738585072011e-308",
                                      "1.7976931348623157e308",
                                      "9007199254740993",
                                      "18446744073709551615",
                                      "123456789012345678901234567890",
                                      "0.1",
                                      "1E+2",
                                      "8.5e-07"};
  RandomStream random("numbers", "cursor");
  for (int i = 0; i < 10000; ++i) {
    numbers.push_back(FormatJson(std::ldexp(random.NextNormal(), random.NextIndex(600) - 300)));
  }
  for (const std::string& number : numbers) {
    JsonCursor text(number);
    const double value = text.ReadNumber(), expected = Json::parse(number).get<double>();
    EXPECT_FALSE(text.has_failed() || !text.rest().empty()) << number;
    EXPECT_EQ(std::signbit(value), std::signbit(expected)) << number;
    EXPECT_EQ(value, expected) << number;
  }
}

TEST(JsonCursor, FailsAtWhatIsNotPlain) {
  for (const char* number : {"", "-", "01x", "1.", ".5", "1e", "+1", "nan", "inf", "-0", "1e999",
                             "1e-999", "0x10", "null", "\"1\""}) {
    JsonCursor text(number);
    text.ReadNumber();
    EXPECT_TRUE(text.has_failed() || !text.rest().empty()) << number;
  }
  for (const char* number : {"1.0", "1e2", "2147483648", "-", "", "true"}) {
    JsonCursor text(number);
    text.ReadInt();
    EXPECT_TRUE(text.has_failed() || !text.rest().empty()) << number;
  }
  for (const char* plain : {"", "a", "\"a", "\"a\\\"", "\"a\\n\"", "\"\t\"", "\"\xff\""}) {
    JsonCursor text(plain);
    text.ReadPlainText();
    EXPECT_TRUE(text.has_failed()) << plain;
  }
  for (const char* value : {"", "[1,]", "{\"a\"}", "{a:1}", "[", "{\"a\":1", "tru", "[1 ,2]", "1 ",
                            "\"\\x\"", "\"\\u00e9\"", "[1}", "{\"a\":1,}", "\"\xc3\x28\""}) {
    EXPECT_FALSE(IsPlainJson(value)) << value;
  }
  EXPECT_FALSE(IsPlainJson(std::string(1000, '[') + std::string(1000, ']')));
}

/** Whatever a disk makes of a text: what is plain is JSON to another library, too. */
TEST(JsonCursor, AcceptsNothingThatIsNoJson) {
  const std::string good =
      "{\"id\":\"0f\",\"q\":[0.25,-1.5e-07,0,-0.0],\"ok\":true,\"why\":\"a \\\"b\\\" \xce\xbc\","
      "\"none\":null,\"list\":[{\"n\":1},{\"n\":[[],{}]}]}";
  ASSERT_TRUE(IsPlainJson(good));
  RandomStream random("mutations", "cursor");
  constexpr std::string_view kLetters = "0123456789.eE+-\"\\{}[],:ntu \n\x80\xc3\xff";
  int num_plain = 0;
  for (int i = 0; i < 50000; ++i) {
    std::string text = good;
    for (int n = random.NextIndex(3); n >= 0; --n) {
      const auto at = static_cast<size_t>(random.NextIndex(static_cast<int>(text.size())));
      const char letter =
          kLetters[static_cast<size_t>(random.NextIndex(static_cast<int>(kLetters.size())))];
      if (random.NextIndex(3) == 0) {
        text.erase(at, 1);
      } else if (random.NextIndex(2) == 0) {
        text.insert(at, 1, letter);
      } else {
        text[at] = letter;
      }
    }
    if (!IsPlainJson(text)) continue;
    ++num_plain;
    EXPECT_FALSE(Json::try_parse(text).is_discarded()) << text;
  }
  EXPECT_GT(num_plain, 1000);
}

}  // namespace
}  // namespace graspbench
