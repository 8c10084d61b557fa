#pragma once
/** @file Pictures of an instant of a trial, with its contacts and forces. */

#include <string>

#include "core/render/scene.h"
#include "workbench/scene_view.h"
#include "workbench/trial_text.h"

namespace graspbench {

/** The instant that a person names: "1.25s" since the start of placing, the end of a phase, or one
of the record's moments ("closed"). @throws Error(kUsage) with what there is. */
const TraceInstant& FindNamedInstant(const TracedTrial& traced, const std::string& name);

/** Hand and object, over them contact points, forces and friction cones.
@throws Error(kEnvironment) when the machine cannot draw. */
Image DrawTrial(const ExaminedTrial& trial, const TraceInstant& instant, const SceneView& view,
                int width, int height);

}  // namespace graspbench
