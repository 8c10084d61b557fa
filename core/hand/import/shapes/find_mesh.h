#pragma once
/** @file
Where the mesh of a URDF lies. Addresses are those of the author's computer:

    meshes/tip.stl                     beside the URDF, or in a folder above it
    package://my_hand/meshes/tip.stl   in a folder my_hand above or beside it, in a folder of the
    model://, $(find my_hand)/..       package path; else meshes/tip.stl as above
    file:///home/me/meshes/tip.stl     there; else as above, by what follows a folder "meshes"

A name in other letters (tip.STL), or the same name in another format, is taken when there is
nothing better. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

struct FoundMesh {
  std::filesystem::path path;      ///< empty: nowhere
  bool is_other = false;           ///< another format than asked for
  std::vector<std::string> tried;  ///< paths without success
};

/** @param folder  of the URDF. @param package_path  folders of packages, or packages themselves.
@param endings  of formats that can be read instead, ".obj" and so on. */
FoundMesh FindMesh(const std::string& address, const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& package_path,
                   const std::vector<std::string>& endings);

}  // namespace graspbench
