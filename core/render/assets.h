#pragma once
/** @file
Files of core/render/assets, compiled into the program (graspbench_embed). A stage is put
together from them in shaders.cc. */

#include <string_view>

namespace graspbench::assets {

extern const std::string_view kEncodeGlsl;       ///< encode.glsl
extern const std::string_view kGeometryFrag;     ///< geometry.frag
extern const std::string_view kLightMapsGlsl;    ///< light_maps.glsl
extern const std::string_view kNoLightMapsGlsl;  ///< no_light_maps.glsl
extern const std::string_view kPositionVert;     ///< position.vert
extern const std::string_view kSurfaceFrag;      ///< surface.frag
extern const std::string_view kSurfaceVert;      ///< surface.vert
extern const std::string_view kTableFrag;        ///< table.frag
extern const std::string_view kTableVert;        ///< table.vert

}  // namespace graspbench::assets
