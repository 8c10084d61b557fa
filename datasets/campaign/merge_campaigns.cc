#include "datasets/campaign/merge_campaigns.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/plan/frozen_folder.h"
#include "datasets/shards/worker_log.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** What is to be copied, found before a byte is written. */
struct Copies {
  std::vector<std::pair<fs::path, fs::path>> files;  // from, to; in this order
  int num_answers = 0;
};

/** A journal's whole lines; empty: there is none. */
std::string ReadLines(const fs::path& path) {
  std::error_code status;
  if (!fs::exists(path, status)) return "";
  const std::string text = ReadFile(path);
  return text.substr(0, text.rfind('\n') + 1);  // npos + 1 is 0
}

/** True when the journal there is the longer one. */
bool AddJournal(const fs::path& here, const fs::path& there, Copies& copies) {
  const std::string mine = ReadLines(here), other = ReadLines(there);
  const size_t common = std::min(mine.size(), other.size());
  if (mine.compare(0, common, other, 0, common) != 0) {
    throw Error(ErrorKind::kFormat, "\"" + there.string() + "\" has other answers than \"" +
                                        here.string() +
                                        "\": two machines or versions of the program have worked "
                                        "on it; nothing was merged, leave one of them out");
  }
  if (other.size() <= mine.size()) return false;
  copies.files.emplace_back(there, here);
  copies.num_answers += static_cast<int>(
      std::count(other.begin() + static_cast<std::ptrdiff_t>(common), other.end(), '\n'));
  return true;
}

void AddScene(const fs::path& here, const fs::path& there, Copies& copies) {
  AddJournal(here / "journal.jsonl", there / "journal.jsonl", copies);
  if (!HasSceneResult(there)) return;
  if (HasSceneResult(here)) {
    if (ReadFile(here / "result.json") == ReadFile(there / "result.json")) return;
    throw Error(ErrorKind::kFormat, "\"" + there.string() + "\" has another result than \"" +
                                        here.string() + "\"; nothing was merged");
  }
  for (const std::string& name : ListMatches(there, kSceneStore.derived)) {
    copies.files.emplace_back(there / name, here / name);
  }
  copies.files.emplace_back(there / kManifestFile, here / kManifestFile);  // last: it is finished
}

/** The program's version may differ. */
void CheckSameStore(const StoreKind& kind, const fs::path& folder, const fs::path& other) {
  VerifyStore(other, OnDamage::kRefuse);
  LoadFrozen(kind, other);
  const auto load = [&kind](const fs::path& of) {
    Json frozen = Json::parse(ReadFile(of / kind.file));
    frozen.erase("program_version");
    const std::optional<Manifest> manifest = FindManifest(of);
    return std::pair(frozen, kind.stores.empty() || !manifest ? "" : manifest->inputs);
  };
  const auto describe = [](const fs::path& of, const std::pair<Json, std::string>& store) {
    return "\n  " + of.string() + ": schema " + FormatJson(store.first.at("schema")) +
           ", physics " + FormatJson(store.first.at("physics_version")) + ", settings " +
           CalcHashHex(FormatJson(store.first.at("config"))) +
           (store.second.empty() ? "" : ", inputs " + store.second);
  };
  const auto here = load(folder), there = load(other);
  if (here == there) return;
  throw Error(ErrorKind::kUsage, "\"" + other.string() + "\" holds another " + kind.name +
                                     " than \"" + folder.string() + "\", nothing was merged:" +
                                     describe(folder, here) + describe(other, there));
}

void Copy(const Copies& copies) {
  for (const auto& [from, to] : copies.files) {
    MakeFolder(to.parent_path());
    WriteFileAtomically(to, to.extension() == ".jsonl" ? ReadLines(from) : ReadFile(from));
  }
}

}  // namespace

int MergeScenes(const fs::path& folder, const std::vector<fs::path>& others) {
  int num_answers = 0;
  VerifyStore(folder, OnDamage::kRefuse);
  for (const fs::path& other : others) CheckSameStore(kSceneStore, folder, other);
  for (const fs::path& other : others) {
    Copies copies;
    AddScene(folder, other, copies);
    Copy(copies);
    num_answers += copies.num_answers;
  }
  return num_answers;
}

int MergeCampaigns(const fs::path& folder, const std::vector<fs::path>& others) {
  int num_answers = 0;
  VerifyStore(folder, OnDamage::kRefuse);
  for (const fs::path& other : others) CheckSameStore(kCampaignStore, folder, other);
  for (const fs::path& other : others) {
    Copies copies;
    for (const fs::path& scene : ListScenes(other)) {
      const fs::path here = folder / scene.lexically_relative(other);
      if (!HasScene(here)) {
        throw Error(ErrorKind::kFormat, "\"" + folder.string() + "\" lacks the scene \"" +
                                            here.filename().string() +
                                            "\" of the same campaign; nothing was merged");
      }
      AddScene(here, scene, copies);
    }
    for (const std::string& search : ListMatches(other, {"comparison/*/*.jsonl"})) {
      AddJournal(folder / search, other / search, copies);
    }
    Copy(copies);
    std::set<std::string> known = ListStartLines(folder);
    AppendStarts(folder, CollectStarts(other, known));
    num_answers += copies.num_answers;
  }
  return num_answers;
}

}  // namespace graspbench
