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
  std::vector<Grasp> grasps;                   ///< its standard grasps, then those of grasp files
  std::shared_ptr<const MountedArm> arm = {};  ///< carries the hand; null: none
};

struct SessionInputs;

/** The settings of a condition, resolved for its trials. */
struct ConditionInputs {
  SessionConfig config;  ///< with the condition's settings, without conditions
  LateDigit late = LateDigit::kNone;
  double delay = 0.0;  ///< [s]
  bool is_compliant = false;
  std::shared_ptr<const SessionInputs>
      inputs;  ///< shares the base's hands and objects where they do
               ///< not differ, so that both use one world
};

struct SessionInputs {
  std::vector<SessionHand> hands;                           ///< in the order of the configuration
  std::vector<std::shared_ptr<const GraspObject>> objects;  ///< in the order of the configuration
  std::map<std::string, std::string> grasp_files;  ///< path in the configuration -> grasp id
  RehearsedTypes types;  ///< where a grasp is "best" and the object names none
  /** Rehearsed types and grasp files as text, keyed by path in the folder of copies, including
  those of conditions that choose again. */
  std::map<std::string, std::string> rehearsed;
  /** Warnings about rehearsed grasps that held half of their imagined trials or fewer. */
  std::vector<std::string> doubts;
  std::map<std::string, ConditionInputs> conditions;                        ///< by name
  std::shared_ptr<FittedGrasps> fitted = std::make_shared<FittedGrasps>();  ///< computed on demand
  /** The base's inputs, for a condition that changes hands or objects: "best" is chosen there, so
  that all conditions compare the same grasp. Null: "best" is chosen in these inputs. */
  std::shared_ptr<const SessionInputs> base = nullptr;
};

/** Loads the hands, objects and grasps that the configuration names, with its `model` applied.
"all" is every shipped hand, or every object of the catalogue. A grasp whose name ends in ".yaml" is
a file (core/grasp/grasp_file.h) and is added to its hand. The benchmark of a campaign also has the
grasps of the campaign's scenes. The name "rehearsed" stands for one grasp per hand and object,
"best" for one standard grasp (rehearsed_types.h). Each is rehearsed unless the folder or an earlier
run has it (rehearsed_grasps.h). Conditions use the grasps of the base, or choose again
(ChooseAgain).
@param folder  of the session whose copies are loaded; empty: the originals are loaded.
@param field_use  kLater if thousands of objects must fit into memory; the caller then completes an
object (CompleteObject) before simulating it.
@throws Error(kNotFound) with suggestions; Error(kFormat) when one of them cannot be used. */
SessionInputs LoadSessionInputs(const SessionConfig& config, FieldUse field_use = FieldUse::kNow,
                                const std::filesystem::path& folder = {});

/** Whether the name stands for a grasp file and not for a grasp's id. */
bool IsGraspFile(const std::string& name);

/** Copies the user's own hands, objects, arm and grasp files into the folder of a session, an
optimisation or a campaign when it is made:

    inputs/hands/<id>/     hand.urdf, hand.yaml and the meshes that hand.urdf refers to
    inputs/objects/<id>/   object.yaml, its mesh and the files that a .gltf refers to
    inputs/arms/<id>/      arm.yaml
    inputs/grasps/<n>.yaml the n-th of the configuration's grasps, from 0
    inputs/grasps/rehearsed/<hand>/<object>.yaml  a rehearsed grasp
    inputs/grasps/best/types.json  the types of best grasps

A condition that chooses grasps again has its own folders "rehearsed-<hash>" and "best-<hash>".

Shipped data are not copied. The copies are sealed with the store. Continuing or reading the store
uses them, even if the store was moved or the originals changed. The scenes and the benchmark of a
campaign use the campaign's copies; the experiments in a session's folder use the session's.

@pre LoadSessionInputs(config) has found them usable.
@throws Error(kUsage) for a hand or object that refers to a file outside its folder; Error(kIo). */
void CopyInputs(const SessionConfig& config, const std::filesystem::path& folder);
/** Writes the rehearsed types and grasps into the folder. @throws Error(kIo). */
void CopyRehearsed(const SessionInputs& inputs, const std::filesystem::path& folder);

/** Copies hand.urdf, hand.yaml, tactile.yaml where there is one, and the meshes that hand.urdf
refers to into the folder `to`. Meshes outside the folder `from` are copied to `to`/meshes and their
paths in hand.urdf are changed accordingly, so the result is self-contained but not a byte-exact
copy. @throws Error(kIo). */
void GatherHand(const std::filesystem::path& from, const std::filesystem::path& to);

/** Returns the path to load an input from: its copy in the store's folder, else the name itself.
@param folder  of the store; empty: there is none yet. */
std::string FindHandInput(const std::string& name, const std::filesystem::path& folder);
std::string FindObjectInput(const std::string& name, const std::filesystem::path& folder);
std::string FindArmInput(const std::string& name, const std::filesystem::path& folder);
/** @param number  index in the configuration's list of grasps. */
std::string FindGraspInput(const std::string& name, size_t number,
                           const std::filesystem::path& folder);

/** Lists the files of the grasps with this id that the scenes of a campaign have found.
@param folder  of the campaign's benchmark; empty result for any other folder. */
std::vector<std::string> ListSceneGrasps(const std::string& id,
                                         const std::filesystem::path& folder);

}  // namespace graspbench
