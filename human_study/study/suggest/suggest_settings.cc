#include "human_study/study/suggest/suggest_settings.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "core/base/config.h"
#include "core/base/units.h"
#include "human_study/study/design/study_config.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

constexpr size_t kMaxRows = 40;       // of trials.csv
constexpr size_t kMaxRecordings = 3;  // whose markers are looked at
constexpr size_t kMaxSuggestions = 16;
constexpr double kYielding = 0.002;  // beyond the noise of its markers [m]
constexpr double kLong = 15.0;       // [s] a recording that holds more than one reach

struct Evidence {
  std::vector<CompanionEvidence> companions;
  double yield = 0.0;  ///< [m]
  std::optional<CutConfig> cut;
};

/** A change to try. */
struct Candidate {
  std::vector<std::string> settings;
  std::string reason, cost;
};

struct Question {
  const Evidence& evidence;
  const StudyResult& result;
  std::vector<const StudyTrial*> trials;  ///< removed for the reason that is asked about
};
using Candidates = std::vector<Candidate>;

Evidence LookAtMarkers(const Study& study) {
  Evidence evidence;
  StudyTables tables;
  std::set<std::string> files;
  for (const PlannedReach& planned : study.trials) {
    if (files.size() == kMaxRecordings || !files.insert(planned.file).second) continue;
    try {
      StudyConfig own = study.config;
      own.markers = MarkersOfHand(own.markers, planned.hand);
      const Recording recording = LoadPlanned(study, planned, tables);
      const PreparedRecording prepared = PrepareRecording(recording, own);
      evidence.yield = std::max(evidence.yield, FindYield(prepared));
      if (planned.hand.empty()) {
        for (const CompanionEvidence& found : FindCompanions(recording, own.markers)) {
          const auto is_same = [&](const auto& known) { return known.digit == found.digit; };
          if (std::none_of(evidence.companions.begin(), evidence.companions.end(), is_same)) {
            evidence.companions.push_back(found);
          }
        }
      }
      const bool is_long = prepared.times.back() - prepared.times.front() > kLong;
      if (study.config.cut.near == 0.0 && is_long && !evidence.cut) {
        evidence.cut = FindCut(prepared);
      }
    } catch (const Error&) {  // the run says why it cannot be read
    }
  }
  return evidence;
}

Candidates ProposeCut(const Question& question) {
  const std::optional<CutConfig>& cut = question.evidence.cut;
  if (!cut) return {};
  return {{{fmt::format("cut.near_m={:g}", cut->near), fmt::format("cut.far_m={:g}", cut->far)},
           "the recording is long, and the hand comes to the object and leaves it several times",
           "every reach becomes a trial; look whether their number is right"}};
}

Candidates UseRegression(const Question& question) {
  const double threshold = question.result.study.config.analysis.movement.speed_threshold;
  std::vector<double> slowest;
  for (const StudyTrial* trial : question.trials) {
    const double least = trial->analysis->movement.slowest_before;
    if (std::isfinite(least)) slowest.push_back(least);
  }
  if (slowest.empty()) return {};
  std::sort(slowest.begin(), slowest.end());
  return {{{"movement.rule=regression"},
           fmt::format("before its peak the wrist's speed goes down to {:.2f} m/s (half of these "
                       "trials) and never below {:g} in {} of {}: the hand does not rest before "
                       "it reaches",
                       slowest[slowest.size() / 2], threshold,
                       std::count_if(slowest.begin(), slowest.end(),
                                     [&](double speed) { return speed > threshold; }),
                       slowest.size()),
           "the onset is carried back from the rising flank: on made-up reaches without a rest it "
           "is off by -1 ms (SD 8), a threshold by 61 ms (SD 8)"}};
}

Candidates UseCompanions(const Question& question) {
  Candidate candidate;
  for (const CompanionEvidence& found : question.evidence.companions) {
    candidate.settings.push_back(
        fmt::format("markers.companions.{}={}", NameOfDigit(found.digit), found.companion));
    candidate.reason += fmt::format(
        "{}\"{}\" is hidden in {} samples; \"{}\" stays {:.0f} mm from it (\u00b1 "
        "{:.1f} mm) and is seen in {} of those",
        candidate.reason.empty() ? "" : "; ", found.tip, found.num_hidden, found.companion,
        MmFromM(found.distance), MmFromM(found.spread), found.num_bridged);
  }
  if (candidate.settings.empty()) return {};
  candidate.cost = "gaps up to cleaning.max_companion_gap_s are filled along the other marker";
  return {candidate};
}

