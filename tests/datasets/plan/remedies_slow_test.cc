// What the named remedy is worth on draws that nobody has looked at: of every condition of a
// session with failures the first is explained, and the remedy that is named runs, beside the trial
// as it is, on eight draws beyond those that it was chosen by. Beside it what could be gained there:
// by the best remedy that is the same everywhere, and by an oracle that knows the best of each
// condition, both chosen on the very draws that they are judged on. Another seed:
// --gtest_random_seed=NUMBER.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <set>

#include "datasets/plan/failed_trial.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {
namespace {

constexpr int kNumUnseenDraws = 8;

struct Gain {
  int num_named = 0, mended = 0, broken = 0;
  int net() const { return mended - broken; }
};

class RemediesTest : public testing::Test {
 protected:
  void Explain(const SessionConfig& config, const SessionInputs& inputs,
               const PlannedTrial& planned, FailedTrial failed, TrialRunner& runner);

  std::map<std::string, Gain> gains_[2];  // by hand; with the same grasp, and with another
  std::map<std::string, int> by_remedy_;  // net gain over all conditions, of each remedy
  int oracle_[2] = {0, 0};
  int num_conditions_ = 0, num_draws_ = 0, num_held_ = 0, num_on_edge_ = 0;
};

void RemediesTest::Explain(const SessionConfig& config, const SessionInputs& inputs,
                           const PlannedTrial& planned, FailedTrial failed, TrialRunner& runner) {
  const Explanation found = ExplainFailure(runner, failed);
  ++num_conditions_;
  num_on_edge_ += found.is_on_edge;
  std::cout << DescribeTrial(planned) << ": " << NameOf(failed.result.diagnosis->mechanism) << ". "
            << DescribeExplanation(found) << "\n";
  const auto holds = [&](const TrialSetup& setup) { return IsSuccess(runner.Run(setup).outcome); };
  std::vector<TrialSetup> setups;
  std::vector<bool> held;
  PlannedTrial unseen = planned;
  for (int i = 0; i < kNumUnseenDraws; ++i) {
    unseen.trial = kFirstFreshDraw + kNumFreshDraws + i;
    setups.push_back(failed.setup);
    setups.back().draw = MakeTrialSetup(config, inputs, unseen).draw;
    held.push_back(holds(setups.back()));
    ++num_draws_;
    num_held_ += held.back();
  }
  int most[2] = {0, 0};
  for (const RemedyResult& remedy : found.remedies) {
    if (remedy.num_draws == 0) continue;
    const bool is_grasp = IsAnotherGrasp(remedy);
    Gain gain = {1, 0, 0};
    for (size_t i = 0; i < setups.size(); ++i) {
      const bool now = holds(ApplyRemedy(remedy.id, failed, setups[i]));
      gain.mended += now && !held[i];
      gain.broken += !now && held[i];
    }
    by_remedy_[remedy.id] += gain.net();
    most[is_grasp] = std::max(most[is_grasp], gain.net());
    const RemedyResult* best = found.FindBest(is_grasp);
    if (!best || best->id != remedy.id) continue;
    Gain& sum = gains_[is_grasp][planned.hand];
    ++sum.num_named;
    sum.mended += gain.mended;
    sum.broken += gain.broken;
    std::cout << fmt::format("  on unseen draws {} mends {}, breaks {}\n", remedy.id, gain.mended,
                             gain.broken);
  }
  for (const bool is_grasp : {false, true}) oracle_[is_grasp] += most[is_grasp];
}

TEST_F(RemediesTest, NoHandLosesByTheNamedOne) {
  SessionConfig config;
  config.seed = 1000 + testing::GTEST_FLAG(random_seed);
  config.grasps = {"predicted"};  // rehearsed types leave nearly nothing to mend
  const SessionInputs inputs = LoadSessionInputs(config);
  std::set<std::string> done;
  std::string pair;
  std::unique_ptr<TrialRunner> runner;
  for (const PlannedTrial& planned : MakePlan(config, inputs)) {
    const TrialSetup setup = MakeTrialSetup(config, inputs, planned);
    if (pair != planned.hand + planned.object) {
      pair = planned.hand + planned.object;
      runner = std::make_unique<TrialRunner>(setup.hand, setup.object);
    }
    if (done.count(pair + planned.grasp) > 0) continue;
    const TrialResult result = runner->Run(setup);
    if (!result.diagnosis) continue;
    done.insert(pair + planned.grasp);
    FailedTrial failed = MakeFailedTrial(config, inputs, planned, setup);
    failed.result = result;
    Explain(config, inputs, planned, std::move(failed), *runner);
  }
  std::cout << fmt::format(
      "seed {}: {} conditions with a failure, {} on an edge; {} of {} unseen "
      "draws hold\n",
      config.seed, num_conditions_, num_on_edge_, num_held_, num_draws_);
  for (const bool is_grasp : {false, true}) {
    int net = 0;
    for (const auto& [hand, gain] : gains_[is_grasp]) {
      net += gain.net();
      std::cout << fmt::format("{}, {}: named in {}, mended {}, broken {}, net {}\n",
                               is_grasp ? "another grasp" : "same grasp", hand, gain.num_named,
                               gain.mended, gain.broken, gain.net());
      EXPECT_GE(gain.net(), 0) << hand;
    }
    std::pair<std::string, int> fixed = {"none", 0};
    for (const auto& [id, gain] : by_remedy_) {
      if (IsAnotherGrasp({id}) == is_grasp && gain > fixed.second) fixed = {id, gain};
    }
    std::cout << fmt::format("{}: {} of {}; the best one for all, {}: {}; an oracle: {}\n",
                             is_grasp ? "another grasp" : "same grasp", net, num_draws_,
                             fixed.first, fixed.second, oracle_[is_grasp]);
  }
}

}  // namespace
}  // namespace graspbench
