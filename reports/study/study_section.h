#pragma once
/** @file
A section of the study's report. A new one is one file in sections/ that defines `StudySection
<name>_study_section()` and one line in section_list.inc, which fixes the order of the page. */

#include <vector>

#include "reports/page/sectioned_page.h"
#include "reports/study/study_report.h"

namespace graspbench {

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
