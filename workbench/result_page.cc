#include "workbench/result_page.h"

#include <algorithm>
#include <ctime>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/trial/trial_runner.h"
#include "datasets/analysis/conditions/basin_summary.h"
#include "datasets/analysis/export_result.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/judged_grasps/grasp_store.h"
#include "datasets/plan/map_design.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/session/explanation_store.h"
#include "datasets/session/find_trial.h"
#include "datasets/session/session_store.h"
#include "objects/catalogue.h"
#include "reports/campaign/campaign_report.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "reports/session_report.h"
#include "workbench/experiments/run_session.h"
#include "workbench/terminal/terminal.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

constexpr double kInstantInterval = 0.01;  // finer than the keys of a view [s]
constexpr int kRunsOfShort = 45;           // trials of a short explanation, roughly

/** Whether its page has a section of failures, and is final. */
bool HasFailuresToExplain(const Session& session) {
  return session.damage.empty() && session.config.conditions.empty() && !IsMap(session.config) &&
         !IsBasin(session) && session.physics_version == kPhysicsVersion &&
         FindUnfinished(session).empty() &&
         !FindUnexplained(session, ExplainScope::kShortly).empty();
}

/** Processor time [s], by that of the first failure of each hand, which runs again. */
double EstimateExplainTime(const PreparedSession& finished) {
  const Session& session = finished.session;
  std::map<std::string, double> times;
  double sum = 0.0;
  for (const PlannedTrial& planned : FindUnexplained(session, ExplainScope::kShortly)) {
    const auto [time, is_new] = times.emplace(planned.hand, 0.0);
    if (is_new) {
      TrialSetup setup = MakeTrialSetup(session.config, finished.inputs, planned);
      TrialBench bench;
      TrialRunner& runner = bench.Prepare(setup);
      const std::clock_t start = std::clock();  // not of the wall: the processor may be shared
      runner.Run(setup);
      time->second = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }
    sum += kRunsOfShort * time->second;
  }
  return sum;
}

}  // namespace

void ExplainUnasked(const fs::path& folder, int num_workers, OnDamage on_damage) {
  int64_t num_failures = 0;
  {  // two large sessions in memory would not fit
    const Session session = LoadSession(folder, on_damage, RecordParts::kBrief);
    if (!HasFailuresToExplain(session)) return;
    num_failures =
        std::count_if(session.records.begin(), session.records.end(),
                      [](const TrialRecord& record) { return !IsSuccess(record.result.outcome); });
  }
  try {
    const PreparedSession finished = LoadFinished(folder, on_damage);
    const double time = EstimateExplainTime(finished);
    TerminalObserver observer([&](const Stage& stage) {
      return folder.string() + ": explaining " + FormatCountOf(stage.num_left, num_failures) +
             (num_failures == 1 ? " failure" : " failures") +
             " for the report (one per condition), about " + FormatFixed(time, 0) +
             " s of one processor; stored";
    });
    const RunRecord record = RunRound(kExplainShortlyRound, finished, num_workers, observer);
    if (record.ending != RunEnding::kFinished) {
      PrintMessage("stopped; the report shows the failures explained so far");
    }
  } catch (const Error& fault) {
    PrintMessage("the report explains no further failures: " + std::string(fault.what()));
  }
}

TrialTracer MakeTrialTracer(const Session& session) {
  using Pair = std::pair<std::string, std::string>;
  struct Bench {
    std::shared_ptr<const GraspObject> object;
    std::unique_ptr<TrialRunner> runner;
  };
  const auto inputs = std::make_shared<const SessionInputs>(
      LoadSessionInputs(session.config, FieldUse::kLater, session.folder));
  const auto benches = std::make_shared<std::map<Pair, Bench>>();
  // Of a large session brief records, which take 1 kB each.
  const auto recorded = std::make_shared<const Session>(session);
  return [recorded, inputs, benches](const PlannedTrial& planned) {
    TrialSetup setup = MakeRecordedSetup(*recorded, *inputs, planned);
    Bench& bench = (*benches)[{planned.hand, planned.object}];
    if (!bench.runner) {
      bench.object = CompleteObject(setup.object);
      bench.runner = std::make_unique<TrialRunner>(setup.hand, bench.object);
    }
    setup.object = bench.object;
    return TraceTrial(*bench.runner, setup, kInstantInterval);
  };
}

