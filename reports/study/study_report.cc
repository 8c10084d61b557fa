#include "reports/study/study_report.h"

#include <algorithm>

#include "core/base/files.h"
#include "core/base/text.h"
#include "reports/study/study_section.h"

namespace graspbench {

std::vector<StudySection> ListStudySections() {
  return {
#define GRASPBENCH_STUDY_SECTION(name) name##_study_section(),
#include "reports/study/sections/section_list.inc"
#undef GRASPBENCH_STUDY_SECTION
  };
}

std::string MakeStudyReport(const StudyResult& result, const RobotSession* robot) {
  std::vector<std::string> people;
  for (const StudyTrial& trial : result.trials) {
    if (std::find(people.begin(), people.end(), trial.participant) == people.end()) {
      people.push_back(trial.participant);
    }
  }
  const std::string subtitle =
      "Human reach to grasp: " + FormatCount(static_cast<int>(people.size()), "participant") +
      ", " + std::to_string(result.CountKept()) + " of " +
      FormatCount(static_cast<int>(result.trials.size()), "trial") + " kept, " +
      FormatCount(static_cast<int>(result.digits.size()), "digit");
  return MakeSectionedPage(result.study.config.name, subtitle, ListStudySections(),
                           StudyPageData{result, robot});
}

std::filesystem::path WriteStudyReport(const std::filesystem::path& folder,
                                       const StudyResult& result, const RobotSession* robot) {
  const std::filesystem::path path = folder / "report" / "index.html";
  MakeFolder(path.parent_path());
  WriteFileAtomically(path, MakeStudyReport(result, robot));
  return path;
}

}  // namespace graspbench
