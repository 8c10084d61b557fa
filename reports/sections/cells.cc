#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "objects/catalogue.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/plots/line_plot.h"
#include "reports/plots/svg_plot.h"
#include "reports/plots/trial_plots.h"
#include "reports/scenes/cell_pictures.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

constexpr char kFewMark[] = "*";

std::string DescribeObject(const CellSummary& cell, const SessionModels& models) {
  const auto object = models.FindObject(cell.object);
  if (!object) return {};
  std::string size;
  for (double side : object->size)
    size += (size.empty() ? "" : " × ") + FormatFixed(MmFromM(side), 1);
  return FormatFixed(GFromKg(object->mass_properties.mass), 1) + " g, " + size +
         " mm (length × width × height)" +
         (object->compressible ? ", compressed to " + DescribeCompression(*object) : "") +
         ", friction " + FormatFixed(object->surface.friction_static, 2) + " static and " +
         FormatFixed(object->surface.friction_dynamic, 2) + " dynamic.";
}

Html DrawTrialStrip(const Filmstrip& strip, const CellSummary& cell, const ReportData& data) {
  const TrialRecord& record = *strip.record;
  const Html trial =
      Text("Trial " + std::to_string(record.plan.trial) + ", " + WordsOf(record.result.outcome) +
           (ExplainEnd(record.result).empty() ? "" : ": " + ExplainEnd(record.result)) +
           "; times since the start of placing.");
  return DrawFilmstrip(strip.pictures, record.result, NameOfCell(cell, data.models)) +
         Element("p", {{"class", "small"}}, trial);
}

/** Draws one trial of each outcome. */
Html DrawFilmstrips(const CellSummary& cell, const ReportData& data) {
  const auto found = data.pictures.by_cell.find(cell.key);
  if (found == data.pictures.by_cell.end()) {
    return Element("p", {{"class", "missing"}},
                   Text("No pictures of this condition") +
                       (data.pictures.problems.empty() && data.models.problems.empty()
                            ? Text(".")
                            : Text("; the reason is among the ") +
                                  LinkTo("findings", "errors and warnings") + Text(".")));
  }
  Html first, others;
  for (const Filmstrip& strip : found->second) {
    (first.empty() ? first : others) += DrawTrialStrip(strip, cell, data);
  }
  return others.empty() ? first : first + Element("div", {{"class", "screen"}}, others);
}

/** Lists the ids of the digits that occur in any trial, the opposing digit first, the others in the
order of the records. */
std::vector<std::string> ListDigits(const CellSummary& cell) {
  std::vector<std::string> digits;
  for (bool is_opposing : {true, false}) {
    for (const TrialRecord* record : cell.records) {
      for (const DigitContact& contact : record->result.contacts) {
        const bool is_known =
            std::find(digits.begin(), digits.end(), contact.digit) != digits.end();
        if (contact.is_opposing == is_opposing && !is_known) digits.push_back(contact.digit);
      }
    }
  }
  return digits;
}

double FindContactTime(const TrialResult& result, const std::string& digit) {
  for (const DigitContact& contact : result.contacts) {
    if (contact.digit == digit) return contact.time;
  }
  return std::nan("");
}

Html MakeSmall(const std::string& text) { return Element("p", {{"class", "small"}}, text); }

/** States how many trials of a cell are shown when it is too large for the page. */
Html DrawShare(const std::vector<const TrialRecord*>& shown, const CellSummary& cell) {
  const std::string share = DescribeShownTrials(shown.size(), cell);
  return share.empty() ? Html() : MakeSmall(share);
}

