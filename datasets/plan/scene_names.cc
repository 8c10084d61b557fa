#include "datasets/plan/scene_names.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "core/base/text/text.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "datasets/plan/rehearsed_grasps.h"
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

constexpr char kAllObjects[] = "all";

/** Those in a folder that is no object itself, by name. */
std::vector<std::string> ListFoldersOfObjects(const std::string& name) {
  namespace fs = std::filesystem;
  std::vector<std::string> folders;
  std::error_code status;
  const auto is_object = [&](const fs::path& path) {
    return fs::is_regular_file(path / "object.yaml", status);
  };
  if (!fs::is_directory(name, status) || is_object(name)) return {};
  for (fs::directory_iterator entry(name, status), end; !status && entry != end;
       entry.increment(status)) {
    if (is_object(entry->path())) folders.push_back(entry->path().string());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
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
  if (std::count(given.begin(), given.end(), ',') > 1) return given;  // a list: JoinRehearsed
  const std::optional<RehearsalConfig> rehearsal = ParseRehearsed(given);
  return rehearsal ? NameRehearsed(*rehearsal) : given;
}

std::vector<std::string> ExpandObjects(const std::vector<std::string>& names) {
  if (names.size() == 1 && names.front() == kAllObjects) return names;
  const std::vector<std::string> catalogue = ListObjects();
  std::vector<std::string> objects;
  for (const std::string& name : names) {
    std::vector<std::string> members = {name};
    if (name == kAllObjects) {
      members = catalogue;
    } else if (std::find(catalogue.begin(), catalogue.end(), name) == catalogue.end()) {
      const std::vector<std::string> found = ListFoldersOfObjects(name);
      if (!found.empty()) members = found;
    }
    objects.insert(objects.end(), members.begin(), members.end());
  }
  return objects;
}

void ReplaceNames(SessionConfig& config) {
  std::transform(config.hands.begin(), config.hands.end(), config.hands.begin(), &FindHandId);
  std::transform(config.objects.begin(), config.objects.end(), config.objects.begin(),
                 &FindObjectId);
  config.objects = ExpandObjects(config.objects);
  std::transform(config.grasps.begin(), config.grasps.end(), config.grasps.begin(), &FindGraspId);
}

std::string FormatListOption(const std::vector<std::string>& values,
                             const std::string& placeholder) {
  std::string text;
  for (const std::string& value : values) {
    if (value.find('/') != std::string::npos) return placeholder;
    text += (text.empty() ? "" : ",") + value;
  }
  return text;
}

std::string DescribeObjectNames(const std::vector<std::string>& names) {
  const std::vector<std::string> catalogue = ListObjects();
  int num_all = 0;
  std::vector<std::pair<std::string, int>> kinds;  // in the order of the names
  const auto count = [&](const std::string& kind, size_t number) {
    const auto known = std::find_if(kinds.begin(), kinds.end(),
                                    [&](const auto& entry) { return entry.first == kind; });
    num_all += static_cast<int>(number);
    if (known == kinds.end()) {
      kinds.emplace_back(kind, number);
    } else {
      known->second += static_cast<int>(number);
    }
  };
  for (const std::string& name : names) {
    const bool is_known = std::find(catalogue.begin(), catalogue.end(), name) != catalogue.end();
    if (is_known || name == kAllObjects) {
      count("the catalogue", is_known ? 1 : catalogue.size());
      continue;
    }
    if (ComesWithProgram(name)) {
      count("the synthetic ones", 1);
      continue;
    }
    std::filesystem::path path = std::filesystem::path(name).lexically_normal();
    if (path.filename() == "object.yaml" || !path.has_filename()) path = path.parent_path();
    const std::string folder = path.parent_path().filename().string();
    count(folder.empty() ? "the working folder" : "the folder " + folder, 1);
  }
  std::string text = FormatCount(num_all, "object");
  for (size_t i = 0; i < kinds.size(); ++i) {
    text += (i == 0 ? ": " : ", ") + std::to_string(kinds[i].second) + " of " + kinds[i].first;
  }
  return text;
}

}  // namespace graspbench
