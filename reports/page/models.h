#pragma once
/** @file
The hands and objects of a session, as far as they can still be loaded, for names and pictures. */

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "core/trial/measures/diagnosis_text.h"
#include "core/trial/measures/object_in_hand.h"
#include "core/trial/outcome.h"
#include "core/trial/trial_result.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/plan/rehearsed_types.h"

namespace graspbench {

struct SessionModels {
  std::map<std::string, std::shared_ptr<const Hand>> hands;
  std::map<std::string, std::shared_ptr<const GraspObject>> objects;
  RehearsedTypes types;               ///< of "best" grasps
  std::vector<std::string> problems;  ///< problems to report to the reader

  /** Display name; the id when the model is missing. */
  std::string NameOfHand(const std::string& id) const;
  std::string NameOfObject(const std::string& id) const;
  /** "thumb"; the digit's id when the hand is missing. */
  std::string NameOfDigit(const std::string& hand, const std::string& digit) const;
  /** Null when missing. */
  std::shared_ptr<const Hand> FindHand(const std::string& id) const;
  std::shared_ptr<const GraspObject> FindObject(const std::string& id) const;
};

/** Loads the session's hands and objects. A model that is missing or has changed is a problem, not
an error: the results are valid without it. */
SessionModels LoadSessionModels(const SessionConfig& config, const std::filesystem::path& folder,
                                const std::vector<PlannedTrial>& plan = {});
inline SessionModels LoadSessionModels(const Session& session) {
  return LoadSessionModels(session.config, session.folder, session.plan);
}

/** "power (g3)"; the id alone for other than standard grasps. */
std::string NameOfGrasp(const std::string& id);

/** "TUM Hand, can, power (g3)". */
std::string NameOfCell(const CellSummary& cell, const SessionModels& models);

/** Name of an outcome in a page: that of records and export/, completed where it can be misread. In
a trial with "no contact", other digits may have touched. */
inline std::string WordsOf(Outcome outcome) {
  return NameOf(outcome) + std::string(outcome == Outcome::kNoContact ? " of a digit" : "");
}

/** Explains the end of a trial in the words of its record; empty for a success. */
inline std::string ExplainEnd(const TrialResult& result) {
  if (!result.diagnosis) return result.reason;
  return (result.reason.empty() ? "" : result.reason + ". ") + DescribeDiagnosis(result);
}

inline std::string WordsOf(Seat seat) {
  return seat == Seat::kUnknown ? "not recorded" : NameOf(seat);
}

}  // namespace graspbench