Html DrawContactTimes(const CellSummary& cell, const std::vector<std::string>& digits,
                      const ReportData& data) {
  const std::vector<const TrialRecord*> shown = ChooseShownTrials(cell, data.summary);
  DotStrips plot;
  plot.text.title = "First contact of each digit, " + NameOfCell(cell, data.models);
  plot.text.description =
      "One strip per digit, one mark per trial, in seconds since the start of closure; the table "
      "of trials has all values.";
  plot.axis = "first contact since start of closure [s]";
  plot.missing = "not by lift-off";
  for (const std::string& digit : digits) {
    DotStrips::Row row;
    row.label = data.models.NameOfDigit(cell.hand, digit);
    row.median = CalcContactSpread(cell, digit).median;
    for (const TrialRecord* record : shown) {
      const double time = FindContactTime(record->result, digit);
      row.dots.push_back({time, record->result.outcome == Outcome::kSuccess,
                          "trial " + std::to_string(record->plan.trial) + ": " +
                              FormatFixed(time, 3) + " s, " + WordsOf(record->result.outcome)});
    }
    plot.rows.push_back(row);
  }
  return Element("div", {},
                 MakeFigure(plot.text.title + ".", "digits that touch late or never.",
                            MakeScroll(plot.text.title, DrawDotStrips(plot))) +
                     DrawShare(shown, cell));
}

/** "Order of contact: TH<FF in 7 trials, FF<TH in 2, others in 1." */
Html DescribeOrders(const CellSummary& cell) {
  constexpr size_t kNumShown = 3;
  Html text = Text("Order of contact: ");
  int num_others = 0;
  for (size_t i = 0; i < cell.orders.size(); ++i) {
    const auto& [order, count] = cell.orders[i];
    if (i >= kNumShown) {
      num_others += count;
      continue;
    }
    text += Text(i == 0 ? "" : ", ") + Element("code", {}, order) +
            Text(" in " + (i == 0 ? FormatCount(count, "trial") : std::to_string(count)));
  }
  if (cell.orders.empty()) text += Text("no digit touched");
  if (num_others > 0) text += Text(", others in " + std::to_string(num_others));
  return Element("p", {{"class", "small"}}, text + Text("."));
}

Html DrawTiming(const CellSummary& cell, const SessionModels& models) {
  Table table("Contact simultaneity, " + NameOfCell(cell, models) + ".",
              {"Measure", "Median", "Range", {"n", "trials in which it is defined"}});
  const auto add = [&](const std::string& name, const Spread& spread, double unit, int decimals) {
    const auto format = [&](double value) { return FormatFixed(unit * value, decimals); };
    table.AddRow({name,
                  format(spread.median) + (spread.n > 0 && spread.n < Spread::kFew ? kFewMark : ""),
                  spread.n == 0 ? "n/a" : format(spread.lowest) + " to " + format(spread.highest),
                  spread.n});
  };
  bool has_few = false;
  const auto add_all = [&](const ContactTimes& times, const std::string& seat) {
    add("GCT [s]" + seat, times.gct, 1.0, 3);
    add("GFT [s]" + seat, times.gft, 1.0, 3);
    add("GOT [s]" + seat, times.got, 1.0, 3);
    add("GFT% [%]" + seat, times.gft_ratio, 100.0, 1);
    add("GOT% [%]" + seat, times.got_ratio, 100.0, 1);
    for (const Spread& spread : {times.gct, times.gft, times.got}) {
      has_few = has_few || spread.n < Spread::kFew;
    }
  };
  const bool is_split = cell.reseated_times.gct.n > 0;
  if (!is_split || cell.times.gct.n > 0) add_all(cell.times, "");
  if (is_split) add_all(cell.reseated_times, ", reseated");
  Html html = table.ToHtml() + DescribeOrders(cell);
  if (cell.num_early > 0) {
    html += MakeSmall("Early contact (before the start of closure) in " +
                      FormatCount(cell.num_early, "trial") + "; excluded from these measures.");
  }
  if (has_few) {
    html += MakeSmall(std::string(kFewMark) + " of fewer than " + std::to_string(Spread::kFew) +
                      " trials.");
  }
  return Element("div", {}, html);
}

Html FormatDraw(const ReportData& data, const PlannedTrial& planned) {
  const TrialDraw draw = MakeObjectDraw(data.session.config, planned.object, planned.trial);
  return Text(FormatFixed(MmFromM(draw.offset_x), 1) + ", " +
              FormatFixed(MmFromM(draw.offset_y), 1) + ", " +
              FormatFixed(DegFromRad(draw.offset_yaw), 1));
}

