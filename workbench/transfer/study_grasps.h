#pragma once
/** @file
Grasps of a study's people, ready for a robot hand: which trials, on which objects, and one of them
as a grasp file. */

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/transfer/transfer_grasp.h"
#include "human_study/study/run/hand_places.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

/** A kept trial, or the median of several. */
struct StudyGrasp {
  std::string id;  ///< of the trial; of a median the participant, or the object
  std::string participant, object;
  Answer<HandPlaces> places;
};

/** Markers this much farther from an object's surface than from that of the others, the median of
persons, are doubted [m]. */
inline constexpr double kHeightDoubt = 0.005;
/** Why the size or the place of an object is doubted, or the side of the hands. */
struct StudyDoubt {
  std::string object;  ///< empty: all
  std::string text;
};

struct StudyGrasps {
  Study study;
  std::vector<StudyGrasp> trials;   ///< the kept ones, in the study's order
  std::vector<StudyGrasp> removed;  ///< with the reason instead of places
  std::vector<StudyDoubt> doubts;
};

/** Runs the study's trials (human_study/study/run/run_study.h). Where trials.csv states the hand, a
trial whose thumb, fingers and palm are those of the other one has no places.
@param data  folder of the recordings; empty: that of study.yaml.
@throws as LoadStudy and RunTrials; Error(kUsage) when no trial is kept. */
StudyGrasps LoadStudyGrasps(const std::string& study_file, const std::string& data);

/** The medians over the trials of a person on an object, in the order of their first trials; of
those with places, or one with the reason where no trial has any. */
std::vector<StudyGrasp> CalcMediansByPerson(const std::vector<StudyGrasp>& trials);

PersonGrasp MakePersonGrasp(const HandPlaces& places);

/** Of people's primitives nobody says what they are made of. */
inline constexpr double kAssumedDensity = 300.0;  ///< [kg/m^3]
inline constexpr double kAssumedFriction = 0.4;   ///< static; dynamic 0.35

/** The object of the study to simulate with: of a sphere, a cylinder or a box a folder is written
below `folder`, named by its id, with kAssumedDensity and kAssumedFriction.
@throws Error(kUsage) for one whose shape the study does not say, or whose id is no plain word;
Error(kNotFound) for one that the study has not; as LoadObject. */
std::shared_ptr<const GraspObject> LoadStudyObject(const Study& study, const std::string& id,
                                                   const std::filesystem::path& folder);
/** It is of the catalogue, and no folder is written. */
bool IsOfCatalogue(const Study& study, const std::string& id);

/** Grasps that a transferred one goes towards and stands beside: the hand's standard ones; of a hand
without any, as after `graspbench hand import`, the best of postures proposed by geometry alone
(core/develop/propose_grasps.h), one for all fingers and one for two, never tried. Empty for a hand
of one digit. @throws as LoadStandardGrasps. */
std::vector<Grasp> FindStandardGrasps(const Hand& hand);

/** The folder of a hand without standard grasps copied to folder/<id>, with FindStandardGrasps in
its hand.yaml. @throws Error(kIo). */
std::filesystem::path CopyWithGrasps(const Hand& hand, const std::filesystem::path& folder);

/** `graspbench new grasp --from`. */
struct NewTransferOptions {
  std::string study, data, hand;
  std::string trial;   ///< empty: the median of all trials on the object
  std::string object;  ///< empty: the trial's, or the study's only one
};
struct NewTransfer {
  std::string file;     ///< content of the grasp file; empty: not transferable
  std::string object;   ///< to run it with: an id, or the folder below the one given
  std::string summary;  ///< what was kept of the person's grasp, and what not
};
/** @param folder  for the object. @throws Error(kNotFound) for a trial or an object that the study
has not; as LoadStudyGrasps, LoadStudyObject, LoadHand. */
NewTransfer MakeNewTransfer(const NewTransferOptions& options, const std::filesystem::path& folder);

}  // namespace graspbench
