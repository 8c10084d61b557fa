#include "core/grasp/standard_grasp.h"

#include <algorithm>
#include <filesystem>

#include "core/base/text/yaml.h"
#include "core/base/units.h"
#include "core/grasp/grasp_yaml.h"

namespace graspbench {
namespace {

constexpr const char* kCodes[] = {"t1", "t2", "t3", "t4"};
constexpr const char* kNames[] = {"all finger precision", "two finger precision", "power",
                                  "two finger pinch"};

Grasp ReadStandardGrasp(const Hand& hand, const GraspTaxon& taxon, const YAML::Node& node,
                        const std::string& file, Diagnostics& problems) {
  const std::string where = "grasp " + taxon.id;
  YamlMap map(node, file, where, problems, &ListHandGraspKeys(), "grasps.ID.");
  Grasp grasp = ReadGrasp(&hand, taxon,
                          {map, ListHandGraspKeys(), "grasps.ID.", file, where + ", ", problems});
  std::string changed;  // reason of a change, for the reader
  map.Read("held_share", grasp.held_share, Needed::kNo);
  map.Read("as_called_share", grasp.as_called_share, Needed::kNo);
  map.Read("changed", changed, Needed::kNo);
  map.FinishKnownKeys();
  return grasp;
}

}  // namespace

const std::vector<GraspTaxon>& ListGraspTaxa() {
  static const std::vector<GraspTaxon> taxa = {
      {"g1", "all finger precision", GraspType::kAllFingerPrecision, 0.1, RadFromDeg(75.0)},
      {"g2", "two finger precision", GraspType::kTwoFingerPrecision, 0.1, RadFromDeg(75.0)},
      {"g3", "power", GraspType::kPower, 0.1, RadFromDeg(75.0)},
      {"g4", "two finger pinch", GraspType::kTwoFingerPinch, 0.1, RadFromDeg(90.0)},
      {"g5", "three finger special", GraspType::kAllFingerPrecision, 0.1, RadFromDeg(90.0)},
      {"g6", "encompassing precision", GraspType::kAllFingerPrecision, 0.1, RadFromDeg(75.0)},
  };
  return taxa;
}

const GraspTaxon& FindGraspTaxon(const std::string& id) {
  std::vector<std::string> known;
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (taxon.id == id) return taxon;
    known.push_back(taxon.id);
  }
  throw Error(ErrorKind::kNotFound, "no grasp \"" + id + "\"" + SuggestNames(id, known));
}

int FindOpposingDigit(const Hand& hand, const Grasp& grasp) {
  int first = -1;
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    const Digit& digit = hand.digits[d];
    if (!std::count(grasp.digits.begin(), grasp.digits.end(), digit.id)) continue;
    if (digit.is_thumb) return static_cast<int>(d);
    if (digit.id == grasp.digits.front()) first = static_cast<int>(d);
  }
  GRASPBENCH_DEMAND(first >= 0, "grasp " + grasp.id + " names no digit of hand " + hand.id);
  return first;
}

std::vector<Grasp> LoadStandardGrasps(const Hand& hand) {
  const std::filesystem::path path = std::filesystem::path(hand.folder) / "hand.yaml";
  const std::string file = path.string();
  Diagnostics problems;
  const YAML::Node root = LoadYaml(path, problems);
  problems.ThrowIfErrors(ErrorKind::kFormat,
                         "the grasps of hand \"" + hand.id + "\" cannot be read:");
  std::vector<Grasp> grasps;
  const YAML::Node node = root["grasps"];
  if (!node.IsDefined()) return grasps;

  YamlMap map(node, file, "grasps", problems);
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    const YAML::Node child = map.Child(taxon.id, Needed::kNo);
    if (child.IsDefined() && !child.IsNull()) {
      grasps.push_back(ReadStandardGrasp(hand, taxon, child, file, problems));
    }
  }
  map.FinishKnownKeys();
  problems.ThrowIfErrors(ErrorKind::kFormat,
                         "the grasps of hand \"" + hand.id + "\" cannot be used:");
  return grasps;
}

const std::vector<GraspTaxonomy>& ListGraspTaxonomies() {
  static const std::vector<GraspTaxonomy> taxonomies = {
      {"Schlesinger",
       1919,
       {"palmar prehension", "tip precision", "spherical grasp", "lateral prehension"}},
      {"Napier", 1956, {"precision grasp", "precision grasp", "power grasp", "-"}},
      {"Iberall and Lyons",
       1984,
       {"basic precision-b", "basic precision-a", "modified power", "basic precision/power-d"}},
      {"Arbib et al.",
       1985,
       {"thumb, fingers 2-3", "thumb, finger 2", "palm, fingers 2-3", "finger 2, finger 3"}},
      {"Lyons", 1985, {"precision grasp", "precision grasp", "encompass grasp", "lateral grasp"}},
      {"Cutkosky",
       1986,
       {"thumb-two finger", "thumb-index finger", "prehensile power", "lateral pinch"}},
      {"Iberall",
       1987,
       {"pad opposition", "pad opposition", "palm opposition", "side opposition"}}};
  return taxonomies;
}

const char* CodeOf(GraspType type) { return kCodes[static_cast<int>(type)]; }
const char* NameOf(GraspType type) { return kNames[static_cast<int>(type)]; }

}  // namespace graspbench
