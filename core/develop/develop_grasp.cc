#include "core/develop/develop_grasp.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/develop/posture_changes.h"
#include "core/optimise/methods/search.h"
#include "core/trial/measures/grasp_types.h"

namespace graspbench {
namespace {

constexpr double kFirmness = 0.3;
constexpr double kAsCalled = 0.6;
constexpr double kAllDigits = 0.2;
constexpr double kEarly = 0.3;
constexpr double kTouching = 0.3;
constexpr double kLifting = 0.2;
constexpr double kSlightPull = 0.2;  // [N]

/** Share of the grasping digits that touched. */
double CalcTouchingShare(const TrialResult& result) {
  if (result.contacts.empty()) return 0.0;
  const auto num_touched =
      std::count_if(result.contacts.begin(), result.contacts.end(),
                    [](const DigitContact& contact) { return !std::isnan(contact.time); });
  return static_cast<double>(num_touched) / static_cast<double>(result.contacts.size());
}

}  // namespace

DevelopTrial MakeDevelopTrial(const Grasp& grasp, const GraspObject& object,
                              const TrialResult& result) {
  DevelopTrial trial;
  trial.outcome = result.outcome;
  if (IsNumericalFailure(result.outcome)) return trial;
  if (IsSuccess(result.outcome)) {
    const double weight = object.mass_properties.mass * kStandardGravity;
    const double sigma = std::isfinite(result.stability.sigma) ? result.stability.sigma : 0.0;
    const double x = std::max(0.0, sigma) / (weight + kSlightPull);
    trial.score = 1.0 + kFirmness * x / (1.0 + x);
    trial.score += kAllDigits * CalcTouchingShare(result);
    trial.is_as_called = IsAsCalled(grasp.id, result);
    if (trial.is_as_called) trial.score += kAsCalled;
    if (result.timing.contact_before_start) trial.score -= kEarly;
    return trial;
  }
  trial.score = kTouching * CalcTouchingShare(result);
  trial.score += kLifting * std::clamp(result.lift_height / grasp.approach_distance, 0.0, 1.0);
  return trial;
}

double CalcMeanScore(const std::vector<DevelopTrial>& trials) {
  double sum = 0.0;
  for (const DevelopTrial& trial : trials) sum += trial.score;
  return trials.empty() ? 0.0 : sum / static_cast<double>(trials.size());
}

int CountSuccesses(const std::vector<DevelopTrial>& trials) {
  return static_cast<int>(std::count_if(
      trials.begin(), trials.end(), [](const DevelopTrial& t) { return IsSuccess(t.outcome); }));
}

int CountAsCalled(const std::vector<DevelopTrial>& trials) {
  return static_cast<int>(std::count_if(trials.begin(), trials.end(),
                                        [](const DevelopTrial& t) { return t.is_as_called; }));
}

namespace {

// Draws of the variation, different at each stage; those of the search start at the last.
constexpr int kCheckDraw = 1, kFirstRaceDraw = 2, kFirstFinalsDraw = 5, kFirstSearchDraw = 10;

/** Distribution of a budget. Most evaluations use half of the shapes. */
struct Plan {
  int num_racing;       ///< number of proposals
  int num_shapes;       ///< even
  int num_finalists;    ///< in addition to the proposal
  int num_evaluations;  ///< of the search

  int CountRace() const {
    return (num_racing + KeepThird(num_racing) + 2 * KeepThird(KeepThird(num_racing))) *
           num_shapes / 2;
  }
  int CountFinals() const {
    return (num_finalists + 1 + 2 * KeepLast(num_finalists + 1)) * num_shapes + kNumTrainingShapes;
  }
  static int KeepThird(int count) { return count / 3 + 1; }
  /** The start stays to the end, so that it is compared on the same trials. */
  static int KeepLast(int count) { return std::max(2, KeepThird(count)); }
};

Plan MakePlan(int budget) {
  Plan plan;
  plan.num_racing = std::clamp(budget / 40, 2, 32);
  plan.num_shapes = budget < 400 ? 4 : kNumTrainingShapes;
  plan.num_finalists = std::clamp(budget / 100, 1, 8);
  plan.num_evaluations =
      std::max(1, (budget - plan.CountRace() - plan.CountFinals()) / (plan.num_shapes / 2));
  return plan;
}

/** Sends requests, and counts trials and failures. */
class Course {
 public:
  explicit Course(const RunDevelopTrials& run) : run_(run) {}

