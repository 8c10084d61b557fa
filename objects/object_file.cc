#include "objects/object_file.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/base/yaml.h"

namespace graspbench {
namespace {

void CheckPositive(const std::string& key, double value, YamlMap& map) {
  if (value <= 0.0) map.Fail(key, "expected a number above 0");
}

/** Lighter than a feather a body's weight drowns in the solver's tolerance; heavier than this no
hand of the catalogue holds it, and the contact's stiffness is far off. [kg] */
constexpr double kLightest = 1e-4, kHeaviest = 100.0;
/** From foams to osmium. [kg/m^3] */
constexpr double kThinnest = 1.0, kDensest = 25000.0;

void CheckRange(const std::string& key, double value, double low, double high, YamlMap& map) {
  if (!map.Has(key) || (value >= low && value <= high)) return;
  map.Fail(key, "expected a number from " + FormatSignificant(low, 3) + " to " +
                    FormatSignificant(high, 3));
}

void CheckGrasp(const std::string& key, const std::string& value, YamlMap& map) {
  static const std::vector<std::string> kGrasps = {"g1", "g2", "g3", "g4", "g5"};
  if (std::find(kGrasps.begin(), kGrasps.end(), value) == kGrasps.end()) {
    map.Fail(key, "no standard grasp \"" + value + "\"" + SuggestNames(value, kGrasps));
  }
}

std::vector<std::string> ListKeys(const YAML::Node& node) {
  std::vector<std::string> keys;
  if (!node.IsMap()) return keys;
  for (const auto& item : node) keys.push_back(item.first.as<std::string>(""));
  return keys;
}

}  // namespace

ObjectFile LoadObjectFile(const std::filesystem::path& path) {
  Diagnostics problems;
  ObjectFile file;
  YamlMap map(LoadYaml(path, problems), path.string(), "object", problems);
  map.Read("name", file.name);
  map.Read("mesh", file.mesh);
  std::string unit;
  map.Read("mesh_unit", unit);
  if (unit == NameOf(LengthUnit::kMm)) {
    file.mesh_unit = LengthUnit::kMm;
  } else if (!unit.empty() && unit != NameOf(LengthUnit::kM)) {
    map.Fail("mesh_unit", "expected m or mm, found \"" + unit + "\"");
  }

  map.Read("mass_kg", file.mass, Needed::kNo);
  map.Read("density_kg_per_m3", file.density, Needed::kNo);
  if (map.Has("mass_kg") == map.Has("density_kg_per_m3")) {
    map.Fail("mass_kg", "give either mass_kg or density_kg_per_m3");
  }
  CheckRange("mass_kg", file.mass, kLightest, kHeaviest, map);
  CheckRange("density_kg_per_m3", file.density, kThinnest, kDensest, map);

  ReadSurface(map, Needed::kYes, file.surface);
  CheckPositive("friction_static", file.surface.friction_static, map);
  CheckPositive("friction_dynamic", file.surface.friction_dynamic, map);

  map.Read("size_m", file.size, Needed::kNo);
  map.Read("size_of_sight_m", file.size_of_sight, Needed::kNo);
  map.Read("centre_of_mass_m", file.p_OOcm, Needed::kNo);
  CheckPositive("size_m", file.size.minCoeff(), map);
  CheckPositive("size_of_sight_m", file.size_of_sight.minCoeff(), map);

  map.Read("colour", file.colour, Needed::kNo);
  if (file.colour.minCoeff() < 0.0 || file.colour.maxCoeff() > 1.0) {
    map.Fail("colour", "expected three numbers from 0 to 1");
  }
  if (map.Has("best_grasp")) {
    const YAML::Node node = map.Child("best_grasp");
    YamlMap best(node, path.string(), "best_grasp", problems);
    for (const std::string& hand : ListKeys(node)) {
      best.Read(hand, file.best_grasp[hand]);
      CheckGrasp(hand, file.best_grasp[hand], best);
    }
  }
  map.Read("grasp_order", file.grasp_order, Needed::kNo);
  for (const std::string& grasp : file.grasp_order) CheckGrasp("grasp_order", grasp, map);
  map.FinishKnownKeys();
  problems.ThrowIfErrors(ErrorKind::kFormat, "the object cannot be used");
  return file;
}

}  // namespace graspbench
