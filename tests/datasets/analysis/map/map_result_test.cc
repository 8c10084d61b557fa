#include "datasets/analysis/map/map_result.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/datasets/analysis/map/made_map.h"

namespace graspbench {

namespace {

TEST(MapResult, TellsWhatWasPlantedInEveryForm) {
  const MapResult result = LoadMap(MakeMapSessionResult());
  ASSERT_EQ(result.parts.size(), 1u);
  EXPECT_EQ(result.parts[0].num_trials, result.parts[0].num_planned);
  const MapCell* const cell =
      FindCell(result.parts[0].map, MapMeasure::kSuccess, "tum", LateDigit::kLast, {{2, 0}});
  ASSERT_NE(cell, nullptr);
  EXPECT_NEAR(cell->estimate, -1.0 / 3.0, 1e-12) << "all lost by 0.3 s";
  EXPECT_EQ(cell->changed.size(), 3u);
  ASSERT_EQ(result.findings().size(), 3u) << "over all regions, by region, by object";
  EXPECT_NE(result.findings()[2].find("By object"), std::string::npos);
  EXPECT_EQ(result.findings()[0].rfind("tum: matters.", 0), 0u) << result.findings()[0];
  const Json json = ToJson(result);
  EXPECT_EQ(json["parts"][0]["id"], "success");
  const std::vector<ExportTable> tables = MakeMapTables(result);
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].name, "map");
  EXPECT_NE(tables[0].csv.find("success,success,tum,last,grip,margin 1.5,,,"), std::string::npos);
  EXPECT_EQ(tables[1].name, "map_objects");
  EXPECT_EQ(json["objects"].size(), 24u) << "twelve objects, first and last digit";
}

TEST(MapTrials, SayWhatTheirConditionAndRecordSay) {
  Session session = MakeMapSessionResult();
  session.records[0].result.contacts[2].time = kUnset;  // the middle finger never touches
  const MapData data = ListMapTrials(session, {});
  ASSERT_EQ(data.trials.size(), session.records.size());
  EXPECT_EQ(data.factors.size(), ListMapFactors().size());
  EXPECT_TRUE(data.factors[4].scales_draws);
  EXPECT_TRUE(std::isinf(data.trials[0].first_to_last));
  EXPECT_TRUE(std::isinf(data.trials[0].values[static_cast<size_t>(MapMeasure::kPush)]));
  const MapTrial& trial = data.trials[1];
  EXPECT_NEAR(trial.first_to_last, 0.05, 1e-12);
  EXPECT_NEAR(trial.values[static_cast<size_t>(MapMeasure::kPush)], 0.001 + trial.delay, 1e-12);
  EXPECT_TRUE(std::isnan(trial.values[static_cast<size_t>(MapMeasure::kThreshold)]));
  EXPECT_LE(trial.offset, std::sqrt(2.0) * 0.01);
}

TEST(MapTrials, ANumericalFailureSaysNothing) {
  Session session = MakeMapSessionResult();
  session.records[3].result.outcome = Outcome::kNumericalFailure;
  EXPECT_EQ(ListMapTrials(session, {}).trials.size(), session.records.size() - 1);
}

}  // namespace

}  // namespace graspbench