  std::vector<double> Score(const std::string& stage, const std::vector<Grasp>& grasps,
                            int first_shape, int num_shapes, const std::vector<int>& draws) {
    std::vector<double> scores;
    for (const auto& trials : Run(stage, grasps, first_shape, num_shapes, draws)) {
      scores.push_back(CalcMeanScore(trials));
    }
    return scores;
  }
  std::vector<std::vector<DevelopTrial>> Run(const std::string& stage,
                                             const std::vector<Grasp>& grasps, int first_shape,
                                             int num_shapes, const std::vector<int>& draws) {
    std::vector<DevelopRequest> requests;
    for (const Grasp& grasp : grasps) {
      DevelopRequest request{stage, grasp, {}};
      for (int shape = first_shape; shape < first_shape + num_shapes; ++shape) {
        for (const int draw : draws) request.trials.push_back({shape, draw});
      }
      num_trials_ += static_cast<int>(request.trials.size());
      requests.push_back(std::move(request));
    }
    auto answers = run_(requests);
    for (const auto& trials : answers) {
      for (const DevelopTrial& trial : trials) num_failures_ += IsNumericalFailure(trial.outcome);
    }
    return answers;
  }
  int num_trials() const { return num_trials_; }
  int num_failures() const { return num_failures_; }

 private:
  const RunDevelopTrials& run_;
  int num_trials_ = 0;
  int num_failures_ = 0;  ///< numerical ones
};

/** Indices by descending score; ties keep their order. */
std::vector<size_t> SortByScore(const std::vector<double>& scores) {
  std::vector<size_t> order(scores.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return scores[a] > scores[b]; });
  return order;
}

/** A contest by the sums of scores of the remaining grasps. */
class Contest {
 public:
  Contest(size_t size, Course& course) : sums_(size, 0.0), left_(size), course_(course) {
    std::iota(left_.begin(), left_.end(), size_t{0});
  }

  void Run(const std::string& stage, const std::vector<Grasp>& all, int first_shape, int num_shapes,
           const std::vector<int>& draws) {
    std::vector<Grasp> grasps;
    for (const size_t k : left_) grasps.push_back(all[k]);
    const auto scores = course_.Score(stage, grasps, first_shape, num_shapes, draws);
    for (size_t k = 0; k < left_.size(); ++k) {
      sums_[left_[k]] += scores[k] * num_shapes * static_cast<double>(draws.size());
    }
    num_trials_ += num_shapes * static_cast<int>(draws.size());
    std::stable_sort(left_.begin(), left_.end(),
                     [&](size_t a, size_t b) { return sums_[a] > sums_[b]; });
  }
  void KeepThird() {
    left_.resize(std::min(left_.size(),
                          static_cast<size_t>(Plan::KeepThird(static_cast<int>(left_.size())))));
  }
  /** Keeps the best, including `always`. */
  void KeepLast(size_t always) {
    const auto count = static_cast<size_t>(Plan::KeepLast(static_cast<int>(left_.size())));
    left_.resize(std::min(left_.size(), count));
    if (std::count(left_.begin(), left_.end(), always) == 0) left_.back() = always;
  }
  size_t winner() const { return left_.front(); }
  /** Mean score of a remaining grasp. */
  double CalcScore(size_t k) const { return sums_[k] / num_trials_; }

