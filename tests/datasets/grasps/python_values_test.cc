#include "datasets/grasps/python_values.h"

#include <gtest/gtest.h>

#include "tests/datasets/grasps/grasp_cases.h"

namespace graspbench {
namespace {

PickleValue MakeArray(char type, int64_t size, const PickleValue& bytes,
                      std::vector<int64_t> shape) {
  PickleValue array;
  array.kind = PickleValue::Kind::kArray;
  array.type = type;
  array.element_size = size;
  array.shape = std::move(shape);
  array.data = &bytes;
  return array;
}

PickleValue MakeBytes(const std::string& bytes) {
  PickleValue value;
  value.kind = PickleValue::Kind::kBytes;
  value.text = bytes;
  return value;
}

TEST(PythonValues, TypesOfNumber) {
  const PickleValue bytes = MakeBytes(std::string("\x00\xbc\x00\x7c\x01\x00\x00\x80", 8));
  // Halves after IEEE 754: -1, infinity (refused), the least one, -0.
  const NumberTable one = ReadNumbers(MakeArray('f', 2, bytes, {1}), "x");
  EXPECT_EQ(one.numbers[0], -1.0);
  EXPECT_TRUE(Has(FindError([&] { ReadNumbers(MakeArray('f', 2, bytes, {2}), "x"); }),
                  "x: number 2 is not finite"));
  const PickleValue least = MakeBytes(std::string("\x01\x00", 2));
  EXPECT_EQ(ReadNumbers(MakeArray('f', 2, least, {}), "x").numbers[0], std::ldexp(1.0, -24));
  const PickleValue integer = MakeBytes("\xfe\xff\xff\xff");
  EXPECT_EQ(ReadNumber(MakeArray('i', 4, integer, {}), "x"), -2);
  EXPECT_EQ(ReadNumber(MakeArray('u', 4, integer, {}), "x"), 4294967294.0);
  EXPECT_EQ(ReadNumber(MakeArray('b', 1, integer, {}), "x"), 1);
}

TEST(PythonValues, RowsMustBeOfOneLength) {
  PickleValue number, row, list;
  number.kind = PickleValue::Kind::kNumber;
  row.kind = list.kind = PickleValue::Kind::kList;
  row.items = {&number, &number};
  PickleValue longer = row;
  longer.items.push_back(&number);
  list.items = {&row, &longer};
  EXPECT_TRUE(Has(FindError([&] { ReadNumbers(list, "x"); }), "rows of 2 and of 3 numbers"));
  list.items = {&row, &row};
  const NumberTable table = ReadNumbers(list, "x");
  EXPECT_EQ(table.num_rows, 2);
  EXPECT_EQ(table.num_columns, 2);
  list.items = {&number, &row};
  EXPECT_TRUE(Has(FindError([&] { ReadNumbers(list, "x"); }), "expected numbers"));
}

// Few bytes announce rows without numbers for hours, or one row again and again.
TEST(PythonValues, WhatTheFileDoesNotHoldIsRefused) {
  const PickleValue nothing = MakeBytes("");
  const PickleValue rows = MakeArray('f', 8, nothing, {1'000'000'000'000, 0});
  EXPECT_EQ(FindError([&] { ReadNumbers(rows, "x"); }),
            "x is an array of numpy (type f, 1000000000000 x 0), expected at least one number in "
            "each row");
  EXPECT_EQ(ReadNumbers(MakeArray('f', 8, nothing, {0, 29}), "x").num_rows, 0);

  const PickleValue bytes = MakeBytes(std::string(100'000, '\0'));
  const PickleValue row = MakeArray('u', 1, bytes, {100'000});
  PickleValue list;
  list.kind = PickleValue::Kind::kList;
  list.items.assign(160, &row);
  EXPECT_EQ(ReadNumbers(list, "x").num_rows, 160);
  list.items.push_back(&row);
  EXPECT_EQ(FindError([&] { ReadNumbers(list, "x"); }),
            "x is a list of more than 16000000 numbers; expected an array, or fewer grasps in one "
            "file");
}

}  // namespace
}  // namespace graspbench
