#pragma once
/** @file
Formatting of a study's numbers: times in milliseconds, lengths in millimetres, ratios in per cent.
Headings state the unit; cells hold only the number. */

#include <string>
#include <vector>

#include "human_study/events/trial_analysis.h"
#include "human_study/study/inference/study_statistics.h"
#include "reports/page/layout.h"
#include "reports/study/study_report.h"

namespace graspbench {

/** Display unit of an SI value, its conversion factor and its number of decimals. */
struct DisplayUnit {
  const char* name = "";  ///< "ms"; empty: a number without unit
  double factor = 1.0;
  int decimals = 2;
};

DisplayUnit FindDisplayUnit(const std::string& si_unit);

/** "grasp forming time (GFT) [ms]". */
std::string FormatHead(const TrialMeasure& measure);
/** The number without unit, in the measure's display unit; "n/a" when it is missing. */
std::string FormatValue(double value, const std::string& si_unit);
/** The number with its unit: "31.2 ms". */
std::string FormatWithUnit(double value, const std::string& si_unit);

/** "0.034", "< 0.001". */
std::string FormatP(double p);
/** "virtual_finger" = "virtual finger". */
std::string MakeWords(std::string id);
/** "diameter" of "diameter_m": a known unit suffix is moved to the levels. */
std::string NameOfFactor(const std::string& factor);
/** "diameter 30 mm, side left" of "0.03, left"; "all trials" for a study without factors. */
std::string NameOfCell(const std::string& cell, const std::vector<Factor>& factors);
/** " by diameter, side" for captions; empty for a study without factors. */
std::string DescribeFactors(const std::vector<Factor>& factors);
/** "s per m of diameter" of "s per diameter_m": slopes stay in SI, as in statistics.csv. */
std::string FormatSlopeUnit(const std::string& unit);
/** Display name of an effect in statistics.csv: factors, and the conditions of a pair. */
std::string NameOfEffect(const std::string& effect, const std::vector<Factor>& factors);

/* A section of the study's report. A new one is one file in sections/ that defines `StudySection
<name>_study_section()` and one line in section_list.inc, which fixes the order of the page. */
struct StudyPageData {
  const StudyResult& result;
  const RobotSession* robot;  ///< null: none
};

using StudySection = PageSection<StudyPageData>;

/** In the order of the page. */
std::vector<StudySection> ListStudySections();

#define GRASPBENCH_STUDY_SECTION(name) StudySection name##_study_section();
#include "reports/study/sections/section_list.inc"
#undef GRASPBENCH_STUDY_SECTION

}  // namespace graspbench
