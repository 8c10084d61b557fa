#pragma once
/** @file
Chosen trials of a session as moving 3-D views (scene_3d.h): of every cell one trial of each outcome,
the same whose pictures are shown. A record keeps three postures of a trial; its course comes from
whoever can carry it out again. */

#include <functional>
#include <string_view>

#include "datasets/analysis/session_summary.h"
#include "reports/page/html.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/scenes/scene_3d.h"

namespace graspbench {

/** Carries out a trial of the session again. @throws Error when it cannot. */
using TrialTracer = std::function<TracedTrial(const PlannedTrial&)>;

struct SessionViews {
  Html body;  ///< empty: no trial could be shown
  PageScript script;
};

/** True for a page of a session that has such views. */
bool HasSessionViews(std::string_view page);

/** A course that is not what the record says is shown with a sentence that names the first field
that differs. Of very many trials the first that fit into a page; it says how many others there are.
*/
SessionViews DrawSessionViews(const Session& session, const SessionSummary& summary,
                              const SessionModels& models, const TrialTracer& trace);

}  // namespace graspbench
