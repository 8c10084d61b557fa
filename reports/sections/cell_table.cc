#include "core/base/text/text.h"
#include "core/base/units.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/scenes/cell_pictures.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html DrawRate(const Tally& tally) {
  if (tally.finished == 0) return Text("n/a");
  const double rate = tally.rate();
  const Html bar =
      Element("span", {{"class", "meter"}, {"style", "--rate:" + FormatFixed(rate, 3)}}, "");
  return Text(FormatFixed(100.0 * rate, 1)) + bar;
}

Html ListFailures(const Tally& tally) {
  Html list;
  for (Outcome outcome : ListOutcomes()) {
    const int count = tally.CountOf(outcome);
    if (outcome == Outcome::kSuccess || count == 0) continue;
    if (!list.empty()) list += Text(", ");
    list += Text(std::to_string(count) + " " + WordsOf(outcome));
  }
  return list.empty() ? Text("none") : list;
}

constexpr char kEarly[] = "†";
constexpr char kFew[] = "*";
constexpr char kReseated[] = "↑";

std::string FormatMedian(const Spread& spread, double unit, int decimals) {
  const char* few = spread.n > 0 && spread.n < Spread::kFew ? kFew : "";
  return FormatFixed(unit * spread.median, decimals) + few;
}

/** Formats the median for each seat class that occurs. */
Html FormatMedians(const CellSummary& cell, Spread ContactTimes::*measure, double unit,
                   int decimals, const std::string& mark) {
  const Spread &kept = cell.times.*measure, &reseated = cell.reseated_times.*measure;
  std::string text = kept.n > 0 || reseated.n == 0 ? FormatMedian(kept, unit, decimals) : "";
  if (reseated.n > 0) {
    text += (text.empty() ? "" : "; ") + FormatMedian(reseated, unit, decimals) + kReseated;
  }
  return Text(text + mark);
}

/** Explains the grasp codes in the table: "g1 all finger precision, ..". */
std::string ExplainCodes() {
  std::string text = "Grasps:";
  for (const GraspTaxon& taxon : ListGraspTaxa()) text += " " + taxon.id + " " + taxon.name + ",";
  text += " by-sight: grasps chosen by the hand's camera, with the number of trials.";
  return text + " " + kEarly +
         " early contact before the start of closure in some trial; such trials are excluded from "
         "the times. " +
         kFew + " median of fewer than " + std::to_string(Spread::kFew) + " trials. " + kReseated +
         " of the reseated trials; the value before it is that of the others.";
}

Html DrawCellTable(const ReportData& data) {
  Table table(
      "Every condition: successes with 95 % Wilson interval, other outcomes, median contact times.",
      {{"Object", "links to the section of the condition"},
       "Hand",
       "Grasp",
       {"n", "finished trials"},
       "Successes",
       {"Rate [%]", "successes of n"},
       {"95 % interval [%]", "Wilson interval of the rate"},
       "Other outcomes",
       {"GCT [s]", "median grasp closure time"},
       {"GFT [s]", "median grasp forming time"},
       {"GOT [s]", "median grasp opposing time"},
       {"GFT% [%]", "median of GFT / GCT"},
       {"GOT% [%]", "median of GOT / GCT"},
       {"Penetration [mm]", "deepest finger contact of any trial"}});
  for (const CellSummary& cell : data.summary.cells) {
    const Tally& tally = cell.tally;
    const std::string early = cell.num_early > 0 ? kEarly : "";
    table.AddRow({DrawFirstThumbnail(data.pictures, cell.key) +
                      LinkTo(cell.key, data.models.NameOfObject(cell.object)),
                  data.models.NameOfHand(cell.hand),
                  Element("span", {{"title", NameOfGrasp(cell.grasp)}}, DescribeGrasp(cell)),
                  tally.finished, tally.successes(), DrawRate(tally), FormatRateInterval(tally),
                  ListFailures(tally), FormatMedians(cell, &ContactTimes::gct, 1.0, 3, ""),
                  FormatMedians(cell, &ContactTimes::gft, 1.0, 3, ""),
                  FormatMedians(cell, &ContactTimes::got, 1.0, 3, ""),
                  FormatMedians(cell, &ContactTimes::gft_ratio, 100.0, 1, early),
                  FormatMedians(cell, &ContactTimes::got_ratio, 100.0, 1, early),
                  FormatFixed(MmFromM(tally.worst_penetration), 2)});
  }
  return table.ToHtml() + Element("p", {{"class", "small"}}, ExplainCodes());
}

}  // namespace

Section cell_table_section() { return {"table", "All conditions", DrawCellTable}; }

}  // namespace graspbench