 private:
  std::vector<double> sums_;
  std::vector<size_t> left_;
  Course& course_;
  int num_trials_ = 0;  ///< of each remaining grasp
};

/** @returns the index of the winner. */
size_t RunRace(const std::vector<ProposedGrasp>& proposals, const Plan& plan, Course& course) {
  std::vector<Grasp> grasps;
  for (const ProposedGrasp& proposed : proposals) {
    if (static_cast<int>(grasps.size()) < plan.num_racing) grasps.push_back(proposed.grasp);
  }
  Contest race(grasps.size(), course);
  const int half = plan.num_shapes / 2;
  race.Run("race", grasps, 0, half, {kFirstRaceDraw});
  race.KeepThird();
  race.Run("race", grasps, half, half, {kFirstRaceDraw + 1});
  race.KeepThird();
  race.Run("race", grasps, 0, plan.num_shapes, {kFirstRaceDraw + 2});
  return race.winner();
}

/** Best evaluations of the later half of the search, when it has converged. */
std::vector<Grasp> ListFinalists(const SearchResult& search, const PostureChanges& changes,
                                 int count) {
  const size_t first = search.individuals.size() / 2;
  std::vector<double> fitness;
  for (size_t k = first; k < search.individuals.size(); ++k) {
    fitness.push_back(search.individuals[k].fitness);
  }
  std::vector<Grasp> finalists;
  for (const size_t k : SortByScore(fitness)) {
    if (static_cast<int>(finalists.size()) == count) break;
    finalists.push_back(changes.Apply(search.individuals[first + k].genome));
  }
  return finalists;
}

}  // namespace

int CountDevelopTrials(int budget) {
  const Plan plan = MakePlan(budget);
  return plan.CountRace() + plan.num_evaluations * plan.num_shapes / 2 + plan.CountFinals();
}

DevelopedGrasp DevelopGrasp(const Hand& hand, const std::vector<ProposedGrasp>& proposals,
                            int budget, int seed, const RunDevelopTrials& run) {
  GRASPBENCH_DEMAND(!proposals.empty(), "nothing was proposed");
  const Plan plan = MakePlan(budget);
  Course course(run);
  DevelopedGrasp developed;
  developed.proposed = proposals[RunRace(proposals, plan, course)];

  // Shapes and draws change with every generation, to avoid overfitting to them.
  const PostureChanges changes(hand, developed.proposed.grasp);
  const int half = plan.num_shapes / 2;
  const auto evaluate = [&](const std::vector<Individual>& generation) {
    std::vector<Grasp> grasps;
    for (const Individual& one : generation) grasps.push_back(changes.Apply(one.genome));
    const int number = generation.front().generation;
    return course.Score("search", grasps, number % 2 == 0 ? 0 : half, half,
                        {kFirstSearchDraw + number});
  };
  const SearchResult search =
      RunSearch("cmaes", changes.MakeSpace(), plan.num_evaluations,
                RandomStream(std::to_string(seed) + " " + developed.proposed.grasp.id,
                             "search of a development"),
                evaluate);

  std::vector<Grasp> finalists = ListFinalists(search, changes, plan.num_finalists);
  finalists.insert(finalists.begin(), developed.proposed.grasp);
  Contest finals(finalists.size(), course);
  finals.Run("finals", finalists, 0, plan.num_shapes, {kFirstFinalsDraw});
  finals.KeepLast(0);
  finals.Run("finals", finalists, 0, plan.num_shapes, {kFirstFinalsDraw + 1, kFirstFinalsDraw + 2});
  developed.proposed_score = finals.CalcScore(0);
  developed.score = finals.CalcScore(finals.winner());
  developed.grasp = finalists[finals.winner()];
  developed.check =
      course.Run("check", {developed.grasp}, kNumTrainingShapes, kNumTrainingShapes, {kCheckDraw})
          .front();
  developed.num_trials = course.num_trials();
  developed.num_numerical_failures = course.num_failures();
  return developed;
}

}  // namespace graspbench
