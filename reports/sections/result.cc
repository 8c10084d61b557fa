#include <algorithm>
#include <limits>

#include "core/base/text/text.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/plots/svg_plot.h"
#include "reports/scenes/cell_pictures.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

constexpr size_t kMaxNamedCells = 6;

std::string DescribeRates(const ReportData& data) {
  std::string sentence;
  const std::vector<std::string>& hands = data.summary.hands;
  for (size_t i = 0; i < hands.size(); ++i) {
    const Tally tally = data.summary.TallyOf(hands[i]);
    sentence +=
        (i == 0 ? "Success: " : "; ") + data.models.NameOfHand(hands[i]) + ", " + FormatRate(tally);
  }
  return sentence + ". ";
}

Html DescribeFailures(const ReportData& data) {
  const Tally& total = data.summary.total;
  const int others = total.finished - total.successes();
  if (others == 0) return Text("Every finished trial was a success.");
  const Outcome worst = total.most_frequent_failure();
  std::string most;  // names all outcomes that are equally frequent
  for (const Outcome outcome : ListOutcomes()) {
    if (IsSuccess(outcome) || total.CountOf(outcome) != total.CountOf(worst)) continue;
    most += (most.empty() ? "" : " and as ") + WordsOf(outcome);
  }
  Html text = LinkTo("failures", FormatCount(others, "trial")) +
              Text(" failed, most often as " + most + " (" + std::to_string(total.CountOf(worst)) +
                   " of " + std::to_string(others) + ")");
  std::vector<const CellSummary*> without;
  for (const CellSummary& cell : data.summary.cells) {
    if (cell.tally.finished > 0 && cell.tally.successes() == 0) without.push_back(&cell);
  }
  if (without.empty()) return text + Text(", and every condition succeeded at least once.");
  text += Text(", and " + std::to_string(without.size()) + " of " +
               FormatCount(static_cast<int>(data.summary.cells.size()), "condition") +
               (without.size() == 1 ? " has" : " have") + " no success: ");
  for (size_t i = 0; i < std::min(without.size(), kMaxNamedCells); ++i) {
    if (i > 0) text += Text(", ");
    text += LinkTo(without[i]->key, data.models.NameOfHand(without[i]->hand) + " on " +
                                        data.models.NameOfObject(without[i]->object) + " (" +
                                        without[i]->grasp + ")");
  }
  if (without.size() > kMaxNamedCells) {
    text += Text(" and " + std::to_string(without.size() - kMaxNamedCells) + " more");
  }
  return text + Text(".");
}

RateBars::Bar MakeBar(const std::string& label, const Tally& tally) {
  RateBars::Bar bar;
  bar.label = label;
  bar.text = std::to_string(tally.successes()) + " of " + std::to_string(tally.finished);
  bar.rate = tally.rate();
  if (tally.finished == 0) return bar;
  const Interval interval = tally.rate_interval();
  bar.low = interval.low;
  bar.high = interval.high;
  bar.text += ", " + FormatRateInterval(tally) + " %";
  return bar;
}

Html DrawRates(const ReportData& data) {
  RateBars plot;
  plot.text.title = "Success rate by hand and grasp";
  for (const std::string& hand : data.summary.hands) {
    const std::string name = data.models.NameOfHand(hand);
    std::vector<RateBars::Bar> grasps;
    for (const std::string& grasp : data.summary.grasps) {
      const Tally tally = data.summary.TallyOf(hand, grasp);
      if (tally.planned > 0) grasps.push_back(MakeBar(NameOfGrasp(grasp), tally));
    }
    const bool is_one = grasps.size() == 1;
    plot.bars.push_back(MakeBar(name + ", " + (is_one ? grasps[0].label : "all grasps"),
                                data.summary.TallyOf(hand)));
    plot.bars.back().is_total = true;
    if (!is_one) plot.bars.insert(plot.bars.end(), grasps.begin(), grasps.end());
  }
  for (const RateBars::Bar& bar : plot.bars) {
    plot.text.description += bar.label + ": " + bar.text + ". ";
  }
  return MakeFigure(
      "Success rate by hand and by standard grasp, with 95 % Wilson intervals.",
      "long intervals, which come from few trials. Grasps are used on different objects, so a low "
      "rate may come from the objects. Trials on one object are correlated, so the "
      "true uncertainty of a pooled rate exceeds its interval.",
      MakeScroll(plot.text.title, DrawRateBars(plot)));
}

