#pragma once
/** @file
The hands and objects of a session, loaded once and shared between threads. */

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_setup.h"
#include "datasets/plan/fitted_grasps.h"
#include "datasets/plan/session_config.h"
#include "objects/catalogue.h"

namespace graspbench {

struct SessionHand {
  std::shared_ptr<const Hand> hand;
  std::vector<Grasp> grasps;  ///< all it can do, then those of grasp files
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
  std::map<std::string, ConditionInputs> conditions;                        ///< by name
  std::shared_ptr<FittedGrasps> fitted = std::make_shared<FittedGrasps>();  ///< those asked for
  /** Of a condition with other hands or objects: the base's, where "best" is chosen for both, so
  that all conditions compare one grasp. Null: here. */
  std::shared_ptr<const SessionInputs> base = nullptr;
};

/** Loads what the configuration names, with its `model` applied; "all" is every hand and object that
comes with the program. A grasp whose name ends in ".yaml" is a file (core/grasp/grasp_file.h) and
goes to its hand; the benchmark of a campaign has the grasps of the campaign's scenes, too.
@param folder  of the session whose copies are taken (input_copies.h); empty: the originals.
@param field_use  kLater where thousands of objects must fit: whoever simulates one completes it
(CompleteObject).
@throws Error(kNotFound) with suggestions; Error(kFormat) when one of them cannot be used. */
SessionInputs LoadSessionInputs(const SessionConfig& config, FieldUse field_use = FieldUse::kNow,
                                const std::filesystem::path& folder = {});

}  // namespace graspbench
