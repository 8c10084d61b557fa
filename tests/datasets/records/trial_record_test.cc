#include "datasets/records/trial_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "tests/datasets/find_error.h"
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
  EXPECT_EQ(FindProblem(""), "the line is truncated or not a record");
  EXPECT_EQ(FindProblem("{\"trial_id\":1}"), "the line is truncated or not a record");
  std::string line = FormatJournalLine(MakeFakeRecord(kPlanned));
  line[20] ^= 1;
  EXPECT_EQ(FindProblem(line), "its bytes do not match their checksum");
  // Valid checksums around content of another version: said, not crashed.
  const auto has = [](const std::string& text, const char* part) { EXPECT_TRUE(Has(text, part)); };
  has(FindProblem(Seal("{")), "it is not a record of this version");
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

TEST(RecordLines, GiveTheLineAtItsPlaceAndNameIt) {
  const TemporaryFolder folder;
  WriteFile(folder.path() / "a.jsonl", "one\n\nthree\n");
  WriteFile(folder.path() / "b.jsonl", "uno\n");
  const RecordLines lines = {folder.path(), {"a.jsonl", "b.jsonl"}, {}, {}};
  EXPECT_EQ(ReadLine(lines, {0, 3, 5, 5}), "three");
  EXPECT_EQ(ReadLine(lines, {1, 1, 0, 3}), "uno");
  EXPECT_EQ(NameOfLine(lines, {0, 3, 5, 5}), "a.jsonl:3");
}

TEST(RecordLines, AShorterOrMissingFileIsAnError) {
  const TemporaryFolder folder;
  WriteFile(folder.path() / "a.jsonl", "one\n");
  const RecordLines lines = {folder.path(), {"a.jsonl", "none.jsonl"}, {}, {}};
  for (const LinePlace& place : {LinePlace{0, 2, 2, 9}, LinePlace{1, 1, 0, 3}}) {
    EXPECT_TRUE(Throws([&] { ReadLine(lines, place); }, ErrorKind::kIo, " again: "));
  }
}

TrialResult MakeResult() { return MakeFakeRecord({"id", "tum", "mug", "g2", 1}).result; }

TEST(CompareResults, EqualResultsDoNotDiffer) {
  TrialResult result = MakeResult();
  result.hold_slip = kUnset;  // missing equals missing
  EXPECT_FALSE(FindFirstDifference(result, result));
}

TEST(CompareResults, TheLastBitOfAFieldCounts) {
  const TrialResult recorded = MakeResult();
  TrialResult now = recorded;
  now.grip_force = std::nextafter(now.grip_force, 100.0);
  const auto difference = FindFirstDifference(recorded, now);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->field, "grip_force_n");
  EXPECT_EQ(std::stod(difference->recorded), recorded.grip_force);
  EXPECT_EQ(std::stod(difference->now), now.grip_force);
}

TEST(CompareResults, NamesTheFirstPlaceWithinLists) {
  const TrialResult recorded = MakeResult();
  TrialResult now = recorded;
  now.contacts[2].time = 17.0;
  now.grip_force = 17.0;
  EXPECT_EQ(FindFirstDifference(recorded, now)->field, "contacts/2/time_s");
  now = recorded;
  now.phases.pop_back();
  const auto difference = FindFirstDifference(recorded, now);
  EXPECT_EQ(difference->field, "phases/1");
  EXPECT_EQ(difference->now, "missing");
  now = recorded;
  now.phases.insert(now.phases.end(), 2, now.phases.back());
  const std::string first = "phases/" + std::to_string(recorded.phases.size());
  EXPECT_EQ(FindFirstDifference(recorded, now)->field, first);
  EXPECT_EQ(FindFirstDifference(recorded, now)->recorded, "missing");
  EXPECT_EQ(FindFirstDifference(now, recorded)->field, first);
}

}  // namespace

}  // namespace graspbench
