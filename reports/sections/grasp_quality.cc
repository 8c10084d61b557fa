#include <algorithm>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/trial/judge/judge.h"
#include "datasets/analysis/judge_evidence.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/plots/line_plot.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

IntervalPlot::Row MakeRow(const std::string& label, const Answer<BootstrapInterval>& answer) {
  if (!answer) return {label, kUnset, kUnset, kUnset, answer.reason()};
  const auto& [low, high] = answer->interval;
  return {label, answer->estimate, low, high, FormatWithRange(answer->estimate, low, high, 2)};
}

Html DrawRanks(const JudgeEvidence& evidence) {
  IntervalPlot plot;
  plot.text.title = "Rank correlation of quality measures with breaking force";
  plot.text.description = "Rank correlations with 95 % intervals, one row per measure.";
  plot.axis = "Spearman's rank correlation with the smallest breaking force";
  for (const RankEvidence& rank : evidence.ranks) {
    plot.rows.push_back(MakeRow(rank.measure, rank.correlation));
  }
  return MakeFigure(
      "Rank correlation of each measure (a column of trials.csv) with the smallest breaking "
      "force, " +
          FormatCount(evidence.num_judged, "judged grasp") + " of " +
          FormatCount(evidence.num_cells, "cell") +
          "; intervals at 95 % from drawing conditions with replacement.",
      "1: same ranking as the breaking force; 0: no relation. Names of epsilons are conventions; "
      "dexgraspbench decreases with quality and is taken with reversed sign.",
      MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

Html DrawRoc(const JudgeEvidence& evidence) {
  IntervalPlot plot;
  plot.text.title = "Prediction of success by measures before lift-off";
  plot.text.description = "Areas under the ROC curve with 95 % intervals, one row per measure.";
  plot.axis = "area under the ROC curve";
  for (const RocEvidence& roc : evidence.roc) plot.rows.push_back(MakeRow(roc.measure, roc.area));
  return MakeFigure("Area under the ROC curve for success, over " +
                        FormatCount(evidence.num_finished, "finished trial") + ", " +
                        std::to_string(evidence.num_successes) +
                        " of them successful; a grasp that never closed counts as 0.",
                    "0.5: chance level; 1: every success ranks above every failure.",
                    MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

Html DrawAgreement(const JudgeEvidence& evidence) {
  std::vector<Column> columns = {"Rule", {"passed", "judged grasps that pass"}};
  for (const std::string& rule : evidence.rules) {
    columns.push_back({rule, "share of judged grasps on which both rules agree"});
  }
  Table table("Share [%] of judged grasps on which two published rules agree.", columns);
  for (size_t a = 0; a < evidence.rules.size(); ++a) {
    std::vector<Cell> row = {evidence.rules[a], std::to_string(evidence.agreements[a][a].num_both) +
                                                    " of " + std::to_string(evidence.num_judged)};
    for (const Agreement& agreement : evidence.agreements[a]) {
      row.push_back(FormatFixed(100.0 * agreement.share(), 1));
    }
    table.AddRow(row);
  }
  std::vector<std::string> rules;
  for (const VerdictRule& rule : ListVerdictRules()) {
    rules.push_back(std::string(rule.name) + ": " + rule.rule + ".");
  }
  return table.ToHtml() + MakeDetails("The rules", MakeList(rules));
}

Html DrawQualityOfCells(const ReportData& data) {
  Table table("Held grasps by condition and seat, medians.",
              {"Condition",
               "Seat",
               "Judged",
               {"Breaking force [N]", "smallest of six pulls, in addition to the weight"},
               "Lowest [N]",
               {"Breaking moment [N mm]", "smallest of six twists"},
               {"sigma [N]", "predicted by the contact forces"},
               {"epsilon", "ferrari-canny, before lift-off"}});
  for (const CellLoads& loads : ListCellLoads(data.summary)) {
    table.AddRow({LinkTo(loads.cell->key, NameOfCell(*loads.cell, data.models)),
                  WordsOf(loads.seat), loads.num_judged, FormatFixed(loads.force.median, 2),
                  FormatFixed(loads.force.lowest, 2), FormatFixed(MmFromM(loads.moment.median), 1),
                  FormatFixed(loads.sigma.median, 2), FormatFixed(loads.epsilon.median, 3)});
  }
  return MakeDetails("Breaking loads of every condition", table.ToHtml());
}

Html DrawGraspQuality(const ReportData& data) {
  const JudgeEvidence evidence = CalcJudgeEvidence(data.session.records);
  if (evidence.num_judged == 0) return Html();
  return DrawRanks(evidence) + DrawRoc(evidence) + DrawAgreement(evidence) +
         DrawQualityOfCells(data);
}

}  // namespace

Section grasp_quality_section() { return {"quality", "Grasp quality", DrawGraspQuality}; }

}  // namespace graspbench
