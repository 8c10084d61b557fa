#include "reports/plots/contact_strip.h"

#include <algorithm>

#include "core/base/text/text.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"

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
      "links that let go and come back, slip late in the hold; rows stand in the order of contact.",
      MakeScroll(chart.text.title, DrawStripChart(chart)));
}

}  // namespace graspbench
