#include "datasets/journal/store_sources.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/base/sha256.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

bool IsPattern(const std::string& name) { return name.find('*') != name.npos; }

/** Of several named hashes, in their order. */
std::string CalcListSha256(const std::vector<ManifestSource>& sources) {
  Sha256 sum;
  for (const ManifestSource& source : sources) sum.Add(source.path + " " + source.sha256 + "\n");
  return sum.CalcDigest();
}

std::string CalcFilesSha256(const fs::path& folder, const std::vector<std::string>& files) {
  std::vector<ManifestSource> sources;
  for (const std::string& file : files) {
    // The files of a folder match a longer pattern; what else is no file is damage, found elsewhere.
    if (!fs::is_regular_file(folder / file)) continue;
    sources.push_back({file, SealFile(folder, file).sha256});
  }
  return sources.empty() ? "" : CalcListSha256(sources);
}

}  // namespace

std::string CalcJournalSha256(const fs::path& folder, const std::string& pattern) {
  std::set<std::string> digests;
  for (const std::string& journal : ListMatches(folder, {pattern})) {
    if (!fs::is_regular_file(folder / journal)) continue;
    ForEachLineOfFile(folder / journal, [&](const FileLine& line) {
      if (line.is_whole && IsCheckedLine(line.text)) digests.insert(CalcSha256(line.text));
    });
  }
  Sha256 sum;
  for (const std::string& digest : digests) sum.Add(digest + "\n");
  return sum.CalcDigest();
}

std::vector<ManifestSource> ListSources(const StoreKind& kind, const fs::path& folder,
                                        const std::vector<std::string>& only) {
  const auto is_asked_for = [&](const std::string& name) {
    return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
  };
  std::vector<ManifestSource> sources;
  const auto add = [&](const std::string& name, const std::string& sha256) {
    if (!sha256.empty()) sources.push_back({name, sha256});
  };
  for (const std::string& name : kind.files) {
    const std::vector<std::string> files = ListMatches(folder, {name});
    if (!is_asked_for(name) || files.empty()) continue;
    if (IsPattern(name)) {
      add(name, CalcFilesSha256(folder, files));
    } else if (fs::is_regular_file(folder / name)) {
      add(name, SealFile(folder, name).sha256);
    }
  }
  for (const std::string& name : kind.journals) {
    const bool is_of_results = name.rfind("workers/", 0) != 0;
    if (is_of_results && is_asked_for(name)) add(name, CalcJournalSha256(folder, name));
  }
  for (const std::string& pattern : kind.stores) {
    const bool all = std::find(only.begin(), only.end(), pattern) != only.end();
    const std::vector<std::string> names = ListMatches(folder, {pattern});
    if (all && IsPattern(pattern)) add(pattern, CalcSha256(FormatJson(names)));
    for (const std::string& name : names) {
      if (all || is_asked_for(name)) add(name, CalcSourceSha256(folder / name));
    }
  }
  return sources;
}

std::string CalcSourceSha256(const fs::path& path) {
  std::error_code status;
  if (fs::is_regular_file(path, status)) {
    return SealFile(path.parent_path(), path.filename().string()).sha256;
  }
  if (const StoreKind* kind = FindStoreKind(path)) return CalcListSha256(ListSources(*kind, path));
  if (HasManifest(path)) return SealFile(path, kManifestFile).sha256;
  return "";
}

std::vector<std::string> FindChangedSources(const fs::path& folder, const ManifestOrigin& origin) {
  const fs::path store = folder / "..";
  const StoreKind* kind = FindStoreKind(store);
  const bool is_output = kind && std::find(kind->outputs.begin(), kind->outputs.end(),
                                           folder.filename().string()) != kind->outputs.end();
  std::map<std::string, std::string> now;
  if (is_output) {
    std::vector<std::string> names;
    for (const ManifestSource& source : origin.inputs) {
      if (source.path.rfind("../", 0) == 0) names.push_back(source.path.substr(3));
    }
    for (const ManifestSource& source : ListSources(*kind, store, names)) {
      now["../" + source.path] = source.sha256;
    }
  }
  std::vector<std::string> changed;
  for (const ManifestSource& source : origin.inputs) {
    const auto found = now.find(source.path);
    const std::string sha256 = found != now.end() ? found->second
                               : is_output        ? ""
                                                  : CalcSourceSha256(folder / source.path);
    // What an output came from lies beside it for good; anything else may have been moved.
    if (sha256 != source.sha256 && (is_output || !sha256.empty())) changed.push_back(source.path);
  }
  return changed;
}

}  // namespace graspbench
