#pragma once
/** @file
Instants of a trial as scenes: hand, object, contacts, and the forces that these can transmit. */

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

/** Legend of figures with contacts. */
inline constexpr char kContactLegend[] =
    "Contacts are drawn over the bodies, also where a body hides them: points, red arrows for the "
    "force on the object, friction cones (green: the contact sticks, blue: it slides).";

/** Makes the contact points, forces and friction cones of an instant. */
std::vector<ContactMark> MakeContactMarks(const TraceInstant& instant);

/** Arrow scale for all pictures of the trial, at which the largest force has the longest arrow
[m/N]. */
double FindArrowScale(const TracedTrial& traced);

/** Upper bound of the force space's radius, for a camera that shows all spaces at one scale [m]. */
inline constexpr double kForceSpaceRadius = 0.045;

/** Makes the force part of the wrench space: all forces that the contacts can exert on the object
while their normal forces sum to at most 1 N. Drawn in W at 40 mm per newton, with a dot at zero
force. Friction cones are approximated by pyramids (core/quality/wrench_space.h), so the space is
slightly too small.
@returns nothing where these forces span no volume, as for two fingers without friction. */
std::optional<Scene> MakeForceSpaceScene(const std::vector<HandContact>& contacts);

}  // namespace graspbench
