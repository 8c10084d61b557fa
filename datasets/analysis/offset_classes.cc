#include "datasets/analysis/offset_classes.h"

#include <algorithm>
#include <cmath>

#include "datasets/plan/session_plan.h"

namespace graspbench {
namespace {

constexpr int kNumClasses = 4;
constexpr char kPositioning[] = "positioning=";

/** The positionings, each with the outcome of a trial under it. */
struct PositionedTrials {
  std::string name;
  const VariedTrials* trials = nullptr;  // null: the session's own
};

std::vector<PositionedTrials> ListPositionedTrials(const Session& session,
                                                   const SensitivityData& varied) {
  std::vector<PositionedTrials> all = {{session.config.positioning, nullptr}};
  for (const auto& [setting, trials] : varied) {
    if (setting.rfind(kPositioning, 0) != 0) continue;
    all.push_back({setting.substr(sizeof kPositioning - 1), &trials});
  }
  return all;
}

int FindClass(const SessionConfig& config, const PlannedTrial& plan, double width) {
  const TrialDraw draw = MakeObjectDraw(config, plan.object, plan.trial);
  const double offset = std::hypot(draw.offset_x, draw.offset_y);
  return std::min(static_cast<int>(offset / width), kNumClasses - 1);
}

}  // namespace

std::vector<OffsetClass> ListOffsetClasses(const Session& session, const SensitivityData& varied) {
  const double width = std::sqrt(2.0) * session.config.variation.offset / kNumClasses;
  std::vector<OffsetClass> classes;
  if (!(width > 0.0)) return classes;
  const std::vector<PositionedTrials> positionings = ListPositionedTrials(session, varied);
  for (const TrialRecord& record : session.records) {
    const std::string& hand = record.plan.hand;
    auto first = std::find_if(classes.begin(), classes.end(),
                              [&](const OffsetClass& c) { return c.hand == hand; });
    if (first == classes.end()) {
      const auto place = classes.size();
      for (const PositionedTrials& positioning : positionings) {
        for (int i = 0; i < kNumClasses; ++i) {
          classes.push_back({hand, positioning.name, width * i, width * (i + 1), Tally()});
        }
      }
      first = classes.begin() + static_cast<std::ptrdiff_t>(place);
    }
    auto found = first + FindClass(session.config, record.plan, width);
    for (const PositionedTrials& positioning : positionings) {
      if (!positioning.trials) {
        found->tally.Count(record.result.outcome);
      } else if (const auto trial = positioning.trials->find(record.plan.id);
                 trial != positioning.trials->end() && trial->second.outcome != Outcome::kNotRun) {
        found->tally.Count(trial->second.outcome);
      }
      found += kNumClasses;
    }
  }
  return classes;
}

}  // namespace graspbench
