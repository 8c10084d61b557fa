#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/version.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/plots/svg_parts.h"

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
         FormatFixed(DegFromRad(sample.yaw), 1) + " deg: " + WordsOf(sample.outcome) +
         (sample.outcome == Outcome::kSuccess ? ", sigma " + FormatFixed(sample.sigma, 2) + " N"
                                              : "");
}

/** Draws a disc with this share of the largest disc's area; draws a cross for a share of 0 or
less. */
Html DrawSample(const BasinSample& sample, double left, double share, const std::string& text) {
  const double x = left + 0.5 * kPanel * (1.0 + sample.offset_x / kBasinOffset);
  const double y = kTop + 0.5 * kPanel * (1.0 - sample.offset_y / kBasinOffset);
  const Html hint = Hint(text);
  if (!(share > 0.0)) {
    return Element("path",
                   {{"class", "cross"},
                    {"d", "M" + Px(x - 3.2) + " " + Px(y - 3.2) + "l6.4 6.4m0 -6.4l-6.4 6.4"}},
                   hint);
  }
  const double r = std::max(kSmallDot, kLargeDot * std::sqrt(share));
  return Element("circle", {{"class", "dot"}, {"cx", Px(x)}, {"cy", Px(y)}, {"r", Px(r)}}, hint);
}

/** Size and text of one sample's mark in a map. */
struct SampleMark {
  double share = 0.0;
  std::string text;
};

Html DrawMap(const std::vector<BasinSample>& samples, const std::vector<SampleMark>& marks,
             const PlotText& text) {
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
    for (size_t i = 0; i < samples.size(); ++i) {
      if (FindSlice(samples[i]) != slice) continue;
      content += DrawSample(samples[i], left, marks[i].share, marks[i].text);
    }
  }
  return Svg("img", 40.0 + kNumSlices * (kPanel + kGap), kTop + kPanel + kBottom, text, content);
}

struct BasinView {
  const BasinPageData& data;
  BasinSummary summary;
};

/** Draws successes as discs whose area grows with sigma. */
Html DrawSigmaMap(const BasinView& view) {
  std::vector<SampleMark> marks;
  for (const BasinSample& sample : view.data.samples) {
    const double most = view.summary.most_sigma;
    const double share = most > 0.0 ? std::fmax(sample.sigma / most, 1e-3) : 1e-3;
    marks.push_back({sample.outcome == Outcome::kSuccess ? share : 0.0, DescribeSample(sample)});
  }
  return DrawMap(
      view.data.samples, marks,
      {"Success by the object's offset",
       "Offsets in x and y in three slices of yaw; discs are successes, crosses are failures."});
}

/** Draws discs whose area falls with the threshold; the smallest grip margin has the largest
disc. */
Html DrawBasinThresholdMap(const BasinView& view) {
  std::vector<SampleMark> marks;
  for (size_t i = 0; i < view.data.samples.size(); ++i) {
    const double threshold = view.data.thresholds[i];
    const std::string name = FormatThreshold(kThresholdScales[0], threshold);
    marks.push_back({std::isfinite(threshold) ? kThresholdScales[0].least / threshold : 0.0,
                     "sample " + std::to_string(i) + ": margin " + name});
  }
  return DrawMap(view.data.samples, marks,
                 {"Grip threshold by the object's offset",
                  "Offsets in x and y in three slices of yaw; large discs succeed with a small "
                  "margin, crosses with no tested margin."});
}

Html DrawBasinThresholds(const BasinView& view) {
  if (view.data.thresholds.empty()) {
    return Element("p", {},
                   Text("The grip threshold per offset was not determined; ") +
                       Element("code", {}, "graspbench threshold") +
                       Text(" with the folder of the basin adds it here."));
  }
  return MakeFigure(
      "The smallest margin with which the trial from each offset succeeds. Large discs need a "
      "small margin. Crosses succeed with no tested margin or were not tested.",
      "discs that shrink towards an edge: only a stronger grip holds there.",
      MakeScroll("Grip threshold by the object's offset", DrawBasinThresholdMap(view)));
}

Html DrawRadius(const BasinView& view) {
  const BasinSummary& summary = view.summary;
  const Html sentence =
      Element("p", {{"class", "verdict"}},
              view.data.title + ": basin radius " + FormatFixed(summary.radius, 2) +
                  " of at most 1. Every offset that was tried within " +
                  FormatFixed(MmFromM(summary.radius_offset), 1) + " mm and " +
                  FormatFixed(DegFromRad(summary.radius_yaw), 1) +
                  " degrees (an ellipsoid) succeeded; more samples can only lower this radius. In "
                  "the whole box " +
                  summary.rate + " succeeded.");
  return sentence +
         MakeFigure(
             "The object's offset from where the hand expects it, y upwards [mm]; joints without "
             "error. Discs are successes, their area is sigma (the largest " +
                 FormatFixed(summary.most_sigma, 1) + " N); crosses are failures.",
             "crosses near the centre; crosses on one side only (the hand should move to that "
             "side); discs that shrink towards an edge.",
             MakeScroll("Success by the object's offset", DrawSigmaMap(view)));
}

