#include <algorithm>
#include <iterator>

#include "core/base/text/text.h"
#include "datasets/analysis/simultaneity_summary.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

using Relations = std::vector<SimultaneityRelation>;

constexpr double kFamilyLevel = 0.05;  // of all relations together
/** Reading and permuting more trials would take longer than the rest of the page. */
constexpr size_t kMostTrials = 5000;

Relations TakeHand(const Relations& relations, const std::string& hand) {
  Relations part;
  std::copy_if(relations.begin(), relations.end(), std::back_inserter(part),
               [&hand](const SimultaneityRelation& row) { return row.hand == hand; });
  return part;
}

std::string DescribeHand(const std::string& name, const Relations& relations) {
  std::string found;
  int num_tests = 0, num_found = 0, num_apart = 0;
  for (const SimultaneityRelation& row : relations) {
    num_tests += row.relation ? 1 : 0;
    num_apart += row.relation && row.relation->interval &&
                 (row.relation->interval->low > 0.0 || row.relation->interval->high < 0.0);
    if (!(row.p_holm <= kFamilyLevel)) continue;
    found += (found.empty() ? ": " : ", ") + NameTimingMeasure(row.measure) + " with " +
             NameResponse(row) + " (" + FormatRho(row) + ")";
    ++num_found;
  }
  if (num_tests == 0) return name + ": too few trials of a condition that differ.";
  return name + ": " + (num_found == 0 ? "none" : std::to_string(num_found)) + " of " +
         FormatCount(num_tests, "relation") +
         " significant after Holm's correction for all relations of the session" + found +
         ". Without a correction the 95 % CI of " + std::to_string(num_apart) +
         " excludes 0; of 20 relations one does by chance.";
}

Html DrawRatios(const std::string& name, const Relations& relations) {
  IntervalPlot plot;
  plot.text.title = "Within-condition correlations with GFT% of the " + name;
  plot.text.description = "Rank correlations with 95 % intervals, one row per response.";
  plot.axis = "rank correlation with GFT%, within conditions";
  for (const SimultaneityRelation& row : relations) {
    if (row.measure != "gft_ratio" || !row.relation) continue;
    const Interval range =
        row.relation->interval ? *row.relation->interval : Interval{kUnset, kUnset};
    plot.rows.push_back(
        {NameResponse(row), row.relation->correlation, range.low, range.high, FormatRho(row)});
  }
  if (plot.rows.empty()) return Html();
  return MakeFigure(plot.text.title + ".",
                    "right of zero: the value grows with the delay of the last digit. A "
                    "correlation is not a cause: the object position affects both.",
                    MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

Html DrawAll(const Relations& relations, const SessionModels& models) {
  Relations found;
  std::vector<Html> hands;
  for (const SimultaneityRelation& row : relations) {
    if (!row.relation) continue;
    found.push_back(row);
    hands.push_back(Text(models.NameOfHand(row.hand)));
  }
  return MakeDetails("All correlations",
                     MakeTable("Rank correlation of simultaneity measures with the outcome, within "
                               "conditions, with 95 % intervals.",
                               ShowRelations(found), hands));
}

Html DrawSimultaneity(const ReportData& data) {
  const Html command = Element("code", {}, "graspbench simultaneity");
  if (data.session.records.size() > kMostTrials) {
    return Element("p", {},
                   command + Text(" with the session's folder prints the correlations; this "
                                  "session has too many trials for the page."));
  }
  const Relations relations = SummariseSimultaneity(data.session);
  Html html = MakeParagraph(
      "Correlation of GFT, GOT, GFT% and GOT% with the outcome, within conditions (hand, object, "
      "grasp). Trials of one condition differ in object pose and drive errors.");
  Html figures;
  for (const std::string& hand : data.summary.hands) {
    const std::string name = data.models.NameOfHand(hand);
    const Relations part = TakeHand(relations, hand);
    html += MakeParagraph(DescribeHand(name, part));
    figures += DrawRatios(name, part);
  }
  return html + figures + DrawAll(relations, data.models) +
         Element(
             "p", {},
             command + Text(" --delay delays one digit on the same draws and so tests causation."));
}

}  // namespace

Section simultaneity_section() {
  return {"simultaneity", "Does simultaneity matter?", DrawSimultaneity};
}

}  // namespace graspbench
