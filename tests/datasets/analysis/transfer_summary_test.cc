#include "datasets/analysis/transfer_summary.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

TransferRow MakeRow(const std::string& object, const std::string& grasp, const std::string& reason,
                    double distance) {
  TransferRow row;
  row.hand = "tum";
  row.object = object;
  row.grasp = grasp;
  row.not_transferable = reason;
  row.pads = {{"TH", "TH", distance, 0.1, true}, {"FF", "FF", distance + 0.001, 0.3, true}};
  return row;
}

/** Two trials of each of three grasps on the can: the transferred one fails in the second. */
Session MakeTried() {
  Session session = MakeSession({"tum"}, {"can"}, "person-01", 2);
  session.records[1].result.outcome = Outcome::kDroppedWhileHolding;
  for (const char* grasp : {"rehearsed", "g1"}) {
    const Session other = MakeSession({"tum"}, {"can"}, grasp, 2);
    session.plan.insert(session.plan.end(), other.plan.begin(), other.plan.end());
    session.records.insert(session.records.end(), other.records.begin(), other.records.end());
  }
  session.records[4].result.outcome = session.records[5].result.outcome =
      Outcome::kDroppedWhileHolding;
  return session;
}

TEST(TransferSummary, CountsWhatWasTransferredAndWhatTrialsSay) {
  const TransferFile file = {"pilot",
                             {},
                             {MakeRow("can", "person-01", "", 0.001),
                              MakeRow("can", "person-02", "FF stays 12.5 mm away", 0.02),
                              MakeRow("cup", "person-01", "FF stays 7.1 mm away", 0.02)}};
  const Session session = MakeTried();
  const std::vector<TransferSummary> summaries = SummariseTransfers(file, session);
  ASSERT_EQ(summaries.size(), 3u);  // tum, then tum on can and cup
  const TransferSummary& all = summaries[0];
  EXPECT_EQ(all.object, "");
  EXPECT_EQ(all.num_grasps, 3);
  EXPECT_EQ(all.num_transferred, 1);
  EXPECT_NEAR(all.median_distance, 0.0015, 1e-12);
  EXPECT_NEAR(all.median_angle, 0.2, 1e-12);
  EXPECT_EQ(all.near_share, 1.0);
  EXPECT_EQ(all.transferred.successes(), 1);
  EXPECT_EQ(all.rehearsed.successes(), 2);
  EXPECT_EQ(all.standard.successes(), 0);
  EXPECT_DOUBLE_EQ(all.over_rehearsed.estimate, -0.5);
  EXPECT_DOUBLE_EQ(all.over_standard.estimate, 0.5);
  EXPECT_EQ(summaries[2].object, "cup");
  EXPECT_EQ(summaries[2].num_transferred, 0);
  EXPECT_EQ(summaries[2].transferred.finished, 0);

  const auto reasons = CountTransferReasons(file, "tum");
  ASSERT_EQ(reasons.size(), 1u);  // alike but for their numbers
  EXPECT_EQ(reasons[0].first, "FF stays 12.5 mm away");
  EXPECT_EQ(reasons[0].second, 2);

  const std::vector<TransferDigit> digits = ListTransferDigits(file);
  ASSERT_EQ(digits.size(), 2u);
  EXPECT_EQ(digits[1].digit, "FF");
  EXPECT_EQ(digits[1].num_pads, 1);
  EXPECT_NEAR(digits[1].largest_distance, 0.002, 1e-12);
}

// A played grasp is compared with the same grasp without its course, on the same draws.
TEST(TransferSummary, ComparesPlayedGraspsWithTheSameGrasps) {
  const TransferFile file = {
      "pilot", {}, {MakeRow("can", "person-01", "", 0.001), MakeRow("can", "person-02", "", 0.02)}};
  Session session = MakeTried();  // person-01 fails in the second of two draws
  const Session played = MakeSession({"tum"}, {"can"}, "person-01-played", 2);
  session.plan.insert(session.plan.end(), played.plan.begin(), played.plan.end());
  session.records.insert(session.records.end(), played.records.begin(), played.records.end());
  const TransferSummary all = SummariseTransfers(file, session).front();
  EXPECT_EQ(all.transferred.finished, 2);
  EXPECT_EQ(all.played.finished, 2);
  EXPECT_EQ(all.played.successes(), 2);
  EXPECT_EQ(all.of_playing.num_draws, 2);
  EXPECT_DOUBLE_EQ(all.of_playing.estimate, 0.5);
  EXPECT_DOUBLE_EQ(all.over_standard.estimate, 0.5);  // as without it
  TransferFile refused = file;
  refused.rows[0].not_played = "0.24 s before contact FF is 3.1 mm inside the table";
  const auto reasons = CountTransferReasons(refused, "tum", &TransferRow::not_played);
  ASSERT_EQ(reasons.size(), 1u);
  EXPECT_EQ(reasons[0].second, 1);
}

TEST(TransferSummary, TheFileReadsBack) {
  const TransferFile file = {"pilot", {"sizes differ"}, {MakeRow("can", "person-01", "no", 0.001)}};
  TransferFile read;
  ReadRecord(RecordToJson(file), read);
  EXPECT_EQ(RecordToJson(read), RecordToJson(file));
}

}  // namespace
}  // namespace graspbench
