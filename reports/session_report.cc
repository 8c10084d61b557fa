#include "reports/session_report.h"

#include <algorithm>

#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "datasets/plan/map_design.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"

namespace graspbench {

std::string MakeSessionReport(const ReportData& data) {
  const Session& session = data.session;
  const SessionSummary& summary = data.summary;
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
      {"Clock, machine and run time", "not on this page; see run.json in the session's folder"}};
  frame.references = {"roethling2007", "sherman2011", "wilson1927", "ferrari1992", "efron1987"};
  std::vector<Section> sections = ListSections();
  const auto leave_out = [&](const std::string& anchor) {
    sections.erase(std::remove_if(sections.begin(), sections.end(),
                                  [&](const Section& section) { return section.anchor == anchor; }),
                   sections.end());
  };
  if (session.config.policy.command.empty()) leave_out("controller");
  if (!HasArm(session.config.arm)) leave_out("arm");
  return AddScript(MakeSectionedPage(frame, sections, data), data.views.script);
}

namespace {

std::filesystem::path WriteReport(const std::filesystem::path& folder, const Session& session,
                                  const SessionSummary& summary, const SessionModels& models,
                                  const TrialTracer& trace) {
  const CellPictures pictures = RenderCellPictures(session, summary, models);
  ReportData data = {session, summary, models, pictures};
  data.sensitivity = SummariseSensitivity(session, LoadSensitivity(session));
  data.numerics = SummariseNumerics(LoadNumericsComparisons(session));
  if (trace) data.views = DrawSessionViews(session, summary, models, trace);
  data.thresholds = LoadThresholds(session);
  return WriteReportPage(folder, MakeSessionReport(data));
}

/** A kind of session with a page of its own. */
struct KindPage {
  bool (*is_of)(const Session& session);
  std::string (*make)(const Session& session);
};
/** The first matching entry is used. */
constexpr KindPage kKindPages[] = {
    {[](const Session& session) { return IsMap(session.config); },
     [](const Session& session) { return MakeMapPage(session, LoadMap(session)); }},
    {[](const Session& session) { return !session.config.conditions.empty(); },
     [](const Session& session) {
       return MakeSweepPage(session, SummariseSweep(session, LoadThresholds(session)));
     }},
    {IsBasin, MakeBasinPage},
    {IsTransfer, MakeTransferPage}};

/** Returns the page of a session of a special kind; empty for any other session. */
std::string MakeKindPage(const Session& session) {
  for (const KindPage& kind : kKindPages) {
    if (kind.is_of(session)) return kind.make(session);
  }
  return "";
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
  std::vector<PlannedTrial>().swap(session.plan);  // the plan is no longer needed
  return WriteReport(folder, session, summary, models, trace);
}

}  // namespace graspbench
