#include "core/optimise/grasp_optimiser.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/base/error.h"
#include "core/base/json.h"
#include "core/base/units.h"
#include "core/grasp/grasp_file.h"
#include "core/grasp/placement.h"
#include "core/hand/coupling.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

constexpr double kLargestChange = RadFromDeg(25.0);  ///< of a target angle, to both sides
constexpr double kFirstStep = RadFromDeg(8.0);

// Learning draws by their use. Those of step 1's choice start with 0, the trial without variation.
constexpr int kFirstTargetCheck = 1000;
constexpr int kFirstFitnessDraw = 2000;
constexpr int kFirstFinalDraw = 3000;
constexpr int kFirstScreeningDraw = 4000;
constexpr int kFirstPreGraspCheck = 5000;

constexpr double kSameAngle = 1e-5;  ///< relative; two pre-grasps that differ by less are one
constexpr int kNumCandidates = 100;
constexpr double kCandidateDistance = RadFromDeg(2.0);
constexpr int kScreeningTrials = 3;
constexpr int kNumFinalists = 10;
/** Finalists are tried on so many times the trials of a choice. */
constexpr int kFinalShare = 2;

std::vector<LearningTrial> RunOne(const RunLearningTrials& run, LearningStage stage,
                                  const StandardGrasp& grasp, const std::vector<int>& draws,
                                  bool keep_postures = false) {
  LearningRequest request;
  request.stage = stage;
  request.grasp = grasp;
  request.draws = draws;
  request.keep_postures = keep_postures;
  return run({request}).at(0);
}

/** The same grasp with the angles that a grasp file holds. */
StandardGrasp RoundAngles(const Hand& hand, const StandardGrasp& grasp,
                          const std::string& made_from) {
  return ParseGraspFile(FormatGraspFile(hand, grasp, made_from), grasp.id, {&hand}).grasp;
}

struct WidthChoice {
  const char* name;
  PreGraspWidth width;
};
constexpr WidthChoice kWidthChoices[] = {{"widest", PreGraspWidth::kWidest},
                                         {"above the table", PreGraspWidth::kAboveTable},
                                         {"half", PreGraspWidth::kHalf}};

/** More successes than `enough` do not count. */
bool IsBetter(const std::vector<LearningTrial>& a, const std::vector<LearningTrial>& b,
              int enough) {
  const int successes_a = std::min(CountSuccesses(a), enough);
  const int successes_b = std::min(CountSuccesses(b), enough);
  if (successes_a != successes_b) return successes_a > successes_b;
  return CalcMedianGftRatio(a) < CalcMedianGftRatio(b);
}

bool IsTried(const std::vector<PreGraspShot>& shots, const StandardGrasp& grasp) {
  return std::any_of(shots.begin(), shots.end(), [&](const PreGraspShot& shot) {
    return shot.grasp.q_pre.isApprox(grasp.q_pre, kSameAngle);
  });
}

double CalcPreGraspGoal(const LearningTrial& trial) {
  const double ratio = trial.timing.gft_ratio;
  return std::isnan(ratio) ? -std::numeric_limits<double>::infinity() : -ratio;
}

/** Checks the best of the shots against the standard grasp, or says why none of them is taken. */
void Choose(const StandardGrasp& standard, const OptimiseConfig& config,
            const RunLearningTrials& run, PreGraspStep& step) {
  if (step.shots.empty()) {
    step.verdict = "standard kept: there was nothing to learn, too few digits touched or no room";
    return;
  }
  const int enough = CountSuccesses(step.standard_trials);
  const auto best = std::min_element(
      step.shots.begin(), step.shots.end(),
      [&](const auto& a, const auto& b) { return IsBetter(a.trials, b.trials, enough); });
  const std::string missed = "contacts were not more simultaneous";
  if (!(CalcMedianGftRatio(best->trials) < CalcMedianGftRatio(step.standard_trials))) {
    step.verdict = "standard kept: " + missed;
    return;
  }
  step.best = static_cast<int>(best - step.shots.begin());
  step.check = CheckGrasp(standard, best->grasp,
                          {kFirstPreGraspCheck, config.check_pairs, CalcPreGraspGoal}, run);
  if (step.check.is_taken()) {
    step.chosen = step.best;
    step.verdict = best->name + " taken";
  } else {
    step.verdict = DescribeRefusal(step.check, "standard", "the new pre-grasp", missed);
  }
}