/** Of every two hands, on the draws that both have. */
Html DrawHandDifferences(const ReportData& data) {
  std::vector<std::string> lines;
  for (const HandDifference& difference : data.summary.differences) {
    lines.push_back(DescribeHandDifference(difference, data.models.NameOfHand(difference.hand),
                                           data.models.NameOfHand(difference.other)));
  }
  if (lines.empty()) return {};
  return MakeParagraph(
             "Difference in success of two hands on the same draws (same object, same pose), with "
             "its 95 % interval. p: exact test clustered by object, after Holm for several pairs "
             "of hands.") +
         MakeList(lines);
}

Html DrawWarnings(const ReportData& data) {
  const Tally& total = data.summary.total;
  Html notes;
  if (total.planned == 0) {
    notes += MakeNote("warning", "This session has no trials.",
                      MakeParagraph("Its plan is empty: no hand has any of the chosen grasps."));
  } else if (total.finished < total.planned) {
    notes += MakeNote(
        "warning", "This session is not complete.",
        MakeParagraph(std::to_string(total.finished) + " of " +
                      FormatCount(total.planned, "planned trial") +
                      " are finished. Every rate below counts finished trials only; the command "
                      "\"graspbench run --resume\" on the session's folder runs the rest."));
  }
  const size_t num_findings = ListFindings(data).size();
  if (num_findings > 0) {
    notes += Element("p", {},
                     LinkTo("findings", FormatCount(static_cast<int>(num_findings), "finding")) +
                         Text(" on the data behind these numbers."));
  }
  return notes;
}

/** Shows the closed hand of the first success as an example of the experiment. */
Html DrawExample(const ReportData& data) {
  for (const CellSummary& cell : data.summary.cells) {
    const auto strips = data.pictures.by_cell.find(cell.key);
    if (strips == data.pictures.by_cell.end() || strips->second.empty()) continue;
    const Filmstrip& strip = strips->second.front();
    if (strip.record->result.outcome != Outcome::kSuccess) continue;
    for (const Picture& picture : strip.pictures) {
      if (picture.moment != Moment::kClosed) continue;
      const std::string name = NameOfCell(cell, data.models);
      return Element("figure", {},
                     Element("img", {{"src", MakeDataUri("image/webp", picture.webp)},
                                     {"width", std::to_string(kPictureWidth)},
                                     {"height", std::to_string(kPictureHeight)},
                                     {"alt", "The closed hand in a successful trial: " + name}}) +
                         Element("figcaption", {}, LinkTo(cell.key, name)));
    }
  }
  return {};
}

/** Shows the cells with the fewest successes with one failure of each; empty if nothing failed. */
Html DrawWorstCells(const ReportData& data) {
  constexpr size_t kMaxShown = 6;
  std::vector<const CellSummary*> worst;
  for (const CellSummary& cell : data.summary.cells) {
    if (cell.tally.successes() < cell.tally.finished) worst.push_back(&cell);
  }
  if (worst.empty()) return {};
  std::stable_sort(worst.begin(), worst.end(), [](const CellSummary* a, const CellSummary* b) {
    return a->tally.rate() < b->tally.rate();
  });
  const size_t num_shown = std::min(worst.size(), kMaxShown);
  Table table("The weakest of " +
                  FormatCount(static_cast<int>(data.summary.cells.size()), "condition") + "; " +
                  std::to_string(worst.size()) + (worst.size() == 1 ? " has" : " have") +
                  " failures.",
              {"Condition", "Successes", "Most often"});
  for (size_t i = 0; i < num_shown; ++i) {
    const CellSummary& cell = *worst[i];
    table.AddRow(
        {DrawLastThumbnail(data.pictures, cell.key) +
             LinkTo(cell.key, data.models.NameOfHand(cell.hand) + ", " +
                                  data.models.NameOfObject(cell.object) + ", " + cell.grasp),
         std::to_string(cell.tally.successes()) + " of " + std::to_string(cell.tally.finished),
         NameOf(cell.tally.most_frequent_failure())});
  }
  return table.ToHtml();
}

Html DrawResult(const ReportData& data) {
  Html html = DrawWarnings(data);
  if (data.summary.total.finished == 0) return html + MakeParagraph("No trial has finished yet.");
  const Html verdict =
      Element("p", {{"class", "verdict"}}, Text(DescribeRates(data)) + DescribeFailures(data));
  html += Element("div", {{"class", "first"}},
                  Element("div", {}, verdict + DrawWorstCells(data)) + DrawExample(data));
  return html + DrawRates(data) + DrawHandDifferences(data);
}

}  // namespace

Section result_section() { return {"result", "Result", DrawResult}; }

}  // namespace graspbench
