#pragma once
/** @file
How far a session's numbers depend on single settings: its trials beside the same trials under one
changed setting (datasets/session/sensitivity_store.h), pair by pair.

Success is compared over all pairs: the difference of the rates with Newcombe's interval for pairs
(core/statistics/proportion.h). A measure is compared over the pairs in which both trials have it:
the difference of the two medians, with an interval from drawing cells (hand, object, grasp) with
replacement, because trials of one cell are alike. Both at 95 %; with tens of settings some
intervals miss 0 by chance. What lacks its pair is counted beside the estimate. */

#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/statistics/proportion.h"
#include "datasets/analysis/offset_classes.h"
#include "datasets/session/sensitivity_store.h"

namespace graspbench {

/** The change of one measure. */
struct MeasureChange {
  std::string measure;     ///< "gft_s"
  int num_pairs = 0;       ///< in which both trials have it
  double before = kUnset;  ///< median over these pairs; so is
  double after = kUnset;
  double low = kUnset, high = kUnset;  ///< 95 % interval of after - before; NaN: none, and
  std::string no_interval;             ///< why

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
  std::string value;    ///< of the same key in the session: "1.0"
  std::string hand;
  PairedCounts successes;    ///< first: as the session has it, second: under the setting
  int num_left_out = 0;      ///< trials of the session that are planned under the setting, too
  std::string why_left_out;  ///< "2 not finished in the session"; empty: none is
  double rate_change_low = kUnset, rate_change_high = kUnset;  ///< of the rate after - before
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
    field("measures", &C::measures);
  }
};

struct SensitivitySummary {
  int physics_version = kPhysicsVersion;
  std::vector<SettingChange> changes;  ///< by setting, then in the order of the session's hands
  std::vector<OffsetClass> offsets;    ///< likewise on the same draws; in no file

  template <class V>
  static void ListFields(V&& field) {
    field("physics_version", &SensitivitySummary::physics_version);
    field("changes", &SensitivitySummary::changes);
  }
};

/** A setting or its value as tables show it, a long number with four digits:
"variation.yaw_rad=0.1745". */
std::string FormatSetting(const std::string& setting);

/** "10", or "6 of 10" where pairs are left out. */
std::string CountPairs(const SettingChange& change);

/** A measure's change as tables show it: "-8 (-12 to -3)", and "-8 (-12 to -3), 5 of 10 pairs" where
not all pairs have it. */
std::string FormatChange(const SettingChange& change, const char* measure, double scale,
                         int decimals);

/** What a table of changes says below it, with a line feed. */
std::string DescribeChanges(const std::vector<SettingChange>& changes);

/** How the session's trials compare with others of the same draws, a change for each hand.
@param setting  its name. */
std::vector<SettingChange> ListChanges(const Session& session, const std::string& setting,
                                       const VariedTrials& trials);

SensitivitySummary SummariseSensitivity(const Session& session, const SensitivityData& data);

}  // namespace graspbench
