#pragma once
/** @file
Trials as animated 3-D views in a page. Pictures of all phases, a table and curves need no script.
Where scripts run, a button opens the scene with a slider over the phases, contact points, forces
and friction cones; a cursor in the curves follows the slider.

A page embeds three.js with its licence and the script once, every hand and object once, and per
trial its motion (datasets/gltf/trial_gltf.h), some 100 kB with the curves. The page loads nothing:
it works from a file, without a network, under its content security policy. */

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "core/hand/hand.h"
#include "core/render/scene.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_trace.h"
#include "reports/page/html.h"
#include "reports/page/layout.h"

namespace graspbench {

struct TrialView {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  TracedTrial traced;
  std::string anchor;  ///< once per page; a link to it opens the scene
  std::string name;    ///< "TUM Hand, can, power (g3), trial 3"
};

/** The views of one page. */
class TrialViews {
 public:
  /** Adds a view. Without a renderer it has no picture; for a trial that could not begin, it is one
  sentence. */
  Html Add(const TrialView& view);

  /** Makes the embedded hands, objects and licence, to be placed once after the last view. Empty
  without views. */
  Html MakeModels() const;

  /** Makes the script; empty without views. */
  PageScript MakeScript() const;

 private:
  std::string FindOrAddModel(const std::string& hash, const char* kind,
                             const std::function<std::string()>& make_glb);
  /** Draws, or returns nothing once the machine has failed to draw. */
  Html DrawWherePossible(const std::function<Html()>& draw);
  Html DrawPoster(const TrialView& view, const TraceInstant& shown, const Camera& camera);

  Html DrawFilm(const TrialView& view, const std::vector<const TraceInstant*>& ends,
                const TraceInstant& shown, const Camera& camera);

  std::map<std::string, std::string> anchor_of_model_;  // by kind and content
  Html models_;
  std::unique_ptr<Renderer> renderer_, film_renderer_;
  bool can_draw_ = true;
};

}  // namespace graspbench
