#include "core/optimise/grasp_optimiser.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/base/text/text.h"
#include "core/grasp/grasp_file.h"
#include "core/grasp/placement.h"
#include "core/optimise/methods/search.h"
#include "core/optimise/pregrasp_learning.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

// Learning draws by their use. Those of the fitness start at 2000 (target_search.cc), those of step
// 1's choice at 0, the trial without variation.
constexpr int kFirstTargetCheck = 1000;
constexpr int kFirstFinalDraw = 3000;
constexpr int kFirstScreeningDraw = 4000;
constexpr int kFirstPreGraspCheck = 5000;

constexpr double kSameAngle = 1e-5;  ///< relative; pre-grasps that differ by less count as one
constexpr double kDelayGains[] = {1.0, 0.5};
constexpr int kNumCandidates = 100;
constexpr int kScreeningTrials = 3;
constexpr int kNumFinalists = 10;

std::vector<LearningTrial> RunOne(const RunLearningTrials& run, LearningStage stage,
                                  const Grasp& grasp, const std::vector<int>& draws,
                                  bool keep_postures = false) {
  LearningRequest request;
  request.stage = stage;
  request.grasp = grasp;
  request.draws = draws;
  request.keep_postures = keep_postures;
  return run({request}).at(0);
}

/** The same grasp with angles rounded as in a grasp file. */
Grasp RoundAngles(const Hand& hand, const Grasp& grasp, const std::string& made_from) {
  return ParseGraspFile(FormatGraspFile(hand, grasp, made_from), grasp.id, {&hand}).grasp;
}

struct WidthChoice {
  const char* name;
  PreGraspWidth width;
};
constexpr WidthChoice kWidthChoices[] = {{"widest", PreGraspWidth::kWidest},
                                         {"above the table", PreGraspWidth::kAboveTable},
                                         {"half", PreGraspWidth::kHalf}};

/** Number of successes that a pre-grasp needs, given the trials of the standard grasp. More do not
count, since one different outcome in twenty is not significant. */
int CountEnough(const std::vector<LearningTrial>& standard) {
  const double margin = kSuccessMargin * static_cast<double>(standard.size());
  return CountSuccesses(standard) - static_cast<int>(margin + 1e-9);
}

/** Whether `a` is better; successes beyond `enough` do not count. */
bool IsBetter(const std::vector<LearningTrial>& a, const std::vector<LearningTrial>& b,
              int enough) {
  const int successes_a = std::min(CountSuccesses(a), enough);
  const int successes_b = std::min(CountSuccesses(b), enough);
  if (successes_a != successes_b) return successes_a > successes_b;
  return CalcMedianGftRatio(a) < CalcMedianGftRatio(b);
}

bool IsTried(const std::vector<PreGraspShot>& shots, const Grasp& grasp) {
  return std::any_of(shots.begin(), shots.end(), [&](const PreGraspShot& shot) {
    return shot.grasp.q_pre.isApprox(grasp.q_pre, kSameAngle) &&
           shot.grasp.closing == grasp.closing;
  });
}

double CalcPreGraspGoal(const LearningTrial& trial) {
  const double ratio = trial.timing.gft_ratio;
  return std::isnan(ratio) ? -std::numeric_limits<double>::infinity() : -ratio;
}

bool IsAny(const PreGraspShot&) { return true; }

/** Index of the best shot for which `is_asked` holds; -1: there is none. */
template <class IsAsked>
int FindBest(const std::vector<PreGraspShot>& shots, int enough, const IsAsked& is_asked) {
  int best = -1;
  for (size_t i = 0; i < shots.size(); ++i) {
    if (!is_asked(shots[i])) continue;
    if (best < 0 || IsBetter(shots[i].trials, shots[best].trials, enough)) {
      best = static_cast<int>(i);
    }
  }
  return best;
}

