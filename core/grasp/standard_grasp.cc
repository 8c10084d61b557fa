#include "core/grasp/standard_grasp.h"

#include <algorithm>
#include <filesystem>

#include "core/base/text/yaml.h"
#include "core/base/units.h"
#include "core/grasp/closing_yaml.h"
#include "core/grasp/grasp_keys.h"
#include "core/grasp/posture_yaml.h"

namespace graspbench {
namespace {

Grasp ReadGrasp(const Hand& hand, const GraspTaxon& taxon, const YAML::Node& node,
                const std::string& file, Diagnostics& problems) {
  const std::string where = "grasp " + taxon.id;
  YamlMap map(node, file, where, problems, &ListHandGraspKeys(), "grasps.ID.");
  Grasp grasp;
  grasp.id = taxon.id;
  grasp.type = taxon.type;
  grasp.approach_distance = taxon.approach_distance;
  grasp.alpha = taxon.alpha;

  double tilt_deg = 0.0;
  std::string changed;
  map.Read("digits", grasp.digits);
  map.Read("tilt_deg", tilt_deg);
  map.Read("palm_may_touch", grasp.palm_may_touch, Needed::kNo);
  map.Read("palm_gap_m", grasp.palm_gap, Needed::kNo);
  map.Read("held_share", grasp.held_share, Needed::kNo);
  ReadApproach(map, grasp.approach);
  map.Read("changed", changed, Needed::kNo);
  grasp.tilt = RadFromDeg(tilt_deg);

  CheckGraspDigits(hand, grasp.digits, map);
  ReadClosing(file, where + ", ", problems, ListHandGraspKeys(), "grasps.ID.", map, grasp);
  ReadPosture(hand, map.Child("pre_deg"), file, where + ", pre_deg", problems, grasp.q_pre);
  ReadPosture(hand, map.Child("target_deg"), file, where + ", target_deg", problems,
              grasp.q_target);
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
      grasps.push_back(ReadGrasp(hand, taxon, child, file, problems));
    }
  }
  map.FinishKnownKeys();
  problems.ThrowIfErrors(ErrorKind::kFormat,
                         "the grasps of hand \"" + hand.id + "\" cannot be used:");
  return grasps;
}

}  // namespace graspbench
