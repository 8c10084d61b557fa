#pragma once
/** @file
A study on disk whose reaches come from protocol_reach.h, and how far its analysis is from their
truth. Everything goes the way of a user's data: C3D files, study.yaml, RunStudy. */

#include <filesystem>
#include <string>
#include <vector>

#include "human_study/study/run/run_study.h"
#include "tests/human_study/protocol/protocol_reach.h"

namespace graspbench::protocol {

struct StudyPlan {
  ReachConditions conditions;
  std::string seed;
  int num_people = 4;
  int trials_per_person = 10;
  bool has_shape = true;  ///< objects.csv tells the cylinder; needs object markers
  bool is_y_up = false;   ///< the laboratory's y axis is up, and nobody says so
  std::string settings;   ///< more lines of study.yaml
};

/** Writes the study into an empty folder and returns the truth, in the order of trials.csv. */
std::vector<Reach> WriteStudy(const StudyPlan& plan, const std::filesystem::path& folder);

struct Accuracy {
  int num_trials = 0;
  int num_kept = 0;
  int num_true_contacts = 0;   ///< of the trials that are kept
  int num_contacts = 0;        ///< .. found of those
  int num_false_contacts = 0;  ///< of digits that never touched, in trials that are kept
  double bias = 0.0;           ///< mean of found - true over contacts [s]
  double sd = 0.0;             ///< [s]
  /** Share of errors within 1.96 stated uncertainties. */
  double coverage = 0.0;
  double gft_bias = 0.0;  ///< mean of found - true GFT, trials in which all that touched are found
  double gft_sd = 0.0;    ///< [s]
  double median_gft = 0.0;   ///< found [s]
  double zero_median = 0.0;  ///< ZeroGft::median of the study [s]
  double zero_limit = 0.0;   ///< ZeroGft::limit [s]
};

Accuracy CompareWithTruth(const StudyResult& result, const std::vector<Reach>& truth);

/** Writes, runs and compares in a folder of its own below `scratch`, which is removed. */
Accuracy Measure(const StudyPlan& plan, const std::filesystem::path& scratch);

}  // namespace graspbench::protocol
