#pragma once
/** @file
The grasps "rehearsed" of a session (core/rehearse): for each hand and object the one that imagined
trials choose. Imagined trials are those of the session, by its variation, strategy and simulation,
with draws of a stream of their own, so that no session meets the draws of its rehearsal whatever
its seed.

What was found is kept between runs (core/base/files/kept.h) under the hash of all that decides it
and of the sources; a session keeps the grasps themselves among its inputs (session_inputs.h),
as grasp files. */

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/rehearse/rehearse_grasp.h"
#include "core/trial/trial_setup.h"
#include "datasets/plan/session_config.h"

namespace graspbench {

/** Reads "rehearsed", "rehearsed:N,k" as people write it, and ids of NameRehearsed; nothing for
another name. @throws Error(kUsage) for numbers that are none, or out of range. */
std::optional<RehearsalConfig> ParseRehearsed(const std::string& name);
/** The grasp's id under such a name, which holds no comma: "rehearsed", "rehearsed-80-8". */
std::string NameRehearsed(const RehearsalConfig& config);
/** Of names that were parted at their commas the ids: "rehearsed:80", "8" is "rehearsed-80-8".
@throws as ParseRehearsed. */
std::vector<std::string> JoinRehearsed(const std::vector<std::string>& names);
/** What the grasps of the session and of its conditions ask for, each once. */
std::vector<RehearsalConfig> ListRehearsals(const SessionConfig& config);

/** The grasps that may be rehearsed on the object, in its order: standard ones, without a placement
and for no object alone. */
std::vector<Grasp> ListRehearsable(const std::vector<Grasp>& grasps, const GraspObject& object);

/** What decides a rehearsal. */
struct RehearsalTask {
  std::shared_ptr<const Hand> hand;
  std::vector<Grasp> grasps;                  ///< of ListRehearsable
  std::shared_ptr<const GraspObject> object;  ///< completed where that is needed
  TrialConditions conditions;                 ///< hand and object are already changed by its model
  ImperfectionConfig imperfections;           ///< likewise, of the hand
  RehearsalConfig config;
  std::shared_ptr<const MountedArm> arm = {};  ///< of the session; null: none
};
RehearsalTask MakeRehearsalTask(const SessionConfig& config, const RehearsalConfig& rehearsal,
                                const std::shared_ptr<const Hand>& hand,
                                const std::vector<Grasp>& grasps,
                                const std::shared_ptr<const GraspObject>& object);

/** Hash of all that decides it: hand, grasps, object, conditions, physics, rules of choice. */
std::string CalcRehearsalHash(const RehearsalTask& task);

/** The setup of an imagined trial; its stream is named by the hand, the object and the draw.
@param object  that of the draw: doubted or not. */
TrialSetup MakeRehearsalSetup(const RehearsalTask& task,
                              const std::shared_ptr<const GraspObject>& object, const Grasp& grasp,
                              const RehearsalQuestion& question);

/** Kept from an earlier run; nothing: it is to be run. */
std::optional<Rehearsal> FindKeptRehearsal(const RehearsalTask& task);
/** Kept, or run in this thread and kept; some seconds. Threads may do so side by side.
@throws Error(kUsage) for a hand without a standard grasp; as TrialRunner. */
Rehearsal FindRehearsal(const RehearsalTask& task);

/** The warning about a grasp that held half of its imagined trials or fewer; else empty. */
std::string DescribeDoubt(const std::string& hand, const std::string& object,
                          const std::string& grasp, int held, int draws);

/** The chosen grasp as the text of a grasp file (core/grasp/grasp_file.h), and any other one.
@param id  of the grasp in the file. */
std::string FormatRehearsedGrasp(const RehearsalTask& task, const GraspCandidate& candidate,
                                 const std::string& id);

}  // namespace graspbench
