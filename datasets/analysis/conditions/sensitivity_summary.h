#pragma once
/** @file
How far a session's results depend on single settings: its trials are compared in pairs with trials
of the same draws under one changed setting. The latter are the sessions in sensitivity/, whose
conditions have one setting each. Equal duplicates are accepted, unequal ones are an error.

Pairs, mean changes and intervals are those of datasets/analysis/pairs.h; a measure is compared over
the pairs in which both trials have it. With tens of settings some intervals exclude 0 by chance.
Trials without a partner are counted with the estimate. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/statistics/proportion.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Lists the conditions of `graspbench sensitivity`.
@param settings  "sim.step_s=0.001"; empty: other values of all unmeasured or assumed parameters.
These are 0.5 and 2 times the value, 0.8 and 1.25 times for friction, 0 and 2 times for the
variation and joint errors, and every other coupling rule. Values out of range, or equal to the
session's, are left out.
@throws Error(kUsage, kRange) for a setting that cannot be used or is given twice. */
std::vector<Condition> ListSensitivityConditions(const SessionConfig& config,
                                                 const std::vector<std::string>& settings = {});

/** Measures that are compared between two trials of the same draw. */
struct TrialMeasures {
  std::string grasp;
  Outcome outcome = Outcome::kNotRun;
  double gct = kUnset;        ///< [s]; times are NaN if a digit touched before closure began
  double gft = kUnset;        ///< [s]
  double gft_ratio = kUnset;  ///< of GCT
  double got_ratio = kUnset;
  double sigma = kUnset;  ///< [N]

  template <class V>
  static void ListFields(V&& field) {
    field("grasp", &TrialMeasures::grasp);
    field("outcome", &TrialMeasures::outcome);
    field("gct_s", &TrialMeasures::gct);
    field("gft_s", &TrialMeasures::gft);
    field("gft_ratio", &TrialMeasures::gft_ratio);
    field("got_ratio", &TrialMeasures::got_ratio);
    field("sigma_n", &TrialMeasures::sigma);
  }
};
TrialMeasures MakeTrialMeasures(const TrialRecord& record);

/** The trials of one setting, by the id of the session's trial with the same draw. An entry with
the outcome kNotRun is a trial of the session whose partner is missing. */
using VariedTrials = std::map<std::string, TrialMeasures>;
using SensitivityData = std::map<std::string, VariedTrials>;  ///< by setting

/** Loads the data from the session's folder; empty for a session without a folder.
@throws Error(kFormat) for unequal duplicates; Error(kIo). */
SensitivityData LoadSensitivity(const Session& session);

/* Success by the object's offset from its nominal position, for each positioning of the hand: the
session's own and those that `graspbench sensitivity` ran on the same draws. */

/** One hand's trials under one positioning with the object's offset in [low, high). */
struct OffsetClass {
  std::string hand;
  std::string positioning;       ///< "camera"
  double low = 0.0, high = 0.0;  ///< [m]; high belongs to the last class only
  Tally tally;
};

/** Lists four classes of equal width, from 0 to the corner of the square of offsets, for hands in
the order of the records, the session's positioning first. Empty if offsets do not vary. */
std::vector<OffsetClass> ListOffsetClasses(const Session& session, const SensitivityData& varied);

/** The change of one measure. */
struct MeasureChange {
  std::string measure;                 ///< "gft_s"
  int num_pairs = 0;                   ///< in which both trials have the measure
  double before = kUnset;              ///< mean over these pairs
  double after = kUnset;               ///< mean over these pairs
  double low = kUnset, high = kUnset;  ///< 95 % interval of after - before; NaN: none
  std::string no_interval;             ///< why there is none

  double change() const { return after - before; }

  template <class V>
  static void ListFields(V&& field) {
    using C = MeasureChange;
    field("measure", &C::measure);
    field("pairs", &C::num_pairs);
    field("before", &C::before);
    field("after", &C::after);
    field("change_low", &C::low);
    field("change_high", &C::high);
    field("no_interval", &C::no_interval);
  }
};

/** One setting and one hand. */
struct SettingChange {
  std::string setting;  ///< "model.mass_scale=0.5"
  std::string value;    ///< of this key in the session: "1.0"
  std::string hand;
  PairedCounts successes;    ///< first: in the session, second: under the setting
  int num_left_out = 0;      ///< session trials planned under the setting but without a pair
  std::string why_left_out;  ///< "2 not finished, 1 without a partner"; empty: none
  double rate_change_low = kUnset, rate_change_high = kUnset;  ///< of rate after - before
  std::string no_interval;                                     ///< why there is none
  int num_objects = 0;                                         ///< of the pairs
  int num_other_grasp = 0;              ///< pairs whose trials have different grasps
  std::vector<MeasureChange> measures;  ///< gct_s, gft_s, gft_ratio, got_ratio, sigma_n

  double rate_change() const {
    return CalcShare(successes.second_only - successes.first_only, successes.num_pairs());
  }
  /** @pre there is a change of this measure. */
  const MeasureChange& Find(const std::string& measure) const;

  template <class V>
  static void ListFields(V&& field) {
    using C = SettingChange;
    field("setting", &C::setting);
    field("session_value", &C::value);
    field("hand", &C::hand);
    field("success_both", &C::successes, &PairedCounts::both);
    field("success_before_only", &C::successes, &PairedCounts::first_only);
    field("success_after_only", &C::successes, &PairedCounts::second_only);
    field("success_neither", &C::successes, &PairedCounts::neither);
    field("left_out", &C::num_left_out);
    field("why_left_out", &C::why_left_out);
    field("rate_change_low", &C::rate_change_low);
    field("rate_change_high", &C::rate_change_high);
    field("no_interval", &C::no_interval);
    field("objects", &C::num_objects);
    field("other_grasp", &C::num_other_grasp);
    field("measures", &C::measures);
  }
};

struct SensitivitySummary {
  int physics_version = kPhysicsVersion;
  std::vector<SettingChange> changes;  ///< by setting, then in the order of the session's hands
  std::vector<OffsetClass> offsets;    ///< on the same draws; not stored

  template <class V>
  static void ListFields(V&& field) {
    field("physics_version", &SensitivitySummary::physics_version);
    field("changes", &SensitivitySummary::changes);
  }
};

/** Formats a setting or its value for tables, long numbers with four digits:
"variation.yaw_rad=0.1745". */
std::string FormatSetting(const std::string& setting);

/** Returns "10", or "6 of 10" if pairs are left out. */
std::string CountPairs(const SettingChange& change);

/** Makes the displayed table of changes with the columns of these headings: setting (or of), was,
hand, pairs, objects, won, lost, success [%], GCT [ms], GFT [ms], GFT% [%], GOT% [%], sigma [N],
other grasp, left out. An entry is "-8 (-12 to -3)", or "-8 (-12 to -3), 5 of 10 pairs" if not all
pairs have the measure. */
ShownTable ShowChanges(const std::vector<SettingChange>& changes,
                       const std::vector<std::string>& headings);

/** Returns the notes below a table of changes, ending with a line feed. */
std::string DescribeChanges(const std::vector<SettingChange>& changes);

enum class PairsTaken { kAll, kSameGrasp };

/** Compares the session's trials with others of the same draws, one change per hand.
@param setting  name for the change.
@param trials  by ids of the session's plan; kNotRun: without a partner. */
std::vector<SettingChange> ListChanges(const Session& session, const std::string& setting,
                                       const VariedTrials& trials,
                                       PairsTaken taken = PairsTaken::kAll);

SensitivitySummary SummariseSensitivity(const Session& session, const SensitivityData& data);

}  // namespace graspbench
