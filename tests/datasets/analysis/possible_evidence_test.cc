// Intervals of judged sessions, thresholds, relations, best grasps and campaigns lie within what
// their numbers can be, whatever comes in: all, none, one cell, ties, one that differs.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/trial/judge/judge.h"
#include "datasets/analysis/best_grasps.h"
#include "datasets/analysis/campaign/campaign_summary.h"
#include "datasets/analysis/campaign/thesis_claims.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/judge_evidence.h"
#include "datasets/analysis/map/common_cause.h"
#include "datasets/analysis/simultaneity_summary.h"
#include "datasets/plan/conditions.h"
#include "tests/datasets/analysis/made_results.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

/** A number of each trial by cell and trial. */
struct ExtremeValue {
  const char* name;
  std::function<double(int cell, int trial)> value;
};

std::vector<ExtremeValue> ListExtremeValues() {
  return {{"zero", [](int, int) { return 0.0; }},
          {"ties", [](int, int) { return 1.0; }},
          {"two values", [](int, int trial) { return trial % 2; }},
          {"by cell", [](int cell, int) { return 1.0 + cell; }},
          {"against cell", [](int cell, int) { return 100.0 - cell; }},
          {"one differs", [](int cell, int trial) { return cell + trial == 0 ? 1.0 : 0.0; }},
          {"unlike", [](int cell, int trial) { return (5 * cell + 3 * trial) % 7; }}};
}

void ExpectInside(const Interval& interval, double least, double most) {
  if (std::isnan(interval.low) && std::isnan(interval.high)) return;
  EXPECT_GE(interval.low, least - 1e-12);
  EXPECT_LE(interval.high, most + 1e-12);
  EXPECT_LE(interval.low, interval.high);
}

void ForEachPair(const std::function<void(const ExtremeValue&, const ExtremeValue&)>& check) {
  for (const ExtremeValue& a : ListExtremeValues()) {
    for (const ExtremeValue& b : ListExtremeValues()) {
      SCOPED_TRACE(std::string(a.name) + ", " + b.name);
      check(a, b);
    }
  }
}

class PossibleEvidence : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  /** Objects of one hand. */
  static Session MakeTrials(const std::function<void(TrialRecord&, int cell)>& change) {
    std::vector<std::string> objects;
    for (int i = 0; i < GetParam().first; ++i) objects.push_back("object" + std::to_string(i));
    Session session = MakeSession({"tum"}, objects, "g1", GetParam().second);
    for (size_t i = 0; i < session.records.size(); ++i) {
      change(session.records[i], static_cast<int>(i) / GetParam().second);
    }
    return session;
  }
};

TEST_P(PossibleEvidence, OfTheJudge) {
  ForEachPair([](const ExtremeValue& sigma, const ExtremeValue& breaking) {
    for (const double most_successes : {0.0, 0.5, 1.0}) {
      const Session session = MakeTrials([&](TrialRecord& record, int cell) {
        const int trial = record.plan.trial;
        record.result.stability.sigma = sigma.value(cell, trial);
        if (sigma.value(cell, trial) > most_successes) {
          record.result.outcome = Outcome::kSlippedInLiftOff;
          return;
        }
        Judgement judgement = MakeEmptyHandJudgement();
        judgement.breaking_force = breaking.value(cell, trial);
        record.judgement = judgement;
      });
      const JudgeEvidence evidence = CalcJudgeEvidence(session.records);
      for (const RankEvidence& rank : evidence.ranks) {
        if (rank.correlation) ExpectInside(rank.correlation->interval, -1.0, 1.0);
      }
      for (const RocEvidence& roc : evidence.roc) {
        if (roc.area) ExpectInside(roc.area->interval, 0.0, 1.0);
      }
      for (const std::vector<Agreement>& row : evidence.agreements) {
        for (const Agreement& agreement : row) {
          ExpectInside({agreement.share(), agreement.share()}, 0.0, 1.0);
        }
      }
    }
  });
}

