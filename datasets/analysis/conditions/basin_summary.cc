#include "datasets/analysis/conditions/basin_summary.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/csv.h"
#include "core/statistics/proportion.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {
double CalcBasinDistance(const BasinSample& sample) {
  return std::hypot(sample.offset_x / kBasinOffset, sample.offset_y / kBasinOffset,
                    sample.yaw / kBasinYaw);
}

double CalcBasinRadius(const std::vector<BasinSample>& samples) {
  double radius = 1.0;
  for (const BasinSample& sample : samples) {
    if (sample.outcome != Outcome::kSuccess) {
      radius = std::min(radius, CalcBasinDistance(sample));
    }
  }
  return radius;
}

BasinSummary SummariseBasin(const std::vector<BasinSample>& samples) {
  BasinSummary summary;
  summary.num_samples = static_cast<int>(samples.size());
  for (const BasinSample& sample : samples) {
    summary.num_successes += sample.outcome == Outcome::kSuccess;
    summary.most_sigma = std::fmax(summary.most_sigma, sample.sigma);
  }
  summary.radius = CalcBasinRadius(samples);
  summary.radius_offset = summary.radius * kBasinOffset;
  summary.radius_yaw = summary.radius * kBasinYaw;
  summary.rate = FormatRate(summary.num_successes, summary.num_samples);
  return summary;
}

bool IsBasin(const Session& session) { return session.config.draws == "halton"; }

std::vector<BasinSample> ListBasinSamples(const Session& session) {
  std::vector<BasinSample> samples;
  for (const TrialRecord& record : session.records) {
    const TrialDraw draw = MakeObjectDraw(session.config, record.plan.object, record.plan.trial);
    samples.push_back({draw.offset_x, draw.offset_y, draw.offset_yaw, record.result.outcome,
                       record.result.stability.sigma});
  }
  return samples;
}

std::string NameBasin(const SessionInputs& inputs, const PlannedTrial& planned) {
  return inputs.hands.front().hand->name + ", " + inputs.objects.front()->name + ", " +
         planned.grasp;
}

namespace {

std::vector<CsvColumn<BasinSample>> ListBasinColumns() {
  return {{"offset_x_m", "m", "of the object", &BasinSample::offset_x},
          {"offset_y_m", "m", "of the object", &BasinSample::offset_y},
          {"yaw_rad", "rad", "of the object", &BasinSample::yaw},
          {"distance", "", "1 at the edge of the range", CalcBasinDistance},
          {"outcome", "", "how the trial ended",
           [](const BasinSample& sample) { return NameOf(sample.outcome); }},
          {"sigma", "N", "stability", &BasinSample::sigma}};
}

}  // namespace

std::string FormatBasinCsv(const std::vector<BasinSample>& samples) {
  return FormatCsv(ListBasinColumns(), samples);
}

Json MakeBasinSchema() { return MakeTableSchema(ListBasinColumns(), ""); }

}  // namespace graspbench
