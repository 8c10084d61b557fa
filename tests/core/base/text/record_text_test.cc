#include "core/base/text/record_text.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

struct Spot {
  std::string name;
  double x = kUnset;

  template <class V>
  static void ListFields(V&& field) {
    field("name", &Spot::name);
    field("x_m", &Spot::x, FieldColumn{"m", "to the right"});
  }
};

struct Jump {
  double height = 0.0;
  double wind = kUnset;
  int steps = 0;
  bool is_valid = false;
  Eigen::VectorXd q;
  Pose X_WO = Pose::Identity();
  std::optional<Spot> start;
  std::vector<Spot> spots;

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
      jump.start = Spot{"", 2.0};
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
