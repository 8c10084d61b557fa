#pragma once
/** @file
Whether simultaneity correlates with the outcome, in a session's trials as run. GFT, GOT, GFT% and
GOT% are correlated with the responses of a trial within cells (hand, object, grasp;
core/statistics/ranks.h), so that easy objects are not mistaken for an effect. The trials of a cell
differ in object pose and drive errors, which affect times and responses alike. So a correlation is
not a cause; delay_summary.h imposes delays instead.

Trials in which a digit never touched, or touched before the start of closure, have no measure of
simultaneity and are excluded, as are numerical failures. Cells that repeat the same trials, as
variants of a campaign that kept the previous grasp, count once. */

#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/statistics/ranks.h"
#include "datasets/records/trial_record.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/* Responses of a trial that may depend on simultaneity. SummariseSimultaneity relates them to
measured times, delay_summary.h to imposed delays. */

/** How a quantity is named in JSON and displayed. */
struct ShownQuantity {
  const char* id = "";     ///< "shift_m"
  const char* label = "";  ///< "push before lift-off [mm]"
  double scale = 1.0;      ///< displayed number = scale * value
  int decimals = 0;
};

struct GraspResponse {
  ShownQuantity shown;
  /** NaN where undefined, as for a lost object or a numerical failure. */
  double (*value)(const TrialRecord& record);
};

/** Success, push and turn before lift-off, slip in the hold, in-hand displacement and rotation,
sigma, and breaking force (judged trials). */
const std::vector<GraspResponse>& ListGraspResponses();

struct SimultaneityRelation {
  std::string hand;     ///< id
  std::string measure;  ///< "gft_s", "got_s", "gft_ratio", "got_ratio"
  const GraspResponse* response = nullptr;
  Answer<WithinCorrelation> relation;
  double p_holm = kUnset;  ///< Holm over all relations of the session; NaN: none
};

/** Computes the relations by hand, then measure, then response (ListGraspResponses()). Reloads
records that are brief. Responses that no trial of the hand has, such as a breaking force without
judge, are left out. */
std::vector<SimultaneityRelation> SummariseSimultaneity(const Session& session);

/** Returns the displayed name of a measure: "GFT%" for "gft_ratio". */
std::string NameTimingMeasure(const std::string& measure);

/** Returns the response's label without its unit: "push before lift-off". */
std::string NameResponse(const SimultaneityRelation& row);

/** Returns "-0.50 (-0.70 to -0.25)", or "n/a". */
std::string FormatRho(const SimultaneityRelation& row);

ShownTable ShowRelations(const std::vector<SimultaneityRelation>& relations);

Json MakeRelationsJson(const std::vector<SimultaneityRelation>& relations);

}  // namespace graspbench
