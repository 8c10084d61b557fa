#pragma once
/** @file
Pages of sessions that are more than their trials: a map of simultaneity, a sweep, a basin. Each is
self-contained like the session's report. A new one is a file here, a line in this header and a row
of kKindPages (session_report.cc). */

#include <string>
#include <vector>

#include "datasets/analysis/conditions/basin_summary.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/map/map_result.h"

namespace graspbench {

/** What it finds of each hand, a map for each measure, the regions with the trials behind them, and
what goes with success without delays. */
std::string MakeMapPage(const Session& session, const MapResult& result);

/** Its conditions, a map for two factors (one for each level of a third), what each level changes
and which levels do not simply add up. */
std::string MakeSweepPage(const Session& session, const SweepSummary& summary);

struct BasinPageData {
  std::string title;    ///< names hand, object and grasp
  std::string command;  ///< that gives the same samples
  std::vector<BasinSample> samples;
  /** Grip thresholds as margins, one a sample, infinite: no grip held; empty: not looked for. */
  std::vector<double> thresholds = {};
};

/** The robustness basin of one grasp: a map of offsets in slices of yaw, and its radius. */
std::string MakeBasinPage(const BasinPageData& data);
/** That of a session. @pre IsBasin(session). */
std::string MakeBasinPage(const Session& session);

}  // namespace graspbench
