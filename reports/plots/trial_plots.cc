#include "reports/plots/trial_plots.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "datasets/records/trace_table.h"
#include "reports/page/assets.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"
#include "reports/plots/svg_parts.h"

namespace graspbench {

Html DrawContactStrip(const TrialRecord& record, const std::string& name,
                      const SessionModels& models) {
  const TrialResult& result = record.result;
  if (result.phases.empty() || result.contact_events.empty()) return {};
  const double end = std::max(result.phases.back().time, result.contact_events.back().time);
  StripChart chart;
  chart.text.title = "Contacts with " + name;
  chart.text.description = "One row per link that touched the object: bars of contact over time.";
  chart.axis = "time since the start of closure [s]";
  chart.kinds = {"in contact"};
  for (size_t i = 0; i + 1 < result.phases.size(); ++i) {
    chart.phases.push_back(
        {result.phases[i].time, result.phases[i + 1].time, result.phases[i].name});
  }
  for (const ContactEvent& event : result.contact_events) {
    const std::string label = models.NameOfDigit(record.plan.hand, event.digit) + ", " + event.link;
    auto row = std::find_if(chart.rows.begin(), chart.rows.end(),
                            [&](const StripChart::Row& known) { return known.label == label; });
    if (row == chart.rows.end()) row = chart.rows.insert(row, {label, {}, {}});
    const std::string at = " at " + FormatFixed(event.time, 3) + " s";
    if (event.kind == ContactEventKind::kLost) {
      if (!row->spans.empty()) row->spans.back().to = event.time;
    } else if (event.kind != ContactEventKind::kSlip) {
      row->spans.push_back({event.time, end, 0, std::string(NameOf(event.kind)) + at});
    }
    row->marks.push_back({event.time, RowOf(kContactEvents, event.kind).symbol,
                          std::string(NameOf(event.kind)) + at});
  }
  return MakeFigure(
      name + ", trial " + std::to_string(record.plan.trial) +
          ", contact of each link: T touched, L lost, R regained, S began to slip. Dashed lines: "
          "the phases of the "
          "trial.",
      "links that lose and regain contact, and slip late in the hold; rows are in the order of "
      "contact.",
      MakeScroll(chart.text.title, DrawStripChart(chart)));
}

namespace {

constexpr double kPlotInterval = 0.03;  // a finer resolution would not be visible [s]
constexpr size_t kMaxDrawnCurves = 8;   // in one plot
constexpr const char* kTimeAxis = "time since the start [s]";

std::vector<const TraceInstant*> ChooseShownInstants(const std::vector<TraceInstant>& trace) {
  std::vector<const TraceInstant*> shown;
  for (const TraceInstant& instant : trace) {
    const bool is_last = &instant == &trace.back();
    if (shown.empty() || is_last || instant.time >= shown.back()->time + kPlotInterval - 1e-9) {
      shown.push_back(&instant);
    }
  }
  return shown;
}

class TrialPlotter {
 public:
  TrialPlotter(const Hand& hand, const TracedTrial& traced, std::string name)
      : hand_(hand), name_(std::move(name)), shown_(ChooseShownInstants(traced.trace)) {
    for (const TraceInstant* instant : shown_) times_.push_back(instant->time);
    for (const PhaseStart& phase : traced.result.phases) {
      if (phase.name == NameOf(Phase::kDone)) continue;
      marks_.push_back({phase.time + traced.closure_start, phase.name});
    }
  }

  Html DrawForces() const {
    LinePlot plot = StartPlot("Forces on the object", "normal force [N]");
    const auto add = [&](const std::string& label, const auto& find_force) {
      LinePlot::Series series = StartSeries(label);
      for (const TraceInstant* instant : shown_) series.y.push_back(find_force(*instant));
      const bool is_zero =
          std::all_of(series.y.begin(), series.y.end(), [](double force) { return force == 0.0; });
      if (!is_zero && plot.series.size() < kMaxDrawnCurves)
        plot.series.push_back(std::move(series));
    };
    add("table", [](const TraceInstant& instant) { return instant.table_force; });
    for (int d = -1; d < static_cast<int>(hand_.digits.size()); ++d) {
      add(d < 0 ? "palm" : hand_.digits[static_cast<size_t>(d)].name,
          [&](const TraceInstant& instant) { return CalcDigitForce(hand_, instant, d); });
    }
    return DrawLinePlot(plot);
  }

  /** Draws at most kMaxDrawnCurves joints of one unit. */
  Html DrawJoints(const std::string& of, const std::vector<int>& joints) const {
    const std::string unit = DisplayUnitOf(JointAt(joints[0]));
    LinePlot plot = StartPlot("Joints of the " + of, of + ": position [" + unit + "]");
    for (int j : joints) {
      LinePlot::Series series = StartSeries(JointAt(j).name);
      for (const TraceInstant* instant : shown_) {
        series.y.push_back(ToDisplayUnits(JointAt(j), instant->q[j]));
      }
      plot.series.push_back(std::move(series));
    }
    return DrawLinePlot(plot);
  }

  const HandJoint& JointAt(int joint) const { return hand_.joints[static_cast<size_t>(joint)]; }

