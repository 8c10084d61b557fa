#include "core/optimise/target_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/optimise/grasp_optimiser.h"

namespace graspbench {
namespace {

SearchResult MakeResult(const std::vector<std::pair<double, double>>& degrees_and_fitness) {
  SearchResult result;
  for (const auto& [degrees, fitness] : degrees_and_fitness) {
    Individual individual;
    individual.number = static_cast<int>(result.individuals.size());
    individual.genome = Eigen::Vector2d(0.0, RadFromDeg(degrees));
    individual.fitness = fitness;
    result.individuals.push_back(individual);
  }
  return result;
}

TEST(FindCandidates, TakesTheFittestThatDifferByTwoDegreesAndNeverTheStart) {
  const SearchResult result =
      MakeResult({{0.0, 9.0}, {10.0, 3.0}, {11.0, 5.0}, {13.5, 4.0}, {20.0, 1.0}});
  std::vector<int> numbers;
  for (const Individual& individual : FindCandidates(result, {0, 1, 2, 3, 4}, 10)) {
    numbers.push_back(individual.number);
  }
  EXPECT_EQ(numbers, (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(FindCandidates(result, {0, 1, 2, 3, 4}, 2).size(), 2u);
  EXPECT_EQ(FindCandidates(result, {0, 1, 3}, 1).at(0).number, 3);
  EXPECT_TRUE(FindCandidates(MakeResult({{0.0, 1.0}}), {0}, 10).empty());
}

class TargetSearchTest : public testing::Test {
 protected:
  TargetSearchTest() : hand_(LoadHand("tum")) {
    ball_.id = "ball";
    ball_.size = Eigen::Vector3d::Constant(0.05);
    start_ = LoadStandardGrasps(hand_).at(2);
    start_.placement = Placement();
  }

  /** Sigma 1 with a grip of 10 N at the start, of 20 N elsewhere; every second trial succeeds. */
  RunLearningTrials MakeRun() {
    return [this](const std::vector<LearningRequest>& requests) {
      std::vector<std::vector<LearningTrial>> answers;
      for (const LearningRequest& request : requests) {
        answers.emplace_back();
        for (const int draw : request.draws) {
          LearningTrial& trial = answers.back().emplace_back();
          trial.sigma = 1.0;
          trial.contacts = {{"TH", true, 0.5}};
          trial.stability.normal_force = request.grasp.q_target == start_.q_target ? 10.0 : 20.0;
          const bool holds = request.individual.number == 2 || draw % 2 == 0;
          trial.outcome = holds ? Outcome::kSuccess : Outcome::kPushedAway;
        }
      }
      return answers;
    };
  }

  Individual MakeIndividual(const TargetSearch& search, int number) const {
    Individual individual;
    individual.number = number;
    individual.genome = search.space().box().start;
    individual.genome[0] += RadFromDeg(3.0 * number);
    return individual;
  }

  Hand hand_;
  GraspObject ball_;
  Grasp start_;
  OptimiseConfig config_;
};

// Twice the start's grip halves what counts.
TEST_F(TargetSearchTest, TheStartSaysHowHardMayBeGripped) {
  TargetSearch search(hand_, ball_, start_, config_);
  EXPECT_EQ(search.grip_limit(), kAnyGrip);
  EXPECT_EQ(search.Evaluate({MakeIndividual(search, 0)}, MakeRun()), std::vector<double>{1.0});
  EXPECT_EQ(search.grip_limit(), 10.0);
  EXPECT_EQ(search.Evaluate({MakeIndividual(search, 1)}, MakeRun()), std::vector<double>{0.5});
  config_.grip = "free";
  TargetSearch free(hand_, ball_, start_, config_);
  free.Evaluate({MakeIndividual(free, 0)}, MakeRun());
  EXPECT_EQ(free.Evaluate({MakeIndividual(free, 1)}, MakeRun()), std::vector<double>{1.0});
}

TEST_F(TargetSearchTest, RanksByWhatHoldsMostOften) {
  TargetSearch search(hand_, ball_, start_, config_);
  search.Evaluate({MakeIndividual(search, 0)}, MakeRun());
  const std::vector<Finalist> ranked =
      search.Rank(LearningStage::kScreening, {MakeIndividual(search, 1), MakeIndividual(search, 2)},
                  {1, 2, 3}, MakeRun());
  ASSERT_EQ(ranked.size(), 2u);
  EXPECT_EQ(ranked[0].number, 2);
  EXPECT_EQ(CountSuccesses(ranked[0].trials), 3);
  EXPECT_EQ(CountSuccesses(ranked[1].trials), 1);
}

// With twice the grip that may be used 1.5 N count as 0.75 N, less than 1 N without squeezing.
TEST_F(TargetSearchTest, RanksEqualsByWhatTheyHoldWithTheGripThatTheyMayUse) {
  TargetSearch search(hand_, ball_, start_, config_);
  search.Evaluate({MakeIndividual(search, 0)}, MakeRun());
  const auto run = [&](const std::vector<LearningRequest>& requests) {
    std::vector<std::vector<LearningTrial>> answers = MakeRun()(requests);
    for (size_t i = 0; i < requests.size(); ++i) {
      if (requests[i].individual.number == 3) answers[i][0].stability.normal_force = 10.0;
      if (requests[i].individual.number == 1) answers[i][0].sigma = 1.5;
    }
    return answers;
  };
  const std::vector<Finalist> ranked = search.Rank(
      LearningStage::kScreening, {MakeIndividual(search, 1), MakeIndividual(search, 3)}, {2}, run);
  ASSERT_EQ(ranked.size(), 2u);
  EXPECT_EQ(ranked[0].number, 3);
}

TEST_F(TargetSearchTest, EverySpaceAndMethodHasItsOwnStream) {
  const auto draw = [&](const char* space, const char* method) {
    config_.search = space;
    config_.method = method;
    return TargetSearch(hand_, ball_, start_, config_).MakeStream().NextNormal();
  };
  const double thumb = draw("thumb", "es");
  EXPECT_EQ(draw("thumb", "es"), thumb);
  EXPECT_NE(draw("all-digits", "es"), thumb);
  EXPECT_NE(draw("thumb", "random"), thumb);
  // As journals that are older than other spaces have it.
  RandomStream before(R"([1,"tum","ball","es",1])", "search of the target");
  EXPECT_EQ(before.NextNormal(), thumb);
}

}  // namespace
}  // namespace graspbench
