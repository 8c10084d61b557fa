#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/shape/obj_file.h"
#include "objects/generate/object_shapes.h"
#include "objects/generate/shape_parts.h"
#include "objects/object_file.h"

namespace graspbench {
namespace {

const std::vector<std::pair<std::string, TriMesh (*)()>>& ListDrawings() {
  static const std::vector<std::pair<std::string, TriMesh (*)()>> kDrawings = {
      {"adhesive_tape", DrawAdhesiveTape},
      {"toy_propeller", DrawToyPropeller},
      {"toy_cube", DrawToyCube},
      {"can", DrawCan},
      {"tissue_pack", DrawTissuePack},
      {"tennis_ball", DrawTennisBall},
      {"paper_ball", DrawPaperBall},
      {"sharpener", DrawSharpener},
      {"remote_control", DrawRemoteControl},
      {"cup", DrawCup},
      {"board_marker", DrawBoardMarker},
      {"tea_light", DrawTeaLight},
      {"golf_ball", DrawGolfBall},
      {"matchbox", DrawMatchbox},
      {"light_bulb", DrawLightBulb},
      {"chocolate_bar", DrawChocolateBar},
      {"folding_rule", DrawFoldingRule},
      {"voltage_tester", DrawVoltageTester},
      {"eraser", DrawEraser},
      {"bunch_of_keys", DrawBunchOfKeys},
      {"pencil", DrawPencil}};
  return kDrawings;
}

}  // namespace

TriMesh GenerateMesh(const std::string& id, const Eigen::Vector3d& size) {
  std::vector<std::string> known;
  for (const auto& [drawn_id, draw] : ListDrawings()) {
    if (drawn_id == id) {
      TriMesh mesh = draw();
      FitTo(size, mesh);
      return mesh;
    }
    known.push_back(drawn_id);
  }
  throw Error(ErrorKind::kNotFound, "no drawing of \"" + id + "\"" + SuggestNames(id, known));
}

void GenerateMeshes(const std::filesystem::path& folder) {
  for (const auto& drawing : ListDrawings()) {
    const std::filesystem::path place = folder / drawing.first;
    const ObjectFile file = LoadObjectFile(place / "object.yaml");
    WriteFileAtomically(place / file.mesh, FormatObj(GenerateMesh(drawing.first, file.size),
                                                     UnitsPerMetre(file.mesh_unit)));
  }
}

}  // namespace graspbench
