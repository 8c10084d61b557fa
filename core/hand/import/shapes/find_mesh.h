#pragma once
/** @file
Finds the mesh files of a URDF. Their addresses are those of the author's computer:

    meshes/tip.stl                     relative to the URDF, or to a folder above it
    package://my_hand/meshes/tip.stl   in a folder my_hand above or beside it, in a folder of the
    model://, $(find my_hand)/..       package path; otherwise meshes/tip.stl as above
    file:///home/me/meshes/tip.stl     there; otherwise as above, by the part after "meshes"

A name in other case (tip.STL), or the same name in another format, is used if there is no exact
match. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

struct FoundMesh {
  std::filesystem::path path;      ///< empty: not found
  bool is_other = false;           ///< another format than requested
  std::vector<std::string> tried;  ///< paths that were tried without success
};

/** @param folder  folder of the URDF. @param package_path  folders of packages, or packages.
@param endings  of formats that can also be read, such as ".obj". */
FoundMesh FindMesh(const std::string& address, const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& package_path,
                   const std::vector<std::string>& endings);

}  // namespace graspbench
