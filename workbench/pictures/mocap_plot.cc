#include "workbench/pictures/mocap_plot.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "human_study/recording/cleaning/trajectory.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;

constexpr size_t kNumSteps = 600;
constexpr int kMissing = 0, kFilled = 1;

/** Height and speed of one point, in steps of several frames. */
struct PointCurves {
  std::vector<double> times, heights, speeds;  // NaN: not seen during the whole step
};

double CalcSpeedTo(const Trajectory& path, size_t i) {
  if (i == 0 || !path.IsValid(i) || !path.IsValid(i - 1)) return std::nan("");
  return (path.p.col(static_cast<Column>(i)) - path.p.col(static_cast<Column>(i - 1))).norm() /
         (path.times[i] - path.times[i - 1]);
}

PointCurves MakeCurves(const Trajectory& path) {
  PointCurves curves;
  const size_t step = std::max<size_t>(1, (path.size() + kNumSteps - 1) / kNumSteps);
  for (size_t first = 0; first < path.size(); first += step) {
    const size_t last = std::min(first + step, path.size());
    double height_sum = 0.0, count = 0.0, fastest = std::nan("");
    for (size_t i = first; i < last; ++i) {
      if (!path.IsValid(i)) continue;
      height_sum += path.p(2, static_cast<Column>(i));
      count += 1.0;
      const double speed = CalcSpeedTo(path, i);
      if (!(speed <= fastest) && !std::isnan(speed)) fastest = speed;
    }
    curves.times.push_back(path.times[first]);
    curves.heights.push_back(count > 0.0 ? height_sum / count : std::nan(""));
    curves.speeds.push_back(fastest);
  }
  return curves;
}

/** Spans of samples in one state, each as long as its frames. */
void AddSpans(const Trajectory& path, SampleState state, int kind, StripChart::Row& row) {
  const double frame = path.size() > 1 ? path.times[1] - path.times[0] : 0.0;
  for (size_t first = 0; first < path.size(); ++first) {
    if (path.states[first] != state) continue;
    size_t last = first;
    while (last + 1 < path.size() && path.states[last + 1] == state) ++last;
    const size_t count = last - first + 1;
    row.spans.push_back({path.times[first], path.times[last] + frame, kind,
                         std::to_string(count) + (count == 1 ? " sample" : " samples")});
    first = last;
  }
}

Html DrawCurve(const std::string& label, const char* what, const char* axis, const PointCurves& c,
               const std::vector<double>& values, bool is_from_zero) {
  LinePlot plot;
  plot.text = {label + ": " + what, std::string(what) + " of the point over the recording"};
  plot.x_axis = "time [s]";
  plot.y_axis = axis;
  plot.is_y_from_zero = is_from_zero;
  plot.series.push_back({label, c.times, values, {}, {}});
  return DrawLinePlot(plot);
}

}  // namespace

std::string MakeRecordingPage(const std::string& name, const Recording& recording) {
  StripChart gaps;
  gaps.text = {"Missing and filled samples", "one row per point; bars mark missing samples"};
  gaps.axis = "time [s]";
  gaps.kinds = {"missing", "filled by the recording software"};
  Html points;
  std::vector<PageLink> contents = {{"gaps", "Missing samples"}};
  for (const RecordedPoint& point : recording.points) {
    if (!point.IsLength()) continue;
    const Trajectory path = MakeTrajectory(recording, point.label);
    StripChart::Row row;
    row.label = point.label;
    AddSpans(path, SampleState::kFilled, kFilled, row);
    AddSpans(path, SampleState::kInvalid, kMissing, row);
    gaps.rows.push_back(std::move(row));

    const std::string anchor = MakePlainKey({"point", point.label});
    contents.push_back({anchor, point.label});
    points += Element("section", {{"id", anchor}}, Element("h2", {}, point.label));
    const PointCurves curves = MakeCurves(path);
    if (point.CountStates(SampleState::kInvalid) == path.size()) {
      points += MakeParagraph("Never seen.");
      continue;
    }
    points += DrawCurve(point.label, "height", "z [m]", curves, curves.heights, false);
    points += DrawCurve(point.label, "speed", "speed [m/s]", curves, curves.speeds, true);
  }
  if (gaps.rows.empty()) {
    throw Error(ErrorKind::kFormat,
                "no point of the recording is a position in metres; state the length unit if the "
                "file does not (--unit mm)");
  }
  const Html body =
      Element("section", {{"id", "gaps"}},
              Element("h2", {}, "Missing samples") +
                  MakeFigure("Where each point was not seen",
                             "gaps while the hand closes: contacts found there are guesses",
                             DrawStripChart(gaps))) +
      points;
  return MakePage({name, std::to_string(recording.num_frames) + " frames, " +
                             std::to_string(gaps.rows.size()) + " points, " + recording.format},
                  contents, body);
}

}  // namespace graspbench
