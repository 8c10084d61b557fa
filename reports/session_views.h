#pragma once
/** @file
Selected trials of a session as animated 3-D views (scene_3d.h): for every condition one trial per
outcome, the same as in the pictures. A record keeps only three postures of a trial, so the motion
comes from a re-simulation by the caller. */

#include <functional>
#include <string_view>

#include "datasets/analysis/session_summary.h"
#include "reports/page/html.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/scenes/scene_3d.h"

namespace graspbench {

/** Simulates a trial of the session again. @throws Error when that fails. */
using TrialTracer = std::function<TracedTrial(const PlannedTrial&)>;

struct SessionViews {
  Html body;  ///< empty: no trial could be shown
  PageScript script;
};

/** Whether a session's page has such views. */
bool HasSessionViews(std::string_view page);

/** Draws the views. If a re-simulation differs from its record, the view names the first field that
differs. Of very many trials, the first that fit into a page are shown, and the number of others is
stated. */
SessionViews DrawSessionViews(const Session& session, const SessionSummary& summary,
                              const SessionModels& models, const TrialTracer& trace);

}  // namespace graspbench
