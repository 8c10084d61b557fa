#include "reports/study/trial_figures.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/text/text.h"
#include "human_study/study/run/removal_advice.h"
#include "human_study/study/run/trial_flags.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

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

LinePlot::Series MakeSeries(const std::string& label, const ScalarCurve& curve, size_t max_points) {
  LinePlot::Series series;
  series.label = label;
  const size_t stride = std::max<size_t>(1, curve.size() / max_points);
  for (size_t i = 0; i < curve.size(); i += stride) {
    series.x.push_back(curve.times[i]);
    series.y.push_back(curve.IsValid(i) ? 1e3 * curve.values[static_cast<Eigen::Index>(i)]
                                        : std::nan(""));
  }
  return series;
}

void AddMark(const EventTime& event, const std::string& label, LinePlot& plot) {
  if (event.IsFound()) plot.marks.push_back({event.time, label});
}

/** A curve of the whole hand over the trial. */
LinePlot MakeCurvePlot(const std::string& title, const char* axis, const char* label,
                       const ScalarCurve& curve, const StudyTrial& trial) {
  LinePlot plot;
  plot.text.title = title + ", trial " + trial.id;
  plot.text.description = title + " over time with the events that the measures rest on.";
  plot.x_axis = "time [s]";
  plot.y_axis = axis;
  plot.series.push_back(MakeSeries(label, curve, kNumDrawn));
  return plot;
}

/** Speed at which the rule of the onset decides [m/s]; NaN: it has none. */
double FindThresholdOf(const Movement& movement, const MovementOptions& options) {
  if (options.rule == "threshold" || options.rule == "longest_run") return options.speed_threshold;
  if (options.rule == "peak_fraction") return options.peak_fraction * movement.peak_speed;
  return std::nan("");
}

LinePlot MakeTipPlot(const StudyTrial& trial, const char* title, const char* axis) {
  LinePlot plot;
  plot.text.title = std::string(title) + ", trial " + trial.id;
  plot.text.description = std::string(title) + " of every digit with the contacts believed.";
  plot.x_axis = "time [s]";
  plot.y_axis = axis;
  for (const DigitContactEvents& digit : trial.analysis->contacts) {
    AddMark(digit.contact, NameOfDigit(digit.digit), plot);
  }
  return plot;
}

/** A sign for the detector of that place in the list. */
const char* SignOfDetector(size_t place) {
  constexpr const char* kSigns[] = {"\u25CB", "\u25B3", "\u25C7", "\u25A1", "\u00D7", "+"};
  return kSigns[place % std::size(kSigns)];
}

}  // namespace

Html DrawTrialSpeed(const StudyTrial& trial, const MovementOptions& options) {
  const TrialAnalysis& analysis = *trial.analysis;
  LinePlot plot =
      MakeCurvePlot("Speed of the wrist", "speed [mm/s]", "speed", analysis.speed, trial);
  const double level = FindThresholdOf(analysis.movement, options);
  if (std::isfinite(level) && analysis.speed.size() > 0) {
    const std::vector<double>& times = analysis.speed.times;
    plot.series.push_back(
        {"threshold", {times.front(), times.back()}, {1e3 * level, 1e3 * level}, {}, {}});
  }
  AddMark(analysis.movement.onset, "onset", plot);
  if (std::isfinite(analysis.movement.peak_time)) {
    plot.marks.push_back({analysis.movement.peak_time, "peak"});
  }
  AddMark(analysis.movement.end, "end", plot);
  return MakeScroll(plot.text.title, DrawLinePlot(plot));
}

Html DrawTrialOpening(const StudyTrial& trial) {
  const TrialAnalysis& analysis = *trial.analysis;
  LinePlot plot = MakeCurvePlot("Hand opening", "opening [mm]", "opening", analysis.opening, trial);
  plot.is_y_from_zero = false;
  AddMark(analysis.movement.onset, "onset", plot);
  AddMark(analysis.closure_start, "widest", plot);
  for (const DigitContactEvents& digit : analysis.contacts) {
    AddMark(digit.contact, NameOfDigit(digit.digit), plot);
  }
  AddMark(analysis.object.lift_off, "lift-off", plot);
  if (!analysis.object.lift_off.IsFound() && analysis.hold.IsFound()) {
    plot.marks.push_back({analysis.hold.time, "hold"});
  }
  return MakeScroll(plot.text.title, DrawLinePlot(plot));
}

Html DrawDecidingCurve(const StudyTrial& trial, const MovementOptions& options) {
  const bool is_speed =
      !trial.IsKept() && FindRemovalAdvice(trial.removed_code).curve == RemovalCurve::kSpeed;
  return is_speed ? DrawTrialSpeed(trial, options) : DrawTrialOpening(trial);
}

Html DrawTrialContacts(const StudyTrial& trial) {
  const std::vector<ContactDetector>& detectors = ContactDetectorList();
  StripChart chart;
  chart.text.title = "Contacts, trial " + trial.id;
  chart.text.description = "Contact times of each digit by each detector.";
  chart.axis = "time [s]";
  chart.kinds = {"believed: 95 % of its uncertainty"};
  for (size_t i = 0; i < detectors.size(); ++i) {
    const auto has_found = [&](const DigitContactEvents& digit) {
      return digit.by_detector[i].IsFound();
    };
    const std::vector<DigitContactEvents>& contacts = trial.analysis->contacts;
    if (std::any_of(contacts.begin(), contacts.end(), has_found)) {
      chart.symbols.emplace_back(SignOfDetector(i), detectors[i].id);
    }
  }
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
      row.marks.push_back({event.time, SignOfDetector(i),
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
  const ContactOptions contact = FitCutoffs(options, CalcRate(reach)).contact;
  const std::vector<TipAgainstObject>& tips =
      filtered.FilterTipsAgainstObject(contact.cutoff, contact.object_cutoff);
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
    speeds.series.push_back(MakeSeries(name, tips[i].speed, kMaxTipPoints));
    distances.series.push_back(
        MakeSeries(name, has_shape ? tips[i].distance : CalcFromHold(tips[i], trial.analysis->hold),
                   kMaxTipPoints));
  }
  return MakeScroll(speeds.text.title, DrawLinePlot(speeds)) +
         MakeScroll(distances.text.title, DrawLinePlot(distances));
}

}  // namespace graspbench
