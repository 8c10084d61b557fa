#include "reports/sections/section.h"

#include "core/base/text/text.h"

namespace graspbench {

namespace {

void AddMissingTrials(const ReportData& data, std::vector<std::string>& findings) {
  for (const CellSummary& cell : data.summary.cells) {
    const int missing = cell.tally.planned - cell.tally.finished;
    if (missing == 0) continue;
    findings.push_back(NameOfCell(cell, data.models) + ": " + std::to_string(missing) + " of " +
                       FormatCount(cell.tally.planned, "planned trial") + " missing.");
  }
}

/** Adds findings about skipped lines, but only for an unfinished session. A skipped line whose
trial was rerun has no effect, and the report of a finished session must not depend on how often it
was interrupted. The commands report such lines on the terminal. */
void AddJournalFindings(const ReportData& data, std::vector<std::string>& findings) {
  if (data.summary.total.finished == data.summary.total.planned) return;
  for (const Diagnostic& entry : data.session.findings.entries()) {
    std::string place = entry.file;
    if (entry.line > 0) place += ", line " + std::to_string(entry.line);
    const char* severity = entry.severity == Severity::kError ? "Error" : "Warning";
    findings.push_back(std::string(severity) + " in " + place + ": " + entry.text);
  }
}

void AddNonsense(const ReportData& data, std::vector<std::string>& findings) {
  constexpr size_t kMaxNamed = 50;
  const auto num_all = static_cast<size_t>(data.summary.total.CountOf(Outcome::kNotPhysical));
  for (const CellSummary& cell : data.summary.cells) {
    for (const TrialRecord* record : cell.records) {
      if (record->result.outcome != Outcome::kNotPhysical) continue;
      if (findings.size() == kMaxNamed) {
        findings.push_back(
            "Not physical and therefore not a success: " + std::to_string(num_all - kMaxNamed) +
            " more trials; export/trials.csv names them.");
        return;
      }
      findings.push_back(
          "Not physical and therefore not a success: " + NameOfCell(cell, data.models) +
          ", trial " + std::to_string(record->plan.trial) + ": " + record->result.reason +
          "; the condition's pictures show such a trial.");
    }
  }
}

void AddTrialFindings(const ReportData& data, std::vector<std::string>& findings) {
  const int failures = data.summary.total.CountOf(Outcome::kNumericalFailure);
  if (failures > 0) {
    findings.push_back(
        FormatCount(failures, "trial") +
        " failed numerically; numerical failures count as failures of the grasp and are listed "
        "under numerical health.");
  }
  for (const CellSummary& cell : data.summary.cells) {
    if (cell.num_early == 0) continue;
    findings.push_back(
        NameOfCell(cell, data.models) + ": in " + FormatCount(cell.num_early, "trial") +
        " a digit touched before the start of closure; excluded from the timing statistics.");
  }
}

}  // namespace

std::vector<std::string> ListFindings(const ReportData& data) {
  std::vector<std::string> findings;
  AddNonsense(data, findings);
  AddMissingTrials(data, findings);
  AddJournalFindings(data, findings);
  AddTrialFindings(data, findings);
  for (const std::string& difference : data.session.machine_differences) {
    findings.push_back("Machines: " + difference);
  }
  for (const std::string& problem : data.models.problems) findings.push_back("Models: " + problem);
  for (const std::string& problem : data.pictures.problems) {
    findings.push_back("Pictures: " + problem);
  }
  return findings;
}

std::vector<Section> ListSections() {
  return {
#define GRASPBENCH_SECTION(name) name##_section(),
#include "reports/sections/section_list.inc"
#undef GRASPBENCH_SECTION
  };
}

}  // namespace graspbench
