// Bytes by hand from the MessagePack specification, and as Python's msgpack and numpy write them.

#include "core/base/text/message_pack.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace graspbench {
namespace {

using namespace std::string_literals;

TEST(MessagePack, ReadsEveryFormOfANumber) {
  const std::pair<std::string, double> cases[] = {{"\x07"s, 7},
                                                  {"\xff"s, -1},
                                                  {"\xcc\xc8"s, 200},
                                                  {"\xcd\x01\x00"s, 256},
                                                  {"\xd0\x80"s, -128},
                                                  {"\xd1\xff\x00"s, -256},
                                                  {"\xca\x3f\x00\x00\x00"s, 0.5},
                                                  {"\xcb\xbf\xf8\x00\x00\x00\x00\x00\x00"s, -1.5},
                                                  {"\xd3\xff\xff\xff\xff\xff\xff\xff\xfe"s, -2}};
  for (const auto& [bytes, value] : cases) {
    EXPECT_EQ(std::get<double>(ParseMessagePack(bytes).value), value);
  }
}

TEST(MessagePack, WritesWhatTheSpecificationSays) {
  MessagePackWriter writer;
  writer.Map(1);
  writer.Text("a");
  writer.List(2);
  writer.Bool(true);
  writer.Number(1.0);
  EXPECT_EQ(writer.bytes(),
            "\x81\xa1"s
            "a\x92\xc3\xcb\x3f\xf0\x00\x00\x00\x00\x00\x00"s);
}

TEST(MessagePack, AnArrayComesBack) {
  MessagePackWriter writer;
  const std::vector<double> values = {1.0, -2.5, 3.0, 4.0, 5.0, 6e300};
  writer.Array(values.data(), {2, 3});
  const auto array = std::get<PackedArray>(ParseMessagePack(writer.bytes()).value);
  EXPECT_EQ(array.shape, (std::vector<size_t>{2, 3}));
  EXPECT_EQ(array.values, values);
}

// msgpack.packb({b"__ndarray__": True, b"data": np.array([1, 2], "<i2").tobytes(), ..})
TEST(MessagePack, ReadsNumpysSmallTypes) {
  const std::string bytes =
      "\x84\xc4\x0b__ndarray__\xc3\xc4\x04"s
      "data\xc4\x04\x01\x00\xfe\xff"s
      "\xc4\x05"s
      "dtype\xa3<i2\xc4\x05shape\x91\x02"s;
  EXPECT_EQ(std::get<PackedArray>(ParseMessagePack(bytes).value).values,
            (std::vector<double>{1.0, -2.0}));
}

TEST(MessagePack, SaysWhatIsWrong) {
  const std::pair<std::string, std::string> cases[] = {
      {""s, "ends too early"},
      {"\xa5"s
       "abc"s,
       "ends too early"},
      {"\xc1"s, "no MessagePack"},
      {"\xd4\x01\x00"s, "extension"},
      {"\x01\x02"s, "bytes after"},
      {"\x81\x01\x02"s, "neither text nor bytes"},
      {"\xdd\xff\xff\xff\xff"s, "longer than the message"},
      {std::string(40, '\x91') + "\x01", "too deeply"},
      {"\x84\xab__ndarray__\xc3\xa4"s
       "data\xc4\x03"s
       "abc\xa5"s
       "dtype\xa3<f8\xa5shape\x91\x02"s,
       "does not fit"},
      {"\x84\xab__ndarray__\xc3\xa4"s
       "data\xc4\x01"s
       "a\xa5"s
       "dtype\xa3>f8\xa5shape\x91\x02"s,
       "dtype"},
      {"\x81\xab__ndarray__\xc3"s, "without data"}};
  for (const auto& [bytes, expected] : cases) {
    try {
      ParseMessagePack(bytes);
      ADD_FAILURE() << expected;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
}

TEST(MessagePack, TakesNestedListsForArrays) {
  const PackedArray array = ReadPackedArray(ParseMessagePack("\x92\x92\x01\x02\x92\x03\x04"s), "x");
  EXPECT_EQ(array.shape, (std::vector<size_t>{2, 2}));
  EXPECT_EQ(array.values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_THROW(ReadPackedArray(ParseMessagePack("\x92\x91\x01\x92\x03\x04"s), "x"), Error);
  EXPECT_THROW(ReadPackedArray(ParseMessagePack("\xa1x"s), "x"), Error);
}

}  // namespace
}  // namespace graspbench
