#pragma once
/** @file
Grasps of a study's participants, prepared for transfer to a robot hand: trials, objects, and one
grasp as a grasp file. */

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/transfer/transfer_grasp.h"
#include "human_study/study/run/hand_places.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

/** An included trial, or the median of several. */
struct StudyGrasp {
  std::string id;  ///< trial id; for a median the participant or the object
  std::string participant, object;
  Answer<HandPlaces> places;
};

/** Difference in marker distance between an object's surface and the other objects' (median over
participants) above which the object's data are doubted [m]. */
inline constexpr double kHeightDoubt = 0.005;
/** Reason to doubt an object's size or position, or the side of the hands. */
struct StudyDoubt {
  std::string object;  ///< empty: all
  std::string text;
};

struct StudyGrasps {
  Study study;
  std::vector<StudyGrasp> trials;   ///< included trials, in the study's order
  std::vector<StudyGrasp> removed;  ///< removed trials, with the reason instead of places
  std::vector<StudyDoubt> doubts;
};

/** Runs the study's trials (human_study/study/run/run_study.h). Where trials.csv states the hand, a
trial whose thumb, fingers and palm are those of the other hand has no places.
@param data  folder of the recordings; empty: that of study.yaml.
@throws as LoadStudy and RunTrials; Error(kUsage) when no trial is included. */
StudyGrasps LoadStudyGrasps(const std::string& study_file, const std::string& data);

/** Computes the median of each participant's trials on each object, in the order of their first
trials. Only trials with places enter; where none has any, the result holds the reason. */
std::vector<StudyGrasp> CalcMediansByPerson(const std::vector<StudyGrasp>& trials);

PersonGrasp MakePersonGrasp(const HandPlaces& places);

/** Assumed material of a study's primitive shapes, for which the study states none. */
inline constexpr double kAssumedDensity = 300.0;  ///< [kg/m^3]
inline constexpr double kAssumedFriction = 0.4;   ///< static; the dynamic one is 0.35

/** Loads an object of the study for simulation. For a sphere, a cylinder or a box, an object folder
is written below `folder`, named by its id, with kAssumedDensity and kAssumedFriction.
@throws Error(kUsage) for an object whose shape the study does not state or whose id is not a plain
word; Error(kNotFound) for an object that the study lacks; as LoadObject. */
std::shared_ptr<const GraspObject> LoadStudyObject(const Study& study, const std::string& id,
                                                   const std::filesystem::path& folder);
/** Whether the object is from the catalogue, so that no folder is written. */
bool IsOfCatalogue(const Study& study, const std::string& id);

/** Returns the grasps that guide a transfer and with which its result is compared: the hand's
standard grasps. For a hand without any, as after `graspbench hand import`, they are the best
postures proposed from geometry alone (core/develop/propose_grasps.h), one for all fingers and one
for two, never simulated. Empty for a hand with one digit. @throws as LoadStandardGrasps. */
std::vector<Grasp> FindStandardGrasps(const Hand& hand);

/** Copies the folder of a hand without standard grasps to folder/<id> and adds FindStandardGrasps
to its hand.yaml. @throws Error(kIo). */
std::filesystem::path CopyWithGrasps(const Hand& hand, const std::filesystem::path& folder);

/** Options of `graspbench new grasp --from`. */
struct NewTransferOptions {
  std::string study, data, hand;
  std::string trial;   ///< empty: the median of all trials on the object
  std::string object;  ///< empty: that of the trial, or the study's only object
};
struct NewTransfer {
  std::string file;     ///< content of the grasp file; empty: not transferable
  std::string object;   ///< object to run the grasp on: an id, or the folder below the one given
  std::string summary;  ///< what was preserved of the person's grasp, and what was not
};
/** @param folder  for the object. @throws Error(kNotFound) for a trial or an object that the study
lacks; as LoadStudyGrasps, LoadStudyObject, LoadHand. */
NewTransfer MakeNewTransfer(const NewTransferOptions& options, const std::filesystem::path& folder);

}  // namespace graspbench