Candidates UseSpeedDetector(const Question& question) {
  if (question.evidence.yield < kYielding) return {};
  Candidate speed = {
      {"contact.detector=speed"},
      fmt::format("the object's markers change their distance by {:.0f} mm: it yields, so "
                  "that digits go on after they touched and never stop at once",
                  MmFromM(question.evidence.yield)),
      "on made-up objects that yield by 5 mm the fall of speed is 35 ms late, every other "
      "detector 60 to 95 ms: compare conditions; single contact times are not reliable"};
  // A limit that nothing keeps on such an object hides what the detector does for it.
  Candidate without_limits = speed;
  without_limits.settings.insert(
      without_limits.settings.end(),
      {"contact.max_uncertainty_s=0", "plausibility.max_disagreement_s=0"});
  without_limits.reason +=
      "; contacts are then known worse, and detectors differ by more, than "
      "the limits for rigid objects";
  return {speed, without_limits};
}

Candidates TryLiftAxes(const Question&) {
  Candidates candidates;
  for (const char* axis : {"0 1 0", "1 0 0", "0 -1 0", "-1 0 0", "0 0 -1", "0 0 1"}) {
    const std::string text = axis;
    const size_t first = text.find(' '), second = text.rfind(' ');
    candidates.push_back({{"lift_off.up_x=" + text.substr(0, first),
                           "lift_off.up_y=" + text.substr(first + 1, second - first - 1),
                           "lift_off.up_z=" + text.substr(second + 1)},
                          "that is the direction in which the object moves most",
                          "look whether it is up in the recording"});
  }
  return candidates;
}

Candidates TryUnits(const Question&) {
  Candidates candidates;
  for (const char* unit : {"mm", "m", "cm", "in"}) {
    candidates.push_back({{std::string("recording.unit=") + unit},
                          "with it the digits are as far apart as a hand's",
                          "check it against the recording's export"});
  }
  return candidates;
}

Candidates LowerCutoffs(const Question& question) {
  const double rate = question.result.lowest_rate;
  return {
      {LowerStatedCutoffs(question.result.study.config, rate),
       fmt::format("a recording has {:.4g} samples a second, and a filter's cut-off must be "
                   "below 0.4 of that",
                   rate),
       "all recordings are filtered at it; without the key the cut-off follows the rate of each "
       "recording"}};
}

/** A limit above which a trial is doubted: larger ones are tried, then none. */
struct Limit {
  const char* code;
  const char* key;
  double (*get)(const AnalysisOptions& options);
  std::array<double, 2> factors;
  const char* reason;
  const char* cost;
};

const std::vector<Limit>& LimitList() {
  using A = AnalysisOptions;
  static const std::vector<Limit> limits = {
      {"contact_after_end",
       "plausibility.max_contact_after_end_s",
       [](const A& a) { return a.plausibility.max_contact_after_end; },
       {2.0, 4.0},
       "digits touch later after the end of the movement than the limit",
       "look whether the wrist's marker is the right one, and at these trials"},
      {"closure_too_long",
       "plausibility.max_closure_time_s",
       [](const A& a) { return a.plausibility.max_closure_time; },
       {1.5, 3.0},
       "the hand closes for longer than the limit",
       "look whether the widest opening of these trials is that of the reach"},
      {"moved_before_touch",
       "plausibility.max_moved_before_s",
       [](const A& a) { return a.plausibility.max_moved_before; },
       {2.0, 4.0},
       "the object moves earlier before the first contact than the limit",
       "something touched it that is not recorded, or the contacts are late"},
  };
  return limits;
}

Candidates Loosen(const Limit& limit, const AnalysisOptions& options) {
  Candidates candidates;
  for (const double factor : {limit.factors[0], limit.factors[1], 0.0}) {
    candidates.push_back({{fmt::format("{}={:g}", limit.key, factor * limit.get(options))},
                          limit.reason,
                          limit.cost});
  }
  return candidates;
}

/** Something that mends the reason of that code. */
struct Maker {
  const char* code;
  Candidates (*make)(const Question& question);
};

const std::vector<Maker>& MakerList() {
  static const std::vector<Maker> makers = {
      {"no_onset", UseRegression},       {"no_opening", UseCompanions},
      {"no_contact", UseCompanions},     {"no_hold", UseCompanions},
      {"not_usable", UseCompanions},     {"gap_event", UseCompanions},
      {"filled_event", UseCompanions},   {"no_contact", UseSpeedDetector},
      {"other_lift_axis", TryLiftAxes},  {"wrong_unit", TryUnits},
      {"cutoff_too_high", LowerCutoffs},
  };
  return makers;
}

/** The study under settings, as far as it is removed for `code`. */
struct State {
  StudyResult result;
  int CountRemoved(const std::string& code) const {
    return static_cast<int>(
        std::count_if(result.trials.begin(), result.trials.end(),
                      [&](const StudyTrial& trial) { return trial.removed_code == code; }));
  }
};

State RunUnder(Study study, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) SetConfigValue(setting, study.config);
  return {RunTrials(LeaveOutReport(std::move(study)))};
}

