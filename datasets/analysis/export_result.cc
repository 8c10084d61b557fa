#include "datasets/analysis/export_result.h"

#include "core/base/files/files.h"
#include "datasets/analysis/conditions/basin_summary.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/conditions/threshold_summary.h"

namespace graspbench {

void ExportResult(const std::filesystem::path& folder, const Session& session, bool with_records) {
  const bool is_sweep = !session.config.conditions.empty();
  ExportSession(folder, session, with_records,
                is_sweep ? MakeSweepTables(SummariseSweep(session))
                         : MakeThresholdTables(LoadThresholds(session)));
  if (!IsBasin(session) || folder != session.folder) return;
  WriteFileAtomically(folder / "basin.csv", FormatBasinCsv(ListBasinSamples(session)));
  SealStore(kSessionStore, folder);
}

}  // namespace graspbench
