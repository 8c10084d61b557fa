#include "core/base/text/record_fields.h"

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace graspbench {
namespace {

struct Point {
  std::string name;
  double x = kUnset;

  template <class V>
  static void ListFields(V&& field) {
    field("name", &Point::name);
    field("x_m", &Point::x, FieldColumn{"m", "to the right"});
  }
};

struct Throw;
Json SpanToJson(const Throw& item);
void ReadSpan(const Json& json, Throw& item);

struct Throw {
  double height = 0.0;
  int bounces = 0;
  bool is_caught = false;
  Eigen::VectorXd q;
  Pose X_WO = Pose::Identity();
  Point start;
  std::vector<Point> points;
  double first = 0.0, last = 0.0;

  template <class V>
  static void ListFields(V&& field) {
    field("height_m", &Throw::height, FieldColumn{"m", "of the highest point"});
    field("bounces", &Throw::bounces, FieldColumn{"", "on the floor"});
    field("is_caught", &Throw::is_caught, FieldColumn{"", "in the end"});
    field("q_rad", &Throw::q);
    field("X_WO", &Throw::X_WO);
    field("start", &Throw::start);
    field("points", &Throw::points);
    field("span_s", &SpanToJson, &ReadSpan);
  }
};

Json SpanToJson(const Throw& item) { return Json::array({item.first, item.last}); }
void ReadSpan(const Json& json, Throw& item) {
  item.first = json.at(0).get<double>();
  item.last = json.at(1).get<double>();
}

Throw MakeThrow() {
  Throw item;
  item.height = 0.1;
  item.bounces = 3;
  item.is_caught = true;
  item.q = Eigen::Vector2d(0.25, -1.0);
  item.start = {"hand", 0.5};
  item.points = {{"a", 1.0}, {"b", kUnset}};
  item.first = 1.5;
  item.last = 2.0;
  return item;
}

// Written by hand, as a reader of the file would expect it.
constexpr const char* kText =
    R"({"height_m":0.1,"bounces":3,"is_caught":true,"q_rad":[0.25,-1.0],)"
    R"("X_WO":{"p_m":[0.0,0.0,0.0],"R":[[1.0,0.0,0.0],[0.0,1.0,0.0],[0.0,0.0,1.0]]},)"
    R"("start":{"name":"hand","x_m":0.5},)"
    R"("points":[{"name":"a","x_m":1.0},{"name":"b","x_m":null}],"span_s":[1.5,2.0]})";

TEST(RecordFields, WritesTheFieldsInTheirOrder) {
  EXPECT_EQ(RecordToJson(MakeThrow()).dump(), kText);
}

TEST(RecordFields, ReadsWhatItWrites) {
  Throw item;
  ReadRecord(Json::parse(kText), item);
  EXPECT_EQ(item.height, 0.1);
  EXPECT_EQ(item.bounces, 3);
  EXPECT_TRUE(item.is_caught);
  EXPECT_EQ(item.q, Eigen::VectorXd(Eigen::Vector2d(0.25, -1.0)));
  EXPECT_EQ(item.start.name, "hand");
  ASSERT_EQ(item.points.size(), 2u);
  EXPECT_EQ(item.points[0].x, 1.0);
  EXPECT_TRUE(std::isnan(item.points[1].x));
  EXPECT_EQ(item.last, 2.0);
  EXPECT_EQ(RecordToJson(item).dump(), kText);
}

TEST(RecordFields, AMissingKeyOrAnotherTypeIsAnError) {
  for (const char* key : {"height_m", "bounces", "points", "span_s"}) {
    Json json = Json::parse(kText);
    json.erase(key);
    Throw item;
    EXPECT_THROW(ReadRecord(json, item), Json::exception) << key;
  }
  Json json = Json::parse(kText);
  json["bounces"] = 2.5;
  Throw item;
  EXPECT_THROW(ReadRecord(json, item), Error);
}

TEST(RecordFields, AColumnHasTheFieldsNameTypeUnitAndValue) {
  const auto take = [](const Throw& row) -> const Throw& { return row; };
  const CsvColumn<Throw> height = MakeFieldColumn<Throw>(
      "height_m", &Throw::height, FieldColumn{"m", "of the highest point"}, take);
  EXPECT_EQ(height.name, "height_m");
  EXPECT_EQ(height.type, "number");
  EXPECT_EQ(height.unit, "m");
  EXPECT_EQ(height.meaning, "of the highest point");
  EXPECT_EQ(height.value(MakeThrow()), Json(0.1));
  const CsvColumn<Throw> caught =
      MakeFieldColumn<Throw>("is_caught", &Throw::is_caught, FieldColumn{"", "in the end"}, take);
  EXPECT_EQ(caught.type, "boolean");
  EXPECT_EQ(caught.value(MakeThrow()), Json(1));
  EXPECT_EQ(MakeFieldColumn<Throw>("bounces", &Throw::bounces, FieldColumn{"", ""}, take).type,
            "integer");
}

}  // namespace
}  // namespace graspbench
