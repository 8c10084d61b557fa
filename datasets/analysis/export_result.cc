#include "datasets/analysis/export_result.h"

#include "core/base/files/files.h"
#include "datasets/analysis/conditions/basin_summary.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/map/map_result.h"
#include "datasets/plan/map_design.h"

namespace graspbench {

void ExportResult(const std::filesystem::path& folder, const Session& session, bool with_records) {
  const bool is_sweep = !session.config.conditions.empty();
  const std::vector<ThresholdSummary> thresholds = LoadThresholds(session);
  std::vector<ExportTable> tables = MakeThresholdTables(thresholds);
  if (IsMap(session.config)) {
    for (ExportTable& table : MakeMapTables(LoadMap(session))) tables.push_back(std::move(table));
  } else if (is_sweep) {
    for (ExportTable& table : MakeSweepTables(SummariseSweep(session, thresholds))) {
      tables.push_back(std::move(table));
    }
  }
  ExportSession(folder, session, with_records, tables);
  if (!IsBasin(session) || folder != session.folder) return;
  WriteFileAtomically(folder / "basin.csv", FormatBasinCsv(ListBasinSamples(session)));
  SealStore(kSessionStore, folder);
}

}  // namespace graspbench
