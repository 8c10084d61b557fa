#pragma once
/** @file
Does simultaneity matter? Of a session's trials as they came: how GFT, GOT, GFT% and GOT% go with
what became of the trial, within conditions (hand, object, grasp)
(core/statistics/within_groups.h), so that easy objects do not pass for an effect. The trials of a
cell differ in where the object stood and in the drives' errors, which move both sides: a relation
is no cause. `delay_summary.h` imposes one.

Trials in which a digit never touched, or touched before the start of closure, have no measure of
simultaneity and take no part; a numerical failure takes none either. Cells that hold the same trials
again, a campaign's variants that kept the grasp before, count once. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/statistics/within_groups.h"
#include "datasets/analysis/campaign/grasp_responses.h"
#include "datasets/session/session_store.h"

namespace graspbench {

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

Json ToJson(const SimultaneityRelation& relation);

}  // namespace graspbench