Html DrawTrials(const CellSummary& cell, const std::vector<std::string>& digits,
                const ReportData& data) {
  const bool is_by_sight =
      std::any_of(cell.records.begin(), cell.records.end(),
                  [](const TrialRecord* record) { return record->result.sight_grasp.has_value(); });
  std::vector<Column> columns = {"Trial", "Outcome", "Why"};
  if (is_by_sight) columns.push_back({"Grasp", "chosen by the camera"});
  for (const std::string& digit : digits) {
    columns.push_back({data.models.NameOfDigit(cell.hand, digit) + " [s]",
                       "first contact since the start of closure"});
  }
  for (const char* head : {"GCT [s]", "GFT [s]", "GOT [s]", "GFT% [%]", "GOT% [%]"}) {
    columns.push_back(head);
  }
  columns.push_back({"Order", "of first contacts; = in the same step"});
  columns.push_back({"Grip [N]", "sum of normal forces before lift-off"});
  columns.push_back({"Lift [mm]", "of the object's centre at the end"});
  columns.push_back({"Slip [mm]", "motion relative to the palm in the hold"});
  columns.push_back({"End speed [mm/s]", "relative to the palm"});
  columns.push_back({"Penetration [mm]", "deepest finger contact"});
  columns.push_back({"Energy residual [mJ]", "unexplained energy"});
  columns.push_back("Steps");
  columns.push_back({"Not converged", "steps whose solve missed its tolerance"});
  columns.push_back(
      {"Drawn", "offset x, y [mm] and yaw [deg] of the object from its nominal pose"});
  columns.push_back("Trial id");
  Table table("Trials of " + NameOfCell(cell, data.models) + ".", columns);
  const std::vector<const TrialRecord*> shown = ChooseShownTrials(cell, data.summary);
  for (const TrialRecord* record : shown) {
    const TrialResult& result = record->result;
    std::vector<Cell> row = {record->plan.trial, WordsOf(result.outcome), ExplainEnd(result)};
    if (is_by_sight) row.push_back(result.sight_grasp.value_or("n/a"));
    for (const std::string& digit : digits) {
      row.push_back(FormatFixed(FindContactTime(result, digit), 3));
    }
    const ContactTiming& timing = result.timing;
    for (double time : {timing.gct, timing.gft, timing.got}) {
      row.push_back(FormatFixed(time, 3));
    }
    for (double ratio : {timing.gft_ratio, timing.got_ratio}) {
      row.push_back(FormatFixed(100.0 * ratio, 1));
    }
    row.push_back(Element("code", {}, FindContactOrder(result).Format()));
    row.push_back(FormatFixed(result.grip_force, 2));
    row.push_back(FormatFixed(MmFromM(result.lift_height), 1));
    row.push_back(FormatFixed(MmFromM(result.hold_slip), 1));
    row.push_back(FormatFixed(MmFromM(result.end_speed), 1));
    row.push_back(FormatFixed(MmFromM(result.worst_penetration), 2));
    row.push_back(FormatSignificant(MjFromJ(result.energy_residual), 3));
    row.push_back(result.num_steps);
    row.push_back(result.num_unconverged);
    row.push_back(FormatDraw(data, record->plan));
    row.push_back(Element("code", {}, record->plan.id));
    table.AddRow(row, MakeTrialAnchor(record->plan));
  }
  return MakeDetails("All values of " + FormatCount(static_cast<int>(shown.size()), "trial"),
                     DrawShare(shown, cell) + table.ToHtml());
}

/** Returns the first success or, without one, the first trial. @pre the cell has a record */
const TrialRecord& FindShownTrial(const CellSummary& cell) {
  const auto success = std::find_if(
      cell.records.begin(), cell.records.end(),
      [](const TrialRecord* record) { return record->result.outcome == Outcome::kSuccess; });
  return success == cell.records.end() ? *cell.records.front() : **success;
}

