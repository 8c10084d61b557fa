#include "core/develop/develop_grasp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "core/base/units.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

/** A world without physics: the nearer a grasp's target is to a hidden one, the better. */
class HiddenTarget {
 public:
  HiddenTarget(const Hand& hand, const std::vector<ProposedGrasp>& proposals)
      : hidden_(proposals.at(3).grasp.q_target) {
    for (int j = 0; j < hand.num_joints(); ++j) {
      if (hand.joints[j].coupled_to < 0) hidden_[j] += RadFromDeg(4.0);
    }
  }
  double Score(const Grasp& grasp) const {
    return 1.3 * std::exp(-(grasp.q_target - hidden_).norm());
  }
  RunDevelopTrials MakeRun() {
    return [this](const std::vector<DevelopRequest>& requests) {
      std::vector<std::vector<DevelopTrial>> answers;
      for (const DevelopRequest& request : requests) {
        for (const auto& trial : request.trials) {
          places_[request.stage].insert({trial.shape, trial.draw});
          ++num_trials_;
        }
        const double score = Score(request.grasp);
        answers.emplace_back(
            request.trials.size(),
            DevelopTrial{score > 1.0 ? Outcome::kSuccess : Outcome::kNoContact, score});
      }
      return answers;
    };
  }

  std::map<std::string, std::set<std::pair<int, int>>> places_;  // by stage: shape, draw
  int num_trials_ = 0;

 private:
  Eigen::VectorXd hidden_;
};

class DevelopGraspTest : public testing::Test {
 protected:
  DevelopGraspTest()
      : hand_(LoadHand("tum")),
        proposals_(
            ProposeGrasps(hand_, FindGraspTaxon("g1"), 12, 12, false, RandomStream("1", "test"))) {}

  Hand hand_;
  std::vector<ProposedGrasp> proposals_;
};

TEST_F(DevelopGraspTest, TheRaceFindsTheBestProposalAndTheSearchABetterOne) {
  HiddenTarget world(hand_, proposals_);
  const DevelopedGrasp developed = DevelopGrasp(hand_, proposals_, 2000, 1, world.MakeRun());
  for (const ProposedGrasp& other : proposals_) {
    EXPECT_LE(world.Score(other.grasp), world.Score(developed.proposed.grasp));
  }
  EXPECT_GT(world.Score(developed.grasp), world.Score(developed.proposed.grasp));
  EXPECT_NEAR(developed.score, world.Score(developed.grasp), 1e-12);
  EXPECT_NEAR(developed.proposed_score, world.Score(developed.proposed.grasp), 1e-12);
  EXPECT_EQ(developed.num_trials, world.num_trials_);
}

// What decides and what checks has not been seen before.
TEST_F(DevelopGraspTest, FinalsHaveOtherDrawsAndTheCheckOtherShapes) {
  HiddenTarget world(hand_, proposals_);
  DevelopGrasp(hand_, proposals_, 1000, 1, world.MakeRun());
  for (const char* stage : {"race", "search"}) {
    for (const auto& [shape, draw] : world.places_[stage]) {
      EXPECT_LT(shape, kNumTrainingShapes) << stage;
      EXPECT_EQ(world.places_["finals"].count({shape, draw}), 0u) << stage;
    }
  }
  for (const auto& [shape, draw] : world.places_["check"]) EXPECT_GE(shape, kNumTrainingShapes);
  EXPECT_EQ(world.places_["check"].size(), static_cast<size_t>(kNumTrainingShapes));
}

TEST_F(DevelopGraspTest, KeepsTheBudgetAndRepeatsItself) {
  for (const int budget : {20, 400, 2500}) {
    HiddenTarget world(hand_, proposals_);
    const DevelopedGrasp a = DevelopGrasp(hand_, proposals_, budget, 1, world.MakeRun());
    const DevelopedGrasp b = DevelopGrasp(hand_, proposals_, budget, 1, world.MakeRun());
    EXPECT_EQ(a.grasp.q_target, b.grasp.q_target);
    EXPECT_LE(a.num_trials, CountDevelopTrials(budget)) << budget;
    EXPECT_LE(CountDevelopTrials(budget), std::max(100.0, 1.2 * budget)) << budget;
  }
}

