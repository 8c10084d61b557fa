#pragma once
/** @file
Merges the links of a foreign hand that are connected by fixed joints into one moving link, with the
mass of its parts.

Masses are judged for the merged body, since a file may assign the mass of all parts to one of them.
If the mass is plausible for the body, parts without mass weigh nothing.

A published inertia is kept if a body of the link's size can have it: positive mass, moments that
satisfy the triangle inequality, centre of mass within the bounds of the shapes. Its moments are at
most what the shapes' farthest point allows. They are at least those of a ball of that mass made of
the densest metal, which no body of that mass can go below. Otherwise centre and inertia, and the
mass if there is none, are those of the shapes' volume. Its density is 1200 kg/m^3, between plastics
and light metal with hollows. Massless links between two joint axes get a small ball. */

#include <string>
#include <vector>

#include "core/hand/contact_fit.h"
#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"
#include "core/hand/import/shapes/load_shapes.h"

namespace graspbench {

struct ImportedHand {
  /** Links and joints with their masses; links[0] is the root, whose pose is not set. Digits, palm
  and drives are guessed later. */
  Hand hand;
  std::vector<CollisionShape> shapes;
  std::vector<std::vector<TriMesh>> solids;  ///< by link, in its frame: meshes that the shapes
                                             ///< replace
  struct Visual {
    int link = -1;
    ImportedVisual visual;
  };
  std::vector<Visual> visuals;
  std::vector<std::string> notes;    ///< by link: origin of its mass and its contact geometry
  bool are_masses_published = true;  ///< for all links with shapes, not computed from the shapes
  std::vector<ForeignDrive> drives;  ///< by joint, as published
  std::vector<ContactFit> fits;      ///< by link with contact geometry (MeasureLinks)
};

/** @param palm  index of the palm's link (SelectHand). @param shapes  by foreign link. Every link
whose frame is not that of a link of the merged hand becomes one of Hand::frames. */
ImportedHand WeldLinks(ForeignHand foreign, int palm, const std::vector<LoadedShapes>& shapes,
                       const std::string& file, Diagnostics& problems);

}  // namespace graspbench
