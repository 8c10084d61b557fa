#include "core/base/enum_table.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

enum class Shape { kBall, kBox, kCan };
struct ShapeRow {
  Shape value;
  const char* name;
  int num_edges;
};
// Not in the enum's order.
constexpr ShapeRow kShapes[] = {
    {Shape::kCan, "can", 2}, {Shape::kBall, "ball", 0}, {Shape::kBox, "box", 12}};

TEST(EnumTable, FindsTheRowOfAValueAndOfAName) {
  EXPECT_EQ(RowOf(kShapes, Shape::kBox).num_edges, 12);
  EXPECT_EQ(RowOf(kShapes, Shape::kCan).num_edges, 2);
  for (const ShapeRow& row : kShapes) {
    EXPECT_EQ(RowFromName(kShapes, row.name, "shape").value, row.value);
    EXPECT_EQ(FindRow(kShapes, row.name), &row);
  }
  EXPECT_EQ(ListNames(kShapes), (std::vector<std::string>{"can", "ball", "box"}));
}

TEST(EnumTable, AnUnknownNameIsAnErrorThatSuggests) {
  EXPECT_EQ(FindRow(kShapes, "bal"), nullptr);
  try {
    RowFromName(kShapes, "bal", "shape");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kFormat);
    const std::string text = e.what();
    EXPECT_EQ(text.find("no shape \"bal\""), 0u) << text;
    EXPECT_NE(text.find("ball"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace graspbench
