#pragma once
/** @file
Effects of single settings on a session's trials: the sessions in sensitivity/, whose conditions have
one setting each. Equal duplicates are fine, unequal ones are an error. */

#include <filesystem>
#include <map>
#include <string>

#include "core/base/text/record_fields.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** What is compared between two trials of the same draws. */
struct TrialMeasures {
  Outcome outcome = Outcome::kNotRun;
  double gct = kUnset;        ///< [s]; times are missing where a digit touched before closure began
  double gft = kUnset;        ///< [s]
  double gft_ratio = kUnset;  ///< of GCT
  double got_ratio = kUnset;
  double sigma = kUnset;  ///< [N]

  template <class V>
  static void ListFields(V&& field) {
    field("outcome", &TrialMeasures::outcome);
    field("gct_s", &TrialMeasures::gct);
    field("gft_s", &TrialMeasures::gft);
    field("gft_ratio", &TrialMeasures::gft_ratio);
    field("got_ratio", &TrialMeasures::got_ratio);
    field("sigma_n", &TrialMeasures::sigma);
  }
};
TrialMeasures MakeTrialMeasures(const TrialResult& result);

/** The trials of one setting by the id of the session's trial with the same draws. One that is not
run is planned under the setting, or would be: its pair is missing. */
using VariedTrials = std::map<std::string, TrialMeasures>;
using SensitivityData = std::map<std::string, VariedTrials>;  ///< by setting

/** From the session's folder; nothing for a session that stands in no folder.
@throws Error(kFormat) for unequal duplicates, Error(kIo). */
SensitivityData LoadSensitivity(const Session& session);

}  // namespace graspbench
