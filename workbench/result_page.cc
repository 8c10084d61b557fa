#include "workbench/result_page.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/judged_grasps/judged_summary.h"
#include "datasets/session/session_store.h"
#include "reports/campaign/campaign_report.h"
#include "reports/grasps_page.h"
#include "reports/page/write_page.h"
#include "reports/session_report.h"
#include "workbench/terminal/terminal.h"
#include "workbench/trace_session.h"

namespace graspbench {
namespace fs = std::filesystem;

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
  Session session = LoadSession(folder, on_damage, RecordParts::kBrief);
  ReportDamage(session.damage);
  if (!session.findings.entries().empty()) PrintMessage(session.findings.Format());
  const TrialTracer trace = views == PageViews::kWith       ? MakeTrialTracer(session)
                            : views == PageViews::kAsBefore ? MakeKeptTracer(session)
                                                            : TrialTracer();
  return WriteSessionReport(place, std::move(session), trace).lexically_relative(place);
}

}  // namespace graspbench
