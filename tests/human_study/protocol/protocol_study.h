#pragma once
/** @file
Studies on disk of the reaches of reaches.h, analysed as a user's: C3D files, study.yaml, RunStudy;
and the counts by which such a study is judged. */

#include <map>
#include <string>
#include <vector>

#include "human_study/study/run/run_study.h"
#include "tests/human_study/protocol/reaches.h"

namespace graspbench::protocol {

struct StudyPlan {
  Conditions conditions;
  ReachMaker make_reach = MakeEverydayReach;
  std::string seed;
  int num_people = 4;
  int trials_per_person = 10;
  bool has_shape = true;    ///< objects.csv has the cylinder; needs object markers
  bool is_y_up = false;     ///< the laboratory's y axis is up, and nobody says so
  double other_rate = 0.0;  ///< of every second trial [Hz]; 0: all have that of the conditions
  std::string settings;     ///< more lines of study.yaml
};

struct Judged {
  StudyResult result;
  std::vector<Reach> truth;  ///< as result.trials
};

/** Writes the study into a folder of its own, runs it and removes the folder. */
Judged RunPlan(const StudyPlan& plan);

struct Accuracy {
  int num_trials = 0, num_kept = 0;
  int num_true_contacts = 0;   ///< of digits that touched, in kept trials
  int num_contacts = 0;        ///< .. found of those
  int num_false_contacts = 0;  ///< of digits that never touched, in kept trials
  /** Wrong by more than 20 ms and by more than stated, in a kept trial without a flag, or with
  "touch not verified" alone, which every trial without a shape has. */
  int num_silent = 0;
  double bias = 0.0, sd = 0.0;          ///< of found - true [s]
  double coverage = 0.0;                ///< share within 1.96 stated uncertainties
  double gft_bias = 0.0, gft_sd = 0.0;  ///< the same of GFT, where all that touched are found [s]
  double median_gft = 0.0;              ///< found [s]
};
/** Contacts against the first touches of the truth; NaN for what has too few of them. */
Accuracy CompareWithTruth(const Judged& judged);

/** "name kept 17 of 18, contacts .." for the log, with the codes of what was removed. */
void Print(const std::string& name, const Judged& judged);

/** Trials by the code of their removal; "" for those that count. */
std::map<std::string, int> CountRemovals(const StudyResult& result);

/** Verdicts on the simultaneity of people in studies that differ in their seed alone. */
struct Verdicts {
  int num_more = 0, num_less = 0, num_not_decided = 0, num_no_difference = 0, num_none = 0;
};
Verdicts CountVerdicts(StudyPlan plan, int num_studies);
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

}  // namespace graspbench::protocol
