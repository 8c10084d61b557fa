#pragma once
/** @file
Objects to grasp: the catalogue's 21 objects and synthetic ones by id, a user's own by path.

"synthetic_7_g3_0" is the first object for grasp g3 of seed 7 (core/shape/synthetic_shapes.h). It is
generated from its id; no file stores it.

The mesh is turned to the pose in which it comes to rest when it is set down on the table as drawn
(core/shape/resting_pose.h); the catalogue's meshes are drawn at rest. Its bounding box is then
centred at O. The inertia is that of the homogeneous solid of the mesh, scaled to the mass. Where
object.yaml gives a centre of mass, the same tensor is taken about that point. The thesis's table
gives the centre of mass along the length only; the catalogue places it at mid-width and mid-height.

@code
const std::shared_ptr<const GraspObject> can = LoadObject("can");
const double distance = can->field->CalcDistance({0.0, 0.0, 0.1});  // from the surface [m]
@endcode */

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/shape/grasp_object.h"

namespace graspbench {

/** Returns the size [m] as text in mm: "12.0 x 34.5 x 6.7". */
std::string FormatSizeInMm(const Eigen::Vector3d& size, int decimals);

/** For a compressible object "68.0 x 58.0 x 46.0 mm under 0.7 N of each fingertip; the size at rest
is a guess", else empty. */
std::string DescribeCompression(const GraspObject& object);

/** Ids of the catalogue in the order of the thesis's table 4.1, from
objects/catalogue/catalogue.yaml. */
std::vector<std::string> ListObjects();

/** Whether `object` is the id of a catalogue or synthetic object; false for "all". */
bool ComesWithProgram(const std::string& object);

/** Replaces the seed in the id of a synthetic object; returns other ids unchanged. */
std::string ChangeSyntheticSeed(const std::string& id, int seed);

/** When to load the distance field: it takes some 4 MB, the rest of an object a few kB to 100
kB. */
enum class FieldUse {
  kNow,
  kLater  ///< `field` stays null; see CompleteObject
};

/** Loads a catalogue object or a synthetic one by its id, or a user's object by the path of its
folder (object.yaml and a mesh, see object_file.h) or of its object.yaml. The mesh is checked
(mesh_check.h); the check's result and the distance field are kept between runs
(core/base/files/kept.h).
@throws Error(kNotFound) with suggestions; Error(kFormat) listing every problem. */
std::shared_ptr<const GraspObject> LoadObject(const std::string& id_or_path,
                                              FieldUse field_use = FieldUse::kNow);

/** Loads a mesh without object.yaml as an object to grasp, for callers that set mass and friction
themselves. O is the frame of the file, whose numbers are metres times `scale`. The object is
homogeneous, of 1000 kg/m^3, without friction, and may consist of separate parts. The mesh is
repaired, and its check kept, as in LoadObject().
@throws as LoadMesh(); Error(kFormat) listing what makes it unusable. */
std::shared_ptr<const GraspObject> LoadMeshObject(const std::filesystem::path& mesh, double scale);

/** Returns a copy of the object with its distance field, or the object itself when it has one. */
std::shared_ptr<const GraspObject> CompleteObject(const std::shared_ptr<const GraspObject>& object);

}  // namespace graspbench
