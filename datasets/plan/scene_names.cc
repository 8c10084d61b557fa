#include "datasets/plan/scene_names.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "core/base/text/text.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

std::string FindId(const std::string& given, std::vector<std::string> (*list_ids)(),
                   std::string (*find_name)(const std::string& id)) {
  if (given.find('/') != given.npos) return given;  // a path, perhaps one of thousands
  const std::vector<std::string> ids = list_ids();
  const std::string wanted = MakeComparable(given);
  for (const std::string& id : ids) {
    if (wanted == MakeComparable(id)) return id;
  }
  std::error_code status;
  if (wanted == "all" || std::filesystem::exists(given, status)) return given;
  static std::map<std::pair<const void*, std::string>, std::string> names;  // read once
  for (const std::string& id : ids) {
    const auto [name, is_new] = names.try_emplace({reinterpret_cast<const void*>(find_name), id});
    if (is_new) name->second = MakeComparable(find_name(id));
    if (wanted == name->second) return id;
  }
  return given;
}

}  // namespace

std::string MakeComparable(const std::string& name) {
  std::string comparable = ToLower(name);
  std::replace_if(
      comparable.begin(), comparable.end(), [](char c) { return c == ' ' || c == '-'; }, '_');
  return comparable;
}

std::string FindHandId(const std::string& given) {
  return FindId(given, &ListHands, [](const std::string& id) { return LoadHand(id).name; });
}

std::string FindObjectId(const std::string& given) {
  return FindId(given, &ListObjects,
                [](const std::string& id) { return LoadObject(id, FieldUse::kLater)->name; });
}

std::string FindGraspId(const std::string& given) {
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (MakeComparable(given) == MakeComparable(taxon.name)) return taxon.id;
    if (MakeComparable(given) == taxon.id) return taxon.id;
  }
  return given;
}

void ReplaceNames(SessionConfig& config) {
  std::transform(config.hands.begin(), config.hands.end(), config.hands.begin(), &FindHandId);
  std::transform(config.objects.begin(), config.objects.end(), config.objects.begin(),
                 &FindObjectId);
  std::transform(config.grasps.begin(), config.grasps.end(), config.grasps.begin(), &FindGraspId);
}

}  // namespace graspbench
