#include "core/base/text/record_fields.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
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

struct Jump {
  double height = 0.0;
  double wind = kUnset;
  int steps = 0;
  bool is_valid = false;
  Eigen::VectorXd q;
  Pose X_WO = Pose::Identity();
  std::optional<Point> start;
  std::vector<Point> spots;

  template <class V>
  static void ListFields(V&& field) {
    field("height_m", &Jump::height);
    field("wind_m_per_s", &Jump::wind, FieldMayMiss{});
    field("steps", &Jump::steps);
    field("is_valid", &Jump::is_valid);
    field("q_rad", &Jump::q);
    field("X_WO", &Jump::X_WO);
    field("start", &Jump::start);
    field("spots", &Jump::spots);
  }
};

Jump MakeJump() {
  Jump jump;
  jump.height = 0.1 + 0.2;
  jump.steps = -3;
  jump.is_valid = true;
  jump.q = Eigen::Vector2d(0.25, -1e-300);
  jump.X_WO = MakePose(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix(),
                       {0.1, -0.2, 0.3});
  jump.spots = {{"first", kUnset}, {"\"second\",\nμ", -0.0}};
  return jump;
}

/** None: the cursor failed. */
std::optional<Jump> Read(const std::string& line) {
  JsonCursor text(line);
  Jump jump;
  ReadRecordText(text, jump);
  return text.has_failed() || !text.rest().empty() ? std::nullopt : std::optional(jump);
}

TEST(RecordText, ReadsWhatWasWritten) {
  for (const bool has_all : {false, true}) {
    Jump jump = MakeJump();
    if (has_all) {
      jump.wind = -1.5;
      jump.start = Point{"", 2.0};
      jump.q.resize(0);
      jump.spots.clear();
    }
    const std::string line = FormatJson(RecordToJson(jump));
    const std::optional<Jump> read = Read(line);
    ASSERT_TRUE(read) << line;
    EXPECT_EQ(FormatJson(RecordToJson(*read)), line);
  }
}

TEST(RecordText, LeavesOtherTextsToTheTree) {
  const std::string line = FormatJson(RecordToJson(MakeJump()));
  EXPECT_FALSE(Read(""));
  EXPECT_FALSE(Read("{}"));
  EXPECT_FALSE(Read(line + " "));
  EXPECT_FALSE(Read(line.substr(0, line.size() - 1) + ",\"more\":1}"));
  EXPECT_FALSE(Read("{ " + line.substr(1)));
}

/** Whatever becomes of the text: where the cursor has not failed, the tree says the same. */
TEST(RecordText, SaysNothingThatATreeDoesNotSay) {
  const std::string line = FormatJson(RecordToJson(MakeJump()));
  constexpr std::string_view kLetters = "0123456789.eE+-\"\\{}[],:ntu \n\x80";
  RandomStream random("mutations", "text");
  int num_read = 0;
  for (int i = 0; i < 50000; ++i) {
    std::string text = line;
    const auto at = static_cast<size_t>(random.NextIndex(static_cast<int>(text.size())));
    text[at] = kLetters[static_cast<size_t>(random.NextIndex(static_cast<int>(kLetters.size())))];
    const std::optional<Jump> read = Read(text);
    if (!read) continue;
    ++num_read;
    Jump expected;
    ASSERT_NO_THROW(ReadRecord(Json::parse(text), expected)) << text;
    EXPECT_EQ(FormatJson(RecordToJson(*read)), FormatJson(RecordToJson(expected))) << text;
  }
  EXPECT_GT(num_read, 5000);
}

}  // namespace
}  // namespace graspbench
