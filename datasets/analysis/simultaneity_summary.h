#pragma once
/** @file
Does simultaneity matter? Of a session's trials as they came: how GFT, GOT, GFT% and GOT% go with
what became of the trial, within conditions (hand, object, grasp) (core/statistics/ranks.h), so that
easy objects do not pass for an effect. The trials of a cell differ in where the object stood and in
the drives' errors, which move both sides: a relation is no cause. `delay_summary.h` imposes one.

Trials in which a digit never touched, or touched before the start of closure, have no measure of
simultaneity and take no part; a numerical failure takes none either. Cells that hold the same
trials again, a campaign's variants that kept the grasp before, count once. */

#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/statistics/ranks.h"
#include "datasets/records/trial_record.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/* What a lack of simultaneity might change of a trial: the list that SummariseSimultaneity relates
to the measured times and `delay_summary.h` to delays that were imposed. One more: a row. */

/** A number as JSON names it and as people read it. */
struct ShownQuantity {
  const char* id = "";     ///< "shift_m"
  const char* label = "";  ///< "push before lift-off [mm]", which is
  double scale = 1.0;      ///< times the value, with
  int decimals = 0;
};

struct GraspResponse {
  ShownQuantity shown;
  /** NaN where it is not defined: of a lost object, of a numerical failure. */
  double (*value)(const TrialRecord& record);
};

/** success, push and turn before lift-off, slip in the hold, way and turn in the hand, sigma,
breaking force (judged trials). */
const std::vector<GraspResponse>& ListGraspResponses();

struct SimultaneityRelation {
  std::string hand;     ///< id
  std::string measure;  ///< "gft_s", "got_s", "gft_ratio", "got_ratio"
  const GraspResponse* response = nullptr;
  Answer<WithinCorrelation> relation;
  double p_holm = kUnset;  ///< over all relations of the session; NaN: there is none
};

/** Reads brief records again. Hand by hand, measure by measure, in the order of
ListGraspResponses(). Responses that no trial of the hand has, such as a breaking force without
judge, are left out. */
std::vector<SimultaneityRelation> SummariseSimultaneity(const Session& session);

/** "gft_ratio" as it is shown: "GFT%". */
std::string NameTimingMeasure(const std::string& measure);

/** "push before lift-off" of "push before lift-off [mm]". */
std::string NameResponse(const SimultaneityRelation& row);

/** "-0.50 (-0.70 to -0.25)"; "n/a". */
std::string FormatRho(const SimultaneityRelation& row);

ShownTable ShowRelations(const std::vector<SimultaneityRelation>& relations);

Json MakeRelationsJson(const std::vector<SimultaneityRelation>& relations);

}  // namespace graspbench