/** Checks a shot against the standard grasp, or explains why it is not worth it. */
void Check(int number, const Grasp& standard, const OptimiseConfig& config,
           const RunLearningTrials& run, PreGraspStep& step) {
  const PreGraspShot& shot = step.shots[number];
  const std::string missed = "contacts were not more simultaneous";
  if (!(CalcMedianGftRatio(shot.trials) < CalcMedianGftRatio(step.standard_trials))) {
    if (step.verdict.empty()) step.verdict = "standard kept: " + missed;
    return;
  }
  step.best = number;
  step.check = CheckGrasp(standard, shot.grasp,
                          {kFirstPreGraspCheck, config.check_pairs, CalcPreGraspGoal, false}, run);
  if (step.check.is_taken()) {
    step.chosen = number;
    const std::string delays = DescribeDelays(shot.grasp);
    step.verdict = shot.name + " taken" + (delays.empty() ? "" : ": " + delays);
  } else {
    step.verdict = DescribeRefusal(step.check, "standard", "the new pre-grasp", missed);
  }
}

/** Checks the best shot; if it is refused, the best of the other kind, with or without delays. */
void Choose(const Grasp& standard, const OptimiseConfig& config, const RunLearningTrials& run,
            PreGraspStep& step) {
  if (step.shots.empty()) {
    step.verdict = "standard kept: there was nothing to learn, too few digits touched or no room";
    return;
  }
  const int enough = CountEnough(step.standard_trials);
  const int best = FindBest(step.shots, enough, IsAny);
  Check(best, standard, config, run, step);
  if (step.chosen >= 0) return;
  const auto is_delayed = [](const PreGraspShot& shot) { return shot.adds_delays; };
  const bool was_delayed = is_delayed(step.shots[best]);
  const int other = FindBest(step.shots, enough, [&](const PreGraspShot& shot) {
    return is_delayed(shot) != was_delayed;
  });
  if (other >= 0) Check(other, standard, config, run, step);
}

std::vector<LearningTrial> TakeFirstLook(const std::vector<LearningTrial>& trials) {
  return {trials.begin(), trials.begin() + std::min<ptrdiff_t>(kPairsPerLook, trials.size())};
}

/** Runs the best pre-grasp without delays if anything was checked; otherwise nothing looked better
on the draws of the choice. */
void TryAlone(const RunLearningTrials& run, PreGraspStep& step) {
  if (step.check.before.empty()) return;
  step.alone = FindBest(step.shots, CountEnough(step.standard_trials),
                        [](const PreGraspShot& shot) { return !shot.adds_delays; });
  if (step.alone < 0) return;
  step.alone_trials = step.alone == step.best
                          ? TakeFirstLook(step.check.after)
                          : RunOne(run, LearningStage::kCheckAlone, step.shots[step.alone].grasp,
                                   ListDraws(kFirstPreGraspCheck, kPairsPerLook));
}

/** Appends shots in which digits wait, derived from one shot and its trials. */
void LearnToWait(const Hand& hand, PreGraspShot shot, const std::string& made_from,
                 const RunLearningTrials& run, std::vector<PreGraspShot>& shots) {
  const std::string name = shot.name;
  for (const double gain : kDelayGains) {
    shot.name += shot.name == name ? ", delayed" : " twice";
    const Grasp before = shot.grasp;
    shot.grasp.closing = LearnDelays(shot.grasp, shot.trials, gain);
    shot.adds_delays = true;
    shot.grasp = RoundAngles(hand, shot.grasp, made_from);
    if (shot.grasp.closing == before.closing) return;
    std::vector<int> draws;
    for (const LearningTrial& trial : shot.trials) draws.push_back(trial.draw);
    shot.trials = RunOne(run, LearningStage::kDelayed, shot.grasp, draws);
    shots.push_back(shot);
  }
}

PreGraspShot MakeStandardShot(const Hand& hand, const Grasp& start, const PreGraspStep& step) {
  PreGraspShot shot;
  shot.name = "standard pre-grasp";
  shot.learned.q_pre = start.q_pre;
  shot.learned.opening = shot.learned.required_opening = CalcOpening(hand, start, start.q_pre);
  shot.grasp = start;
  shot.trials = step.standard_trials;
  return shot;
}