PreGraspStep LearnInTwoShots(const Hand& hand, const GraspObject& object,
                             const StandardGrasp& start, const std::string& made_from,
                             const OptimiseConfig& config, const RunLearningTrials& run) {
  PreGraspStep step;
  const std::vector<int> draws = ListDraws(0, config.choice_trials);
  step.standard_trials = RunOne(run, LearningStage::kStandard, start, draws, true);
  const int enough = CountSuccesses(step.standard_trials);
  StandardGrasp grasp = start;
  LearningTrial lesson = step.standard_trials.front();
  std::vector<Eigen::VectorXd> expected;
  for (const LearningStage stage : {LearningStage::kOneShot, LearningStage::kTwoShot}) {
    if (lesson.closings.empty()) break;  // the simulation gave up
    const std::vector<Eigen::VectorXd> seen =
        CalcDeviations(hand, grasp, lesson.closings, lesson.touch_postures);
    if (expected.empty()) expected = seen;
    for (size_t d = 0; d < seen.size(); ++d) expected[d] = 0.5 * (expected[d] + seen[d]);
    const size_t first = step.shots.size();
    for (const WidthChoice& choice : kWidthChoices) {
      PreGraspShot shot;
      shot.learned = LearnPreGrasp(hand, object, grasp, expected, choice.width);
      if (!shot.learned.is_new) continue;
      shot.name = std::string(NameOf(stage)) + ", " + choice.name;
      shot.was_pushed_away = IsOutOfReach(lesson.outcome);
      shot.grasp = grasp;
      shot.grasp.q_pre = shot.learned.q_pre;
      shot.grasp = RoundAngles(hand, shot.grasp, made_from);
      if (IsTried(step.shots, shot.grasp)) continue;
      shot.trials = RunOne(run, stage, shot.grasp, draws, true);
      step.shots.push_back(shot);
    }
    if (step.shots.size() == first) break;
    const auto best = std::min_element(
        step.shots.begin() + static_cast<std::ptrdiff_t>(first), step.shots.end(),
        [&](const auto& a, const auto& b) { return IsBetter(a.trials, b.trials, enough); });
    grasp = best->grasp;
    lesson = best->trials.front();
  }
  Choose(start, config, run, step);
  return step;
}

StandardGrasp MakeGrasp(const Hand& hand, const StandardGrasp& start,
                        const std::vector<int>& joints, const Eigen::VectorXd& genome) {
  StandardGrasp grasp = start;
  for (size_t i = 0; i < joints.size(); ++i) {
    grasp.q_target[joints[i]] = genome[static_cast<Eigen::Index>(i)];
  }
  ApplyCoupling(hand, grasp.q_target);
  return grasp;
}

SearchSpace MakeSpace(const Hand& hand, const StandardGrasp& start,
                      const std::vector<int>& joints) {
  SearchSpace space;
  const auto size = static_cast<Eigen::Index>(joints.size());
  space.start.resize(size);
  space.lower.resize(size);
  space.upper.resize(size);
  space.step = kFirstStep;
  for (Eigen::Index i = 0; i < size; ++i) {
    const int joint = joints[static_cast<size_t>(i)];
    const HandJoint& limits = hand.joints[static_cast<size_t>(joint)];
    space.start[i] = start.q_target[joint];
    space.lower[i] = std::max(limits.lower, space.start[i] - kLargestChange);
    space.upper[i] = std::min(limits.upper, space.start[i] + kLargestChange);
  }
  return space;
}

LearningRequest MakeRequest(const Hand& hand, const StandardGrasp& start, const TargetStep& step,
                            LearningStage stage, const Individual& individual,
                            const std::vector<int>& draws) {
  LearningRequest request;
  request.stage = stage;
  request.grasp = MakeGrasp(hand, start, step.joints, individual.genome);
  request.draws = draws;
  request.full_hold = false;
  request.individual = individual;
  return request;
}

