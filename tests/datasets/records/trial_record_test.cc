#include "datasets/records/trial_record.h"

#include <gtest/gtest.h>

#include <sstream>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

const PlannedTrial kPlanned = {"0123456789abcdef", "tum", "mug", "g2", 3};

/** The error's text; empty when the line is read. */
std::string FindProblem(const std::string& line) {
  try {
    ParseJournalLine(line);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kFormat);
    return e.what();
  }
  return "";
}

/** A line with a valid checksum around any text that lacks its closing brace. */
std::string Seal(const std::string& body) {
  return body + ",\"xxh64\":\"" + CalcHashHex(body) + "\"}";
}

TEST(TrialRecord, ReadsBackExactlyWhatWasWritten) {
  for (int i = 0; i < 200; ++i) {
    const TrialRecord record =
        MakeFakeRecord({CalcHashHex(std::to_string(i)), "my \"hand\"\n", "mug", "g2", i});
    const std::string line = FormatJournalLine(record);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const TrialRecord read = ParseJournalLine(line);
    EXPECT_EQ(FormatJournalLine(read), line);
    EXPECT_EQ(read.plan, record.plan);
    EXPECT_EQ(read.result.outcome, record.result.outcome);
    EXPECT_EQ(read.result.reason, record.result.reason);
    EXPECT_EQ(read.result.grip_force, record.result.grip_force);
    EXPECT_EQ(read.result.snapshots[0].X_WO.matrix(), record.result.snapshots[0].X_WO.matrix());
  }
}

// By way of a tree they would be the same, and take ten times as long.
TEST(TrialRecord, ResultsAreReadStraightFromTheirText) {
  for (int i = 0; i < 200; ++i) {
    const std::string text = FormatJson(
        ToJson(MakeFakeRecord({CalcHashHex(std::to_string(i)), "tum", "mug", "g2", i}).result));
    JsonCursor cursor(text);
    const TrialResult result = ReadTrialResultText(cursor);
    ASSERT_FALSE(cursor.has_failed()) << cursor.rest();
    EXPECT_EQ(FormatJson(ToJson(result)), text);
    EXPECT_EQ(JsonNumber(result.timing.gct),
              JsonNumber(TrialResultFromJson(Json::parse(text)).timing.gct));
  }
}

TEST(TrialRecord, IsAnOrdinaryJsonLine) {
  const Json json = Json::parse(FormatJournalLine(MakeFakeRecord(kPlanned)));
  EXPECT_EQ(json.at("trial_id"), kPlanned.id);
  EXPECT_EQ(json.at("xxh64").get<std::string>().size(), 16u);
}

TEST(TrialRecord, MissingNumbersAreNull) {
  TrialRecord record = MakeFakeRecord(kPlanned);
  record.result.hold_slip = std::nan("");
  const std::string line = FormatJournalLine(record);
  EXPECT_TRUE(Json::parse(line).at("result").at("hold_slip_m").is_null());
  EXPECT_TRUE(std::isnan(ParseJournalLine(line).result.hold_slip));
}

TEST(TrialRecord, EveryFlippedBitIsFound) {
  const std::string line = FormatJournalLine(MakeFakeRecord(kPlanned));
  for (size_t bit = 0; bit < 8 * line.size(); ++bit) {
    std::string damaged = line;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    ASSERT_NE(FindProblem(damaged), "") << "bit " << bit;
  }
}

TEST(TrialRecord, EveryCutIsFound) {
  const std::string line = FormatJournalLine(MakeFakeRecord(kPlanned));
  for (size_t length = 0; length < line.size(); ++length) {
    ASSERT_NE(FindProblem(line.substr(0, length)), "") << length;
    ASSERT_NE(FindProblem(line.substr(line.size() - length)), "") << length;
  }
}

TEST(TrialRecord, SaysWhatIsWrong) {
  EXPECT_EQ(FindProblem(""), "the line is cut off or is no record");
  EXPECT_EQ(FindProblem("{\"trial_id\":1}"), "the line is cut off or is no record");
  std::string line = FormatJournalLine(MakeFakeRecord(kPlanned));
  line[20] ^= 1;
  EXPECT_EQ(FindProblem(line), "its bytes do not match their checksum");
  // Valid checksums around content of another version: said, not crashed.
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(FindProblem(Seal("{")), "it is no record of this version");
  has(FindProblem(Seal("{\"trial_id\":\"a\"")), "key 'hand' not found");
  const auto change = [](const std::string& path, const Json& value) {
    Json json = ToJson(MakeFakeRecord(kPlanned));
    Json* place = &json;
    std::istringstream parts(path);
    for (std::string part; std::getline(parts, part, '/');) {
      place = place->is_array() ? &(*place)[std::stoul(part)] : &(*place)[part];
    }
    *place = value;
    std::string body = json.dump();
    body.pop_back();
    return FindProblem(Seal(body));
  };
  has(change("trial", 1e300), "expected a whole number");
  has(change("result/num_steps", 4294967296), "expected a whole number");
  has(change("result/outcome", "sucess"), "did you mean \"success\"?");
  has(change("result/contacts/0/is_thumb", true), "more than one thumb");
  has(change("result/snapshots/0/X_WO/R", Json::array()), "out of range");
}

}  // namespace
}  // namespace graspbench
