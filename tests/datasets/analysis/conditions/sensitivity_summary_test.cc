#include "datasets/analysis/conditions/sensitivity_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

constexpr char kSetting[] = "model.mass_scale=2.0";

/** Two hands on six objects, five trials each, with measures drawn anew for every trial. */
Session MakeNoisySession() {
  Session session = MakeSession({"tum", "shadow"}, {"a", "b", "c", "d", "e", "f"}, "g1", 5);
  RandomStream random("sensitivity", "noise");
  for (TrialRecord& record : session.records) {
    TrialResult& result = record.result;
    result.outcome = random.NextUniform(0.0, 1.0) < 0.7 ? Outcome::kSuccess : Outcome::kKnockedOver;
    result.timing.gft = random.NextUniform(0.0, 0.2);
    result.timing.gct = result.timing.gft + 0.5;
    result.stability.sigma = IsSuccess(result.outcome) ? random.NextUniform(1.0, 3.0) : kUnset;
  }
  return session;
}

SensitivityData RepeatUnchanged(const Session& session) {
  SensitivityData data;
  for (const TrialRecord& record : session.records) {
    data[kSetting][record.plan.id] = MakeTrialMeasures(record);
  }
  return data;
}

double CalcAverage(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(SensitivitySummary, ASettingThatChangesNothingChangesNothing) {
  const Session session = MakeNoisySession();
  const SensitivitySummary summary = SummariseSensitivity(session, RepeatUnchanged(session));
  ASSERT_EQ(summary.changes.size(), 2u);
  for (const SettingChange& change : summary.changes) {
    EXPECT_EQ(change.setting, kSetting);
    EXPECT_EQ(change.value, "1.0");
    EXPECT_EQ(change.successes.num_pairs(), 30);
    EXPECT_EQ(change.rate_change(), 0.0);
    EXPECT_LT(change.rate_change_low, 0.0);
    EXPECT_GT(change.rate_change_high, 0.0);
    for (const MeasureChange& measure : change.measures) {
      EXPECT_EQ(measure.change(), 0.0) << measure.measure;
      EXPECT_EQ(measure.no_interval, "no trial changes");
    }
  }
}

// Counts, means and pairs with a straight loop over all trials.
TEST(SensitivitySummary, AgreesWithALoopOverAllPairs) {
  const Session session = MakeNoisySession();
  SensitivityData data = RepeatUnchanged(session);
  RandomStream random("sensitivity", "change");
  for (auto& [id, measures] : data[kSetting]) {
    if (random.NextUniform(0.0, 1.0) < 0.2) {
      measures.outcome = IsSuccess(measures.outcome) ? Outcome::kNoContact : Outcome::kSuccess;
    }
    measures.gft += random.NextUniform(-0.05, 0.15);
    if (random.NextUniform(0.0, 1.0) < 0.1) measures.gft = kUnset;
  }
  data[kSetting].erase(session.records[7].plan.id);
  const SensitivitySummary summary = SummariseSensitivity(session, data);
  ASSERT_EQ(summary.changes.size(), 2u);
  for (const SettingChange& change : summary.changes) {
    int lost = 0, won = 0, pairs = 0;
    std::vector<double> before, after;
    for (const TrialRecord& record : session.records) {
      const auto found = data[kSetting].find(record.plan.id);
      if (record.plan.hand != change.hand || found == data[kSetting].end()) continue;
      ++pairs;
      lost += IsSuccess(record.result.outcome) && !IsSuccess(found->second.outcome);
      won += !IsSuccess(record.result.outcome) && IsSuccess(found->second.outcome);
      if (std::isnan(found->second.gft)) continue;
      before.push_back(record.result.timing.gft);
      after.push_back(found->second.gft);
    }
    EXPECT_EQ(change.successes.num_pairs(), pairs);
    EXPECT_EQ(change.successes.first_only, lost);
    EXPECT_EQ(change.successes.second_only, won);
    EXPECT_DOUBLE_EQ(change.rate_change(), static_cast<double>(won - lost) / pairs);
    const MeasureChange& gft = change.Find("gft_s");
    EXPECT_EQ(gft.num_pairs, static_cast<int>(before.size()));
    EXPECT_NEAR(gft.before, CalcAverage(before), 1e-12);
    EXPECT_NEAR(gft.after, CalcAverage(after), 1e-12);
    EXPECT_LE(gft.low, gft.change());
    EXPECT_GE(gft.high, gft.change());
    EXPECT_LT(gft.high - gft.low, 0.2);
  }
}

// The change is 1, 2, .. 6 s by object and nothing else varies, so the interval's limits are those
// of all 6^6 draws of objects.
TEST(SensitivitySummary, DrawsObjectsAndNotTrials) {
  Session session = MakeSession({"tum"}, {"a", "b", "c", "d", "e", "f"}, "g1", 5);
  SensitivityData data = RepeatUnchanged(session);
  for (const TrialRecord& record : session.records) {
    data[kSetting][record.plan.id].gft += record.plan.object[0] - 'a' + 1.0;
  }
  const SensitivitySummary summary = SummariseSensitivity(session, data);
  const MeasureChange& gft = summary.changes.at(0).Find("gft_s");
  EXPECT_NEAR(gft.change(), 3.5, 1e-12);
  std::vector<double> all;
  for (int code = 0; code < 46656; ++code) {
    std::vector<double> draw;
    for (int rest = code, k = 0; k < 6; rest /= 6, ++k) draw.push_back(rest % 6 + 1.0);
    all.push_back(CalcAverage(draw));
  }
  std::sort(all.begin(), all.end());
  EXPECT_NEAR(gft.low, all[46656 / 40], 0.18);  // means of six step by sixths
  EXPECT_NEAR(gft.high, all[46656 - 46656 / 40], 0.18);
  EXPECT_GT(gft.high - gft.low, 2.0);  // trials as members would give less than one
}

TEST(SensitivitySummary, SaysWhyThereIsNoInterval) {
  const Session session = MakeSession({"tum"}, {"a", "b"}, "g1", 5);
  SensitivityData data = RepeatUnchanged(session);
  for (auto& [id, measures] : data[kSetting]) {
    measures.gft += 0.1;
    measures.gct = kUnset;
  }
  const SensitivitySummary summary = SummariseSensitivity(session, data);
  const SettingChange& change = summary.changes.at(0);
  EXPECT_NEAR(change.Find("gft_s").change(), 0.1, 1e-12);
  EXPECT_TRUE(std::isnan(change.Find("gft_s").low));
  EXPECT_EQ(change.Find("gft_s").no_interval, "2 to resample; an interval needs 5 or more");
  EXPECT_EQ(change.Find("gct_s").no_interval, "no pair has it twice");
}

// What was planned under the setting and is missing on one side is counted; what nobody asked for
// is not.
TEST(SensitivitySummary, CountsWhatLacksItsPair) {
  Session session = MakeSession({"tum", "shadow"}, {"a", "b"}, "g1", 5);
  SensitivityData data = RepeatUnchanged(session);
  VariedTrials& trials = data[kSetting];
  for (size_t i = 0; i < 4; ++i) trials[session.plan[i].id] = TrialMeasures();
  trials.erase(session.plan[4].id);
  session.records.erase(session.records.begin() + 3);
  session.records.erase(session.records.begin() + 8);  // the session's trial 9
  for (size_t i = 10; i < 20; ++i) trials[session.plan[i].id] = TrialMeasures();
  const SensitivitySummary summary = SummariseSensitivity(session, data);
  ASSERT_EQ(summary.changes.size(), 2u);
  EXPECT_EQ(CountPairs(summary.changes[0]), "4 of 9");
  EXPECT_EQ(summary.changes[0].why_left_out, "2 not finished, 3 without a partner");
  EXPECT_EQ(CountPairs(summary.changes[1]), "0 of 10");
  EXPECT_EQ(summary.changes[1].why_left_out, "10 without a partner");
  EXPECT_TRUE(std::isnan(summary.changes[1].rate_change()));
}

TEST(SensitivitySummary, IsReadAsItWasWritten) {
  const Session session = MakeNoisySession();
  const Json json = RecordToJson(SummariseSensitivity(session, RepeatUnchanged(session)));
  SensitivitySummary read;
  ReadRecord(json, read);
  EXPECT_EQ(RecordToJson(read), json);
}

TEST(FormatSetting, ShortensLongNumbersOnly) {
  EXPECT_EQ(FormatSetting("variation.yaw_rad=0.17453292519943295"), "variation.yaw_rad=0.1745");
  EXPECT_EQ(FormatSetting("0.17453292519943295"), "0.1745");
  for (const char* kept : {"model.mass_scale=0.5", "100000.0", "model.coupling=middle_first", "",
                           "model.coupling=0.17453292519943295x", "="}) {
    EXPECT_EQ(FormatSetting(kept), kept);
  }
}

}  // namespace
}  // namespace graspbench
