// The choice of rehearsal against an oracle, which tries every candidate on the fresh draws:
//
//   rehearsal_oracle SEED HAND OBJECT..
//
// Robust: held in 9 of 10 fresh draws. The oracle holds an object robustly where a candidate does so
// on ten draws, and again on ten others. The choice is judged on these others. An empty cache folder
// (XDG_CACHE_HOME) makes the processor time that of rehearsing.
#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <map>

#include "core/base/text/text.h"
#include "core/statistics/summary.h"
#include "core/trial/trial_runner.h"
#include "datasets/plan/rehearsed_grasps.h"
#include "datasets/plan/scene_names.h"
#include "datasets/plan/session_plan.h"
#include "objects/catalogue.h"
#include "workbench/experiments/rehearse_objects.h"

namespace graspbench {
namespace {

constexpr int kNumDraws = 10, kRobust = 9;

/** Trials of one hand and object. */
class FreshTrials {
 public:
  FreshTrials(const RehearsalTask& task, std::string seed)
      : task_(task),
        object_(CompleteObject(task.object)),
        seed_(std::move(seed)),
        runner_(task.hand, object_) {}

  bool Holds(const Grasp& grasp, const std::string& purpose, int draw) {
    TrialSetup setup = MakeRehearsalSetup(task_, object_, grasp, {draw, 1.0});
    const std::string names = FormatJson({seed_, purpose, task_.hand->id, task_.object->id, draw});
    setup.draw = DrawVariation(task_.conditions.variation, *task_.hand, RandomStream(names, "pose"),
                               RandomStream(names, "joint error"));
    return IsSuccess(runner_.Run(setup).outcome);
  }
  /** @param gives_up  as soon as it cannot be robust. */
  int Count(const Grasp& grasp, const std::string& purpose, bool gives_up) {
    int num_held = 0;
    for (int draw = 0; draw < kNumDraws; ++draw) {
      if (gives_up && draw - num_held > kNumDraws - kRobust) break;
      num_held += Holds(grasp, purpose, draw);
    }
    return num_held;
  }
  bool IsRobust(const Grasp& grasp, const std::string& purpose) {
    return Count(grasp, purpose, true) >= kRobust;
  }
  /** Every candidate that a rehearsal tries which finds none that holds all draws. */
  std::vector<RehearsedCandidate> ListCandidates(const CandidateMaker& maker) {
    return RehearseGrasp(
               maker, task_.config,
               [&](const Grasp& grasp, const RehearsalQuestion& question) {
                 const bool is_last = question.draw + 1 >= task_.config.num_draws;
                 const bool holds = !is_last && Holds(grasp, "candidates", question.draw);
                 return RehearsalAnswer{holds ? Outcome::kSuccess : Outcome::kLostWhileClosing, ""};
               })
        .tried;
  }
  const GraspObject& object() const { return *object_; }

 private:
  const RehearsalTask& task_;
  std::shared_ptr<const GraspObject> object_;
  std::string seed_;
  TrialRunner runner_;
};

void Compare(const std::string& seed, const std::string& hand,
             const std::vector<std::string>& objects) {
  SessionConfig scene;
  scene.hands = {hand};
  scene.objects = ExpandObjects(objects);
  int num_robust = 0, num_by_any = 0, num_held = 0, num_trials = 0;
  std::map<std::string, std::pair<int, int>> shares;  // fresh draws held and run, by rehearsal's
  std::vector<double> times;
  for (const RehearsalTask& task : ListRehearsalTasks(scene, {})) {
    const std::clock_t start = std::clock();
    const Rehearsal rehearsal = FindRehearsal(task);
    times.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    FreshTrials trials(task, seed);
    const CandidateMaker maker(*task.hand, task.grasps, trials.object());
    const int held = trials.Count(maker.Make(rehearsal.choice().candidate), "judged", false);
    num_held += held;
    num_trials += kNumDraws;
    const auto num_rehearsed = static_cast<int>(rehearsal.choice().outcomes.size());
    auto& share = shares[fmt::format("{} of {}", rehearsal.choice().CountHeld(), num_rehearsed)];
    share.first += held;
    share.second += kNumDraws;
    bool is_by_any = held >= kRobust;
    num_robust += is_by_any;
    std::string better;
    if (!is_by_any) {
      for (const RehearsedCandidate& one : trials.ListCandidates(maker)) {
        const Grasp grasp = maker.Make(one.candidate);
        if (!trials.IsRobust(grasp, "chosen by the oracle") || !trials.IsRobust(grasp, "judged")) {
          continue;
        }
        is_by_any = true;
        better = ", robust: " + Describe(one.candidate);
        break;
      }
      fmt::print("{}: {}, rehearsed {} of {}, fresh {} of {}{}\n", task.object->id,
                 Describe(rehearsal.choice().candidate), rehearsal.choice().CountHeld(),
                 num_rehearsed, held, kNumDraws, better);
    }
    num_by_any += is_by_any;
  }
  fmt::print("{}: {} objects, fresh trials held {} of {}; robust {} of {} by any candidate\n", hand,
             times.size(), num_held, num_trials, num_robust, num_by_any);
  for (const auto& [rehearsed, share] : shares) {
    fmt::print("  rehearsed {}: {} of {} fresh draws\n", rehearsed, share.first, share.second);
  }
  double sum = 0.0;
  for (const double time : times) sum += time;
  std::sort(times.begin(), times.end());
  fmt::print("  rehearsed in {:.2f} s of processor time an object, 95 % in {:.2f} s\n",
             sum / static_cast<double>(times.size()), CalcSortedQuantile(times, 0.95));
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) try {
  if (argc < 4) {
    fmt::print(stderr, "rehearsal_oracle SEED HAND OBJECT..\n");
    return 2;
  }
  graspbench::Compare(argv[1], argv[2], {argv + 3, argv + argc});
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
