#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "datasets/analysis/argument/argument_evidence.h"
#include "datasets/analysis/campaign/campaign_summary.h"
#include "datasets/analysis/campaign/thesis_claims.h"
#include "datasets/analysis/session_comparison.h"
#include "datasets/plan/scene_names.h"

namespace graspbench {
namespace {

constexpr char kEvolved[] = "-evolved";

std::string FormatSuccess(const PairedCounts& counts) {
  const auto rate = [&](int successes) {
    const Interval interval = CalcWilsonInterval(successes, counts.num_pairs());
    return FormatWithRange(100.0 * successes / counts.num_pairs(), 100.0 * interval.low,
                           100.0 * interval.high, 1) +
           " %";
  };
  return "before " + rate(counts.both + counts.first_only) + ", after " +
         rate(counts.both + counts.second_only);
}

ArgumentNumber MakeSuccessNumber(const std::string& subject, const PairedCounts& counts,
                                 const Interval& interval) {
  ArgumentNumber number;
  number.measure = &kSuccessChange;
  number.subject = subject;
  number.n = counts.num_pairs();
  number.of = "pair";
  if (number.n > 0) {
    number.value = 100.0 * (counts.second_only - counts.first_only) / number.n;
    number.room = 100.0 - 100.0 * (counts.both + counts.first_only) / number.n;
    number.detail = FormatSuccess(counts);
  }
  number.interval = {100.0 * interval.low, 100.0 * interval.high};
  return number;
}

/** Standard against new target grasp of a campaign, by hand. */
void AddCampaign(const FromFolder<Campaign>& campaign, std::vector<ArgumentNumber>& numbers) {
  const SessionSummary benchmark = SummariseSession(campaign.result.benchmark);
  const std::vector<SceneVariants> scenes = ListScenes(campaign.result, benchmark);
  std::vector<std::string> hands;
  for (const SceneVariants& scene : scenes) {
    if (std::find(hands.begin(), hands.end(), scene.hand) == hands.end()) {
      hands.push_back(scene.hand);
    }
  }
  for (const std::string& hand : hands) {
    const PairedCounts counts = CountPairedSuccesses(scenes, kStandardGrasp, kNewTarget, hand);
    if (counts.num_pairs() == 0) continue;
    ArgumentNumber number =
        MakeSuccessNumber(hand + ": seen objects", counts, CalcPairedDifferenceInterval(counts));
    number.decides = true;
    number.source = campaign.folder;
    number.command = "graspbench campaign --hand " + hand + " --out DIR";
    const auto num_left = std::count_if(scenes.begin(), scenes.end(), [&](const auto& scene) {
      return scene.hand == hand && !scene.IsComplete();
    });
    if (num_left > 0) number.left_out = FormatCount(num_left, "scene") + " that is not finished";
    Judge(number);
    numbers.push_back(number);
  }
}

/** The trials of one hand, on objects of the catalogue or on others. */
Session TakePart(const Session& session, const std::string& hand, bool is_seen) {
  const std::vector<std::string>& objects = session.config.objects;
  const bool is_all = std::find(objects.begin(), objects.end(), "all") != objects.end();
  const auto is_taken = [&](const PlannedTrial& planned) {
    const bool is_listed =
        is_all || std::find(objects.begin(), objects.end(), planned.object) != objects.end();
    return planned.hand == hand && is_listed == is_seen && !planned.condition;
  };
  Session part;
  part.config = session.config;
  for (const PlannedTrial& planned : session.plan) {
    if (is_taken(planned)) part.plan.push_back(planned);
  }
  for (const TrialRecord& record : session.records) {
    if (is_taken(record.plan)) part.records.push_back(record);
  }
  return part;
}

/** Tries both sets of grasps on the draws of this session. */
std::string MakePairCommand(const SessionConfig& config, const std::string& hand, bool is_seen) {
  return "graspbench run --hand " + hand + "," + hand + kEvolved + " --object " +
         (is_seen ? FormatListOption(config.objects, "OBJECT") : "FOLDER") + " --grasp " +
         FormatListOption(config.grasps, "FILE") + " --trials " + std::to_string(config.trials) +
         " --out DIR";
}

/** A hand's grasps against its evolved ones, where the two were tried on the same draws. */
void AddSessions(const FromFolder<Session>& first, const std::string& hand,
                 const FromFolder<Session>& second, bool is_seen,
                 std::vector<ArgumentNumber>& numbers) {
  const Session before = TakePart(first.result, hand, is_seen);
  const Session after = TakePart(second.result, hand + kEvolved, is_seen);
  if (before.records.empty() || after.records.empty()) return;
  SessionComparison comparison;
  try {
    comparison = CompareSessions(before, after);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kUsage) throw;
    return;  // other draws: they are no pairs
  }
  const SettingChange& change = comparison.changes.front();
  ArgumentNumber number =
      MakeSuccessNumber(hand + (is_seen ? ": seen objects" : ": unseen objects"), change.successes,
                        {change.rate_change_low, change.rate_change_high});
  number.decides = is_seen;
  number.detail += "; " + FormatCount(change.num_objects, "object");
  const int num_left_out = comparison.num_only_before + comparison.num_only_after;
  if (num_left_out > 0) number.left_out = FormatCount(num_left_out, "trial") + " without a partner";
  // The interval comes from drawing objects, so more draws of the same ones hardly narrow it.
  const int num_objects =
      CountToDecide(*number.measure, number.value, number.interval, change.num_objects);
  if (!change.no_interval.empty()) {
    number.would_decide = "other objects: " + change.no_interval;
  } else if (num_objects > 0) {
    number.would_decide = FormatWanted(num_objects, change.num_objects, "object");
  }
  number.source =
      first.folder == second.folder ? first.folder : first.folder + ", " + second.folder;
  number.command = MakePairCommand(first.result.config, hand, is_seen);
  Judge(number);
  if (number.verdict != ArgumentVerdict::kNotDecided) number.would_decide.clear();
  numbers.push_back(number);
}

std::vector<std::string> ListHandsOf(const Session& session) {
  std::vector<std::string> hands;
  for (const PlannedTrial& planned : session.plan) {
    if (std::find(hands.begin(), hands.end(), planned.hand) == hands.end()) {
      hands.push_back(planned.hand);
    }
  }
  return hands;
}

}  // namespace

std::vector<ArgumentNumber> ListSuccessNumbers(const ArgumentSources& sources) {
  std::vector<ArgumentNumber> numbers;
  for (const auto& campaign : sources.campaigns) AddCampaign(campaign, numbers);
  for (const bool is_seen : {true, false}) {
    for (const auto& first : sources.sessions) {
      for (const std::string& hand : ListHandsOf(first.result)) {
        for (const auto& second : sources.sessions) {
          AddSessions(first, hand, second, is_seen, numbers);
        }
      }
    }
  }
  return numbers;
}

}  // namespace graspbench
