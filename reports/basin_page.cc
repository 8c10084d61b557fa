#include "reports/basin_page.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "datasets/analysis/basin_summary.h"
#include "reports/layout.h"
#include "reports/svg_parts.h"

namespace graspbench {
namespace {

constexpr int kNumSlices = 3;
constexpr double kPanel = 210.0, kGap = 36.0, kTop = 24.0, kBottom = 44.0;
constexpr double kSmallDot = 1.5, kLargeDot = 7.0;

int FindSlice(const BasinSample& sample) {
  const double share = 0.5 * (sample.yaw / kBasinYaw + 1.0);
  return std::clamp(static_cast<int>(kNumSlices * share), 0, kNumSlices - 1);
}

std::string DescribeSample(const BasinSample& sample) {
  return FormatFixed(MmFromM(sample.offset_x), 1) + ", " +
         FormatFixed(MmFromM(sample.offset_y), 1) + " mm, " +
         FormatFixed(DegFromRad(sample.yaw), 1) + " deg: " + NameOf(sample.outcome) +
         (sample.outcome == Outcome::kSuccess ? ", sigma " + FormatFixed(sample.sigma, 2) + " N"
                                              : "");
}

/** Successes are discs whose area grows with sigma, failures crosses. */
Html DrawSample(const BasinSample& sample, double left, double most_sigma) {
  const double x = left + 0.5 * kPanel * (1.0 + sample.offset_x / kBasinOffset);
  const double y = kTop + 0.5 * kPanel * (1.0 - sample.offset_y / kBasinOffset);
  const Html hint = Hint(DescribeSample(sample));
  if (sample.outcome != Outcome::kSuccess) {
    return Element("path",
                   {{"class", "cross"},
                    {"d", "M" + Px(x - 3.2) + " " + Px(y - 3.2) + "l6.4 6.4m0 -6.4l-6.4 6.4"}},
                   hint);
  }
  const double share = most_sigma > 0.0 ? sample.sigma / most_sigma : 0.0;
  const double r = std::max(kSmallDot, kLargeDot * std::sqrt(share));
  return Element("circle", {{"class", "dot"}, {"cx", Px(x)}, {"cy", Px(y)}, {"r", Px(r)}}, hint);
}

Html DrawMap(const std::vector<BasinSample>& samples, double most_sigma) {
  Html content;
  for (int slice = 0; slice < kNumSlices; ++slice) {
    const double left = 40.0 + slice * (kPanel + kGap);
    const double edge = DegFromRad(kBasinYaw), width = 2.0 * edge / kNumSlices;
    content += Label("middle", left + 0.5 * kPanel, 0.5 * kTop,
                     "yaw " + FormatFixed(-edge + slice * width, 0) + " to " +
                         FormatFixed(-edge + (slice + 1) * width, 0) + " deg");
    for (const double share : {0.0, 0.5, 1.0}) {
      const double place = share * kPanel;
      content += Line("grid", left + place, kTop, left + place, kTop + kPanel);
      content += Line("grid", left, kTop + place, left + kPanel, kTop + place);
      const double value = MmFromM(kBasinOffset) * (2.0 * share - 1.0);
      content += Label("middle small", left + place, kTop + kPanel + 11.0, FormatFixed(value, 0));
      if (slice == 0) {
        content +=
            Label("end small", left - kPlotGap, kTop + kPanel - place, FormatFixed(value, 0));
      }
    }
    content += Label("middle small", left + 0.5 * kPanel, kTop + kPanel + 29.0, "x [mm]");
    for (const BasinSample& sample : samples) {
      if (FindSlice(sample) == slice) content += DrawSample(sample, left, most_sigma);
    }
  }
  const PlotText text = {"Success by the object's offset",
                         "Offsets in x and y in three slices of yaw; discs are successes, crosses "
                         "failures."};
  return Svg("img", 40.0 + kNumSlices * (kPanel + kGap), kTop + kPanel + kBottom, text, content);
}

}  // namespace

std::string MakeBasinPage(const std::string& title, const std::vector<BasinSample>& samples) {
  const BasinSummary summary = SummariseBasin(samples);
  const Html body =
      MakeParagraph(
          "Basin radius " + FormatFixed(summary.radius, 2) +
          " of at most 1: every offset that was tried within " +
          FormatFixed(MmFromM(summary.radius_offset), 1) + " mm and " +
          FormatFixed(DegFromRad(summary.radius_yaw), 1) +
          " degrees (an ellipsoid) succeeded; more samples can only lower it. In the whole box " +
          summary.rate + " succeeded.") +
      MakeFigure(
          "The object's offset from where the hand expects it, y upwards [mm]; joints without "
          "error. Discs are successes, their area is sigma (the largest " +
              FormatFixed(summary.most_sigma, 1) + " N); crosses are failures.",
          "crosses near the middle; crosses on one side only: the hand should stand farther to "
          "that side; discs that shrink towards an edge.",
          MakeScroll("Success by the object's offset", DrawMap(samples, summary.most_sigma)));
  return MakePage("Robustness basin", title, {}, body);
}

}  // namespace graspbench
