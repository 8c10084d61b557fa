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

/** The instant that a person names: "1.25s" since the start of placing, the end of a phase, or one
of the record's moments ("closed"); empty: the end of stabilisation, or of a trial that ended
before. @throws Error(kUsage) with what there is. */
const TraceInstant& FindNamedInstant(const TracedTrial& traced, const std::string& name);

/** @throws Error(kUsage) for what is an instant of no trial. */
void CheckInstantName(const std::string& name);

/** "960x720". @throws Error(kUsage) with the largest side. */
struct PictureSize {
  int width = 0, height = 0;
};
PictureSize ParsePictureSize(const std::string& text);

/** Hand and object, over them contact points, forces and friction cones.
@throws Error(kEnvironment) when the machine cannot draw. */
Image DrawTrial(const TrialSetup& setup, const TracedTrial& traced, const TraceInstant& instant,
                const SceneView& view, const PictureSize& size);

/** The same for the whole trial, as an animated WebP file in real time.
@throws Error(kEnvironment); Error(kUnsupported) for a trial that could not begin. */
std::string FilmTrial(const TrialSetup& setup, const TracedTrial& traced, const SceneView& view,
                      const PictureSize& size);

/** What a picture of a hand shows beside the pictures of its links. */
struct HandPictureParts {
  bool has_shapes = false;  ///< what touches, through the links and alone
  bool has_axes = false;    ///< axes of the joints, through the links
};

/** A hand in columns: the pictures of its links, and what else is asked for
(core/render/contact_marks.h). Two rows: against the palm, and from the side. All joints at zero, or
at the limit nearest to it. @throws Error(kEnvironment) when the machine cannot draw;
Error(kUnsupported): nothing of the hand touches. */
Image DrawHand(const std::shared_ptr<const Hand>& hand, const HandPictureParts& parts);

/** What its columns and colours are, a line. */
std::string DescribeHandPicture(const HandPictureParts& parts);

}  // namespace graspbench
