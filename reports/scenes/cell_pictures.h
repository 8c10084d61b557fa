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
#include "core/trial/trial_result.h"
#include "core/trial/trial_trace.h"
#include "datasets/analysis/session_summary.h"
#include "reports/page/html.h"
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

/** Of the cells that are drawn in full; the strips of other outcomes as long as
there are not too many for one page. Never throws for a machine that cannot draw: the reason becomes
a problem. */
CellPictures RenderCellPictures(const Session& session, const SessionSummary& summary,
                                const SessionModels& models);

/* What a page shows one by one of a session that is too large for it: of 100,000 trials a table
alone would be 90 MB. Rates, medians and ranges are always of all trials. */

/** True for all cells of most sessions, and for the first 250 of a larger one: the others have no
pictures, strips and tables of trials. */
bool IsDrawnInFull(const CellSummary& cell, const SessionSummary& summary);

/** Of a session of up to 3,000 finished trials all of the cell's; of a larger one evenly spaced
ones, as many for every cell, at least 10 and 3,000 in all. */
std::vector<const TrialRecord*> ChooseShownTrials(const CellSummary& cell,
                                                  const SessionSummary& summary);

/** Of a shown trial's row, for links: "trial-3f2a...". */
std::string MakeTrialAnchor(const PlannedTrial& planned);

/** Of its scene in 3-D, where the page has one: "view-3f2a...". */
std::string MakeViewAnchor(const PlannedTrial& planned);

/** "71 of 2381 trials, evenly spaced; export/trials.csv has all of them." Empty when all are shown.
*/
std::string DescribeShownTrials(size_t num_shown, const CellSummary& cell);

/** The pictures of one trial side by side, with their moments and times.
@param of  what is grasped by what, for people who cannot see it. */
Html DrawFilmstrip(const std::vector<Picture>& pictures, const TrialResult& result,
                   const std::string& of);

/** The hand when it was closed, else the trial's last picture, small and without words of its own;
nothing without pictures. */
Html DrawThumbnail(const std::vector<Picture>& pictures);

/** That of the first or the last of a cell's strips: its success, and a failure. */
///@{
Html DrawFirstThumbnail(const CellPictures& pictures, const std::string& cell);
Html DrawLastThumbnail(const CellPictures& pictures, const std::string& cell);
///@}

}  // namespace graspbench
