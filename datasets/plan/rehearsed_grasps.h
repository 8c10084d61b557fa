#pragma once
/** @file
The grasps "rehearsed" of a session (core/rehearse): for each hand and object the grasp that
imagined trials choose. Imagined trials use the session's variation, strategy and simulation, but
draws from a random stream of their own. So no session uses the draws of its rehearsal, whatever its
seed.

Rehearsals are kept between runs (core/base/files/kept.h) under a hash of all their inputs and of
the sources. A session stores the grasps themselves among its inputs (session_inputs.h), as grasp
files. */

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/rehearse/rehearse_grasp.h"
#include "core/trial/trial_setup.h"
#include "datasets/plan/session_config.h"

namespace graspbench {

/** Parses "rehearsed", the user's form "rehearsed:N,k" and ids from NameRehearsed; nothing for
another name. @throws Error(kUsage) for numbers that are malformed or out of range. */
std::optional<RehearsalConfig> ParseRehearsed(const std::string& name);
/** Returns the grasp's id, which has no comma: "rehearsed", "rehearsed-80-8". */
std::string NameRehearsed(const RehearsalConfig& config);
/** Rejoins names that were split at commas and converts them to ids: "rehearsed:80", "8" gives
"rehearsed-80-8".
@throws as ParseRehearsed. */
std::vector<std::string> JoinRehearsed(const std::vector<std::string>& names);
/** Lists the rehearsals that the grasps of the session and its conditions require, each once. */
std::vector<RehearsalConfig> ListRehearsals(const SessionConfig& config);

/** Returns the grasps that may be rehearsed on the object, in its grasp_order: standard ones
without a placement that are not made for one object. */
std::vector<Grasp> ListRehearsable(const std::vector<Grasp>& grasps, const GraspObject& object);

/** The inputs of a rehearsal. */
struct RehearsalTask {
  std::shared_ptr<const Hand> hand;
  std::vector<Grasp> grasps;                  ///< from ListRehearsable
  std::shared_ptr<const GraspObject> object;  ///< completed (CompleteObject) if needed
  TrialConditions conditions;                 ///< its model is already applied to hand and object
  ImperfectionConfig imperfections;           ///< already applied to the hand
  RehearsalConfig config;
  std::shared_ptr<const MountedArm> arm = {};  ///< the session's arm; null: none
};
RehearsalTask MakeRehearsalTask(const SessionConfig& config, const RehearsalConfig& rehearsal,
                                const std::shared_ptr<const Hand>& hand,
                                const std::vector<Grasp>& grasps,
                                const std::shared_ptr<const GraspObject>& object);

/** Hash of all that determines the rehearsal: hand, grasps, object, conditions, physics and rules
of choice. */
std::string CalcRehearsalHash(const RehearsalTask& task);

/** Makes the setup of an imagined trial. Its random stream is named by hand, object and draw.
@param object  the task's object, or its changed copy for a draw for which IsDoubtful(). */
TrialSetup MakeRehearsalSetup(const RehearsalTask& task,
                              const std::shared_ptr<const GraspObject>& object, const Grasp& grasp,
                              const RehearsalQuestion& question);

/** Returns the rehearsal kept by an earlier run; nothing if it must be run. */
std::optional<Rehearsal> FindKeptRehearsal(const RehearsalTask& task);
/** Returns the kept rehearsal, or runs it in this thread and keeps it, which takes some seconds.
Thread-safe.
@throws Error(kUsage) for a hand without a standard grasp; as TrialRunner. */
Rehearsal FindRehearsal(const RehearsalTask& task);

/** Returns the warning for a grasp that held half of its imagined trials or fewer; else empty. */
std::string DescribeDoubt(const std::string& hand, const std::string& object,
                          const std::string& grasp, int held, int draws);

/** Formats a candidate as the text of a grasp file (core/grasp/grasp_file.h).
@param id  of the grasp in the file. */
std::string FormatRehearsedGrasp(const RehearsalTask& task, const GraspCandidate& candidate,
                                 const std::string& id);

}  // namespace graspbench