PreGraspStep LearnInTwoShots(const Hand& hand, const GraspObject& object, const Grasp& start,
                             const std::string& made_from, const OptimiseConfig& config,
                             const RunLearningTrials& run) {
  PreGraspStep step;
  const std::vector<int> draws = ListDraws(0, config.choice_trials);
  step.standard_trials = RunOne(run, LearningStage::kStandard, start, draws, true);
  const int enough = CountEnough(step.standard_trials);
  Grasp grasp = start;
  LearningTrial lesson = step.standard_trials.front();
  std::vector<Eigen::VectorXd> expected;
  for (const LearningStage stage : {LearningStage::kOneShot, LearningStage::kTwoShot}) {
    if (lesson.closings.empty()) break;  // the simulation failed
    const std::vector<Eigen::VectorXd> seen =
        CalcDeviations(hand, grasp, lesson.closings, lesson.touch_postures);
    if (expected.empty()) expected = seen;
    for (size_t d = 0; d < seen.size(); ++d) expected[d] = 0.5 * (expected[d] + seen[d]);
    std::vector<PreGraspShot> shots;
    for (const WidthChoice& choice : kWidthChoices) {
      PreGraspShot shot;
      shot.learned = LearnPreGrasp(hand, object, grasp, expected, choice.width);
      if (!shot.learned.is_new) continue;
      shot.name = std::string(NameOf(stage)) + ", " + choice.name;
      shot.was_pushed_away = IsOutOfReach(lesson.outcome);
      shot.grasp = grasp;
      shot.grasp.q_pre = shot.learned.q_pre;
      shot.grasp = RoundAngles(hand, shot.grasp, made_from);
      if (IsTried(step.shots, shot.grasp) || IsTried(shots, shot.grasp)) continue;
      shot.trials = RunOne(run, stage, shot.grasp, draws, true);
      shots.push_back(shot);
    }
    const int best = FindBest(shots, enough, IsAny);
    step.shots.insert(step.shots.end(), shots.begin(), shots.end());
    if (best < 0) break;
    grasp = shots[best].grasp;
    lesson = shots[best].trials.front();
  }
  const int best = FindBest(step.shots, enough, IsAny);
  const PreGraspShot standard = MakeStandardShot(hand, start, step);
  if (best >= 0) {
    const PreGraspShot new_pregrasp = step.shots[best];
    LearnToWait(hand, new_pregrasp, made_from, run, step.shots);
  }
  LearnToWait(hand, standard, made_from, run, step.shots);
  Choose(start, config, run, step);
  TryAlone(run, step);
  return step;
}

void ChooseFinalist(const TargetSearch& search, const OptimiseConfig& config,
                    const RunLearningTrials& run, TargetStep& step) {
  const std::vector<Finalist> screened = search.Rank(
      LearningStage::kScreening, FindCandidates(step.search, step.simulated, kNumCandidates),
      ListDraws(kFirstScreeningDraw, kScreeningTrials), run);
  std::vector<Individual> chosen;
  for (size_t i = 0; i < std::min<size_t>(screened.size(), kNumFinalists); ++i) {
    chosen.push_back(step.search.individuals[screened[i].number]);
  }
  step.finalists = search.Rank(LearningStage::kFinalist, chosen,
                               ListDraws(kFirstFinalDraw, config.choice_trials), run);
  if (!step.finalists.empty()) step.found = step.finalists.front().number;
}

/** Runs the search only. */
TargetStep RunTargetSearch(TargetSearch& search, const OptimiseConfig& config,
                           const RunLearningTrials& run) {
  TargetStep step;
  step.coordinates = search.space().coordinates();
  step.space = search.space().box();
  Race race(step.space);
  const auto simulate = [&](const std::vector<Individual>& generation) {
    for (const Individual& individual : generation) step.simulated.push_back(individual.number);
    return search.Evaluate(generation, run);
  };
  step.search =
      RunSearch(config.method, step.space, config.evaluations, search.MakeStream(),
                [&](const std::vector<Individual>& generation) {
                  return config.race ? race.Evaluate(generation, simulate) : simulate(generation);
                });
  step.grip_limit = search.grip_limit();
  return step;
}

/** Empty if it grips about as hard as the start, or if its grip is not limited. */
std::string DescribeGrip(const TargetStep& step) {
  constexpr double kHarder = 1.05;
  const double times = CalcMeanGrip(step.check.after) / CalcMeanGrip(step.check.before);
  if (!(times > kHarder) || std::isinf(step.grip_limit)) return "";
  return ", which grips " + FormatFixed(times, 2) +
         " times as hard as the start; what it holds counted for as much grip as it may use";
}

}  // namespace

std::vector<LearningTrial> PreGraspStep::ListBeforeAlone() const {
  return TakeFirstLook(check.before);
}

