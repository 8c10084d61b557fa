#pragma once
/** @file
The GLSL programs of the renderer, one vertex and one fragment stage each.

All shading happens in the stage frame S: origin on the table below the camera's target, z up, y
along the camera's heading. Light directions are fixed in S. So a picture depends on the camera's
pose relative to the scene, not on the pose of both in the world. */

#include <string>
#include <string_view>

namespace graspbench {

/** Files of core/render/assets, compiled into the program (graspbench_embed). */
namespace assets {
extern const std::string_view kEncodeGlsl;       ///< encode.glsl
extern const std::string_view kGeometryFrag;     ///< geometry.frag
extern const std::string_view kLightMapsGlsl;    ///< light_maps.glsl
extern const std::string_view kNoLightMapsGlsl;  ///< no_light_maps.glsl
extern const std::string_view kPositionVert;     ///< position.vert
extern const std::string_view kSurfaceFrag;      ///< surface.frag
extern const std::string_view kSurfaceVert;      ///< surface.vert
extern const std::string_view kTableFrag;        ///< table.frag
extern const std::string_view kTableVert;        ///< table.vert
}  // namespace assets

struct ShaderSource {
  const char* name;  ///< for messages
  std::string vertex;
  std::string fragment;
};

/** Returns the shader for the depth of surfaces as seen by a light. */
ShaderSource MakeDepthShader();
/** Returns the shader for drawables. @param taps  samples of a shadow's filter; 0: no shadows. */
ShaderSource MakeSurfaceShader(int taps);
/** Returns the shader for the table with its shadow and its 50 mm grid. */
ShaderSource MakeTableShader();
/** Return the shaders for the drawable's index and the depth from the camera: for drawables, for
the table. */
///@{
ShaderSource MakeGeometryShader();
ShaderSource MakeTableGeometryShader();
///@}

}  // namespace graspbench
