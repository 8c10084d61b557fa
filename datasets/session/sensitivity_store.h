#pragma once
/** @file
Trials of a session again under one changed setting each, on the same draws, in its folder beside
the trials:

    sensitivity/<n>.jsonl    append-only, one file per worker; a line = setting, id of the session's
                             trial, measures, checksum; synced

Done = a valid line with setting and id. Equal duplicates are fine, unequal ones are an error. A
merge of sessions does not bring these lines; they are soon made again. */

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

/** A setting as "sim.step_s=0.001" with its value as in JSON, so that one setting has one name.
@throws Error(kUsage) for an unknown key, a value of another type, a setting that changes which
trials there are; Error(kRange) for a value out of range. */
std::string NormaliseSetting(const std::string& assignment, const SessionConfig& config);

/** The trials of one setting by the id of the session's trial with the same draws. */
using VariedTrials = std::map<std::string, TrialMeasures>;
using SensitivityData = std::map<std::string, VariedTrials>;  ///< by setting

/** What is stored in the session's folder; damaged lines become `findings`. Nothing for a session
that stands in no folder. @throws Error(kFormat) for unequal duplicates, Error(kIo). */
SensitivityData LoadSensitivity(const Session& session, Diagnostics& findings);

/** Appends to one worker's file; each Append is on the disk when it returns. */
class SensitivityWriter {
 public:
  /** @throws Error(kIo) as JournalWriter. */
  SensitivityWriter(const std::filesystem::path& folder, int worker);
  void Append(const std::string& setting, const std::string& trial_id,
              const TrialMeasures& measures);

 private:
  AppendFile file_;
};

}  // namespace graspbench
