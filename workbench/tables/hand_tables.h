#pragma once
/** @file
Hands as text and as JSON. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/hand/contact_fit.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "objects/check_mesh_file.h"

namespace graspbench {

struct DescribedHands {
  Json json;          ///< {hands: [..]}
  std::string table;  ///< one row each
};
/** The hands that come with the program. */
DescribedHands DescribeHands();

/** Mass, digits, grasps, coupling, and the limits and drive of each joint; angles in degrees. */
Json MakeHandJson(const Hand& hand);
/** As MakeHandJson, as text with a table of the joints. */
std::string FormatHand(const Hand& hand);

/** Deviation of the contact geometry from each link's surface (core/hand/contact_fit.h) [mm]. */
std::string FormatContact(const std::vector<ContactFit>& fits);
/** Describes the links whose contact geometry deviates by more than 1 mm; empty: none.
@param surface  the reference surface. */
std::string DescribeCoarseContact(const std::vector<ContactFit>& fits, const std::string& surface);
/** Describes the link whose surface the self-contact capsules cover worst; empty: at least half of
every link is covered. */
std::string DescribeThinSelfContact(const std::vector<ContactFit>& fits);

/** Objects and checked meshes as text and as JSON. */
struct DescribedObjects {
  Json json;          ///< {objects: [..]}
  std::string table;  ///< one row each
};
/** The objects of the catalogue. */
DescribedObjects DescribeObjects();

/** Sizes, mass, friction and best grasps. */
Json MakeObjectJson(const GraspObject& object);
std::string FormatObject(const GraspObject& object);

/** Warnings and errors, then properties of the mesh and whether it can be used. */
std::string FormatMeshSummary(const std::string& path, const MeshReport& report);

/** The changes of a repair, and the summary of the mesh written to `path`. */
std::string FormatRepair(const std::string& path, const MeshFileRepair& repair);

}  // namespace graspbench