// A world in which the start is the luckiest in the first finals and the unluckiest after them, and
// the other way round: whatever is chosen scores no lower on the same trials.
TEST_F(DevelopGraspTest, NothingIsChosenThatScoresLowerThanTheStart) {
  for (const int seed : {1, 2, 3, 4, 5, 6}) {
    RandomStream luck(std::to_string(seed), "luck");
    const auto run = [&](const std::vector<DevelopRequest>& requests) {
      std::vector<std::vector<DevelopTrial>> answers;
      for (const DevelopRequest& request : requests) {
        const DevelopTrial trial{Outcome::kNoContact, luck.NextUnit()};
        answers.emplace_back(request.trials.size(), trial);
      }
      return answers;
    };
    const DevelopedGrasp developed = DevelopGrasp(hand_, proposals_, 900, seed, run);
    EXPECT_GE(developed.score, developed.proposed_score);
    EXPECT_GT(developed.proposed_score, 0.0);
  }
}

// In all stages: one trial of each request fails, and nothing else.
TEST_F(DevelopGraspTest, CountsTrialsThatFailNumerically) {
  int num_requests = 0;
  const auto run = [&](const std::vector<DevelopRequest>& requests) {
    std::vector<std::vector<DevelopTrial>> answers;
    for (const DevelopRequest& request : requests) {
      ++num_requests;
      answers.emplace_back(request.trials.size(), DevelopTrial{Outcome::kNoContact, 0.1});
      answers.back().front() = {Outcome::kNumericalFailure, 0.0};
    }
    return answers;
  };
  const DevelopedGrasp developed = DevelopGrasp(hand_, proposals_, 400, 1, run);
  EXPECT_EQ(developed.num_numerical_failures, num_requests);
  EXPECT_GT(num_requests, 10);
}

class DevelopTrialTest : public testing::Test {
 protected:
  DevelopTrialTest() {
    object_.mass_properties.mass = 0.1;
    result_.contacts = {{"TH", true, 0.4}, {"FF", false, std::nan("")}};
  }
  double Score(Outcome outcome) {
    result_.outcome = outcome;
    return MakeDevelopTrial(grasp_, object_, result_).score;
  }
  void Lift(double height) { result_.lift_height = height; }

  Grasp grasp_;
  GraspObject object_;
  TrialResult result_;
};

TEST_F(DevelopTrialTest, FailuresLeadTowardsSuccess) {
  EXPECT_EQ(Score(Outcome::kNumericalFailure), 0.0);
  const double one_touched = Score(Outcome::kNoContact);
  EXPECT_NEAR(one_touched, 0.15, 1e-12);
  result_.contacts[1].time = 0.5;
  const double all_touched = Score(Outcome::kSlippedInLiftOff);
  EXPECT_GT(all_touched, one_touched);
  Lift(0.05);
  const double half_lifted = Score(Outcome::kDroppedWhileHolding);
  EXPECT_NEAR(half_lifted, all_touched + 0.1, 1e-12);
  Lift(5.0);
  EXPECT_LT(Score(Outcome::kDroppedWhileHolding), 1.0);
}

TEST_F(DevelopTrialTest, TheOppositionOfTheNameCounts) {
  result_.stability.sigma = 0.0;
  result_.contacts[1].time = 0.5;
  for (const auto& [id, opposition] :
       {std::pair("g1", Opposition::kPad), std::pair("g2", Opposition::kPad),
        std::pair("g3", Opposition::kPalm), std::pair("g4", Opposition::kSide)}) {
    grasp_.id = id;
    for (const auto& found : kOppositions) {
      result_.opposition = found.value;
      const bool is_called = found.value == opposition;
      EXPECT_NEAR(Score(Outcome::kSuccess), is_called ? 1.8 : 1.2, 1e-12) << id << found.name;
      EXPECT_EQ(MakeDevelopTrial(grasp_, object_, result_).is_as_called, is_called);
    }
  }
}

}  // namespace
}  // namespace graspbench
