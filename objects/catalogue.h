#pragma once
/** @file
Things to grasp: the catalogue's 21 objects by id, synthetic ones by id, or any mesh of a user by
path.

"synthetic_7_g3_0" is the first object for grasp g3 of seed 7 (core/shape/synthetic_shapes.h). No
file has it: its id decides it.

The mesh is turned to how the object rests on the table when it is set down as the mesh lies
(core/shape/resting_pose.h; the catalogue's lie as they rest), and moved so that its bounding box is
centred at O. The inertia is that of the homogeneous
solid of the mesh, scaled to the mass; where object.yaml gives a centre of mass, the same tensor is
taken about that point. The thesis's table gives the centre of mass along the length only: across
and upwards the catalogue puts it in the middle.

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

/** "12.0 x 34.5 x 6.7", in mm. */
std::string FormatSizeInMm(const Eigen::Vector3d& size, int decimals);

/** "68.0 x 58.0 x 46.0 mm under 0.7 N of each fingertip; the size at rest is a guess" of a
compressible object, else empty. */
std::string DescribeCompression(const GraspObject& object);

/** Ids of the catalogue in the order of the thesis's table 4.1, from
objects/catalogue/catalogue.yaml. */
std::vector<std::string> ListObjects();

/** Those of the catalogue and the synthetic ones, which come with the program; not "all". */
bool ComesWithProgram(const std::string& object);

/** Of a synthetic object the one of another seed; other ids stay. */
std::string ChangeSyntheticSeed(const std::string& id, int seed);

/** A distance field takes some 4 MB, all the rest of an object a few kB to 100 kB. */
enum class FieldUse {
  kNow,
  kLater  ///< `field` stays empty, see CompleteObject
};

/** Loads a catalogue object or a synthetic one by its id, or a user's object by the path of its
folder (object.yaml and a mesh, see object_file.h) or of its object.yaml. The mesh is checked
(mesh_check.h); the check's result and the distance field are kept between runs
(core/base/files/kept.h).
@throws Error(kNotFound) with suggestions; Error(kFormat) listing every problem. */
std::shared_ptr<const GraspObject> LoadObject(const std::string& id_or_path,
                                              FieldUse field_use = FieldUse::kNow);

/** A mesh alone as a thing to grasp, for those who state mass and friction themselves: O is the
frame in which it is drawn, in metres times `scale`; it is homogeneous, of 1000 kg/m^3, without
friction, and may consist of bodies apart. Mended and kept as others.
@throws as LoadMesh(); Error(kFormat) listing what makes it unusable. */
std::shared_ptr<const GraspObject> LoadMeshObject(const std::filesystem::path& mesh, double scale);

/** The object with its distance field; itself when it has one. */
std::shared_ptr<const GraspObject> CompleteObject(const std::shared_ptr<const GraspObject>& object);

}  // namespace graspbench
