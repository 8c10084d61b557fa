#pragma once
/** @file
The numbers of the argument (argument.h), read from existing result folders. Each is the result of
the analysis that makes the underlying table:

    people     a study's statistics.csv: its verdict against independent digits and the ratio of
               GFT, with at least five persons; synthetic participants decide nothing
    robots     a map's cell over all regions, last digit: success (decides) and threshold; an
               unfinished map is not decided
    step 1     result.json of optimisations: median over scenes of GFT after minus before, in the
               trials of the check; of the pre-grasp alone (decides), and of the checked candidate,
               which may delay digits. Where no candidate was better, the change is 0.
    step 2     result.json: median over scenes of the ratio of the found target's fitness to the
               start's, in the trials of the check; the thumb alone by sigma with at least 1,000
               evaluations (decides), and every other search
    success    a campaign's trials of the standard and the new target grasp on the same draws
               (decides); two sessions of a hand with and without "-evolved" grasps on the same
               draws: catalogue objects, on which these were evolved (decides), and others

Candidates are evaluated before acceptance, so that the acceptance rule does not bias the number;
the number accepted is reported with it. The interval of a median is that of order statistics
(threshold_summary.h) and needs at least six scenes. A scene without a number is left out and
counted. */

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "datasets/analysis/argument/argument.h"
#include "datasets/analysis/map/map_result.h"
#include "datasets/campaign/campaign_store.h"

namespace graspbench {

/** A study's result for GFT against independent digits, from statistics.csv. */
struct PeopleEvidence {
  std::string folder;
  bool is_synthetic = false;  ///< from graspbench study demo: no real person, decides nothing
  std::string verdict;        ///< as in statistics.csv: "more simultaneous", ..
  double ratio = kUnset;
  Interval interval = {kUnset, kUnset};
  double gft = kUnset;         ///< mean [s]
  double detectable = kUnset;  ///< relative reduction that is detected with 80 % power
  int num_persons = 0;
  std::string note;
};
/** Reads the evidence from statistics.csv. @param text  of the file. @param file  its name in
messages.
@throws Error(kFormat) for a table that cannot be read, or that lacks the row because an earlier
program made it. */
PeopleEvidence ReadPeopleEvidence(const std::string& text, const std::string& file);

template <class Result>
struct FromFolder {
  std::string folder;
  Result result;
};

/** The results that were read. */
struct ArgumentSources {
  std::vector<PeopleEvidence> people;
  std::vector<FromFolder<MapResult>> maps;
  std::vector<FromFolder<SceneRecord>> scenes;  ///< from optimisations and campaigns
  std::vector<FromFolder<Campaign>> campaigns;
  std::vector<FromFolder<Session>> sessions;  ///< except maps

  /** Returns "1 study, 2 maps, ..". */
  std::string Describe() const;
};
/** Loads all results. A folder that is not a result is searched for results.
@throws Error(kNotFound, kUsage) for a folder without any; as the loaders. */
ArgumentSources LoadArgumentSources(const std::vector<std::filesystem::path>& folders);

/** Returns the five claims with their numbers, verdicts and what was not run. */
std::vector<ArgumentClaim> MakeArgument(const ArgumentSources& sources);

/** List the numbers of each claim, with verdicts. */
///@{
std::vector<ArgumentNumber> ListPeopleNumbers(const std::vector<PeopleEvidence>& people);
std::vector<ArgumentNumber> ListRobotNumbers(const std::vector<FromFolder<MapResult>>& maps);
std::vector<ArgumentNumber> ListPreGraspNumbers(const std::vector<FromFolder<SceneRecord>>& scenes);
std::vector<ArgumentNumber> ListTargetNumbers(const std::vector<FromFolder<SceneRecord>>& scenes);
std::vector<ArgumentNumber> ListSuccessNumbers(const ArgumentSources& sources);
///@}

}  // namespace graspbench
