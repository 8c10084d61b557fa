#include "reports/study/trial_figures.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "human_study/study/run/trial_flags.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

constexpr size_t kMaxPoints = 120;     // of a curve
constexpr size_t kMaxTipPoints = 400;  // of a tip, which a person looks at closely

/** Distance from the place in the hold [m]: what there is to see when no shape is known. */
ScalarCurve CalcFromHold(const TipAgainstObject& tip, const Hold& hold) {
  ScalarCurve curve = tip.speed;
  const int at = FindHoldSample(tip.speed, hold);
  for (Eigen::Index i = 0; i < curve.values.size(); ++i) {
    curve.values(i) =
        at < 0 ? std::nan("") : (tip.smooth.path.p.col(i) - tip.smooth.path.p.col(at)).norm();
  }
  return curve;
}

LinePlot::Series MakeSeries(const std::string& label, const ScalarCurve& curve) {
  LinePlot::Series series;
  series.label = label;
  const size_t stride = std::max<size_t>(1, curve.size() / kMaxTipPoints);
  for (size_t i = 0; i < curve.size(); i += stride) {
    series.x.push_back(curve.times[i]);
    series.y.push_back(curve.IsValid(i) ? 1e3 * curve.values[static_cast<Eigen::Index>(i)]
                                        : std::nan(""));
  }
  return series;
}

LinePlot MakeTipPlot(const StudyTrial& trial, const char* title, const char* axis) {
  LinePlot plot;
  plot.text.title = std::string(title) + ", trial " + trial.id;
  plot.text.description = std::string(title) + " of every digit with the contacts believed.";
  plot.x_axis = "time [s]";
  plot.y_axis = axis;
  for (const DigitContactEvents& digit : trial.analysis->contacts) {
    if (digit.contact.IsFound()) {
      plot.marks.push_back({digit.contact.time, NameOfDigit(digit.digit)});
    }
  }
  return plot;
}

}  // namespace

Html DrawTrialOpening(const StudyTrial& trial) {
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

std::string CodeOfDetector(const ContactDetector& detector) {
  return std::string(detector.id).substr(0, 2);
}

Html DrawTrialContacts(const StudyTrial& trial) {
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
      row.marks.push_back({event.time, CodeOfDetector(detectors[i]),
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

Html DrawTrialTips(const StudyTrial& trial, const ReachTrial& reach,
                   const AnalysisOptions& options) {
  FilteredTrial filtered(reach);
  const std::vector<TipAgainstObject>& tips =
      filtered.FilterTipsAgainstObject(options.contact.cutoff, options.contact.object_cutoff);
  const bool has_shape = std::any_of(tips.begin(), tips.end(), [](const TipAgainstObject& tip) {
    return tip.distance.size() > 0;
  });
  LinePlot speeds = MakeTipPlot(trial, "Speed of the tips against the object", "speed [mm/s]");
  LinePlot distances = MakeTipPlot(trial,
                                   has_shape ? "Distance of the markers from the surface"
                                             : "Distance of the tips from their place in the hold",
                                   "distance [mm]");
  for (size_t i = 0; i < tips.size(); ++i) {
    const std::string name = NameOfDigit(reach.digits[i].digit);
    speeds.series.push_back(MakeSeries(name, tips[i].speed));
    distances.series.push_back(MakeSeries(
        name, has_shape ? tips[i].distance : CalcFromHold(tips[i], trial.analysis->hold)));
  }
  return MakeScroll(speeds.text.title, DrawLinePlot(speeds)) +
         MakeScroll(distances.text.title, DrawLinePlot(distances));
}

}  // namespace graspbench