/** Lists the failures: " 2 dropped while holding, 1 no contact of a digit"; empty if all
succeeded. */
Html DescribeOthers(const Tally& tally) {
  std::string text;
  for (const Outcome outcome : ListOutcomes()) {
    if (IsSuccess(outcome) || tally.CountOf(outcome) == 0) continue;
    text += (text.empty() ? " " : ", ") + std::to_string(tally.CountOf(outcome)) + " " +
            WordsOf(outcome);
  }
  return text.empty() ? Html() : Element("span", {{"class", "others"}}, text);
}

Html DrawCell(const CellSummary& cell, const ReportData& data) {
  const Tally& tally = cell.tally;
  // Folded: a session has dozens of conditions, and the failures are listed further up.
  const Html summary = Element(
      "summary", {},
      Element("h4", {},
              Text(data.models.NameOfObject(cell.object) + ", " + NameOfGrasp(cell.grasp) + " ") +
                  Element("span", {{"class", "count"}},
                          std::to_string(tally.successes()) + " of " +
                              std::to_string(tally.finished))) +
          DescribeOthers(tally));
  Html content;
  std::string facts = DescribeObject(cell, data.models);
  if (tally.finished > 0) {
    facts += " Success in " + FormatRate(tally) + ".";
  }
  if (tally.finished < tally.planned) {
    facts += " " + std::to_string(tally.planned - tally.finished) + " of " +
             FormatCount(tally.planned, "planned trial") + " missing.";
  }
  content += Element("p", {{"class", "small"}}, facts);
  if (tally.finished > 0 && IsDrawnInFull(cell, data.summary)) {
    const std::vector<std::string> digits = ListDigits(cell);
    content += DrawFilmstrips(cell, data);
    content += Element("div", {{"class", "pair screen"}},
                       DrawContactTimes(cell, digits, data) + DrawTiming(cell, data.models));
    const Html events = DrawContactStrip(LoadWhole(data.session, FindShownTrial(cell)),
                                         NameOfCell(cell, data.models), data.models);
    Html folded = DrawTrials(cell, digits, data);
    if (!events.empty()) folded = MakeDetails("Contact events of one trial", events) + folded;
    content += Element("div", {{"class", "screen"}}, folded);
  }
  return Element("details", {{"id", cell.key}, {"class", "cell"}}, summary + content);
}

Html DrawCells(const ReportData& data) {
  if (data.summary.cells.empty()) return MakeParagraph("There is nothing to show.");
  Html html = MakeParagraph(
      "A click opens a condition. Pictures show the first successful trial, if any, and one trial "
      "of each other outcome. Records hold three instants per trial; graspbench trial draws any "
      "other. Strips below show the first contact time of each grasping digit: a disc for a "
      "success, a cross for any other outcome, a line at the median. The order of trials is the "
      "same in all strips.");
  html += Element("p", {{"class", "look"}},
                  Element("b", {}, "What to look for: ") +
                      Text("digits that touch late or never, crosses away from the discs, contacts "
                           "that the grasp does not intend."));
  if (!IsDrawnInFull(data.summary.cells.back(), data.summary)) {
    html += MakeNote("info", "This session has too many conditions for one page.",
                     MakeParagraph("The first conditions are shown in full, the others only by "
                                   "their rates; export/trials.csv has all trials."));
  }
  html += Element("p", {{"class", "print"}},
                  "The printed page shows one trial per condition; the page on screen shows all "
                  "trials, and export/trials.csv has their values.");
  for (const std::string& hand : data.summary.hands) {
    Html cells;
    Html faultless;
    int num_faultless = 0;
    for (const CellSummary& cell : data.summary.cells) {
      if (cell.hand != hand) continue;
      num_faultless += cell.tally.is_faultless();
      (cell.tally.is_faultless() ? faultless : cells) += DrawCell(cell, data);
    }
    html += Element("h3", {}, data.models.NameOfHand(hand));
    html += Element("div", {{"class", "cells"}}, cells);
    if (num_faultless == 0) continue;
    html += MakeDetails(
        FormatCount(num_faultless, "condition") + " in which every finished trial succeeded",
        Element("div", {{"class", "cells"}}, faultless));
  }
  return html;
}

}  // namespace

Section cells_section() { return {"cells", "Condition by condition", DrawCells}; }

}  // namespace graspbench
