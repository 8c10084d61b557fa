#pragma once
/** @file
Studies on disk of the reaches of everyday_reach.h, analysed as a user's: C3D files, study.yaml,
RunStudy; and the counts by which such a study is judged. */

#include <filesystem>
#include <string>
#include <vector>

#include "human_study/study/run/run_study.h"
#include "tests/human_study/protocol/everyday_reach.h"

namespace graspbench::everyday {

/** MakeReach, or another generator that takes the same conditions. */
using ReachMaker = Reach (*)(const Conditions& conditions, const std::string& id, int trial);

struct StudyPlan {
  Conditions conditions;
  ReachMaker make_reach = MakeReach;
  std::string seed;
  int num_people = 4;
  int trials_per_person = 10;
  bool has_shape = true;    ///< objects.csv has the cylinder
  double other_rate = 0.0;  ///< of every second trial [Hz]; 0: all have that of the conditions
  std::string settings;     ///< more lines of study.yaml
};

struct Judged {
  StudyResult result;
  std::vector<Reach> truth;  ///< as result.trials
};

/** Writes, runs and removes the study below `scratch`. */
Judged RunPlan(const StudyPlan& plan, const std::filesystem::path& scratch);

struct Accuracy {
  int num_trials = 0, num_kept = 0;
  int num_contacts = 0;       ///< found in kept trials
  int num_true_contacts = 0;  ///< of digits that touched, in kept trials
  /** Wrong by more than 20 ms in a kept trial without a flag, or with "touch not verified" alone,
  which every trial without a shape has. */
  int num_silent = 0;
  double bias = 0.0, sd = 0.0;  ///< of found - true [s]
  double coverage = 0.0;        ///< share within 1.96 stated uncertainties
};
/** Contacts against the first touches of the truth. */
Accuracy CompareWithTruth(const Judged& judged);

/** Verdicts on the simultaneity of people in studies that differ in their seed alone. */
struct Verdicts {
  int num_more = 0, num_less = 0, num_not_decided = 0, num_no_difference = 0, num_none = 0;
};
Verdicts CountVerdicts(StudyPlan plan, int num_studies, const std::filesystem::path& scratch);
/** The same quickly: the movement from the recorded wrist, touches and widest opening from the truth
with errors of 4 and 10 ms (SD), which are stated. */
Verdicts CountVerdictsOfEvents(StudyPlan plan, int num_studies);

/** What independent digits must not be mistaken in, by name: profiles, distances, ends, drifts,
lags. */
struct NamedPlan {
  std::string name;
  StudyPlan plan;
};
std::vector<NamedPlan> ListIndependentPeople();
/** Digits that share a delay of 60 ms (SD), with profiles that leave the clock at most half that. */
std::vector<NamedPlan> ListCoordinatedPeople();

}  // namespace graspbench::everyday
