#pragma once
/** @file
Every problem of a URDF text, with its line.

urdfdom turns a URDF into a model, but it knows no lines, stops at the first fault and prints to the
console. So tinyxml2 looks at the text first, reports all problems at once, and hands on a tidied
document: the part of URDF that describes a hand, without comments, extensions (`<gazebo>`,
`<transmission>`, ...) and elements that are not used here (`<dynamics>`, `<mimic>`, ...). */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"

namespace tinyxml2 {
class XMLElement;
}

namespace graspbench {

/** What a URDF names, known even when some of it is broken. */
struct UrdfOutline {
  std::vector<std::string> links;
  std::vector<std::string> moving_joints;  ///< revolute and prismatic
  std::string document;                    ///< for urdfdom; empty when the URDF has errors
};

/** @param file    name of the text in messages.
@param folder  meshes are found relative to it. */
UrdfOutline CheckUrdf(const std::string& text, const std::string& file,
                      const std::filesystem::path& folder, Diagnostics& problems);

/** What an <origin> has beside `xyz` and `rpy`, to stand behind where it is: another attribute
(`quat_xyzw`), an element, text. Whoever ignored it would put its part elsewhere. Empty: nothing. */
std::string FindUnknownInOrigin(const tinyxml2::XMLElement& origin);

}  // namespace graspbench
