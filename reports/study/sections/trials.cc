#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "human_study/study/trial_flags.h"
#include "reports/line_plot.h"
#include "reports/study/study_format.h"
#include "reports/study/study_section.h"

namespace graspbench {
namespace {

/** Each costs the page about 10 kB. */
constexpr size_t kMaxDrawn = 100;
constexpr size_t kMaxPoints = 120;  // of a curve

/** Trials that a person should look at come first; within that, the order of the plan. */
std::vector<const StudyTrial*> ChooseTrials(const StudyResult& result) {
  std::vector<const StudyTrial*> trials;
  for (const StudyTrial& trial : result.trials) {
    if (trial.analysis) trials.push_back(&trial);
  }
  if (trials.size() <= kMaxDrawn) return trials;
  std::stable_partition(trials.begin(), trials.end(), [](const StudyTrial* trial) {
    return !trial->IsKept() || !FormatFlags(*trial->analysis).empty();
  });
  trials.resize(kMaxDrawn);
  return trials;
}

Html DrawOpening(const StudyTrial& trial) {
  const TrialAnalysis& analysis = *trial.analysis;
  LinePlot plot;
  plot.text.title = "Hand opening, trial " + trial.id;
  plot.text.description = "Opening over time with the events that the measures rest on.";
  plot.x_axis = "time [s]";
  plot.y_axis = "opening [mm]";
  plot.is_y_from_zero = false;
  LinePlot::Series series;
  series.label = "opening";
  const ScalarCurve& curve = analysis.opening;
  const size_t stride = std::max<size_t>(1, curve.size() / kMaxPoints);
  for (size_t i = 0; i < curve.size(); i += stride) {
    series.x.push_back(curve.times[i]);
    series.y.push_back(1e3 * curve.values[static_cast<Eigen::Index>(i)]);
  }
  plot.series.push_back(series);
  const auto mark = [&](const EventTime& event, const char* label) {
    if (event.IsFound()) plot.marks.push_back({event.time, label});
  };
  mark(analysis.movement.onset, "onset");
  mark(analysis.closure_start, "widest");
  mark(analysis.object.lift_off, "lift-off");
  if (!analysis.object.lift_off.IsFound() && analysis.hold.IsFound()) {
    plot.marks.push_back({analysis.hold.time, "hold"});
  }
  return MakeScroll(plot.text.title, DrawLinePlot(plot));
}

/** Two letters, as many as tell them apart. */
std::string CodeOf(const ContactDetector& detector) {
  return std::string(detector.id).substr(0, 2);
}

/** One row a digit: a mark a detector, a span of the believed one's 95 %. */
Html DrawContacts(const StudyTrial& trial) {
  const std::vector<ContactDetector>& detectors = ContactDetectorList();
  StripChart chart;
  chart.text.title = "Contacts, trial " + trial.id;
  chart.text.description = "Contact times of each digit by each detector.";
  chart.axis = "time [s]";
  chart.kinds = {"believed: 95 % of its uncertainty"};
  for (const DigitContactEvents& digit : trial.analysis->contacts) {
    StripChart::Row row;
    row.label = NameOfDigit(digit.digit);
    if (digit.contact.IsFound() && std::isfinite(digit.contact.uncertainty)) {
      const double half = digit.contact.CalcHalfWidth();
      row.spans.push_back({digit.contact.time - half, digit.contact.time + half, 0,
                           FormatValue(digit.contact.time, "s") + " ms"});
    }
    for (size_t i = 0; i < detectors.size(); ++i) {
      const EventTime& event = digit.by_detector[i];
      if (!event.IsFound()) continue;
      row.marks.push_back({event.time, CodeOf(detectors[i]),
                           std::string(detectors[i].id) + ": " + FormatValue(event.time, "s") +
                               " ms" + (event.is_in_gap ? ", in a gap" : "") +
                               (event.is_filled ? ", filled" : "")});
    }
    if (row.marks.empty()) row.label += ": none";
    chart.rows.push_back(row);
  }
  return MakeScroll(chart.text.title, DrawStripChart(chart));
}

std::string DescribeTrial(const StudyTrial& trial, const std::vector<Factor>& factors) {
  const ContactTiming& timing = trial.analysis->timing;
  std::string cell;
  for (const std::string& level : trial.levels) cell += (cell.empty() ? "" : ", ") + level;
  std::string text = trial.id + (cell.empty() ? "" : ", " + NameOfCell(cell, factors));
  text += ": GFT " + FormatWithUnit(timing.gft, "s") + ", GOT " + FormatWithUnit(timing.got, "s") +
          ", GFT% " + FormatWithUnit(timing.gft_ratio, "1");
  const std::string flags = FormatFlags(*trial.analysis);
  if (!trial.IsKept()) {
    text += " \u2013 removed: " + trial.removed;
  } else if (!flags.empty()) {
    text += " \u2013 " + flags;
  }
  return text;
}

Html DrawTrials(const StudyPageData& data) {
  const std::vector<const StudyTrial*> trials = ChooseTrials(data.result);
  if (trials.empty()) return MakeParagraph("No trial could be analysed.");
  std::string legend;
  for (const ContactDetector& detector : ContactDetectorList()) {
    legend += (legend.empty() ? "" : ", ") + CodeOf(detector) + " " + detector.id;
  }
  std::string text = "Detectors: " + legend + ". All events of all trials stand in events.csv.";
  if (trials.size() == kMaxDrawn && data.result.trials.size() > kMaxDrawn) {
    text += " Drawn are " + std::to_string(kMaxDrawn) + " of " +
            std::to_string(data.result.trials.size()) + " trials, those removed or flagged first.";
  }
  Html html = MakeParagraph(text);
  for (const StudyTrial* trial : trials) {
    const std::string anchor = MakePlainKey({"trial", trial->participant, trial->trial});
    html += Element("div", {{"id", anchor}},
                    MakeDetails(DescribeTrial(*trial, data.result.study.factors),
                                Element("div", {{"class", "pair"}},
                                        Element("div", {}, DrawOpening(*trial)) +
                                            Element("div", {}, DrawContacts(*trial)))));
  }
  return html;
}

}  // namespace

StudySection trials_study_section() { return {"trials", "Trial by trial", DrawTrials}; }

}  // namespace graspbench
