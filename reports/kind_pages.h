#pragma once
/** @file
Further self-contained pages besides the session's report: for special sessions (a simultaneity map,
a sweep, a basin), for judged grasps, and for developed postures. Without a renderer a page has no
pictures and says why. A new page for sessions needs a file here, a line in this header and a row of
kKindPages (session_report.cc). */

#include <memory>
#include <string>
#include <vector>

#include "core/develop/develop_grasp.h"
#include "core/hand/hand.h"
#include "core/trial/protocols/free_space.h"
#include "datasets/analysis/argument/argument.h"
#include "datasets/analysis/conditions/basin_summary.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/controller_comparison.h"
#include "datasets/analysis/development_summary.h"
#include "datasets/analysis/map/map_result.h"
#include "datasets/judged_grasps/grasp_store.h"
#include "datasets/plan/rehearsed_grasps.h"
#include "datasets/scene/rehearsal_store.h"

namespace graspbench {

/** Page of a simultaneity map: the findings for each hand, a map for each measure, the regions with
their trials, and what correlates with success without delays. */
std::string MakeMapPage(const Session& session, const MapResult& result);

/** Page of a sweep: its conditions, a map for two factors (one for each level of a third), the
effect of each level, and the interactions. */
std::string MakeSweepPage(const Session& session, const SweepSummary& summary);

struct BasinPageData {
  std::string title;    ///< names hand, object and grasp
  std::string command;  ///< that reproduces the samples
  std::vector<BasinSample> samples;
  /** Grip thresholds as margins, one per sample; infinite: no grip held; empty: not determined. */
  std::vector<double> thresholds = {};
};

/** Page of one grasp's robustness basin: a map of offsets in slices of yaw, and the radius. */
std::string MakeBasinPage(const BasinPageData& data);
/** As above, for a session. @pre IsBasin(session). */
std::string MakeBasinPage(const Session& session);

/** Page of one external grasp judged under one profile: the verdict, an animated 3-D view of its
stages and of the deciding push or lift, the measurements, and the profile. */
struct GraspPageData {
  std::string name;         ///< "mug.npy, grasp 3"
  std::string object_name;  ///< as in the file
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  FreeSpaceProfile profile;
  TracedFreeSpace traced;
  std::vector<std::string> assumptions;  ///< about what the file does not state
  std::vector<std::string> commands;     ///< that reproduce the page
};

/** Without a renderer it has no pictures and says
why. */
std::string MakeGraspPage(const GraspPageData& data);

/** Page of external grasps judged under profiles: success under each profile, agreement with the
files' own verdicts, transitions, failures with reasons, and the most marginal verdicts.
@param config  frozen configuration of the store. @param judged  the summarised grasps. */
std::string MakeGraspsPage(const Json& config, const std::vector<JudgedGrasp>& judged,
                           const JudgedSummary& summary);

/** Page of developed postures: pictures, how well they comply with the rules, and the results of
their simulation. */
struct PosturePageData {
  std::shared_ptr<const Hand> hand;
  DevelopConfig config;
  std::vector<DevelopedGrasp> developed;
  std::vector<std::vector<DevelopmentStage>> stages;  ///< by grasp, as far as known
};

/** On a machine that cannot draw, a message replaces the pictures.
@pre each grasp's digits and postures fit the hand. */
std::string MakePosturePage(const PosturePageData& data);

/** Page of rehearsed grasps of hands on objects: the choice, the candidates simulated, their
successes and reasons of failure, and pictures of the chosen grasp and the next three. */
struct RehearsalPageData {
  RehearsalConfig config;
  std::vector<RehearsalTask> tasks;  ///< one per pair
  std::vector<RehearsedPair> pairs;
};

/** Without a renderer it has no pictures and says why. */
std::string MakeRehearsalPage(const RehearsalPageData& data);

/** Page of a session that transferred human grasps to robot hands: how closely each hand follows
the human grasp and what it loses, by object and digit; why grasps are not transferable; pictures.
@pre IsTransfer(session). */
std::string MakeTransferPage(const Session& session);
bool IsTransfer(const Session& session);

/** Page of the five claims of the thesis: the answers, then for each claim a picture, the numbers,
the commands that made them, and what was not run. @param sources  data read: "1 study, 2 maps". */
std::string MakeArgumentPage(const std::vector<ArgumentClaim>& claims, const std::string& sources);

/** Page of success over consecutive sessions: a curve and a table. */
std::string MakeLearningPage(const std::vector<LearningPoint>& points);

}  // namespace graspbench