/** The fittest individuals that differ from each other in some joint; never the start. */
std::vector<Individual> FindCandidates(const SearchResult& search) {
  std::vector<Individual> sorted(search.individuals.begin() + 1, search.individuals.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.fitness > b.fitness; });
  std::vector<Individual> candidates;
  for (const Individual& individual : sorted) {
    if (candidates.size() == kNumCandidates) break;
    const bool is_new =
        std::none_of(candidates.begin(), candidates.end(), [&](const Individual& other) {
          return (individual.genome - other.genome).cwiseAbs().maxCoeff() < kCandidateDistance;
        });
    if (is_new) candidates.push_back(individual);
  }
  return candidates;
}

/** Tries the individuals and sorts them: those that succeed most often first, among equals those of
higher fitness. */
std::vector<Finalist> RankByTrials(const Hand& hand, const StandardGrasp& start,
                                   const TargetStep& step, LearningStage stage,
                                   const std::vector<Individual>& individuals,
                                   const std::vector<int>& draws, const RunLearningTrials& run) {
  const double limit = step.grip_limit;
  std::vector<LearningRequest> requests;
  for (const Individual& individual : individuals) {
    requests.push_back(MakeRequest(hand, start, step, stage, individual, draws));
  }
  std::vector<Finalist> ranked;
  if (requests.empty()) return ranked;
  const std::vector<std::vector<LearningTrial>> trials = run(requests);
  for (size_t i = 0; i < requests.size(); ++i) {
    ranked.push_back({individuals[i].number, trials[i]});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [limit](const Finalist& a, const Finalist& b) {
    const int successes_a = CountSuccesses(a.trials), successes_b = CountSuccesses(b.trials);
    if (successes_a != successes_b) return successes_a > successes_b;
    return CalcFitness(a.trials, limit) > CalcFitness(b.trials, limit);
  });
  return ranked;
}

void ChooseFinalist(const Hand& hand, const StandardGrasp& start, const OptimiseConfig& config,
                    const RunLearningTrials& run, TargetStep& step) {
  const std::vector<Finalist> screened =
      RankByTrials(hand, start, step, LearningStage::kScreening, FindCandidates(step.search),
                   ListDraws(kFirstScreeningDraw, kScreeningTrials), run);
  std::vector<Individual> chosen;
  for (size_t i = 0; i < std::min<size_t>(screened.size(), kNumFinalists); ++i) {
    chosen.push_back(step.search.individuals[static_cast<size_t>(screened[i].number)]);
  }
  step.finalists =
      RankByTrials(hand, start, step, LearningStage::kFinalist, chosen,
                   ListDraws(kFirstFinalDraw, kFinalShare * config.choice_trials), run);
  if (!step.finalists.empty()) step.found = step.finalists.front().number;
}

}  // namespace

int CountSuccesses(const std::vector<LearningTrial>& trials) {
  return static_cast<int>(std::count_if(trials.begin(), trials.end(), [](const auto& trial) {
    return trial.outcome == Outcome::kSuccess;
  }));
}

double CalcMedianGftRatio(const std::vector<LearningTrial>& trials) {
  std::vector<double> ratios;
  for (const LearningTrial& trial : trials) {
    const double ratio = trial.timing.gft_ratio;
    ratios.push_back(std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio);
  }
  return CalcMedian(std::move(ratios));
}

double CalcMeanGrip(const std::vector<LearningTrial>& trials) {
  std::vector<double> grips;
  for (const LearningTrial& trial : trials) {
    if (std::isfinite(trial.stability.normal_force)) grips.push_back(trial.stability.normal_force);
  }
  return CalcMean(grips);
}

double CalcMeanSigma(const std::vector<LearningTrial>& trials) {
  std::vector<double> sigmas;
  for (const LearningTrial& trial : trials) sigmas.push_back(trial.sigma);
  return CalcMean(sigmas);
}

const OptimiseStepRow& StepsOf(const OptimiseConfig& config) {
  return RowFromName(kOptimiseSteps, config.step, "step");
}

const GripBudgetRow& GripOf(const OptimiseConfig& config) {
  return RowFromName(kGripBudgets, config.grip, "grip");
}

int CountLearningTrials(const OptimiseConfig& config) {
  constexpr double kShareOfPairs = 0.6;  // until a check is decided, in the campaigns run so far
  constexpr int kNumPreGrasps = 5;       // the standard one and, of six, those that differ
  const OptimiseStepRow& steps = StepsOf(config);
  const int check = static_cast<int>(2.0 * kShareOfPairs * config.check_pairs);
  const int step1 = kNumPreGrasps * config.choice_trials + check;
  const int step2 = config.evaluations * config.fitness_trials + kNumCandidates * kScreeningTrials +
                    kNumFinalists * kFinalShare * config.choice_trials + check;
  return (steps.learns_pregrasp ? step1 : 0) + (steps.searches_target ? step2 : 0);
}

