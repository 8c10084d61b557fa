#include "core/optimise/target_search.h"

#include <algorithm>

#include "core/base/text/json.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

constexpr int kFirstFitnessDraw = 2000;  // of the learning draws (grasp_optimiser.cc)
constexpr double kCandidateDistance = RadFromDeg(2.0);

}  // namespace

TargetSearch::TargetSearch(const Hand& hand, const GraspObject& object, const Grasp& start,
                           const OptimiseConfig& config)
    : hand_(hand),
      object_(object),
      config_(config),
      space_(MakeGraspSpace(config.search, {hand, object, start})) {
  if (GripOf(config).value == GripBudget::kLimit) grip_limit_ = config.grip_limit;
}

RandomStream TargetSearch::MakeStream() const {
  Json name = {config_.seed, hand_.id, object_.id, config_.method, config_.fitness_trials};
  if (config_.search != kThumbSpace) name.push_back(config_.search);
  return RandomStream(FormatJson(name), "search of the target");
}

LearningRequest TargetSearch::MakeRequest(LearningStage stage, const Individual& individual,
                                          const std::vector<int>& draws) const {
  LearningRequest request;
  request.stage = stage;
  request.grasp = space_->MakeGrasp(individual.genome);
  request.draws = draws;
  request.full_hold = false;
  request.finds_strength = FindsStrength(config_);
  request.individual = individual;
  return request;
}

std::vector<double> TargetSearch::Evaluate(const std::vector<Individual>& generation,
                                           const RunLearningTrials& run) {
  const std::vector<int> draws = config_.fitness_trials == 1
                                     ? std::vector<int>{0}
                                     : ListDraws(kFirstFitnessDraw, config_.fitness_trials);
  std::vector<LearningRequest> requests;
  for (const Individual& individual : generation) {
    requests.push_back(MakeRequest(LearningStage::kSearch, individual, draws));
  }
  const std::vector<std::vector<LearningTrial>> answers = run(requests);
  if (GripOf(config_).value == GripBudget::kEqual && generation.front().number == 0) {
    const double of_start = CalcMeanGrip(answers.front());
    if (of_start > 0.0) grip_limit_ = of_start;  // else it held nothing
  }
  std::vector<double> fitness;
  for (const auto& trials : answers) fitness.push_back(CalcFitness(trials, grip_limit_));
  return fitness;
}

std::vector<Finalist> TargetSearch::Rank(LearningStage stage,
                                         const std::vector<Individual>& individuals,
                                         const std::vector<int>& draws,
                                         const RunLearningTrials& run) const {
  std::vector<LearningRequest> requests;
  for (const Individual& individual : individuals) {
    requests.push_back(MakeRequest(stage, individual, draws));
  }
  std::vector<Finalist> ranked;
  if (requests.empty()) return ranked;
  const std::vector<std::vector<LearningTrial>> trials = run(requests);
  for (size_t i = 0; i < requests.size(); ++i) {
    ranked.push_back({individuals[i].number, trials[i]});
  }
  const double limit = grip_limit_;
  std::stable_sort(ranked.begin(), ranked.end(), [limit](const Finalist& a, const Finalist& b) {
    const int successes_a = CountSuccesses(a.trials), successes_b = CountSuccesses(b.trials);
    if (successes_a != successes_b) return successes_a > successes_b;
    return CalcFitness(a.trials, limit) > CalcFitness(b.trials, limit);
  });
  return ranked;
}

std::vector<Individual> FindCandidates(const SearchResult& search,
                                       const std::vector<int>& simulated, int most) {
  std::vector<Individual> sorted;
  for (const int number : simulated) {
    if (number > 0) sorted.push_back(search.individuals[number]);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.fitness > b.fitness; });
  std::vector<Individual> candidates;
  for (const Individual& individual : sorted) {
    if (static_cast<int>(candidates.size()) == most) break;
    const bool is_new =
        std::none_of(candidates.begin(), candidates.end(), [&](const Individual& other) {
          return (individual.genome - other.genome).cwiseAbs().maxCoeff() < kCandidateDistance;
        });
    if (is_new) candidates.push_back(individual);
  }
  return candidates;
}

void CheckSearch(const Hand& hand, const GraspObject& object, const Grasp& start,
                 const OptimiseConfig& config) {
  const TargetSearch search(hand, object, start, config);
  MakeSearchMethod(config.method, search.space().box(), config.evaluations, search.MakeStream());
}

}  // namespace graspbench
