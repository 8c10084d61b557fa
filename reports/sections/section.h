#pragma once
/** @file
A section of the report. A new one is one file here that defines `Section <name>_section()` and one
line in section_list.inc, which fixes the order of the page. */

#include <string>
#include <vector>

#include "datasets/analysis/conditions/numerics_summary.h"
#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/session_summary.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/scenes/cell_pictures.h"
#include "reports/session_views.h"

namespace graspbench {

struct ReportData {
  const Session& session;
  const SessionSummary& summary;
  const SessionModels& models;
  const CellPictures& pictures;
  SensitivitySummary sensitivity = {};            ///< of this session; without changes: not run
  std::vector<NumericsSummary> numerics = {};     ///< empty: not checked
  std::vector<ThresholdSummary> thresholds = {};  ///< empty: not determined
  SessionViews views = {};                        ///< without body: not requested
};

/** A section must accept a session without a plan or without records. */
using Section = PageSection<ReportData>;

/** In the order of the page. */
std::vector<Section> ListSections();

#define GRASPBENCH_SECTION(name) Section name##_section();
#include "reports/sections/section_list.inc"
#undef GRASPBENCH_SECTION

// Limitations of the results, as sentences.
/** Lists errors first: missing trials, damaged journal lines of an unfinished session, numerical
failures, contacts before the start of closure, missing models and pictures. Empty for a flawless
session. */
std::vector<std::string> ListFindings(const ReportData& data);

}  // namespace graspbench
