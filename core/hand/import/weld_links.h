#pragma once
/** @file
The moving links of a foreign hand: what hangs together by fixed joints becomes one, with the mass
of its parts.

Masses are judged by the body that the parts make together: a file may give the mass of all of them
to one. Where the body can have it, a part without mass weighs nothing.

A published inertia is kept when a body of the link's size can have it: positive mass, moments that
fulfil the triangle inequality, centre of mass within the bounds of the shapes, no larger than the
shapes' farthest point allows, no smaller than those of a ball of that mass as dense as the densest
metal, which no body of that mass goes below. Otherwise mass (where there is none), centre and
inertia are those of the shapes' volume at a density of 1200 kg/m^3, between plastics and light
metal with hollows. Weightless links between two joint axes get a small ball. */

#include <string>
#include <vector>

#include "core/hand/contact_fit.h"
#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"
#include "core/hand/import/shapes/load_shapes.h"

namespace graspbench {

struct ImportedHand {
  /** Links and joints with their masses; links[0] is the root, its pose not set. Digits, palm and
  drives are guessed later. */
  Hand hand;
  std::vector<CollisionShape> shapes;
  std::vector<std::vector<TriMesh>> solids;  ///< that the shapes stand for, by link, in its frame
  struct Visual {
    int link = -1;
    ImportedVisual visual;
  };
  std::vector<Visual> visuals;
  std::vector<std::string> notes;    ///< by link: where its mass and its contact come from
  bool are_masses_published = true;  ///< of all links with shapes, and not computed from these
  std::vector<ForeignDrive> drives;  ///< by joint, as published
  std::vector<ContactFit> fits;      ///< by link with contact (MeasureLinks)
};

/** @param palm  index of the palm's link (SelectHand). @param shapes  by foreign link. Every link of
the description whose frame is not that of a link of the hand becomes one of Hand::frames. */
ImportedHand WeldLinks(ForeignHand foreign, int palm, const std::vector<LoadedShapes>& shapes,
                       const std::string& file, Diagnostics& problems);

}  // namespace graspbench
