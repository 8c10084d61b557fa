#include "core/develop/develop_grasp.h"

#include <algorithm>
#include <numeric>

#include "core/base/error.h"
#include "core/develop/posture_changes.h"
#include "core/optimise/search.h"

namespace graspbench {
namespace {

/** How a budget is spent. */
struct Plan {
  int num_racing;       ///< proposals
  int num_shapes;       ///< of an evaluation
  int num_finalists;    ///< beside the proposal
  int num_evaluations;  ///< of the search

  int CountRace() const { return num_racing * num_shapes / 2 + (num_racing / 3 + 1) * num_shapes; }
  int CountFinals() const { return (num_finalists + 1) * 2 * num_shapes + kNumTrainingShapes; }
};

Plan MakePlan(int budget) {
  Plan plan;
  plan.num_racing = std::clamp(budget / 40, 2, 32);
  plan.num_shapes = budget < 200 ? 4 : kNumTrainingShapes;
  plan.num_finalists = std::clamp(budget / 100, 1, 5);
  plan.num_evaluations =
      std::max(1, (budget - plan.CountRace() - plan.CountFinals()) / plan.num_shapes);
  return plan;
}

/** Asks, counts and remembers. */
class Course {
 public:
  explicit Course(const RunDevelopTrials& run) : run_(run) {}

  std::vector<double> Score(const std::string& stage, const std::vector<StandardGrasp>& grasps,
                            int first_shape, int num_shapes, const std::vector<int>& draws) {
    std::vector<double> scores;
    for (const auto& trials : Run(stage, grasps, first_shape, num_shapes, draws)) {
      scores.push_back(CalcMeanScore(trials));
    }
    return scores;
  }
  std::vector<std::vector<DevelopTrial>> Run(const std::string& stage,
                                             const std::vector<StandardGrasp>& grasps,
                                             int first_shape, int num_shapes,
                                             const std::vector<int>& draws) {
    std::vector<DevelopRequest> requests;
    for (const StandardGrasp& grasp : grasps) {
      DevelopRequest request{stage, grasp, {}};
      for (int shape = first_shape; shape < first_shape + num_shapes; ++shape) {
        for (const int draw : draws) request.trials.push_back({shape, draw});
      }
      num_trials_ += static_cast<int>(request.trials.size());
      requests.push_back(std::move(request));
    }
    return run_(requests);
  }
  int num_trials() const { return num_trials_; }

 private:
  const RunDevelopTrials& run_;
  int num_trials_ = 0;
};

/** Indices by falling score, equal ones in their order. */
std::vector<size_t> SortByScore(const std::vector<double>& scores) {
  std::vector<size_t> order(scores.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return scores[a] > scores[b]; });
  return order;
}

/** @returns the index of the winner. */
size_t RunRace(const std::vector<ProposedGrasp>& proposals, const Plan& plan, Course& course) {
  std::vector<size_t> left(std::min(proposals.size(), static_cast<size_t>(plan.num_racing)));
  std::iota(left.begin(), left.end(), size_t{0});
  std::vector<double> sums(left.size(), 0.0);
  const auto run_heat = [&](int first_shape, int num_shapes, int draw) {
    std::vector<StandardGrasp> grasps;
    for (const size_t p : left) grasps.push_back(proposals[p].grasp);
    const auto scores = course.Score("race", grasps, first_shape, num_shapes, {draw});
    for (size_t k = 0; k < left.size(); ++k) sums[left[k]] += scores[k];
  };
  const auto keep = [&](size_t count) {
    std::stable_sort(left.begin(), left.end(),
                     [&](size_t a, size_t b) { return sums[a] > sums[b]; });
    left.resize(std::min(left.size(), std::max<size_t>(1, count)));
  };
  const int half = plan.num_shapes / 2;
  run_heat(0, half, 1);
  keep(left.size() / 3);
  run_heat(half, plan.num_shapes - half, 1);
  keep(left.size() / 3);
  run_heat(0, plan.num_shapes, 2);
  keep(1);
  return left.front();
}

}  // namespace

int CountDevelopTrials(int budget) {
  const Plan plan = MakePlan(budget);
  return plan.CountRace() + plan.num_evaluations * plan.num_shapes + plan.CountFinals();
}

DevelopedGrasp DevelopGrasp(const Hand& hand, const std::vector<ProposedGrasp>& proposals,
                            int budget, int seed, const RunDevelopTrials& run) {
  GRASPBENCH_DEMAND(!proposals.empty(), "nothing was proposed");
  const Plan plan = MakePlan(budget);
  Course course(run);
  DevelopedGrasp developed;
  developed.proposed = proposals[RunRace(proposals, plan, course)];

  const PostureChanges changes(hand, developed.proposed.grasp);
  const auto evaluate = [&](const std::vector<Individual>& generation) {
    std::vector<StandardGrasp> grasps;
    for (const Individual& one : generation) grasps.push_back(changes.Apply(one.genome));
    return course.Score("search", grasps, 0, plan.num_shapes, {1});
  };
  const SearchResult search =
      RunSearch("cmaes", changes.MakeSpace(), plan.num_evaluations,
                RandomStream(std::to_string(seed) + " " + developed.proposed.grasp.id,
                             "search of a development"),
                evaluate);

  std::vector<double> fitness;
  for (const Individual& one : search.individuals) fitness.push_back(one.fitness);
  std::vector<StandardGrasp> finalists = {developed.proposed.grasp};
  for (const size_t k : SortByScore(fitness)) {
    if (static_cast<int>(finalists.size()) > plan.num_finalists) break;
    if (k > 0) finalists.push_back(changes.Apply(search.individuals[k].genome));
  }
  const std::vector<double> scores = course.Score("finals", finalists, 0, plan.num_shapes, {3, 4});
  const size_t best = SortByScore(scores).front();
  developed.proposed_score = scores.front();
  developed.score = scores[best];
  developed.grasp = finalists[best];
  developed.check =
      course.Run("check", {developed.grasp}, kNumTrainingShapes, kNumTrainingShapes, {1}).front();
  developed.num_trials = course.num_trials();
  return developed;
}

}  // namespace graspbench
