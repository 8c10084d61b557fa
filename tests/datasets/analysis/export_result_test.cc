#include "datasets/analysis/export_result.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/files/files.h"
#include "datasets/analysis/conditions/basin_summary.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

// A basin says its samples in its own folder, under its manifest.
TEST(ExportResult, OfABasinHasItsSamples) {
  TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path() / "basin";
  SessionConfig config;
  config.draws = "halton";
  config.trials = 3;
  std::vector<PlannedTrial> plan;
  for (int i = 0; i < 3; ++i) {
    plan.push_back({"000000000000000" + std::to_string(i), "tum", "mug", "g2", i, std::nullopt});
  }
  CreateSession(folder, config, plan);
  {
    JournalWriter journal(folder, 0);
    for (const PlannedTrial& planned : plan) journal.Append(MakeFakeRecord(planned));
  }
  ExportResult(folder, LoadSession(folder, OnDamage::kRefuse, RecordParts::kBrief));
  const std::string csv = ReadFile(folder / "basin.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  WriteFile(folder / "basin.csv", csv + "1,2,3\n");
  EXPECT_FALSE(CheckStore(folder).damages.empty()) << "it is in a hash";
  // The points are those of the Halton sequence, in this session's box.
  const std::vector<BasinSample> samples = ListBasinSamples(LoadSession(folder, OnDamage::kAccept));
  EXPECT_EQ(samples[0].offset_x, 0.0);
  EXPECT_EQ(samples[1].offset_x, 0.0);  // the middle of the interval in base 2
  EXPECT_NEAR(samples[1].offset_y, -config.variation.offset / 3.0, 1e-15);
  EXPECT_NEAR(samples[2].offset_x, -config.variation.offset / 2.0, 1e-15);
}

}  // namespace
}  // namespace graspbench
