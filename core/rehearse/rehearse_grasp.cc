#include "core/rehearse/rehearse_grasp.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/optimise/methods/search.h"
#include "core/statistics/proportion.h"

namespace graspbench {
namespace {

constexpr double kYawShare = 0.4;    ///< share of all candidates
constexpr size_t kNumVaried = 3;     ///< candidates varied at a time
constexpr size_t kNumFinalists = 3;  ///< least number of candidates tested on all draws
constexpr size_t kNumPostureFinalists = 8;
constexpr int kPostureDraws = 4;  ///< multiple of the draws on which they are compared
constexpr int kMostLost = 1;      ///< draws of kNumProofDraws that a choice may lose
constexpr double kGripShares[] = {0.5, 0.25, 0.125};

/** Indices of the tested candidates, by descending run. */
std::vector<size_t> SortByRun(const std::vector<RehearsedCandidate>& tried) {
  std::vector<size_t> order;
  for (size_t i = 0; i < tried.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return tried[a].FindRun() > tried[b].FindRun(); });
  return order;
}

/** Run, plus the progress of the first lost draw: the share of the outcomes of closing, lift-off
and hold that it passed. */
double CalcFitness(const RehearsedCandidate& tried) {
  constexpr Outcome kCourse[] = {Outcome::kNoContact, Outcome::kPushedAway,
                                 Outcome::kLostWhileClosing, Outcome::kSlippedInLiftOff,
                                 Outcome::kDroppedWhileHolding};
  const auto* const passed =
      std::find(std::begin(kCourse), std::end(kCourse), tried.outcomes.back());
  const double share = static_cast<double>(passed - kCourse) / std::size(kCourse);
  const bool is_lost = !IsSuccess(tried.outcomes.back()) && passed != std::end(kCourse);
  return tried.FindRun() + (is_lost ? share : 0.0);
}

class Rehearser {
 public:
  Rehearser(const CandidateMaker& maker, const RehearsalConfig& config, const RunRehearsal& run)
      : maker_(maker), config_(config), run_(run) {}

  Rehearsal Run() {
    const auto of_yaw = static_cast<size_t>(kYawShare * config_.num_candidates);
    if (!TryAll(maker_.ListByRule()) && !IsFull() && !TryAll(maker_.ListByApproach()) &&
        !IsFull() && !TryAll(TakeFirst(maker_.ListByYaw(), of_yaw))) {
      while (!IsFull() && !is_found_ && Vary()) {
      }
    }
    if (!is_found_) ChooseMostHeld();
    if (!is_found_ && config_.num_postures > 0) {
      SearchPosture();
    }
    return std::move(rehearsal_);
  }

 private:
  bool IsFull() const {
    return static_cast<int>(rehearsal_.tried.size()) >= config_.num_candidates;
  }

  static std::vector<GraspCandidate> TakeFirst(std::vector<GraspCandidate> all, size_t count) {
    if (all.size() > count) all.resize(count);
    return all;
  }

  RehearsalAnswer Ask(const Grasp& grasp, const RehearsalQuestion& question) {
    ++rehearsal_.num_trials;
    return run_(grasp, question);
  }

  void TryDraw(const Grasp& grasp, RehearsedCandidate& tried) {
    const int draw = static_cast<int>(tried.outcomes.size());
    const RehearsalAnswer answer = Ask(grasp, {draw});
    tried.outcomes.push_back(answer.outcome);
    if (!IsSuccess(answer.outcome) && tried.reason.empty()) tried.reason = answer.reason;
  }

  int CalcNumProofDraws() const { return std::max(config_.num_draws, kNumProofDraws); }

  /** Whether it can still be chosen: it held all of `num_draws`, and enough of the proof so far. */
  bool MayBeChosen(const RehearsedCandidate& tried) const {
    const auto num = static_cast<int>(tried.outcomes.size());
    return tried.FindRun() >= std::min(num, config_.num_draws) &&
           num - tried.CountHeld() <= kMostLost;
  }

  /** Tests a candidate until it can no longer be chosen. */
  RehearsedCandidate TryDraws(const GraspCandidate& candidate, int num_draws) {
    const Grasp grasp = maker_.Make(candidate);
    RehearsedCandidate tried;
    tried.candidate = candidate;
    do {
      TryDraw(grasp, tried);
    } while (MayBeChosen(tried) && static_cast<int>(tried.outcomes.size()) < num_draws);
    return tried;
  }

  /** @returns whether a candidate passed the proof; it is then chosen. */
  bool TryAll(const std::vector<GraspCandidate>& candidates) {
    for (const GraspCandidate& candidate : candidates) {
      const bool is_known =
          std::any_of(rehearsal_.tried.begin(), rehearsal_.tried.end(),
                      [&](const RehearsedCandidate& one) { return one.candidate == candidate; });
      if (IsFull() || is_known) continue;
      rehearsal_.tried.push_back(TryDraws(candidate, CalcNumProofDraws()));
      is_found_ = MayBeChosen(rehearsal_.tried.back());
      if (!is_found_) continue;
      rehearsal_.chosen = static_cast<int>(rehearsal_.tried.size()) - 1;
      return true;
    }
    return false;
  }

  /** Varies the best candidates not yet varied. @returns whether there is anything new. */
  bool Vary() {
    const size_t num_before = rehearsal_.tried.size();
    size_t num_varied = 0;
    for (const size_t i : SortByRun(rehearsal_.tried)) {
      if (num_varied == kNumVaried) break;
      if (std::count(varied_.begin(), varied_.end(), i) > 0) continue;
      varied_.push_back(i);
      ++num_varied;
      if (TryAll(maker_.ListVariations(GraspCandidate(rehearsal_.tried[i].candidate)))) return true;
    }
    return rehearsal_.tried.size() > num_before;
  }

