#pragma once
/** @file
The numbers of the argument (argument.h), taken from folders that were run before. Each is that of
the analysis which makes the table behind it:

    people     a study's statistics.csv: its verdict against independent digits and GFT's ratio, of
               five persons or more; synthetic participants decide nothing
    robots     a map's cell of all regions, last digit, success (decides) and threshold; a map that
               is not finished is not decided
    step 1     result.json of optimisations: the median over scenes of GFT after less before, on the
               trials of the check; of the pre-grasp alone (decides), and of what was checked, which
               may make digits wait. Where nothing looked better the standard pre-grasp stays: 0.
    step 2     result.json: the median over scenes of the found target's fitness over the start's, on
               the trials of the check; the thumb alone by sigma with 1,000 evaluations or
               more (decides), and every other search
    success    a campaign's trials of the standard and the new target grasp on the same draws
               (decides); two sessions of a hand and of its "-evolved" grasps on the same draws:
               objects of the catalogue, on which these were evolved (decides), and others

Candidates are judged before they are accepted, so that the rule by which a grasp is accepted does
not flatter the number; how many were accepted stands beside it. The interval of a median is that of
order statistics (threshold_summary.h): six scenes or more. A scene without a number is left out and
counted. */

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "datasets/analysis/argument/argument.h"
#include "datasets/analysis/map/map_result.h"
#include "datasets/campaign/campaign_store.h"

namespace graspbench {

/** What statistics.csv of a study says of GFT against independent digits. */
struct PeopleEvidence {
  std::string folder;
  bool is_synthetic = false;  ///< of graspbench study demo: no person, so it decides nothing
  std::string verdict;        ///< "more simultaneous", .. of statistics.csv
  double ratio = kUnset;
  Interval interval = {kUnset, kUnset};
  double gft = kUnset;         ///< mean [s]
  double detectable = kUnset;  ///< a share less that is found in 8 of 10 such studies
  int num_persons = 0;
  std::string note;
};
/** @param text  of statistics.csv. @param file  its name in messages.
@throws Error(kFormat) for a table that cannot be read, and where it lacks the row: made by an
earlier program. */
PeopleEvidence ReadPeopleEvidence(const std::string& text, const std::string& file);

template <class Result>
struct FromFolder {
  std::string folder;
  Result result;
};

/** What was read. */
struct ArgumentSources {
  std::vector<PeopleEvidence> people;
  std::vector<FromFolder<MapResult>> maps;
  std::vector<FromFolder<SceneRecord>> scenes;  ///< of optimisations and campaigns
  std::vector<FromFolder<Campaign>> campaigns;
  std::vector<FromFolder<Session>> sessions;  ///< that are no maps

  /** "1 study, 2 maps, .." */
  std::string Describe() const;
};
/** A folder that is no result is searched for results.
@throws Error(kNotFound, kUsage) for a folder without any; as the loaders. */
ArgumentSources LoadArgumentSources(const std::vector<std::filesystem::path>& folders);

/** The five claims with their numbers, verdicts and what was not run. */
std::vector<ArgumentClaim> MakeArgument(const ArgumentSources& sources);

/** The numbers of each claim, judged. */
///@{
std::vector<ArgumentNumber> ListPeopleNumbers(const std::vector<PeopleEvidence>& people);
std::vector<ArgumentNumber> ListRobotNumbers(const std::vector<FromFolder<MapResult>>& maps);
std::vector<ArgumentNumber> ListPreGraspNumbers(const std::vector<FromFolder<SceneRecord>>& scenes);
std::vector<ArgumentNumber> ListTargetNumbers(const std::vector<FromFolder<SceneRecord>>& scenes);
std::vector<ArgumentNumber> ListSuccessNumbers(const ArgumentSources& sources);
///@}

}  // namespace graspbench
