#pragma once
/** @file
Pictures of an instant of a trial, with its contacts and forces. */

#include <memory>
#include <string>

#include "core/hand/hand.h"
#include "core/render/scene.h"
#include "core/trial/trial_trace.h"
#include "workbench/pictures/scene_view.h"

namespace graspbench {

/** Finds an instant by name: "1.25s" since the start of placing, the end of a phase, or an event of
the record ("closed"). Empty: the end of stabilisation, or of a trial that ended before.
@throws Error(kUsage) naming the instants that exist. */
const TraceInstant& FindNamedInstant(const TracedTrial& traced, const std::string& name);

/** @throws Error(kUsage) for a name that no trial could have. */
void CheckInstantName(const std::string& name);

/** Size in pixels, as "960x720". */
struct PictureSize {
  int width = 0, height = 0;
};
/** @throws Error(kUsage) naming the largest side. */
PictureSize ParsePictureSize(const std::string& text);

/** Draws hand and object, overlaid with contact points, forces and friction cones.
@throws Error(kEnvironment) when the machine cannot draw. */
Image DrawTrial(const TrialSetup& setup, const TracedTrial& traced, const TraceInstant& instant,
                const SceneView& view, const PictureSize& size);

/** As DrawTrial for the whole trial, as an animated WebP file in real time.
@throws Error(kEnvironment); Error(kUnsupported) for a trial that could not begin. */
std::string FilmTrial(const TrialSetup& setup, const TracedTrial& traced, const SceneView& view,
                      const PictureSize& size);

/** What a picture of a hand shows besides its links' meshes. */
struct HandPictureParts {
  bool has_shapes = false;  ///< contact shapes, through the links and alone
  bool has_axes = false;    ///< axes of the joints, through the links
};

/** Draws a hand in columns: the meshes of its links, and the requested parts
(core/render/contact_marks.h). The two rows look at the palm and from the side. All joints are at
zero or at the nearest limit. @throws Error(kEnvironment) when the machine cannot draw;
Error(kUnsupported): the hand has no contact shapes. */
Image DrawHand(const std::shared_ptr<const Hand>& hand, const HandPictureParts& parts);

/** One line that explains the columns and colours. */
std::string DescribeHandPicture(const HandPictureParts& parts);

}  // namespace graspbench