  /** Searches postures, starting from the choice. */
  void SearchPosture() {
    const auto start_of_search = static_cast<size_t>(rehearsal_.chosen);
    GraspCandidate candidate = rehearsal_.choice().candidate;
    const Grasp start = maker_.Make(candidate);
    const auto space = maker_.MakePostureSpace(start);
    RunSearch("es", space->box(), config_.num_postures, maker_.MakePostureStream(),
              [&](const std::vector<Individual>& generation) {
                std::vector<double> fitness;
                for (const Individual& individual : generation) {
                  const Eigen::VectorXd& genome = individual.genome;
                  candidate.posture.assign(genome.data(), genome.data() + genome.size());
                  rehearsal_.tried.push_back(TryDraws(candidate, config_.num_draws));
                  fitness.push_back(CalcFitness(rehearsal_.tried.back()));
                }
                return fitness;
              });
    ChooseOnMoreDraws(start_of_search);
  }

  /** Compares the start of the search with the postures that held most. */
  void ChooseOnMoreDraws(size_t start) {
    std::vector<size_t> finalists = {start};
    for (const size_t i : SortByRun(rehearsal_.tried)) {
      const bool is_searched = !rehearsal_.tried[i].candidate.posture.empty();
      if (is_searched && finalists.size() <= kNumPostureFinalists) finalists.push_back(i);
    }
    for (const size_t i : finalists) TryOn(kPostureDraws * config_.num_draws, i);
    rehearsal_.chosen = static_cast<int>(
        *std::max_element(finalists.begin(), finalists.end(), [&](size_t a, size_t b) {
          return rehearsal_.tried[a].CountHeld() < rehearsal_.tried[b].CountHeld();
        }));
  }

  void TryOn(int num_draws, size_t candidate) {
    RehearsedCandidate& tried = rehearsal_.tried[candidate];
    const Grasp grasp = maker_.Make(tried.candidate);
    while (static_cast<int>(tried.outcomes.size()) < num_draws) TryDraw(grasp, tried);
  }

  void FindThreshold(RehearsedCandidate& tried) {
    const Grasp grasp = maker_.Make(tried.candidate);
    for (const double share : kGripShares) {
      if (!IsSuccess(Ask(grasp, {0, share}).outcome)) return;
      tried.grip_threshold = share;
    }
  }

  /** Candidates of the longest run, and at least kNumFinalists. */
  std::vector<size_t> ListFinalists() const {
    std::vector<size_t> finalists;
    const std::vector<size_t> order = SortByRun(rehearsal_.tried);
    const int longest = rehearsal_.tried[order.front()].FindRun();
    for (const size_t i : order) {
      const bool is_longest = longest > 0 && rehearsal_.tried[i].FindRun() == longest;
      if (finalists.size() < kNumFinalists || is_longest) finalists.push_back(i);
    }
    return finalists;
  }

  void ChooseMostHeld() {
    const std::vector<size_t> finalists = ListFinalists();
    const bool has_run = rehearsal_.tried[finalists.front()].FindRun() >= config_.num_draws;
    for (const size_t i : finalists) TryOn(has_run ? CalcNumProofDraws() : config_.num_draws, i);
    const auto value = [&](size_t i) {
      return std::pair(rehearsal_.tried[i].CountHeld(), rehearsal_.tried[i].FindRun());
    };
    const size_t most = *std::max_element(finalists.begin(), finalists.end(),
                                          [&](size_t a, size_t b) { return value(a) < value(b); });
    std::vector<size_t> equal;
    for (const size_t i : finalists) {
      if (value(i) == value(most)) equal.push_back(i);
    }
    size_t best = equal.front();
    for (const size_t i : equal) {
      if (equal.size() == 1 || rehearsal_.tried[i].FindRun() == 0) break;
      FindThreshold(rehearsal_.tried[i]);
      if (rehearsal_.tried[i].grip_threshold < rehearsal_.tried[best].grip_threshold) best = i;
    }
    rehearsal_.chosen = static_cast<int>(best);
  }

  const CandidateMaker& maker_;
  const RehearsalConfig& config_;
  const RunRehearsal& run_;
  Rehearsal rehearsal_;
  bool is_found_ = false;
  std::vector<size_t> varied_;
};

}  // namespace

bool operator==(const RehearsalConfig& a, const RehearsalConfig& b) {
  return a.num_candidates == b.num_candidates && a.num_draws == b.num_draws &&
         a.num_postures == b.num_postures;
}

int RehearsedCandidate::CountHeld() const {
  return static_cast<int>(std::count_if(outcomes.begin(), outcomes.end(),
                                        [](Outcome outcome) { return IsSuccess(outcome); }));
}

std::string RehearsedCandidate::FormatHeld() const {
  return std::to_string(CountHeld()) + " of " + std::to_string(outcomes.size());
}

std::string RehearsedCandidate::FormatInterval() const {
  const Interval interval = CalcWilsonInterval(CountHeld(), static_cast<int>(outcomes.size()));
  return FormatFixed(100.0 * interval.low, 0) + " to " + FormatFixed(100.0 * interval.high, 0) +
         " %";
}

int RehearsedCandidate::FindRun() const {
  const auto first = std::find_if(outcomes.begin(), outcomes.end(),
                                  [](Outcome outcome) { return !IsSuccess(outcome); });
  return static_cast<int>(first - outcomes.begin());
}

Rehearsal RehearseGrasp(const CandidateMaker& maker, const RehearsalConfig& config,
                        const RunRehearsal& run) {
  GRASPBENCH_DEMAND(config.num_candidates > 0 && config.num_draws > 0, "nothing to rehearse");
  return Rehearser(maker, config, run).Run();
}

}  // namespace graspbench
