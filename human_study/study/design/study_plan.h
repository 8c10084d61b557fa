#pragma once
/** @file
How many persons and trials a study needs to show a difference, before it is made: from stated
variances, or from those of a pilot's results (power.h).

Of the pilot's trials at two levels of one column the spread of trials is pooled within persons and
conditions; persons' differences (a factor that varies within persons) or means (a group) have the
variance that remains when their trials' share is taken off, zero where nothing does. The difference
to be shown is never the pilot's own: a difference that a small study finds is too large on average.

A pilot knows its variances badly. The power is therefore also given over 1,000 draws of what they
may be: each observed variance times df / chi squared. */

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "human_study/statistics/power.h"

namespace graspbench {

struct PilotQuestion {
  std::string measure = "grasp_forming_time_s";
  std::string factor;               ///< column of the pilot's tidy.csv; empty: its first
  std::vector<std::string> levels;  ///< two of them; empty: the first and the last
};

struct Pilot {
  std::string factor, level_a, level_b;
  bool is_between = false;
  int num_persons = 0;      ///< of both groups, where there are groups
  int num_trials = 0;       ///< at both levels
  double difference = 0.0;  ///< its own, b - a: not to be planned with
  double mean = 0.0;        ///< of the persons
  double trial_variance = 0.0, trial_df = 0.0;
  double observed_variance = 0.0, observed_df = 0.0;  ///< of differences or means as observed
  double trial_share = 0.0;  ///< of the observed variance, in units of trial_variance

  PowerDesign MakeDesign(double difference) const;
};

/** @param folder  of `graspbench study run`. @throws Error(kNotFound, kFormat) with what is missing
and which names exist. */
Pilot LoadPilot(const std::filesystem::path& folder, const PilotQuestion& question);

struct PlanRow {
  int num_trials = 0;                  ///< of a person and condition
  Answer<int> num_persons;             ///< of each group, where there are groups
  PowerEstimate power;                 ///< with that many
  std::optional<Interval> over_pilot;  ///< 95 % of the draws of the pilot's variances
};

struct StudyPlan {
  PowerDesign design;
  double wanted = 0.8;
  std::vector<PlanRow> rows;
};

struct PlanRequest {
  double difference = 0.0;
  double wanted = 0.8;
  std::vector<int> trials = {1, 2, 5, 10, 20};
  int num_persons = 0;  ///< 0: as many as `wanted` needs
  std::string measure = "grasp_forming_time_s";
  PowerDesign stated;  ///< variances, without a pilot
  std::optional<Pilot> pilot;
};

/** @throws Error(kUsage) for a request that makes no sense: no difference, no variance, a
difference that is no reaching hand's. */
StudyPlan MakeStudyPlan(const PlanRequest& request);

}  // namespace graspbench
