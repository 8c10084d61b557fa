#include "objects/object_file.h"

#include <algorithm>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml.h"

namespace graspbench {
namespace {

/** Ids and names of the taxonomy (core/grasp, which this room does not know; a test compares). */
constexpr std::pair<const char*, const char*> kGrasps[] = {{"g1", "all finger precision"},
                                                           {"g2", "two finger precision"},
                                                           {"g3", "power"},
                                                           {"g4", "two finger pinch"},
                                                           {"g5", "three finger special"},
                                                           {"g6", "encompassing precision"}};

/** A grasp by its id or name, made its id. */
void CheckGrasp(const std::string& key, std::string& value, YamlMap& map) {
  std::string wanted = ToLower(value);
  std::replace_if(
      wanted.begin(), wanted.end(), [](char c) { return c == '_' || c == '-'; }, ' ');
  std::vector<std::string> known;
  for (const auto& [id, name] : kGrasps) {
    known.insert(known.end(), {id, name});
    if (wanted != id && wanted != name) continue;
    value = id;
    return;
  }
  map.Fail(key, "no standard grasp \"" + value + "\"" + SuggestNames(value, known));
}

std::vector<std::string> ListKeys(const YAML::Node& node) {
  std::vector<std::string> keys;
  if (!node.IsMap()) return keys;
  for (const auto& item : node) keys.push_back(item.first.as<std::string>(""));
  return keys;
}

}  // namespace

const FileKeys& ListObjectKeys() {
  // Lighter than a feather a body's weight drowns in the solver's tolerance; heavier than 100 kg no
  // hand of the catalogue holds it, and the contact's stiffness is far off. Densities reach from
  // foams to osmium.
  static const FileKeys keys = [] {
    FileKeys rows = {
        {"name", kRequired, "what a person calls it"},
        {"mesh", kRequired, "file beside this one: OBJ, STL, PLY, GLB or glTF"},
        {"mesh_unit", kRequired, "of the mesh's numbers: m or mm"},
        {"mass_kg", "", "either this or density_kg_per_m3", 1e-4, 100},
        {"density_kg_per_m3", "", "either this or mass_kg", 1, 25000},
    };
    for (const FileKey& row : ListSurfaceKeys(Needed::kYes, "")) rows.push_back(row);
    const FileKeys rest = {
        {"size_m", "", "length, width and height; the mesh must have them within 0.1 mm",
         kAboveZero},
        {"compressible", "", "how fingertips compress it (manual: objects); else it is rigid"},
        {"compressible.force_n", kRequired, "of each fingertip at grasp_m", 0.01, 100},
        {"compressible.sight_m", kRequired,
         "length, width and height at rest; the mesh must have them within 0.1 mm", kAboveZero},
        {"compressible.grasp_m", kRequired,
         "the same where fingertips press on both sides with force_n; each from 0.6 of sight_m to "
         "sight_m",
         kAboveZero},
        {"compressible.sight_guessed", "false", KeyType::kBoolean,
         "true: nobody measured sight_m; outputs mark it as a guess"},
        {"centre_of_mass_m", "",
         "from the middle of the bounding box; else that of a homogeneous body"},
        {"best_grasp", "", "by hand, by id or name: {tum: g3, shadow: power}"},
        {"grasp_order", "", "grasps for hands that best_grasp does not name, best first"},
        {"approach", "automatic",
         "from where hands come: automatic, above or side; before what their grasps say"},
        {"separate_parts", "false", KeyType::kBoolean,
         "true: the mesh has bodies that do not touch, and they move as one"},
        {"colour", "[0.8, 0.7, 0.5]", "linear red, green and blue", 0, 1},
    };
    rows.insert(rows.end(), rest.begin(), rest.end());
    return rows;
  }();
  return keys;
}

namespace {

void ReadCompression(YamlMap& map, const std::string& path, Diagnostics& problems,
                     ObjectFile& file) {
  const YAML::Node node = map.Child("compressible", Needed::kNo);
  if (!map.Has("compressible")) return;
  YamlMap keys(node, path, "compressible", problems, &ListObjectKeys(), "compressible.");
  Compression& compression = file.compression.emplace();
  keys.Read("force_n", compression.force);
  keys.Read("sight_m", file.size);
  keys.Read("grasp_m", compression.size_of_grasp);
  keys.Read("sight_guessed", compression.is_sight_guessed, Needed::kNo);
  keys.FinishKnownKeys();
  if (map.Has("size_m")) map.Fail("size_m", "leave it out: compressible states it as sight_m");
  const auto &sight = file.size.array(), &grasp = compression.size_of_grasp.array();
  if ((grasp > sight).any() || (grasp < kLeastSizeOfGrasp * sight).any()) {
    keys.Fail("grasp_m",
              "each size must be from 0.6 of sight_m to sight_m; correct one of the two");
  }
}

}  // namespace

ObjectFile LoadObjectFile(const std::filesystem::path& path) {
  return ParseObjectFile(ReadFile(path), path.string());
}

ObjectFile ParseObjectFile(const std::string& text, const std::string& path) {
  Diagnostics problems;
  ObjectFile file;
  YamlMap map(ParseYaml(text, path, problems), path, "object", problems, &ListObjectKeys());
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

  ReadSurface(map, Needed::kYes, file.surface);

  map.Read("size_m", file.size, Needed::kNo);
  ReadCompression(map, path, problems, file);
  map.Read("centre_of_mass_m", file.p_OOcm, Needed::kNo);

  ReadApproach(map, file.approach);
  map.Read("separate_parts", file.has_separate_parts, Needed::kNo);
  map.Read("colour", file.colour, Needed::kNo);
  if (map.Has("best_grasp")) {
    const YAML::Node node = map.Child("best_grasp", Needed::kNo);
    YamlMap best(node, path, "best_grasp", problems);
    for (const std::string& hand : ListKeys(node)) {
      best.Read(hand, file.best_grasp[hand]);
      CheckGrasp(hand, file.best_grasp[hand], best);
    }
  }
  map.Read("grasp_order", file.grasp_order, Needed::kNo);
  for (std::string& grasp : file.grasp_order) CheckGrasp("grasp_order", grasp, map);
  map.FinishKnownKeys();
  problems.ThrowIfErrors(ErrorKind::kFormat, "the object cannot be used");
  return file;
}

}  // namespace graspbench