/** Every n-th row. */
Study TakeSome(Study study) {
  const size_t step = (study.trials.size() + kMaxRows - 1) / kMaxRows;
  std::vector<PlannedReach> some;
  for (size_t i = 0; i < study.trials.size(); i += step) some.push_back(study.trials[i]);
  study.trials = std::move(some);
  study.reviews.clear();  // of trials that may not be among these
  return study;
}

/** Finds one more change at a time. */
class Search {
 public:
  explicit Search(const Study& study)
      : study_(study), evidence_(LookAtMarkers(study)), state_(RunUnder(study, {})) {}

  const State& state() const { return state_; }
  const std::vector<Suggestion>& suggestions() const { return suggestions_; }

  void Run() {
    if (evidence_.cut) {
      Take(ProposeCut({evidence_, state_.result, {}}), "");
    }
    while (suggestions_.size() < kMaxSuggestions && (Mend() || Tolerate())) {
    }
    Prune();
  }

 private:
  std::vector<std::string> ListSettings(const Suggestion* left_out = nullptr) const {
    std::vector<std::string> settings;
    for (const Suggestion& suggestion : suggestions_) {
      if (&suggestion == left_out) continue;
      settings.insert(settings.end(), suggestion.settings.begin(), suggestion.settings.end());
    }
    return settings;
  }

  /** The best of them, if it helps. @param code  of the trials it should help; empty: all. */
  bool Take(const Candidates& candidates, const std::string& code) {
    std::optional<State> best;
    Suggestion taken;
    for (const Candidate& candidate : candidates) {
      std::vector<std::string> settings = ListSettings();
      settings.insert(settings.end(), candidate.settings.begin(), candidate.settings.end());
      State state = RunUnder(study_, settings);
      const State& rival = best ? *best : state_;
      const int kept = state.result.CountKept(), rival_kept = rival.result.CountKept();
      const bool is_better =
          kept > rival_kept ||
          (kept == rival_kept && state.CountRemoved(code) < rival.CountRemoved(code)) ||
          (code.empty() && state.result.trials.size() > rival.result.trials.size());
      if (!is_better) continue;
      taken = {candidate.settings, candidate.reason, candidate.cost, kept};
      best = std::move(state);
    }
    if (!best) return false;
    state_ = std::move(*best);
    suggestions_.push_back(taken);
    return true;
  }

  /** One change more that mends; false when none helps. */
  bool Mend() {
    std::set<std::string> asked;
    for (const RemovalGroup& group : GroupRemoved(state_.result.trials)) {
      if (!asked.insert(group.code).second) continue;
      for (const Maker& maker : MakerList()) {
        if (maker.code != group.code) continue;
        Question question = {evidence_, state_.result, {}};
        for (const StudyTrial& trial : state_.result.trials) {
          if (trial.removed_code == group.code && trial.analysis) question.trials.push_back(&trial);
        }
        if (Take(maker.make(question), group.code)) return true;
      }
    }
    return false;
  }

  /** One limit less narrow; false when none helps. */
  bool Tolerate() {
    for (const Limit& limit : LimitList()) {
      if (state_.CountRemoved(limit.code) == 0) continue;
      if (Take(Loosen(limit, state_.result.study.config.analysis), limit.code)) return true;
    }
    return false;
  }

  /** A change may have lost its use by those after it. */
  void Prune() {
    const size_t num_before = suggestions_.size();
    for (size_t i = suggestions_.size(); i-- > 0 && suggestions_.size() > 1;) {
      State state = RunUnder(study_, ListSettings(&suggestions_[i]));
      if (state.result.CountKept() < state_.result.CountKept()) continue;
      if (state.result.trials.size() != state_.result.trials.size()) continue;
      state_ = std::move(state);
      suggestions_.erase(suggestions_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (suggestions_.size() < num_before) Recount();
  }

  void Recount() {
    std::vector<std::string> settings;
    for (Suggestion& suggestion : suggestions_) {
      settings.insert(settings.end(), suggestion.settings.begin(), suggestion.settings.end());
      suggestion.num_kept = RunUnder(study_, settings).result.CountKept();
    }
  }

  const Study& study_;
  Evidence evidence_;
  State state_;
  std::vector<Suggestion> suggestions_;
};

}  // namespace

StudySuggestions SuggestSettings(const Study& study) {
  const Study some = TakeSome(study);
  StudySuggestions answer;
  answer.num_rows = static_cast<int>(some.trials.size());
  answer.num_all_rows = static_cast<int>(study.trials.size());
  Search search(some);
  answer.num_trials = static_cast<int>(search.state().result.trials.size());
  answer.num_kept = search.state().result.CountKept();
  search.Run();
  answer.suggestions = search.suggestions();
  const StudyResult& result = search.state().result;
  answer.num_trials_then = static_cast<int>(result.trials.size());
  answer.num_kept_then = result.CountKept();
  answer.others = GroupRemoved(result.trials);
  return answer;
}

}  // namespace graspbench