 private:
  LinePlot StartPlot(const std::string& what, const std::string& y_axis) const {
    LinePlot plot;
    plot.text.title = what + ", " + name_;
    plot.text.description = what + " over the time of the trial.";
    plot.x_axis = kTimeAxis;
    plot.y_axis = y_axis;
    plot.marks = marks_;
    plot.has_cursor = true;
    return plot;
  }

  LinePlot::Series StartSeries(const std::string& label) const {
    LinePlot::Series series;
    series.label = label;
    series.x = times_;
    return series;
  }

  const Hand& hand_;
  std::string name_;
  std::vector<const TraceInstant*> shown_;
  std::vector<double> times_;
  std::vector<LinePlot::Mark> marks_;
};

}  // namespace

std::vector<Html> DrawTrialPlots(const Hand& hand, const TracedTrial& traced,
                                 const std::string& name) {
  if (traced.trace.empty()) return {};
  const TrialPlotter plotter(hand, traced, name);
  std::vector<Html> plots = {plotter.DrawForces()};
  for (int d = static_cast<int>(hand.digits.size()) - 1; d >= -1; --d) {
    for (const bool is_prismatic : {false, true}) {
      std::vector<int> joints;
      for (int j = 0; j < hand.num_joints(); ++j) {
        const HandJoint& joint = plotter.JointAt(j);
        if (hand.FindDigitOfLink(joint.link) != d || joint.is_prismatic != is_prismatic) continue;
        if (joints.size() < kMaxDrawnCurves) joints.push_back(j);
      }
      const std::string of = d < 0 ? "wrist" : hand.digits[static_cast<size_t>(d)].name;
      if (!joints.empty()) plots.push_back(plotter.DrawJoints(of, joints));
    }
  }
  return plots;
}

Html DrawPhaseStrip(const TracedTrial& traced, const std::string& name) {
  constexpr double kWidth = 640.0, kHeight = 26.0, kRow = 20.0;
  if (traced.trace.empty()) return {};
  const double end = std::max(traced.trace.back().time, traced.trace.front().time + kPlotInterval);
  const auto place = [&](double time) { return kWidth * std::clamp(time / end, 0.0, 1.0); };
  std::vector<std::pair<double, std::string>> phases;  // start, name
  for (const PhaseStart& phase : traced.result.phases) {
    if (phase.name == NameOf(Phase::kDone)) continue;
    phases.emplace_back(phase.time + traced.closure_start, phase.name);
  }
  if (phases.empty() || phases.front().first > 0.0) {
    phases.emplace(phases.begin(), 0.0, NameOf(traced.trace.front().phase));
  }
  Html content;
  for (size_t p = 0; p < phases.size(); ++p) {
    const double left = place(phases[p].first);
    const double right = p + 1 < phases.size() ? place(phases[p + 1].first) : kWidth;
    const std::string hint = phases[p].second + " from " + FormatFixed(phases[p].first, 3) + " s";
    content += Rect("phase", left, 0.0, right - left, kHeight, hint);
    if (CalcLabelWidth({phases[p].second}) > right - left) continue;
    content += Label("middle small", 0.5 * (left + right), 0.5 * kHeight, phases[p].second);
  }
  const std::optional<Diagnosis>& diagnosis = traced.result.diagnosis;
  const bool has_fault = diagnosis && std::isfinite(diagnosis->time);
  if (has_fault) {
    const double x = place(diagnosis->time);
    content += Line("fault", x, 0.0, x, kHeight + 0.5 * kRow);
    content += Label(x < 0.5 * kWidth ? "start small" : "end small",
                     x + (x < 0.5 * kWidth ? 4.0 : -4.0), kHeight + 0.5 * kRow,
                     std::string(NameOf(diagnosis->mechanism)) + " at " +
                         FormatFixed(diagnosis->time, 3) + " s");
  }
  content += DrawCursor(0.0, end, 0.0, kWidth, 0.0, kHeight);
  return Svg("img", kWidth, kHeight + (has_fault ? kRow : 1.0),
             {"Phases, " + name, "The phases of the trial over its time."}, content);
}

std::string MakeTrialSvg(const Hand& hand, const TracedTrial& traced, const std::string& name) {
  constexpr double kWidth = 760.0, kRow = 360.0, kEdge = 16.0;
  const std::vector<Html> plots = DrawTrialPlots(hand, traced, name);
  if (plots.empty()) {
    throw Error(ErrorKind::kUnsupported,
                "the trial has no motion because it could not begin: " + traced.result.reason);
  }
  Html content = Element("style", {}, assets::kStyle);
  for (size_t i = 0; i < plots.size(); ++i) {
    const double y = kEdge + kRow * static_cast<double>(i);
    content +=
        Element("g", {{"transform", "translate(" + Px(kEdge) + " " + Px(y) + ")"}}, plots[i]);
  }
  const std::string height = FormatFixed(2.0 * kEdge + kRow * static_cast<double>(plots.size()), 0);
  return Element("svg",
                 {{"xmlns", "http://www.w3.org/2000/svg"},
                  {"style", "background: var(--page)"},
                  {"viewBox", "0 0 " + FormatFixed(kWidth, 0) + " " + height},
                  {"width", FormatFixed(kWidth, 0)},
                  {"height", height}},
                 Element("title", {}, name) + content)
             .markup() +
         "\n";
}

}  // namespace graspbench
