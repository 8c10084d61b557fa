#pragma once
/** @file
Instants of a trial as scenes: hand, object, contacts, and the forces they could bear. */

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/render/contact_marks.h"
#include "core/render/scene.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_trace.h"

namespace graspbench {

/** Of a figure with contacts. */
inline constexpr char kContactLegend[] =
    "Drawn over the bodies, also where these hide them: contact points, red arrows for the force "
    "on "
    "the object, friction cones, green where a contact stands still and blue where it slides.";

/** Contact points, forces and friction cones of an instant. */
std::vector<ContactMark> MakeContactMarks(const TraceInstant& instant);

/** The largest force is as long as the longest arrow, in all pictures of the trial [m/N]. */
double FindArrowScale(const TracedTrial& traced);

/** How far any force of that space can be from zero, for a camera that shows all spaces at one
scale [m]. */
inline constexpr double kForceSpaceRadius = 0.045;

/** The force part of the wrench space: all forces that the contacts can put on the object while
their normal forces sum to at most one newton, in W, 40 mm a newton, with a dot where the force is
zero. Pyramids for cones (core/quality/wrench_space.h), so a little too small.
@returns nothing where these forces fill no volume, as those of two fingers without friction. */
std::optional<Scene> MakeForceSpaceScene(const std::vector<HandContact>& contacts);

}  // namespace graspbench
