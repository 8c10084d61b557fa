#include "human_study/study/run/analyse_study.h"

#include <vector>

#include "core/base/files/files.h"
#include "human_study/statistics/tidy_export.h"
#include "human_study/study/output/motion_bids.h"
#include "human_study/study/output/study_tables.h"
#include "human_study/study/output/wide_table.h"

namespace graspbench {

StudyResult AnalyseStudy(const Study& study, const std::filesystem::path& folder,
                         const std::function<void(size_t, size_t)>& on_row) {
  MotionBidsWriter bids(folder / "bids", study);
  StudyWatch watch;
  watch.on_row = on_row;
  watch.on_trial = [&](const StudyTrial& trial, const ReachTrial& reach) {
    bids.WriteTrial(trial, reach);
  };
  StudyResult result = RunStudy(study, watch);
  bids.Finish();
  WriteStudyTables(result, folder);
  WriteWideTable(result, folder);
  std::vector<MeasureTable> tables;
  for (const TrialMeasure& measure : TrialMeasureList()) {
    tables.push_back(MakeMeasureTable(result, measure));
  }
  std::vector<ScriptHypothesis> hypotheses;
  for (const Hypothesis& h : study.hypotheses) {
    hypotheses.push_back({h.measure, h.slope, h.equal_within});
  }
  SaveTidyExport(tables, folder / "tidy", hypotheses);
  WriteFileAtomically(folder / "tidy" / "openings.csv", FormatOpeningTable(result));
  return result;
}

}  // namespace graspbench
