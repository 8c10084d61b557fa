#pragma once
/** @file
The GLSL programs of the renderer, one vertex and one fragment stage each.

All shading happens in the stage frame S: origin on the table below the camera's target, z up, y
along the camera's heading. Light comes from fixed directions in S, so a picture depends on where
the camera stands relative to the scene and not on where both stand in the world. */

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

/** Depth of the surfaces as a light sees them. */
ShaderSource MakeDepthShader();
/** The drawables. @param taps  of a shadow's filter; 0: no shadows. */
ShaderSource MakeSurfaceShader(int taps);
/** The table with its shadow and its 50 mm grid. */
ShaderSource MakeTableShader();
/** Which drawable, and how far before the camera: of the drawables, of the table. */
///@{
ShaderSource MakeGeometryShader();
ShaderSource MakeTableGeometryShader();
///@}

}  // namespace graspbench
