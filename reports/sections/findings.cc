#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html DrawFindings(const ReportData& data) {
  const std::vector<std::string> findings = ListFindings(data);
  return findings.empty() ? MakeParagraph("No errors and no warnings.") : MakeList(findings);
}

}  // namespace

Section findings_section() { return {"findings", "Errors and warnings", DrawFindings}; }

}  // namespace graspbench
