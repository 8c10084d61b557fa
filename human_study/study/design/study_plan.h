#pragma once
/** @file
Plans a study: the numbers of persons and trials needed to show a difference, from stated variances
or from those of a pilot (power.h).

From the pilot's trials at two levels of one column, the trial variance is pooled within persons and
conditions. The variance of the persons' differences (a factor within persons) or means (a group) is
the observed one minus the share of the trials, at least zero. The difference to be shown is never
that of the pilot: differences found in a small study are too large on average.

A pilot's variances are imprecise. The power is therefore also given over 1,000 draws of the
variances: each observed variance times df / chi squared. */

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "human_study/statistics/power.h"

namespace graspbench {

struct PilotQuestion {
  std::string measure = "grasp_forming_time_s";
  std::string factor;               ///< column of the pilot's tidy.csv; empty: the first factor
  std::vector<std::string> levels;  ///< two levels; empty: the first and the last
};

struct Pilot {
  std::string factor, level_a, level_b;
  bool is_between = false;
  int num_persons = 0;      ///< of both groups together, if there are groups
  int num_trials = 0;       ///< at both levels
  double difference = 0.0;  ///< observed b - a; not to be used for planning
  double mean = 0.0;        ///< of the persons
  double trial_variance = 0.0, trial_df = 0.0;
  double observed_variance = 0.0, observed_df = 0.0;  ///< observed, of differences or means
  double trial_share = 0.0;  ///< the trials' part of it, in units of trial_variance

  PowerDesign MakeDesign(double difference) const;
};

/** Loads a pilot. @param folder  results of `graspbench study run`.
@throws Error(kNotFound, kFormat) naming what is missing and which names exist. */
Pilot LoadPilot(const std::filesystem::path& folder, const PilotQuestion& question);

struct PlanRow {
  int num_trials = 0;                  ///< per person and condition
  Answer<int> num_persons;             ///< per group, if there are groups
  PowerEstimate power;                 ///< for these numbers
  std::optional<Interval> over_pilot;  ///< 95 % range over draws of the pilot's variances
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

/** Makes the plan. @throws Error(kUsage) for an invalid request: no difference, no variance, or a
difference that is implausible for reaching. */
StudyPlan MakeStudyPlan(const PlanRequest& request);

}  // namespace graspbench
