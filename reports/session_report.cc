#include "reports/session_report.h"

#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "datasets/analysis/conditions/basin_summary.h"
#include "datasets/plan/map_design.h"
#include "reports/basin_page.h"
#include "reports/map_page.h"
#include "reports/page/layout.h"
#include "reports/page/write_page.h"
#include "reports/sections/section.h"
#include "reports/sweep_page.h"

namespace graspbench {

std::string MakeSessionReport(const Session& session, const SessionSummary& summary,
                              const SessionModels& models, const CellPictures& pictures,
                              const SensitivitySummary& sensitivity,
                              const std::vector<NumericsSummary>& numerics,
                              const std::vector<ThresholdSummary>& thresholds,
                              const SessionViews& views) {
  const ReportData data = {session,     summary,  models,     pictures,
                           sensitivity, numerics, thresholds, views.body};
  const std::string subtitle =
      FormatCount(static_cast<int>(summary.hands.size()), "hand") + ", " +
      FormatCount(static_cast<int>(summary.objects.size()), "object") + ", " +
      FormatCount(static_cast<int>(summary.cells.size()), "condition") + ", " +
      std::to_string(summary.total.finished) + " of " +
      FormatCount(summary.total.planned, "planned trial") + " finished, seed " +
      std::to_string(session.config.seed) + DescribeDamage(session.damage) +
      DescribePhysics(session.physics_version);
  PageFrame frame = {"Grasp benchmark session", subtitle};
  frame.commands = {"graspbench run DIR/session.json --out ANOTHER", "graspbench report DIR"};
  frame.facts = {
      {"Seed", std::to_string(session.config.seed)},
      {"Trials", std::to_string(summary.total.finished) + " of " +
                     std::to_string(summary.total.planned) + " planned"},
      {"Hash of the configuration", CalcHashHex(FormatJson(ToJson(session.config)))},
      {"Clock, machine and run time", "not in this page; run.json in the session's folder"}};
  frame.references = {"roethling2007", "sherman2011", "wilson1927", "ferrari1992", "efron1987"};
  return AddScript(MakeSectionedPage(frame, ListSections(), data), views.script);
}

namespace {

std::filesystem::path WriteReport(const std::filesystem::path& folder, const Session& session,
                                  const SessionSummary& summary, const SessionModels& models,
                                  const TrialTracer& trace) {
  const CellPictures pictures = RenderCellPictures(session, summary, models);
  const SensitivitySummary sensitivity = SummariseSensitivity(session, LoadSensitivity(session));
  const std::vector<NumericsSummary> numerics = SummariseNumerics(LoadNumericsComparisons(session));
  const SessionViews views =
      trace ? DrawSessionViews(session, summary, models, trace) : SessionViews();
  return WriteReportPage(folder, MakeSessionReport(session, summary, models, pictures, sensitivity,
                                                   numerics, LoadThresholds(session), views));
}

/** The page of a session that is more than its trials; empty: it is not. */
std::string MakeKindPage(const Session& session) {
  if (IsMap(session.config)) return MakeMapPage(session, LoadMap(session));
  if (!session.config.conditions.empty())
    return MakeSweepPage(session, SummariseSweep(session, LoadThresholds(session)));
  if (!IsBasin(session)) return "";
  const SessionModels models = LoadSessionModels(session);
  const PlannedTrial& planned = session.plan.front();
  std::vector<double> thresholds;
  for (const ThresholdSummary& summary : LoadThresholds(session)) {
    if (summary.scale->mode == GripMode::kMargin) {
      thresholds = ListThresholdsOf(session, summary);
    }
  }
  return MakeBasinPage({models.NameOfHand(planned.hand) + ", " +
                            models.NameOfObject(planned.object) + ", " + planned.grasp,
                        "graspbench run DIR/session.json --out ANOTHER", ListBasinSamples(session),
                        thresholds});
}

}  // namespace

std::filesystem::path WriteSessionReport(const std::filesystem::path& folder,
                                         const Session& session, const TrialTracer& trace) {
  const std::string page = MakeKindPage(session);
  if (!page.empty()) return WriteReportPage(folder, page);
  return WriteReport(folder, session, SummariseSession(session), LoadSessionModels(session), trace);
}

std::filesystem::path WriteSessionReport(const std::filesystem::path& folder, Session&& session,
                                         const TrialTracer& trace) {
  const std::string page = MakeKindPage(session);
  if (!page.empty()) return WriteReportPage(folder, page);
  const SessionSummary summary = SummariseSession(session);
  const SessionModels models = LoadSessionModels(session);
  std::vector<PlannedTrial>().swap(session.plan);  // nobody asks for it any more
  return WriteReport(folder, session, summary, models, trace);
}

}  // namespace graspbench
