#pragma once
/** @file
A parallel gripper as hands are published: hung from the world, one finger without inertia
that mimics the other, a name with a blank and one beyond ASCII. */

#include <string>

#include "core/hand/import/import_hand.h"

namespace graspbench {

inline const char* const kSmallGripper = R"(<?xml version="1.0"?>
<robot name="parallel gripper ü">
  <link name="world"/>
  <joint name="mount" type="fixed">
    <parent link="world"/><child link="the hand"/>
    <origin xyz="0 0 1" rpy="3.141592653589793 0 0"/>
  </joint>
  <link name="the hand">
    <inertial>
      <mass value="0.7"/>
      <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.0025" iyz="0" izz="0.0017"/>
    </inertial>
    <collision>
      <origin xyz="0 0 0.03"/><geometry><box size="0.06 0.2 0.06"/></geometry>
    </collision>
  </link>
  <link name="left">
    <inertial>
      <mass value="0.015"/>
      <inertia ixx="2.4e-6" ixy="0" ixz="0" iyy="2.3e-6" iyz="0" izz="7.5e-7"/>
    </inertial>
    <collision>
      <origin xyz="0 0.0085 0.03"/><geometry><box size="0.02 0.015 0.055"/></geometry>
    </collision>
  </link>
  <link name="right">
    <collision>
      <origin xyz="0 -0.0085 0.03"/><geometry><box size="0.02 0.015 0.055"/></geometry>
    </collision>
  </link>
  <joint name="slide_left" type="prismatic">
    <parent link="the hand"/><child link="left"/>
    <origin xyz="0 0 0.06"/><axis xyz="0 1 0"/>
    <limit effort="20" lower="0" upper="0.04" velocity="0.2"/>
  </joint>
  <joint name="slide_right" type="prismatic">
    <parent link="the hand"/><child link="right"/>
    <origin xyz="0 0 0.06"/><axis xyz="0 -1 0"/>
    <limit effort="20" lower="0" upper="0.04" velocity="0.2"/>
    <mimic joint="slide_left"/>
  </joint>
</robot>
)";

/** Refuses every mesh. */
inline HandSource MakeSourceWithoutMeshes() {
  HandSource source;
  source.num_cover_points = 0;
  source.file = "gripper.urdf";
  source.folder = "no-such-folder";
  source.load_mesh = [](const std::filesystem::path&) -> TriMesh {
    throw Error(ErrorKind::kNotFound, "no mesh here");
  };
  return source;
}

/** The text with the first `from` replaced. */
inline std::string ReplaceOnce(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace graspbench
