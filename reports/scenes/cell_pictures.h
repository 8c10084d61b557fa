#pragma once
/** @file
Filmstrips: for every cell three pictures of one trial, from one camera, drawn off-screen, and as
many of one trial of every other way in which the cell's trials ended.

The first trial is the cell's first successful one, else its first one with snapshots. Within a
strip the camera only rises, with a hand that lifts the object; it stands as near as the scenes
allow. The records hold three moments; for all phases a trial has to be simulated again, as for the
3-D views (scene_3d.h). */

#include <map>
#include <string>
#include <vector>

#include "core/render/scene.h"
#include "core/trial/trial_trace.h"
#include "datasets/analysis/session_summary.h"
#include "reports/page/models.h"

namespace graspbench {

struct Picture {
  Moment moment = Moment::kClosed;
  double time = 0.0;  ///< since the start of placing [s]
  std::string webp;
  std::string thumbnail = {};  ///< the same, smaller by kThumbnailShrink
};

struct Filmstrip {
  const TrialRecord* record = nullptr;
  std::vector<Picture> pictures;
};

struct CellPictures {
  /** By the cell's anchor: the trial of ChooseTrial, then one of each other outcome. */
  std::map<std::string, std::vector<Filmstrip>> by_cell;
  std::vector<std::string> problems;  ///< why pictures are missing
};

inline constexpr int kPictureWidth = 480;
inline constexpr int kPictureHeight = 360;
inline constexpr int kThumbnailShrink = 4;

/** Of the cell's trials whose snapshots fit the hand the first that is not physical, else the first
success, else the first; null without any. @param session  that of the cell's records. */
const TrialRecord* ChooseTrial(const CellSummary& cell, const Hand& hand, const Session& session);

/** That trial, and of every other outcome in the cell the first trial whose snapshots fit. */
std::vector<const TrialRecord*> ChooseTrialPerOutcome(const CellSummary& cell, const Hand& hand,
                                                      const Session& session);

/** All from one camera, which rises with hand and object. @throws Error when the machine
cannot draw. @pre not empty; ChooseTrial found that they fit the hand. */
std::vector<Picture> RenderSnapshots(const std::vector<SceneSnapshot>& snapshots,
                                     const std::shared_ptr<const Hand>& hand,
                                     const std::shared_ptr<const GraspObject>& object,
                                     Renderer& renderer);

/** Instants of one trial in the same way, with their contacts over them: WebP, one each, of the
renderer's size (4 : 3). @throws as above. */
std::vector<std::string> RenderInstants(const std::vector<const TraceInstant*>& instants,
                                        double arrow_scale, const std::shared_ptr<const Hand>& hand,
                                        const std::shared_ptr<const GraspObject>& object,
                                        Renderer& renderer);

/** Of the cells that are drawn in full (shown_trials.h); the strips of other outcomes as long as
there are not too many for one page. Never throws for a machine that cannot draw: the reason becomes
a problem. */
CellPictures RenderCellPictures(const Session& session, const SessionSummary& summary,
                                const SessionModels& models);

}  // namespace graspbench