TEST_P(PossibleEvidence, OfRelations) {
  ForEachPair([](const ExtremeValue& gft, const ExtremeValue& push) {
    const Session session = MakeTrials([&](TrialRecord& record, int cell) {
      record.result.timing.gft_ratio = gft.value(cell, record.plan.trial);
      record.result.stability.sigma = push.value(cell, record.plan.trial);
      if (push.value(cell, record.plan.trial) == 0.0) record.result.outcome = Outcome::kPushedAway;
    });
    for (const SimultaneityRelation& row : SummariseSimultaneity(session)) {
      if (row.relation && row.relation->interval) {
        ExpectInside(*row.relation->interval, -1.0, 1.0);
      }
    }
  });
}

// Where all trials or times are alike, nothing correlates, whatever rounding leaves of them.
TEST_P(PossibleEvidence, OfCommonCauses) {
  ForEachPair([](const ExtremeValue& success, const ExtremeValue& cause) {
    MapData data;
    data.factors = {{"grip", {"weak", "firm"}, false}};
    bool is_varied = false;
    for (int object = 0; object < GetParam().first; ++object) {
      const bool first_holds = success.value(object, 0) > 0.0;
      for (int draw = 0; draw < GetParam().second; ++draw) {
        const bool holds = success.value(object, draw) > 0.0;
        is_varied |= holds != first_holds;
        MapTrial trial;
        trial.hand = "tum";
        trial.object = "object" + std::to_string(object);
        trial.draw = draw;
        trial.levels = {static_cast<size_t>((object + draw) % 2)};
        trial.values = {holds ? 1.0 : 0.0, kUnset, kUnset, kUnset};
        trial.first_to_last = 0.1 * cause.value(object, draw);
        trial.offset = trial.turn = 0.001 * cause.value(object, draw);
        data.trials.push_back(trial);
      }
    }
    const Answer<NaturalRelation> relation = FindNaturalRelation(data, "tum");
    if (!relation) return;
    EXPECT_TRUE(is_varied) << relation->correlation;
    ExpectInside(relation->interval, -1.0, 1.0);
    for (const NaturalRelation::Cause& one : relation->causes) {
      ExpectInside({one.partial, one.partial}, -1.0, 1.0);
      ExpectInside(one.interval, -1.0, 1.0);
    }
  });
}

TEST_P(PossibleEvidence, OfBestGrasps) {
  ForEachPair([](const ExtremeValue& usual, const ExtremeValue& other) {
    Session session;
    session.config.grasps = {"all"};
    session.config.trials = GetParam().second;
    const SessionInputs inputs = MakeFakeInputs();
    session.plan = MakePlan(session.config, inputs);
    for (const PlannedTrial& planned : session.plan) {
      TrialRecord& record = session.records.emplace_back(MakeFakeRecord(planned));
      const bool is_g1 = planned.grasp == "g1";
      const double value = (is_g1 ? other : usual).value(is_g1, planned.trial);
      record.result.outcome = value > 0.0 ? Outcome::kSuccess : Outcome::kPushedAway;
    }
    const SessionSummary summary = SummariseSession(session);
    for (const BestGrasp& row : FindBestGrasps(session, summary, inputs)) {
      ExpectInside(row.gain, -1.0, 1.0);
    }
  });
}

