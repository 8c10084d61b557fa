#include "core/base/text/text.h"
#include "human_study/study/run/trial_removal.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

std::vector<std::string> ListFindings(const StudyResult& result) {
  std::vector<std::string> findings;
  for (const Diagnostic& entry : result.study.warnings.entries()) {
    findings.push_back("Settings: " + entry.text);
  }
  for (const StudyWarning& warning : result.warnings) findings.push_back(warning.text + ".");
  for (const std::string& deviation : ListDeviations(result.study)) {
    findings.push_back("Not as frozen: " + deviation + ".");
  }
  for (const RemovalGroup& group : GroupRemoved(result.trials)) {
    findings.push_back(FormatCount(static_cast<int>(group.trials.size()), "trial") +
                       " removed: " + group.text + ".");
  }
  if (!result.findings.empty()) {
    findings.push_back(FormatCount(static_cast<int>(result.findings.size()), "assumption") +
                       " needed to read the files; they are listed below the removed trials.");
  }
  const UnverifiedTouches touches = CountUnverified(result);
  if (touches.num_contacts > 0) {
    findings.push_back(FormatCount(touches.num_contacts, "contact") + " in " +
                       FormatCount(touches.num_trials, "trial") +
                       " cannot be distinguished from a digit that stops off the object.");
  }
  return findings;
}

Html DrawFindings(const StudyPageData& data) {
  const std::vector<std::string> findings = ListFindings(data.result);
  return findings.empty() ? MakeParagraph("No errors and no warnings.") : MakeList(findings);
}

}  // namespace

StudySection findings_study_section() { return {"findings", "Errors and warnings", DrawFindings}; }

}  // namespace graspbench
