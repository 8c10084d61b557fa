#include "core/hand/import/cover_links.h"

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/import/shapes/cover_surface.h"

namespace graspbench {
namespace {

/** Of the link, as the loader makes them of its shapes. */
std::vector<ContactSphere> MakeBalls(const ImportedHand& imported, int link, bool is_pad) {
  Hand alone;
  for (const CollisionShape& shape : imported.shapes) {
    if (shape.link == link) AddContact(shape, is_pad, alone);
  }
  return alone.contact_spheres;
}

}  // namespace

void CoverLinks(const std::string& file, int num_points, ImportedHand& imported,
                Diagnostics& problems) {
  const Hand& hand = imported.hand;
  for (const Digit& digit : hand.digits) {
    for (const int link : digit.links) {
      const std::vector<TriMesh>& solids = imported.solids[static_cast<size_t>(link)];
      if (solids.empty()) continue;
      const SurfaceCover cover =
          CoverSurface(solids, MakeBalls(imported, link, link == digit.distal_link), num_points);
      for (const SurfaceCover::Ball& ball : cover.balls) {
        CollisionShape& shape = imported.shapes.emplace_back();
        shape.link = link;
        shape.X_LS = MakePose(ball.centre);
        shape.size.setConstant(2.0 * ball.radius);
        shape.is_cover = true;
      }
      const std::string& name = hand.links[link].name;
      const std::string told = FormatFixed(MmFromM(cover.uncovered), 2) +
                               " mm of its surface stay uncovered at 95 of 100 points";
      std::string& note = imported.notes[static_cast<size_t>(link)];
      note += (note.empty() ? "" : "\n") + name + ": " +
              FormatCount(static_cast<int64_t>(cover.balls.size()), "ball") +
              " more at edges and ends; " + told;
      if (cover.uncovered <= kMostUncovered) continue;
      problems.Warn(file, 0, "link \"" + name + "\": " + told + ": what it grasps there sinks in");
    }
  }
}

}  // namespace graspbench
