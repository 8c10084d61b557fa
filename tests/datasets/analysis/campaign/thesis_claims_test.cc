#include "datasets/analysis/campaign/thesis_claims.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {

namespace {

/** What the three variants of a scene are worth, by number of the scene. */
struct Worth {
  double gft[3] = {0.4, 0.4, 0.4};
  double breaking[3] = {4.0, 4.0, 4.0};
  double sigma[3] = {4.0, 4.0, 4.0};
  int lost[3] = {0, 0, 0};  ///< of ten trials
};

/** Eight objects for each of two hands; scenes and variants differ by up to 12 %. */
Campaign MakeWorthCampaign(const Worth& worth, bool shadow_is_turned_round = false) {
  Campaign campaign;
  for (const std::string hand : {"tum", "shadow"}) {
    for (int object = 0; object < 8; ++object) {
      SceneRecord scene;
      scene.config.hand = hand;
      scene.config.object = "thing" + std::to_string(object);
      scene.config.grasp = "g3";
      scene.result = {{"target_step", {{"taken", true}}}};
      campaign.scenes.push_back(scene);
      const char* grasps[] = {"g3", "new-pregrasp", "new-target"};
      for (int variant = 0; variant < 3; ++variant) {
        const double share = 1.0 + 0.02 * ((variant + 2) * object % 7);
        for (int trial = 0; trial < 10; ++trial) {
          const std::string& thing = scene.config.object;
          const PlannedTrial plan = {hand + grasps[variant] + thing + std::to_string(trial), hand,
                                     thing, grasps[variant], trial};
          const bool is_lost = trial < worth.lost[variant];
          TrialRecord record =
              MakeRecord(plan, is_lost ? Outcome::kSlippedInLiftOff : Outcome::kSuccess);
          const bool is_turned = hand == "shadow" && shadow_is_turned_round && variant < 2;
          record.result.timing.gft_ratio = share * worth.gft[is_turned ? 1 - variant : variant];
          record.result.stability.sigma = is_lost ? 0.0 : share * worth.sigma[variant];
          record.result.stability.hold.normal_force = 20.0;
          if (!is_lost) {
            record.judgement.emplace().breaking_force = share * worth.breaking[variant];
          }
          campaign.benchmark.plan.push_back(plan);
          campaign.benchmark.records.push_back(record);
        }
      }
    }
  }
  return campaign;
}

ClaimVerdict FindVerdict(const Campaign& campaign, const std::string& id) {
  const Summarised summarised(campaign);
  for (const ThesisClaim& claim : JudgeThesis(summarised.campaign, summarised.scenes)) {
    if (claim.id == id) return claim.verdict;
  }
  ADD_FAILURE() << id;
  return ClaimVerdict::kNotDecided;
}

TEST(ThesisClaims, HoldWhereTheirPlantedEffectIs) {
  Worth worth;
  worth.gft[1] = worth.gft[2] = 0.2;
  worth.breaking[2] = 6.0;
  worth.sigma[2] = 5.0;
  const Campaign campaign = MakeWorthCampaign(worth);
  for (const char* id : {"learned", "thumb", "better", "sigma"}) {
    EXPECT_EQ(FindVerdict(campaign, id), ClaimVerdict::kHolds) << id;
  }
}

TEST(ThesisClaims, DoNotHoldWhereTheOppositeIs) {
  Worth worth;
  worth.gft[0] = 0.2;
  worth.breaking[2] = 3.0;
  worth.sigma[2] = 5.0;
  const Campaign campaign = MakeWorthCampaign(worth);
  for (const char* id : {"learned", "thumb", "better", "sigma"}) {
    EXPECT_EQ(FindVerdict(campaign, id), ClaimVerdict::kDoesNotHold) << id;
  }
}

TEST(ThesisClaims, AreNotDecidedWhereNothingChanges) {
  const Campaign campaign = MakeWorthCampaign({});
  for (const char* id : {"learned", "thumb", "better"}) {
    EXPECT_EQ(FindVerdict(campaign, id), ClaimVerdict::kNotDecided) << id;
  }
}

// Late digits go with failures, as they would if both came from where the object lay.
TEST(ThesisClaims, ACorrelationDecidesNothing) {
  Campaign campaign = MakeWorthCampaign({});
  for (size_t i = 0; i < campaign.benchmark.records.size(); ++i) {
    TrialResult& result = campaign.benchmark.records[i].result;
    const bool is_late = campaign.benchmark.plan[i].trial % 2 == 1;
    result.timing.gct = 0.5 + 0.001 * static_cast<double>(i);  // no variant is a copy of another
    result.timing.gft_ratio = is_late ? 0.8 : 0.2;
    if (is_late && i % 3 > 0) result.outcome = Outcome::kSlippedInLiftOff;
  }
  const Summarised summarised(campaign);
  const ThesisClaim claim = JudgeThesis(summarised.campaign, summarised.scenes).front();
  ASSERT_FALSE(claim.evidence.empty());
  EXPECT_LT(claim.evidence[0].interval.high, 0.0) << "the correlation itself is certain";
  EXPECT_EQ(claim.verdict, ClaimVerdict::kNotDecided);
}

TEST(ThesisClaims, OneHandIsNotTwo) {
  Worth worth;
  worth.gft[1] = worth.gft[2] = 0.2;
  EXPECT_EQ(FindVerdict(MakeWorthCampaign(worth), "learned"), ClaimVerdict::kHolds);
  EXPECT_EQ(FindVerdict(MakeWorthCampaign(worth, true), "learned"), ClaimVerdict::kDoesNotHold);
}

// Stronger grasps that lose every fifth object are not better.
TEST(ThesisClaims, SuccessThatIsLostOutweighsForce) {
  Worth worth;
  worth.breaking[2] = 8.0;
  worth.lost[2] = 2;
  EXPECT_EQ(FindVerdict(MakeWorthCampaign(worth), "better"), ClaimVerdict::kDoesNotHold);
}

TEST(ThesisClaims, PairsAreOfOnePose) {
  Worth worth;
  worth.lost[0] = 1;
  worth.lost[2] = 3;
  const Summarised summarised(MakeWorthCampaign(worth));
  const PairedCounts counts =
      CountPairedSuccesses(summarised.scenes, kStandardGrasp, kNewTarget, "tum");
  EXPECT_EQ(counts.num_pairs(), 80);
  EXPECT_EQ(counts.neither, 8);
  EXPECT_EQ(counts.first_only, 16);
  EXPECT_EQ(counts.second_only, 0);
}

TEST(ThesisClaims, WithoutTrialsNothingIsDecided) {
  const Summarised summarised((Campaign()));
  for (const ThesisClaim& claim : JudgeThesis(summarised.campaign, summarised.scenes)) {
    EXPECT_EQ(claim.verdict, ClaimVerdict::kNotDecided) << claim.id;
    EXPECT_TRUE(claim.evidence.empty()) << claim.id;
  }
}

// FF touches at 0.4, TH at 0.5, MF at 0.6 s in every trial.
TEST(GraspCourse, GapIsTheMeanOverTrialsInWhichBothTouched) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 3);
  session.records[0].result.contacts[1].time += 0.1;
  session.records[2].result.contacts[0].time = std::nan("");
  const CellSummary cell = SummariseSession(session).cells.at(0);
  EXPECT_NEAR(CalcContactGap(cell, "FF", "MF"), 0.25, 1e-12);
  EXPECT_NEAR(CalcContactGap(cell, "MF", "FF"), 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(CalcContactGap(cell, "FF", "LF")));
}

TEST(GraspCourse, FirstTouchesAreCountedByDigit) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 4);
  session.records[1].result.contacts[2].time = 0.1;  // the thumb
  for (DigitContact& contact : session.records[2].result.contacts) contact.time = std::nan("");
  const CellSummary cell = SummariseSession(session).cells.at(0);
  const std::map<std::string, int> expected = {{"FF", 2}, {"TH", 1}};
  EXPECT_EQ(CountFirstTouches(cell), expected);
  EXPECT_EQ(FindFirstDigit(cell), "FF");
  EXPECT_EQ(FindFirstDigit(CellSummary()), "");
}

}  // namespace

}  // namespace graspbench