std::string NameWhatChanged(const PreGraspShot& shot) {
  if (!shot.adds_delays) return "pre-grasp";
  return shot.learned.is_new ? "pre-grasp and closing delays" : "closing delays";
}

double CalcMedianGftRatio(const std::vector<LearningTrial>& trials) {
  std::vector<double> ratios;
  for (const LearningTrial& trial : trials) {
    const double ratio = trial.timing.gft_ratio;
    ratios.push_back(std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio);
  }
  return CalcMedian(std::move(ratios));
}

Answer<double> CalcGftFloor(const std::vector<LearningTrial>& trials) {
  return CalcGftFloor(ListContacts(trials));
}

double CalcMeanSigma(const std::vector<LearningTrial>& trials) {
  std::vector<double> sigmas;
  for (const LearningTrial& trial : trials) sigmas.push_back(trial.sigma);
  return CalcMean(sigmas);
}

int CountLearningTrials(const OptimiseConfig& config) {
  constexpr double kShareOfPairs = 0.6;  // until a check is decided, in the campaigns so far
  constexpr int kNumPreGrasps = 9;       // the standard one and, of ten others, those that differ
  const OptimiseStepRow& steps = StepsOf(config);
  const int check = static_cast<int>(2.0 * kShareOfPairs * config.check_pairs);
  const int step1 = kNumPreGrasps * config.choice_trials + check;
  const double simulated = (config.race ? Race::kRacedShare : 1.0) * config.evaluations;
  const int step2 = static_cast<int>(simulated) * config.fitness_trials +
                    kNumCandidates * kScreeningTrials + kNumFinalists * config.choice_trials +
                    check;
  return (steps.learns_pregrasp ? step1 : 0) + (steps.searches_target ? step2 : 0);
}

Grasp MakeObjectGrasp(const Hand& hand, const GraspObject& object, const Grasp& standard,
                      const std::string& id) {
  Grasp grasp = standard;
  grasp.placement = CalcPlacement(hand, standard, object);
  grasp.object = object.id;
  grasp.id = id;
  return RoundAngles(hand, grasp, standard.id);
}

TargetStep SearchTarget(const Hand& hand, const GraspObject& object, const Grasp& start,
                        const OptimiseConfig& config, const RunLearningTrials& run) {
  TargetSearch search(hand, object, start, config);
  return RunTargetSearch(search, config, run);
}

OptimisedGrasp OptimiseGrasp(const Hand& hand, const GraspObject& object, const Grasp& standard,
                             const OptimiseConfig& config, const RunLearningTrials& run) {
  OptimisedGrasp result;
  result.new_pregrasp = MakeObjectGrasp(hand, object, standard, NameOf(kNewPreGrasp));
  if (StepsOf(config).searches_target) CheckSearch(hand, object, result.new_pregrasp, config);
  if (StepsOf(config).learns_pregrasp) {
    PreGraspStep& step = result.pregrasp_step;
    step = LearnInTwoShots(hand, object, result.new_pregrasp, standard.id, config, run);
    if (step.chosen >= 0) result.new_pregrasp = step.shots[step.chosen].grasp;
  }
  result.new_target = result.new_pregrasp;
  result.new_target.id = NameOf(kNewTarget);
  if (!StepsOf(config).searches_target) return result;

  TargetStep& step = result.target_step;
  const Grasp start = result.new_target;
  TargetSearch search(hand, object, start, config);
  step = RunTargetSearch(search, config, run);
  ChooseFinalist(search, config, run, step);
  const auto goal = [&](const LearningTrial& trial) { return CalcFitness(trial, step.grip_limit); };
  const CheckPlan plan = {kFirstTargetCheck, config.check_pairs, goal, FindsStrength(config)};
  if (step.found == 0) {
    step.check = CheckOldGrasp(start, plan, run);
    step.verdict = "start kept: the search tried nothing else";
    return result;
  }
  const Individual& best = step.search.individuals[step.found];
  const Grasp found = RoundAngles(hand, search.space().MakeGrasp(best.genome), standard.id);
  step.check = CheckGrasp(start, found, plan, run);
  step.verdict = step.check.is_taken()
                     ? "new target taken" + DescribeGrip(step)
                     : DescribeRefusal(step.check, "start", "the new target",
                                       "it did not hold better with the grip that it may use");
  if (step.check.is_taken()) result.new_target = found;
  return result;
}

}  // namespace graspbench