StandardGrasp MakeObjectGrasp(const Hand& hand, const GraspObject& object,
                              const StandardGrasp& standard, const std::string& id) {
  StandardGrasp grasp = standard;
  grasp.placement = CalcPlacement(hand, standard, object);
  grasp.object = object.id;
  grasp.id = id;
  return RoundAngles(hand, grasp, standard.id);
}

TargetStep SearchTarget(const Hand& hand, const GraspObject& object, const StandardGrasp& start,
                        const OptimiseConfig& config, const RunLearningTrials& run) {
  TargetStep step;
  step.joints =
      FindDrivenJoints(hand, hand.digits[static_cast<size_t>(FindOpposingDigit(hand, start))]);
  step.space = MakeSpace(hand, start, step.joints);
  const GripBudget grip = GripOf(config).value;
  if (grip == GripBudget::kLimit) step.grip_limit = config.grip_limit;
  const std::vector<int> draws = config.fitness_trials == 1
                                     ? std::vector<int>{0}
                                     : ListDraws(kFirstFitnessDraw, config.fitness_trials);
  const auto evaluate = [&](const std::vector<Individual>& generation) {
    std::vector<LearningRequest> requests;
    for (const Individual& individual : generation) {
      requests.push_back(MakeRequest(hand, start, step, LearningStage::kSearch, individual, draws));
    }
    const std::vector<std::vector<LearningTrial>> answers = run(requests);
    if (grip == GripBudget::kEqual && generation.front().number == 0) {
      const double of_start = CalcMeanGrip(answers.front());
      if (of_start > 0.0) step.grip_limit = of_start;  // else it held nothing
    }
    std::vector<double> fitness;
    for (const auto& trials : answers) fitness.push_back(CalcFitness(trials, step.grip_limit));
    return fitness;
  };
  const std::string name =
      FormatJson({config.seed, hand.id, object.id, config.method, config.fitness_trials});
  step.search = RunSearch(config.method, step.space, config.evaluations,
                          RandomStream(name, "search of the target"), evaluate);
  return step;
}

OptimisedGrasp OptimiseGrasp(const Hand& hand, const GraspObject& object,
                             const StandardGrasp& standard, const OptimiseConfig& config,
                             const RunLearningTrials& run) {
  OptimisedGrasp result;
  result.new_pregrasp = MakeObjectGrasp(hand, object, standard, NameOf(kNewPreGrasp));
  if (StepsOf(config).learns_pregrasp) {
    PreGraspStep& step = result.pregrasp_step;
    step = LearnInTwoShots(hand, object, result.new_pregrasp, standard.id, config, run);
    if (step.chosen >= 0) result.new_pregrasp = step.shots[static_cast<size_t>(step.chosen)].grasp;
  }
  result.new_target = result.new_pregrasp;
  result.new_target.id = NameOf(kNewTarget);
  if (!StepsOf(config).searches_target) return result;

  TargetStep& step = result.target_step;
  const StandardGrasp start = result.new_target;
  step = SearchTarget(hand, object, start, config, run);
  ChooseFinalist(hand, start, config, run, step);
  if (step.found == 0) {
    step.check = CheckOldGrasp(start, kFirstTargetCheck, run);
    step.verdict = "start kept: the search tried nothing else";
    return result;
  }
  const Individual& best = step.search.individuals[static_cast<size_t>(step.found)];
  const StandardGrasp found =
      RoundAngles(hand, MakeGrasp(hand, start, step.joints, best.genome), standard.id);
  const auto goal = [&](const LearningTrial& trial) { return CalcFitness(trial, step.grip_limit); };
  step.check = CheckGrasp(start, found, {kFirstTargetCheck, config.check_pairs, goal}, run);
  step.verdict = step.check.is_taken()
                     ? "new target taken"
                     : DescribeRefusal(step.check, "start", "the new target",
                                       "it did not hold better with the grip that it may use");
  if (step.check.is_taken()) result.new_target = found;
  return result;
}

}  // namespace graspbench
