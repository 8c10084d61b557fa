#pragma once
/** @file
Pages beside the session's report, each as self-contained: of sessions that are more than their
trials (a map of simultaneity, a sweep, a basin), of judged grasps, of developed postures. Without a
renderer a page has no pictures and says why. A new one of a session is a file here, a line in this
header and a row of kKindPages (session_report.cc). */

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

/** What it finds of each hand, a map for each measure, the regions with the trials behind them, and
what correlates with success without delays. */
std::string MakeMapPage(const Session& session, const MapResult& result);

/** Its conditions, a map for two factors (one for each level of a third), what each level changes
and which levels do not simply add up. */
std::string MakeSweepPage(const Session& session, const SweepSummary& summary);

struct BasinPageData {
  std::string title;    ///< names hand, object and grasp
  std::string command;  ///< that gives the same samples
  std::vector<BasinSample> samples;
  /** Grip thresholds as margins, one a sample, infinite: no grip held; empty: not looked for. */
  std::vector<double> thresholds = {};
};

/** The robustness basin of one grasp: a map of offsets in slices of yaw, and its radius. */
std::string MakeBasinPage(const BasinPageData& data);
/** That of a session. @pre IsBasin(session). */
std::string MakeBasinPage(const Session& session);

/** One grasp that somebody made, judged under one profile: the verdict, a moving 3-D view of its
stages and of the push or lift that decides, what was measured, the profile. */
struct GraspPageData {
  std::string name;         ///< "mug.npy, grasp 3"
  std::string object_name;  ///< as the file has it
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  FreeSpaceProfile profile;
  TracedFreeSpace traced;
  std::vector<std::string> assumptions;  ///< what the file does not say
  std::vector<std::string> commands;     ///< that make the page again
};

/** Without a renderer it has no pictures and says
why. */
std::string MakeGraspPage(const GraspPageData& data);

/** Grasps that others made and profiles have judged: success under each profile, agreement with the
files' own verdicts, transitions, failures with their reasons, what was nearest the border.
@param config  frozen, of the store.   @param judged  what the summary is of. */
std::string MakeGraspsPage(const Json& config, const std::vector<JudgedGrasp>& judged,
                           const JudgedSummary& summary);

/** Developed postures: what they look like, how far they keep the rules, what the simulation said
of them. */
struct PosturePageData {
  std::shared_ptr<const Hand> hand;
  DevelopConfig config;
  std::vector<DevelopedGrasp> developed;
  std::vector<std::vector<DevelopmentStage>> stages;  ///< by grasp, as far as known
};

/** On a machine that cannot draw it says so in the
place of pictures. @pre a grasp's digits and postures fit the hand. */
std::string MakePosturePage(const PosturePageData& data);

/** Rehearsed grasps of hands on objects: what was chosen, which candidates were tried, what each
held and why it failed, pictures of the chosen one and of the three next. */
struct RehearsalPageData {
  RehearsalConfig config;
  std::vector<RehearsalTask> tasks;  ///< one a pair
  std::vector<RehearsedPair> pairs;
};

/** Without a renderer it has no pictures and says why. */
std::string MakeRehearsalPage(const RehearsalPageData& data);

/** People's grasps on robot hands, of a session that transferred them: which hand follows people
best and loses least, by object and digit, why grasps are not transferable, pictures.
@pre IsTransfer(session). */
std::string MakeTransferPage(const Session& session);
bool IsTransfer(const Session& session);

/** The five claims of the thesis on one page: the answers, then of each its picture, its numbers,
the commands that made them and what was not run.
@param sources  what was read: "1 study, 2 maps". */
std::string MakeArgumentPage(const std::vector<ArgumentClaim>& claims, const std::string& sources);

/** Success over sessions that followed each other: a curve and a table. */
std::string MakeLearningPage(const std::vector<LearningPoint>& points);

}  // namespace graspbench
