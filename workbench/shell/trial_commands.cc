#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/statistics/proportion.h"
#include "core/statistics/summary.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_cards.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/shell/shell_words.h"
#include "workbench/terminal.h"
#include "workbench/text_table.h"

namespace graspbench {
namespace {

constexpr int kMaxTrials = 10000;
constexpr double kJustBefore = 0.01;  // [s]
constexpr int kNumNeighbours = 10;    // draws among which a successful one is looked for

/** The choice's trials of the draws 0 to count - 1, or as many as there was time for. */
std::vector<TrialResult> RunDraws(Shell& shell, int count) {
  std::vector<TrialResult> results;
  for (int draw = 0; draw < count && !shell.IsStopped(); ++draw) {
    results.push_back(shell.scene().runner().Run(shell.scene().MakeSetup(draw)));
  }
  return results;
}

double CalcMedianOf(const std::vector<TrialResult>& results,
                    double (*measure)(const TrialResult& result)) {
  std::vector<double> values;
  for (const TrialResult& result : results) {
    if (IsSuccess(result.outcome)) values.push_back(measure(result));
  }
  return CalcMedianOfFinite(values);
}

int CountSuccesses(const std::vector<TrialResult>& results) {
  int count = 0;
  for (const TrialResult& result : results) count += IsSuccess(result.outcome);
  return count;
}

std::string FormatTrials(const std::vector<TrialResult>& results) {
  TextTable table({"draw", "outcome", "GFT [ms]", "sigma [N]", "reason"});
  for (size_t draw = 0; draw < results.size(); ++draw) {
    const TrialResult& result = results[draw];
    table.AddRow({std::to_string(draw), NameOf(result.outcome),
                  FormatFixed(MsFromS(result.timing.gft), 1),
                  FormatFixed(result.stability.sigma, 2), result.reason});
  }
  const int count = static_cast<int>(results.size());
  return table.Format() + "success  " + FormatRate(CountSuccesses(results), count) +
         fmt::format(
             "\nmedian   GFT {} ms, sigma {} N of the successes\n",
             FormatFixed(
                 MsFromS(CalcMedianOf(results, [](const TrialResult& r) { return r.timing.gft; })),
                 1),
             FormatFixed(
                 CalcMedianOf(results, [](const TrialResult& r) { return r.stability.sigma; }), 2));
}

/** Whether object and hand met in the same poses. */
bool AreSameDraws(const SceneChoice& a, const SceneChoice& b) {
  return a.config.objects == b.config.objects && a.config.seed == b.config.seed &&
         a.config.variation.offset == b.config.variation.offset &&
         a.config.variation.yaw == b.config.variation.yaw;
}

/** The same draws before and now. */
std::string FormatComparison(const DrawnTrials& trials_before,
                             const std::vector<TrialResult>& now) {
  const std::vector<TrialResult>& before = trials_before.results;
  PairedCounts pairs;
  for (size_t draw = 0; draw < std::min(before.size(), now.size()); ++draw) {
    const bool was = IsSuccess(before[draw].outcome), is = IsSuccess(now[draw].outcome);
    ++(was ? (is ? pairs.both : pairs.first_only) : (is ? pairs.second_only : pairs.neither));
  }
  const Interval change = CalcPairedDifferenceInterval(pairs);
  return fmt::format(
      "against {}, {}{}, on {}: {} won, {} lost; the rate changes by {} to {} points\n",
      trials_before.choice.config.hands.front(), trials_before.grasp,
      trials_before.choice.joints.empty() ? "" : " with joints set by hand",
      FormatCount(pairs.num_pairs(), "same draw"), pairs.second_only, pairs.first_only,
      FormatFixed(100.0 * change.low, 1), FormatFixed(100.0 * change.high, 1));
}

/** The last contact that slipped or was lost, in the time that `goto` takes. */
std::string DescribeLastEvent(const TrialResult& result, double closure_start) {
  const ContactEvent* last = nullptr;
  for (const ContactEvent& event : result.contact_events) {
    const bool is_loss =
        event.kind == ContactEventKind::kSlip || event.kind == ContactEventKind::kLost;
    if (is_loss) last = &event;
  }
  if (last == nullptr) return "no contact slipped or was lost\n";
  const std::string time = FormatFixed(last->time + closure_start, 3);
  return fmt::format("last     {} of {} ({}) at {} s; its forces just before: goto {}, contacts\n",
                     NameOf(last->kind), last->digit, last->link, time,
                     FormatFixed(last->time + closure_start - kJustBefore, 3));
}

std::string DescribeMissing(const TrialResult& result) {
  std::string text;
  for (size_t d = 0; d < result.contacts.size(); ++d) {
    if (!std::isnan(result.contacts[d].time)) continue;
    text += fmt::format("missing  {} never touched; its nearest was {} mm\n",
                        result.contacts[d].digit.str(),
                        FormatFixed(MmFromM(result.touches[d].smallest_gap), 1));
  }
  return text;
}

double CalcDistance(const TrialDraw& a, const TrialDraw& b, double radius) {
  const double yaw = radius * std::abs(a.offset_yaw - b.offset_yaw);
  return std::hypot(a.offset_x - b.offset_x, a.offset_y - b.offset_y, yaw);
}

std::string DescribeNeighbour(Shell& shell) {
  ShellScene& scene = shell.scene();
  const double radius = 0.5 * scene.setup().object->size.x();
  int nearest = -1;
  double distance = std::numeric_limits<double>::infinity();
  const std::vector<TrialResult> results = RunDraws(shell, kNumNeighbours);
  for (int draw = 0; draw < static_cast<int>(results.size()); ++draw) {
    if (!IsSuccess(results[static_cast<size_t>(draw)].outcome)) continue;
    const double candidate = CalcDistance(scene.MakeSetup(draw).draw, scene.setup().draw, radius);
    if (candidate >= distance) continue;
    distance = candidate;
    nearest = draw;
  }
  if (nearest < 0)
    return fmt::format("nearest  none of the draws 0 to {} succeeds\n", results.size() - 1);
  return fmt::format("nearest  draw {} succeeds; its object stands {} mm from this one\n", nearest,
                     FormatFixed(MmFromM(distance), 1));
}

}  // namespace

void RunTrials(Shell& shell, const ShellArguments& arguments) {
  if (shell.scene().choice().place) {
    throw Error(ErrorKind::kUsage,
                "the object was put by hand, so all draws would be the same; see: draw, undo");
  }
  const int count =
      arguments.empty() ? 10 : ParseCount(arguments[0], "the number of trials", 1, kMaxTrials);
  const std::vector<TrialResult> results = RunDraws(shell, count);
  if (results.empty()) return;
  std::string text = FormatTrials(results);
  const SceneChoice& choice = shell.scene().choice();
  if (shell.trials && AreSameDraws(shell.trials->choice, choice)) {
    text += FormatComparison(*shell.trials, results);
  }
  shell.trials = DrawnTrials{choice, shell.scene().setup().grasp.id, results};
  PrintResult(text);
}

void JudgeTrial(Shell& shell, const ShellArguments&) {
  ShellScene& scene = shell.scene();
  if (!scene.is_over()) throw Error(ErrorKind::kUsage, "the trial goes on; first: run");
  if (!scene.course().is_held()) {
    throw Error(ErrorKind::kUsage, "nothing is in the hand that could be judged; see: why");
  }
  const Judgement judgement = scene.course().Judge();
  TextTable table({"load in the palm's frame", "breaks at", ""});
  for (const BreakingLoad& load : judgement.loads) {
    table.AddRow(
        {load.direction, FormatFixed(load.load, 3),
         std::string(load.is_force() ? "N" : "N m") + (load.is_broken ? "" : ", not broken")});
  }
  PrintResult(table.Format() + fmt::format("smallest {} N, {} N m\n",
                                           FormatFixed(judgement.breaking_force, 2),
                                           FormatFixed(judgement.breaking_moment, 3)));
}

void ExplainTrial(Shell& shell, const ShellArguments&) {
  ShellScene& scene = shell.scene();
  if (!scene.is_over()) throw Error(ErrorKind::kUsage, "the trial goes on; first: run");
  const TrialResult result = scene.course().End();
  std::string text = "outcome  " + std::string(NameOf(result.outcome));
  text += (result.reason.empty() ? "" : ": " + result.reason) + "\n";
  text += DescribeMissing(result) + DescribeLastEvent(result, scene.notes().closure_start);
  if (!IsSuccess(result.outcome)) text += DescribeNeighbour(shell);
  PrintResult(text);
}

}  // namespace graspbench
