#include "reports/session_report.h"

#include "core/base/text.h"
#include "reports/layout.h"
#include "reports/sections/section.h"
#include "reports/write_page.h"

namespace graspbench {

std::string MakeSessionReport(const Session& session, const SessionSummary& summary,
                              const SessionModels& models, const CellPictures& pictures,
                              const SensitivitySummary& sensitivity) {
  const ReportData data = {session, summary, models, pictures, sensitivity};
  const std::string subtitle = FormatCount(static_cast<int>(summary.hands.size()), "hand") + ", " +
                               FormatCount(static_cast<int>(summary.objects.size()), "object") +
                               ", " + FormatCount(static_cast<int>(summary.cells.size()), "cell") +
                               ", " + std::to_string(summary.total.finished) + " of " +
                               FormatCount(summary.total.planned, "planned trial") +
                               " finished, seed " + std::to_string(session.config.seed) +
                               DescribeDamage(session.damage);
  return MakeSectionedPage("Grasp benchmark session", subtitle, ListSections(), data);
}

namespace {

std::filesystem::path WriteReport(const std::filesystem::path& folder, const Session& session,
                                  const SessionSummary& summary, const SessionModels& models) {
  const CellPictures pictures = RenderCellPictures(session, summary, models);
  Diagnostics findings;  // whoever ran the sensitivity was told
  const SensitivitySummary sensitivity =
      SummariseSensitivity(session, LoadSensitivity(session, findings));
  return WriteReportPage(folder,
                         MakeSessionReport(session, summary, models, pictures, sensitivity));
}

}  // namespace

std::filesystem::path WriteSessionReport(const std::filesystem::path& folder,
                                         const Session& session) {
  return WriteReport(folder, session, SummariseSession(session), LoadSessionModels(session));
}

std::filesystem::path WriteSessionReport(const std::filesystem::path& folder, Session&& session) {
  const SessionSummary summary = SummariseSession(session);
  const SessionModels models = LoadSessionModels(session);
  std::vector<PlannedTrial>().swap(session.plan);  // nobody asks for it any more
  return WriteReport(folder, session, summary, models);
}

}  // namespace graspbench