Html DrawSamples(const BasinView& view) {
  Table table("All tested offsets; basin.csv has the exact values.",
              {"Sample",
               "x [mm]",
               "y [mm]",
               "Yaw [deg]",
               {"Distance", "1 at the edge of the range"},
               "Outcome",
               "sigma [N]"});
  int count = 0;
  for (const BasinSample& sample : view.data.samples) {
    table.AddRow({count++, FormatFixed(MmFromM(sample.offset_x), 1),
                  FormatFixed(MmFromM(sample.offset_y), 1), FormatFixed(DegFromRad(sample.yaw), 1),
                  FormatFixed(CalcBasinDistance(sample), 2), WordsOf(sample.outcome),
                  FormatFixed(sample.sigma, 2)});
  }
  return MakeDetails("All values of " + FormatCount(count, "sample"), table.ToHtml());
}

Html DrawBasinFindings(const BasinView& view) {
  std::vector<std::string> findings;
  const std::vector<BasinSample>& samples = view.data.samples;
  const auto count = [&](Outcome outcome) {
    return static_cast<int>(
        std::count_if(samples.begin(), samples.end(),
                      [&](const BasinSample& sample) { return sample.outcome == outcome; }));
  };
  if (const int failures = count(Outcome::kNumericalFailure); failures > 0) {
    findings.push_back(FormatCount(failures, "sample") +
                       " failed numerically; numerical failures count as failures of the grasp.");
  }
  if (const int nonsense = count(Outcome::kNotPhysical); nonsense > 0) {
    findings.push_back(FormatCount(nonsense, "sample") + (nonsense == 1 ? " was" : " were") +
                       " not physical, which does not count as a success.");
  }
  if (!samples.empty() && samples.front().outcome != Outcome::kSuccess) {
    findings.push_back("The grasp fails even without an offset, so the radius is 0.");
  }
  return findings.empty() ? MakeParagraph("No errors and no warnings.") : MakeList(findings);
}

Html DrawBasinMethods(const BasinView& view) {
  return MakeMethodsText(
      {"The robustness of one grasp (" + view.data.title +
       ") to the object's position was mapped in simulation with graspbench " +
       std::string(program_version()) + ": " + FormatCount(view.summary.num_samples, "trial") +
       ", the first without offset, the others "
       "at the points of a Halton sequence (bases 2, 3 and 5) in a box of +-" +
       FormatFixed(MmFromM(kBasinOffset), 0) + " mm along both horizontal axes and +-" +
       FormatFixed(DegFromRad(kBasinYaw), 0) +
       " degrees about the vertical, joints without error. "
       "The basin radius is the distance of the nearest failure, 1 at the edge of the box."});
}

}  // namespace

std::string MakeBasinPage(const BasinPageData& data) {
  static const std::vector<PageSection<BasinView>> sections = {
      {"result", "Result", &DrawRadius},
      {"thresholds", "The smallest grip that holds", &DrawBasinThresholds},
      {"samples", "Samples", &DrawSamples},
      {"findings", "Errors and warnings", &DrawBasinFindings},
      {"methods", "Methods", &DrawBasinMethods}};
  PageFrame frame = {"Robustness basin", data.title};
  frame.commands.push_back(data.command);
  frame.facts.emplace_back("Samples", std::to_string(data.samples.size()));
  frame.references = {"sherman2011", "halton1960", "wilson1927"};
  return MakeSectionedPage(frame, sections, BasinView{data, SummariseBasin(data.samples)});
}

std::string MakeBasinPage(const Session& session) {
  const SessionModels models = LoadSessionModels(session);
  const PlannedTrial& planned = session.plan.front();
  std::vector<double> thresholds;
  for (const ThresholdSummary& summary : LoadThresholds(session)) {
    if (summary.scale->mode == GripMode::kMargin) {
      thresholds = ListThresholdsOf(session, summary);
    }
  }
  return MakeBasinPage({models.NameOfHand(planned.hand) + ", " +
                            models.NameOfObject(planned.object) + ", " + planned.grasp,
                        "graspbench run DIR/session.json --out ANOTHER", ListBasinSamples(session),
                        thresholds});
}

}  // namespace graspbench
