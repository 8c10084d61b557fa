#include "core/grasp/grasp_taxonomies.h"

namespace graspbench {
namespace {

constexpr const char* kCodes[] = {"t1", "t2", "t3", "t4"};
constexpr const char* kNames[] = {"all finger precision", "two finger precision", "power",
                                  "two finger pinch"};

}  // namespace

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
