#include "core/render/shaders.h"

#include <initializer_list>
#include <string_view>

namespace graspbench {
namespace {

using namespace assets;

std::string JoinStage(std::initializer_list<std::string_view> parts) {
  std::string stage = "#version 330 core\n";
  for (const std::string_view part : parts) stage += part;
  return stage;
}

std::string FormatTaps(int taps) { return "const int kTaps = " + std::to_string(taps) + ";\n"; }

}  // namespace

ShaderSource MakeDepthShader() {
  return {"depth", JoinStage({kPositionVert}), JoinStage({"void main() {}\n"})};
}

ShaderSource MakeSurfaceShader(int taps) {
  const std::string light =
      taps > 0 ? FormatTaps(taps) + std::string(kLightMapsGlsl) : std::string(kNoLightMapsGlsl);
  return {"surface", JoinStage({kSurfaceVert}),
          JoinStage({"in vec3 p_S;\nuniform vec3 to_key;\n", kEncodeGlsl, light, kSurfaceFrag})};
}

ShaderSource MakeTableShader() {
  return {"table", JoinStage({kTableVert}), JoinStage({kEncodeGlsl, kTableFrag})};
}

ShaderSource MakeGeometryShader() {
  return {"geometry", JoinStage({kPositionVert}), JoinStage({kGeometryFrag})};
}

ShaderSource MakeTableGeometryShader() {
  return {"table geometry", JoinStage({kTableVert}), JoinStage({kGeometryFrag})};
}

}  // namespace graspbench