TrialTracer MakeKeptTracer(const Session& session) {
  const std::filesystem::path page = session.folder / "report" / "index.html";
  if (!std::filesystem::exists(page) || !HasSessionViews(ReadFile(page))) return {};
  try {
    return MakeTrialTracer(session);
  } catch (const Error& fault) {
    PrintMessage("the page loses its 3-D views: " + std::string(fault.what()));
    return {};
  }
}

namespace {

void ReportDamage(const std::vector<Damage>& damage) {
  if (!damage.empty()) PrintMessage("damage accepted" + FormatDamage(damage));
}

/** As its manifest names it; basins were once written without a folder for it. */
std::optional<fs::path> FindPage(const Manifest& manifest) {
  for (const char* name : {"report/index.html", "index.html"}) {
    const bool is_listed =
        std::any_of(manifest.files.begin(), manifest.files.end(),
                    [name](const ManifestFile& file) { return file.path == name; });
    if (is_listed) return name;
  }
  return std::nullopt;
}

/** What stands in the place of a result with a page. */
std::string DescribeOther(const fs::path& folder) {
  std::error_code status;
  if (!fs::exists(folder, status)) return "is not there";
  const std::optional<Manifest> manifest = FindManifest(folder);
  const StoreKind* kind = FindStoreKind(folder);
  if (kind == nullptr && !manifest) return "holds no result of graspbench";
  return "holds the result of kind " + (kind ? std::string(kind->name) : manifest->kind) +
         ", which has no page";
}

fs::path TakeWholePage(const fs::path& folder, const fs::path& place, OnDamage on_damage) {
  const std::optional<Manifest> manifest = FindManifest(folder);
  const std::optional<fs::path> page = manifest ? FindPage(*manifest) : std::nullopt;
  if (!page) {
    throw Error(ErrorKind::kNotFound, "\"" + folder.string() + "\" " + DescribeOther(folder) +
                                          "; expected the folder of a session (graspbench run), a "
                                          "campaign, a study or a basin");
  }
  ReportDamage(VerifyStore(folder, on_damage).damages);
  if (place == folder) return *page;
  MakeFolder((place / *page).parent_path());
  WriteFileAtomically(place / *page, ReadFile(folder / *page));
  return *page;
}

}  // namespace

fs::path WriteResultPage(const fs::path& folder, const fs::path& place, OnDamage on_damage,
                         PageViews views) {
  const auto refuse_views = [views](const char* kind) {
    if (views != PageViews::kWith) return;
    throw Error(ErrorKind::kUsage, std::string("--3d is for sessions; this is ") + kind);
  };
  if (HasCampaign(folder)) {
    refuse_views("a campaign");
    const Campaign campaign = LoadCampaign(folder, on_damage);
    ReportDamage(campaign.damage);
    return WriteCampaignReport(place, campaign).lexically_relative(place);
  }
  if (HasJudgedGrasps(folder)) {
    refuse_views("no session");
    ReportDamage(VerifyStore(folder, on_damage).damages);
    const Json config = LoadGraspConfig(folder);
    const std::vector<JudgedGrasp> judged = LoadJudgedGrasps(folder);
    return WriteReportPage(
               place, MakeGraspsPage(config, judged, SummariseJudged(judged, FindLimits(config))))
        .lexically_relative(place);
  }
  const std::optional<Manifest> manifest = FindManifest(folder);
  if (!HasSession(folder) && !(manifest && manifest->kind == kSessionStore.name)) {
    refuse_views("no session");
    return TakeWholePage(folder, place, on_damage);
  }
  if (place == folder) ExplainUnasked(folder, CountProcessors(), on_damage);
  Session session = LoadSession(folder, on_damage, RecordParts::kBrief);
  ReportDamage(session.damage);
  if (!session.findings.entries().empty()) PrintMessage(session.findings.Format());
  const TrialTracer trace = views == PageViews::kWith       ? MakeTrialTracer(session)
                            : views == PageViews::kAsBefore ? MakeKeptTracer(session)
                                                            : TrialTracer();
  return WriteSessionReport(place, std::move(session), trace).lexically_relative(place);
}

fs::path WriteResults(const Session& session, const TrialTracer& trace) {
  ExportResult(session.folder, session);
  return WriteSessionReport(session.folder, session, trace);
}

std::string FormatPlaces(const fs::path& page, const fs::path& table) {
  return "\nreport   " + page.string() +
         (table.empty() ? "\n" : "\ndata     " + table.string() + "\n");
}

}  // namespace graspbench
