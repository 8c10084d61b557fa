#include "reports/study/study_report.h"

#include <algorithm>
#include <set>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "reports/study/study_format.h"

namespace graspbench {

std::vector<StudySection> ListStudySections() {
  return {
#define GRASPBENCH_STUDY_SECTION(name) name##_study_section(),
#include "reports/study/sections/section_list.inc"
#undef GRASPBENCH_STUDY_SECTION
  };
}

/** Lists the sections; without an included trial, only those that say why. */
static std::vector<StudySection> ListSectionsOf(const StudyResult& result) {
  std::vector<StudySection> sections = ListStudySections();
  if (result.CountKept() > 0) return sections;
  const std::set<std::string> told = {"summary", "removed", "trials", "findings", "methods"};
  sections.erase(std::remove_if(sections.begin(), sections.end(),
                                [&](const auto& s) { return told.count(s.anchor) == 0; }),
                 sections.end());
  return sections;
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
  PageFrame frame = {result.study.config.name, subtitle};
  frame.commands = {"graspbench study run STUDY.YAML --out DIR"};
  frame.facts = {
      {"Recordings",
       std::to_string(result.trials.size()) + " trials, listed in the study's trials.csv"},
      {"Hash of the settings", CalcHashHex(FormatJson(ConfigToJson(result.study.config)))}};
  frame.references = {"roethling2007", "greenhouse1959", "holm1979", "efron1987"};
  return MakeSectionedPage(frame, ListSectionsOf(result), StudyPageData{result, robot});
}

std::filesystem::path WriteStudyReport(const std::filesystem::path& folder,
                                       const StudyResult& result, const RobotSession* robot) {
  const std::filesystem::path path = folder / "report" / "index.html";
  MakeFolder(path.parent_path());
  WriteFileAtomically(path, MakeStudyReport(result, robot));
  return path;
}

}  // namespace graspbench
