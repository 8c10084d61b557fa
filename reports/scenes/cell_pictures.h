#pragma once
/** @file
Filmstrips, rendered off-screen: for every condition three pictures of one trial from one camera,
and three of one trial for every other outcome of the condition.

The first trial is the condition's first success, else its first trial with snapshots. Within a
strip the camera only rises, along with a hand that lifts the object; it is as close as the scenes
allow. Records hold three moments; to show all phases, a trial must be simulated again, as for the
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
  std::string thumbnail = {};  ///< the picture reduced by kThumbnailShrink
};

struct Filmstrip {
  const TrialRecord* record = nullptr;
  std::vector<Picture> pictures;
};

struct CellPictures {
  /** By the condition's anchor: the trial of ChooseTrial, then one of each other outcome. */
  std::map<std::string, std::vector<Filmstrip>> by_cell;
  std::vector<std::string> problems;  ///< why pictures are missing
};

inline constexpr int kPictureWidth = 480;
inline constexpr int kPictureHeight = 360;
inline constexpr int kThumbnailShrink = 4;

/** Among the condition's trials whose snapshots fit the hand, chooses the first non-physical one,
else the first success, else the first; null without any. @param session  that of the condition's
records. */
const TrialRecord* ChooseTrial(const CellSummary& cell, const Hand& hand, const Session& session);

/** Returns that trial, and for every other outcome the first trial whose snapshots fit. */
std::vector<const TrialRecord*> ChooseTrialPerOutcome(const CellSummary& cell, const Hand& hand,
                                                      const Session& session);

/** Renders all snapshots from one camera, which rises with hand and object. @throws Error when the
machine cannot draw. @pre `snapshots` is not empty; ChooseTrial found that they fit the hand. */
std::vector<Picture> RenderSnapshots(const std::vector<SceneSnapshot>& snapshots,
                                     const std::shared_ptr<const Hand>& hand,
                                     const std::shared_ptr<const GraspObject>& object,
                                     Renderer& renderer);

/** Renders instants of one trial in the same way, overlaid with their contacts, as one WebP image
each, of the renderer's size (4 : 3). @throws as above. */
std::vector<std::string> RenderInstants(const std::vector<const TraceInstant*>& instants,
                                        double arrow_scale, const std::shared_ptr<const Hand>& hand,
                                        const std::shared_ptr<const GraspObject>& object,
                                        Renderer& renderer);

/** Renders the conditions that are drawn in full; strips of other outcomes only as far as they fit
into one page. If the machine cannot draw, the reason becomes a problem; nothing is thrown. */
CellPictures RenderCellPictures(const Session& session, const SessionSummary& summary,
                                const SessionModels& models);

/* Selection of the trials that a page shows one by one when a session is too large: a table of
100,000 trials alone would be 90 MB. Rates, medians and ranges always include all trials. */

/** True for the first 250 conditions, which are all in most sessions. Further ones have no
pictures, strips and tables of trials. */
bool IsDrawnInFull(const CellSummary& cell, const SessionSummary& summary);

/** Returns all trials of the condition in a session of up to 3,000 finished trials. In a larger
one, returns evenly spaced trials: an equal number per condition, at least 10, and 3,000 in all. */
std::vector<const TrialRecord*> ChooseShownTrials(const CellSummary& cell,
                                                  const SessionSummary& summary);

/** Anchor of a shown trial's row: "trial-3f2a...". */
std::string MakeTrialAnchor(const PlannedTrial& planned);

/** Anchor of the trial's 3-D scene, if the page has one: "view-3f2a...". */
std::string MakeViewAnchor(const PlannedTrial& planned);

/** "71 of 2381 trials, evenly spaced; export/trials.csv has all of them." Empty when all are
shown. */
std::string DescribeShownTrials(size_t num_shown, const CellSummary& cell);

/** Draws the pictures of one trial side by side, with moments and times. @param of  hand and
object, for the alternative text. */
Html DrawFilmstrip(const std::vector<Picture>& pictures, const TrialResult& result,
                   const std::string& of);

/** Draws the closed hand, else the trial's last picture, as a thumbnail without text; nothing
without pictures. */
Html DrawThumbnail(const std::vector<Picture>& pictures);

/** Draws the thumbnail of a condition's first strip (its success) or last strip (a failure). */
///@{
Html DrawFirstThumbnail(const CellPictures& pictures, const std::string& cell);
Html DrawLastThumbnail(const CellPictures& pictures, const std::string& cell);
///@}

}  // namespace graspbench
