#pragma once
/** @file
Hands for a person and for a program. */

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

/** Mass, digits, grasps, coupling, and limits and drive of each joint; angles in degrees. */
Json MakeHandJson(const Hand& hand);
/** The same as text with a table of the joints. */
std::string FormatHand(const Hand& hand);

/** How well contact covers the links (core/hand/contact_fit.h), in millimetres. */
std::string FormatContact(const std::vector<ContactFit>& fits);
/** The links above 1 mm; empty: none is. @param surface  what contact is measured against. */
std::string DescribeCoarseContact(const std::vector<ContactFit>& fits, const std::string& surface);
/** The link whose surface capsules miss most; empty: they are near half of each at least. */
std::string DescribeThinSelfContact(const std::vector<ContactFit>& fits);

/** Things to grasp and checked meshes for a person and for a program. */
struct DescribedObjects {
  Json json;          ///< {objects: [..]}
  std::string table;  ///< one row each
};
/** The catalogue. */
DescribedObjects DescribeObjects();

/** Sizes, mass, friction and best grasps. */
Json MakeObjectJson(const GraspObject& object);
std::string FormatObject(const GraspObject& object);

/** The warnings, the problems, then what the mesh is and whether it can be used. */
std::string FormatMeshSummary(const std::string& path, const MeshReport& report);

/** What a repair did, and the summary of what it has written to `path`. */
std::string FormatRepair(const std::string& path, const MeshFileRepair& repair);

}  // namespace graspbench
