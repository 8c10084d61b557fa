#pragma once
/** @file
The hands and objects of a session, loaded once and shared between threads. */

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/arm/mounted_arm.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_setup.h"
#include "datasets/plan/fitted_grasps.h"
#include "datasets/plan/rehearsed_types.h"
#include "datasets/plan/session_config.h"
#include "objects/catalogue.h"

namespace graspbench {

struct SessionHand {
  std::shared_ptr<const Hand> hand;
  std::vector<Grasp> grasps;                   ///< all it can do, then those of grasp files
  std::shared_ptr<const MountedArm> arm = {};  ///< that carries it; null: none
};

struct SessionInputs;

/** A condition as its trials need it. */
struct ConditionInputs {
  SessionConfig config;  ///< with its settings and without conditions
  LateDigit late = LateDigit::kNone;
  double delay = 0.0;  ///< [s]
  bool is_compliant = false;
  std::shared_ptr<const SessionInputs>
      inputs;  ///< with the base's hands and objects where they are
               ///< no others, so that a world serves both
};

struct SessionInputs {
  std::vector<SessionHand> hands;                           ///< in the order of the configuration
  std::vector<std::shared_ptr<const GraspObject>> objects;  ///< in the order of the configuration
  std::map<std::string, std::string> grasp_files;  ///< path in the configuration -> the grasp's id
  RehearsedTypes types;  ///< where a grasp is "best" and the object names none
  /** What was rehearsed, types and grasp files, as texts by place in the folder of copies; with
  that of conditions which choose again. */
  std::map<std::string, std::string> rehearsed;
  /** What imagined trials say of rehearsed grasps that held half of them or fewer. */
  std::vector<std::string> doubts;
  std::map<std::string, ConditionInputs> conditions;                        ///< by name
  std::shared_ptr<FittedGrasps> fitted = std::make_shared<FittedGrasps>();  ///< those asked for
  /** Of a condition with other hands or objects: the base's, where "best" is chosen for both, so
  that all conditions compare one grasp. Null: here. */
  std::shared_ptr<const SessionInputs> base = nullptr;
};

/** Loads what the configuration names, with its `model` applied; "all" is every hand and object that
comes with the program. A grasp whose name ends in ".yaml" is a file (core/grasp/grasp_file.h) and
goes to its hand; the benchmark of a campaign has the grasps of the campaign's scenes, too. A name
"rehearsed" stands for one grasp for each hand and object, "best" for one standard grasp
(rehearsed_types.h), each rehearsed where neither the folder nor an earlier run has it
(rehearsed_grasps.h). Conditions have those of the base, or choose again (ChooseAgain).
@param folder  of the session whose copies are taken; empty: the originals.
@param field_use  kLater where thousands of objects must fit: whoever simulates one completes it
(CompleteObject).
@throws Error(kNotFound) with suggestions; Error(kFormat) when one of them cannot be used. */
SessionInputs LoadSessionInputs(const SessionConfig& config, FieldUse field_use = FieldUse::kNow,
                                const std::filesystem::path& folder = {});

/** The user's own hands, objects, arm and grasp files, copied into the folder of a session, an
optimisation or a campaign when it is made:

    inputs/hands/<id>/     hand.urdf, hand.yaml and the meshes that hand.urdf names
    inputs/objects/<id>/   object.yaml, its mesh and the files that a .gltf names
    inputs/arms/<id>/      arm.yaml
    inputs/grasps/<n>.yaml the n-th of the configuration's grasps, from 0
    inputs/grasps/rehearsed/<hand>/<object>.yaml  a rehearsed grasp
    inputs/grasps/best/types.json  the types of best grasps

A condition that chooses again has folders "rehearsed-<hash>" and "best-<hash>" of its own.

What comes with the program is not copied. The copies are sealed with the store; whoever continues
or reads it takes them, wherever it was moved to and whatever became of the originals. The scenes
and the benchmark of a campaign have no copies of their own: theirs are the campaign's; nor do the
experiments in a session's folder.

True for a name that stands for a grasp file and not for a grasp's id. */
bool IsGraspFile(const std::string& name);

/** @pre LoadSessionInputs(config) has found them usable. @throws Error(kUsage) for a file that is
named from outside its hand's or object's folder; Error(kIo). */
void CopyInputs(const SessionConfig& config, const std::filesystem::path& folder);
/** What was rehearsed. @throws Error(kIo). */
void CopyRehearsed(const SessionInputs& inputs, const std::filesystem::path& folder);

/** hand.urdf, hand.yaml and the meshes that hand.urdf names, into the folder `to`; meshes named
from outside the folder are put into `meshes` and hand.urdf names them there: a hand of its own, not
a copy to the byte. @throws Error(kIo). */
void GatherHand(const std::filesystem::path& from, const std::filesystem::path& to);

/** Where to load an input from: its copy in the store's folder, else the name itself.
@param folder  empty: there is no store yet. */
std::string FindHandInput(const std::string& name, const std::filesystem::path& folder);
std::string FindObjectInput(const std::string& name, const std::filesystem::path& folder);
std::string FindArmInput(const std::string& name, const std::filesystem::path& folder);
/** @param number  in the configuration's list of grasps. */
std::string FindGraspInput(const std::string& name, size_t number,
                           const std::filesystem::path& folder);

/** Files of the grasps of this id that the scenes of a campaign have found.
@param folder  of the campaign's benchmark; none for any other. */
std::vector<std::string> ListSceneGrasps(const std::string& id,
                                         const std::filesystem::path& folder);

}  // namespace graspbench