// Of the scale's grips; above them where no grip held.
TEST_P(PossibleEvidence, OfThresholds) {
  for (const ThresholdScale& scale : kThresholdScales) {
    for (const ExtremeValue& first : ListExtremeValues()) {
      SCOPED_TRACE(first.name);
      Session session, experiment;
      experiment.config.conditions = ListThresholdGrips(scale, experiment.config);
      for (int object = 0; object < GetParam().first; ++object) {
        for (int trial = 0; trial < GetParam().second; ++trial) {
          PlannedTrial planned = {"", "tum", "object" + std::to_string(object), "g1", trial};
          planned.id = DescribeTrial(planned);
          session.plan.push_back(planned);
          experiment.plan.push_back(planned);
          const std::string base = planned.id;
          for (int place = 0; place <= kMostGripPlace; ++place) {
            planned.id = base + std::to_string(place);
            planned.condition = experiment.config.conditions[static_cast<size_t>(place)].name;
            experiment.plan.push_back(planned);
            TrialRecord& record = experiment.records.emplace_back();
            record.plan = planned;
            record.result.outcome = place >= first.value(object, trial)
                                        ? Outcome::kSuccess
                                        : Outcome::kDroppedWhileHolding;
          }
        }
      }
      for (const CellThreshold& cell : SummariseThresholds(experiment, session).cells) {
        if (std::isnan(cell.low)) continue;  // too few draws
        const double most = cell.num_never > 0 ? INFINITY : scale.most;
        ExpectInside({cell.low, cell.high}, scale.least, most);
        ExpectInside({cell.low, cell.median}, scale.least, INFINITY);
        ExpectInside({cell.median, cell.high}, scale.least, INFINITY);
      }
    }
  }
}

Campaign MakeExtremeCampaign(const std::pair<int, int>& size, const ExtremeValue& before,
                             const ExtremeValue& after) {
  Campaign campaign;
  for (int object = 0; object < size.first; ++object) {
    SceneRecord scene;
    scene.config.hand = "tum";
    scene.config.object = "object" + std::to_string(object);
    scene.config.grasp = "g3";
    scene.result = {{"target_step", {{"taken", true}}}};
    campaign.scenes.push_back(scene);
    for (const char* grasp : {"g3", "new-pregrasp", "new-target"}) {
      const ExtremeValue& extreme = std::string(grasp) == "g3" ? before : after;
      for (int trial = 0; trial < size.second; ++trial) {
        const PlannedTrial plan = {grasp + scene.config.object + std::to_string(trial), "tum",
                                   scene.config.object, grasp, trial};
        const double value = extreme.value(object, trial);
        TrialRecord record =
            MakeRecord(plan, value > 0.0 ? Outcome::kSuccess : Outcome::kSlippedInLiftOff);
        record.result.timing.gft_ratio = value;
        record.result.stability.sigma = value;
        if (value > 0.0) record.judgement.emplace().breaking_force = value;
        campaign.benchmark.plan.push_back(plan);
        campaign.benchmark.records.push_back(record);
      }
    }
  }
  return campaign;
}

// Ratios are not negative, shares and correlations are within 1.
TEST_P(PossibleEvidence, OfCampaigns) {
  ForEachPair([](const ExtremeValue& before, const ExtremeValue& after) {
    const Summarised summarised(MakeExtremeCampaign(GetParam(), before, after));
    for (const VariantMeasure& measure : ListVariantMeasures()) {
      const StepEffect effect = CalcStepEffect(measure, summarised.scenes, Variant(0), Variant(1));
      if (effect.ratio) ExpectInside(effect.ratio->interval, 0.0, INFINITY);
      if (std::string(measure.name).rfind("success", 0) != 0) continue;
      for (const SceneVariants& scene : summarised.scenes) {
        const PairedDifference row = CalcPairedDifference(measure, scene, Variant(0), Variant(1));
        if (row.interval) ExpectInside(row.interval->interval, -1.0, 1.0);
      }
    }
    for (const ThesisClaim& claim : JudgeThesis(summarised.campaign, summarised.scenes)) {
      for (const ClaimEvidence& evidence : claim.evidence) {
        // A claim whose neutral value is 1 is about a ratio, 0.5 about a share, 0 a correlation.
        const bool is_ratio = claim.neutral == 1.0;
        SCOPED_TRACE(std::string(claim.id) + ", " + evidence.what);
        ExpectInside(evidence.interval, claim.neutral == 0.0 ? -1.0 : 0.0,
                     is_ratio ? INFINITY : 1.0);
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(OfObjectsAndTrials, PossibleEvidence,
                         testing::Values(std::pair(1, 1), std::pair(1, 8), std::pair(5, 1),
                                         std::pair(6, 3)));

}  // namespace
}  // namespace graspbench
