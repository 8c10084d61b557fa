#include "datasets/journal/sealed_store.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "datasets/journal/append_file.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/file_lock.h"
#include "datasets/journal/read_journal.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

constexpr char kDamaged[] = ".damaged";
constexpr char kSetAside[] = ".set-aside";
constexpr char kIsUnsealed[] = "is not in the manifest";

void SortByPath(std::vector<ManifestFile>& files) {
  std::sort(files.begin(), files.end(),
            [](const ManifestFile& a, const ManifestFile& b) { return a.path < b.path; });
}

void Remove(std::vector<ManifestFile>& files, const std::vector<std::string>& patterns) {
  files.erase(
      std::remove_if(files.begin(), files.end(),
                     [&](const ManifestFile& file) { return IsMatch(file.path, patterns); }),
      files.end());
}

/** Schema and versions as the text of a frozen configuration has them. */
Json ParseVersions(const StoreKind& kind, const std::string& text) {
  try {
    const Json frozen = Json::parse(text);
    return {{"program", frozen.at("program_version")},
            {"physics", frozen.at("physics_version")},
            {"schema", IntFrom(frozen.at("schema"))}};
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::kFormat,
                std::string(kind.file) + " is damaged: " + DescribeJsonFault(e));
  }
}

Json LoadVersions(const StoreKind& kind, const fs::path& folder) {
  return ParseVersions(kind, ReadFile(folder / kind.file));
}

/** Of the files as they are now; the versions are left out. */
Manifest MakeManifest(const StoreKind& kind, const fs::path& folder) {
  Manifest manifest;
  manifest.kind = kind.name;
  for (const auto* patterns : {&kind.files, &kind.derived}) {
    for (const std::string& path : ListMatches(folder, *patterns)) {
      if (fs::is_directory(folder / path)) continue;  // its files match a longer pattern
      manifest.files.push_back(SealFile(folder, path));
    }
  }
  for (const std::string& path : ListMatches(folder, kind.journals)) {
    const bool with_torn_line = kind.keeps_torn_lines && !IsMatch(path, kind.shared_journals);
    manifest.files.push_back(SealJournal(folder, path, with_torn_line));
  }
  SortByPath(manifest.files);
  return manifest;
}

/** What never changes and cannot be made again is judged by its first seal. */
void KeepFirstSeals(const StoreKind& kind, const Manifest& before, Manifest& after) {
  std::set<std::string> kept;  // thousands, in a session of many own objects
  for (const ManifestFile& old : before.files) {
    if (IsMatch(old.path, kind.files)) kept.insert(old.path);
  }
  const auto is_kept = [&](const ManifestFile& file) { return kept.count(file.path) > 0; };
  after.files.erase(std::remove_if(after.files.begin(), after.files.end(), is_kept),
                    after.files.end());
  std::copy_if(before.files.begin(), before.files.end(), std::back_inserter(after.files), is_kept);
  SortByPath(after.files);
}

/** Without the stores inside it. @param only  patterns; empty: all of them. */
StoreState CheckOwnFiles(const StoreKind& kind, const fs::path& folder,
                         const std::vector<std::string>& only = {}) {
  const auto is_asked_for = [&](const std::string& path) {
    return only.empty() || IsMatch(path, only);
  };
  StoreState state;
  state.kind = kind.name;
  Manifest manifest;
  if (!HasManifest(folder)) {
    try {
      LoadVersions(kind, folder);
      state.damages.push_back({kManifestFile, 0, "is missing"});
    } catch (const Error&) {
      RethrowUnlessDamage(folder / kind.file);
      state.damages.push_back({kind.file, 0, "is no configuration"});
    }
  } else {
    try {
      manifest = LoadManifest(folder);
      state.is_made_anew = manifest.is_made_anew;
      Manifest asked_for = manifest;
      asked_for.files.erase(
          std::remove_if(asked_for.files.begin(), asked_for.files.end(),
                         [&](const ManifestFile& file) { return !is_asked_for(file.path); }),
          asked_for.files.end());
      state.damages = FindDamage(folder, asked_for);
      if (manifest.kind != kind.name) {
        state.damages.push_back({kManifestFile, 0, "is that of a " + manifest.kind});
      }
    } catch (const Error&) {
      RethrowUnlessDamage(folder / kManifestFile);
      state.damages.push_back({kManifestFile, 0, "its bytes have changed"});
    }
  }
  if (manifest.files.empty() && !state.damages.empty()) return state;
  for (const std::string& file : ListMatches(folder, kind.files)) {
    // Stores inside come and go between two seals; they vouch for themselves.
    if (file.find('/') == file.npos && is_asked_for(file) && !manifest.Find(file)) {
      state.damages.push_back({file, 0, kIsUnsealed});
    }
  }
  const auto add = [&](const std::vector<Damage>& damages) {
    state.damages.insert(state.damages.end(), damages.begin(), damages.end());
  };
  for (const std::string& journal : ListMatches(folder, kind.journals)) {
    if (!is_asked_for(journal)) continue;
    const bool is_sealed = manifest.Find(journal) != nullptr;
    if (!fs::is_regular_file(folder / journal)) {
      if (!is_sealed) state.damages.push_back({journal, 0, "is no file"});
      continue;
    }
    if (!is_sealed) add(FindBadLines(folder, journal, 0));
    add(FindForeignLines(kind, folder, journal, manifest));
  }
  return state;
}

/** Moves the lines that are no records of this journal into a file beside. @returns how many. */
int SetLinesAside(const StoreKind& kind, const fs::path& folder, const std::string& name,
                  const Manifest& manifest) {
  const fs::path journal = folder / name;
  const AppendFile lock(journal);
  std::set<int> foreign;
  for (const Damage& damage : FindForeignLines(kind, folder, name, manifest))
    foreign.insert(damage.line);
  std::string good, bad;
  int num_bad = 0;
  ForEachLineOfFile(journal, [&](const FileLine& line) {
    try {
      if (line.text.empty()) return;
      ParseCheckedLine(line.text);
      if (foreign.count(line.number) > 0) throw Error(ErrorKind::kFormat, "of another kind");
      good.append(line.text) += '\n';
    } catch (const Error&) {
      bad.append(line.text) += '\n';
      ++num_bad;
    }
  });
  if (num_bad == 0) return 0;
  AppendFile(journal.string() + kDamaged).Append(bad);
  WriteFileAtomically(journal, good);
  return num_bad;
}

void SetFileAside(const fs::path& path, const char* ending) {
  fs::path aside = path.string() + ending;
  for (int number = 2; fs::exists(aside); ++number) {
    aside = path.string() + ending + std::to_string(number);
  }
  std::error_code status;
  fs::rename(path, aside, status);
  if (status) {
    throw Error(ErrorKind::kIo, "cannot rename \"" + path.string() + "\": " + status.message());
  }
}

void RepairJournals(const StoreKind& kind, const fs::path& folder, const Manifest& manifest,
                    const StoreState& state, StoreRepair& repair) {
  for (const std::string& journal : ListMatches(folder, kind.journals)) {
    const bool is_damaged =
        std::any_of(state.damages.begin(), state.damages.end(), [&](const Damage& damage) {
          return damage.path == journal || damage.path == kManifestFile;
        });
    if (!is_damaged) continue;
    const int count = SetLinesAside(kind, folder, journal, manifest);
    if (count == 0) continue;
    repair.actions.push_back(journal + ": " + FormatCount(count, "damaged line") +
                             " set aside in " + journal + kDamaged);
  }
}

/** True when something that can be made again was damaged: then all of it is to be. */
bool RepairDerived(const StoreKind& kind, const fs::path& folder, const StoreState& state,
                   StoreRepair& repair) {
  bool is_damaged = false;
  for (const Damage& damage : state.damages) {
    if (!IsMatch(damage.path, kind.derived)) continue;
    is_damaged = true;
    std::string action = damage.path + ": ";
    if (fs::exists(folder / damage.path)) {
      SetFileAside(folder / damage.path, kDamaged);
      action += "set aside as " + damage.path + kDamaged + "; ";
    }
    repair.actions.push_back(action + "it is rebuilt when the run continues");
  }
  return is_damaged;
}

void RepairOwnFiles(const StoreKind& kind, const fs::path& folder, StoreRepair& repair) {
  const StoreState state = CheckOwnFiles(kind, folder);
  if (state.damages.empty()) return;
  Manifest before = FindManifest(folder).value_or(Manifest());
  if (before.files.empty()) {
    before.versions = LoadVersions(kind, folder);
    before.is_made_anew = true;
    repair.actions.push_back(std::string(kManifestFile) + ": rebuilt from the present files");
  }
  RepairJournals(kind, folder, before, state, repair);
  const bool are_derived_damaged = RepairDerived(kind, folder, state, repair);
  Manifest after = MakeManifest(kind, folder);
  after.versions = before.versions;
  after.inputs = before.inputs;
  after.is_made_anew = before.is_made_anew;
  if (are_derived_damaged) Remove(after.files, kind.derived);
  KeepFirstSeals(kind, before, after);
  WriteManifest(folder, after);
  repair.actions.push_back(
      "sealed the existing results; missing trials run when the session continues");
}

std::vector<Damage> CheckOutput(const fs::path& output) {
  if (!HasManifest(output)) return {};
  try {
    return FindDamage(output, LoadManifest(output));
  } catch (const Error&) {
    RethrowUnlessDamage(output / kManifestFile);
    return {{kManifestFile, 0, "its bytes have changed"}};
  }
}

/** The name from the store of a file that an output's manifest names. */
std::string NameInStore(const std::string& output, const std::string& file) {
  return (fs::path(output) / file).lexically_normal().generic_string();
}

void RepairOutputs(const StoreKind& kind, const fs::path& folder, StoreRepair& repair) {
  for (const std::string& output : kind.outputs) {
    const std::vector<Damage> damages = CheckOutput(folder / output);
    for (const Damage& damage : damages) {
      const std::string name = NameInStore(output, damage.path);
      std::string action = name + ": ";
      if (fs::exists(folder / name)) {
        SetFileAside(folder / name, kDamaged);
        action += "set aside as " + name + kDamaged + "; ";
      }
      repair.actions.push_back(action + "graspbench " + output + " makes it again");
    }
    if (!damages.empty()) UnsealOutput(folder / output);
  }
}

const StoreKind* DemandKind(const fs::path& folder) {
  const StoreKind* kind = FindStoreKind(folder);
  if (kind || HasManifest(folder)) return kind;
  throw Error(
      ErrorKind::kNotFound,
      "\"" + folder.string() +
          "\" holds no session, optimisation, campaign or other result of graspbench" +
          (fs::exists(folder / "pipeline.lock") ? "; for a pipeline, check each result folder, and "
                                                  "use graspbench pipeline status for stale stages"
                                                : ""));
}

/** The stores inside that are begun or that the manifest knows. */
std::vector<std::string> ListStores(const StoreKind& kind, const fs::path& folder) {
  std::vector<std::string> stores;
  for (const std::string& name : ListMatches(folder, kind.stores)) {
    if (FindStoreKind(folder / name)) stores.push_back(name);
  }
  return stores;
}

enum class OutputUse { kSkip, kCheck };

/** @param name  of the folder for the person who asked. */
void AddStale(const fs::path& folder, const std::string& name, std::vector<StaleResult>& stale) {
  const std::optional<Manifest> manifest = FindManifest(folder);
  if (!manifest || !manifest->origin) return;
  for (const std::string& input : FindChangedSources(folder, *manifest->origin)) {
    stale.push_back({name, input, manifest->origin->command});
  }
}

StoreState Check(const fs::path& folder, OutputUse outputs) {
  const StoreKind* kind = DemandKind(folder);
  if (!kind) {
    StoreState state;
    try {
      const Manifest manifest = LoadManifest(folder);
      state.kind = manifest.kind;
      state.damages = FindDamage(folder, manifest);
      if (outputs == OutputUse::kCheck) AddStale(folder, ".", state.stale);
    } catch (const Error&) {
      RethrowUnlessDamage(folder / kManifestFile);
      state.kind = "result";
      state.damages.push_back({kManifestFile, 0, "its bytes have changed"});
    }
    return state;
  }
  StoreState state = CheckOwnFiles(*kind, folder);
  for (const std::string& store : ListStores(*kind, folder)) {
    const StoreState inner = Check(folder / store, outputs);
    state.is_made_anew = state.is_made_anew || inner.is_made_anew;
    for (const Damage& damage : inner.damages) {
      state.damages.push_back({store + "/" + damage.path, damage.line, damage.text});
    }
    for (const StaleResult& stale : inner.stale) {
      state.stale.push_back({store + "/" + stale.path, stale.input, stale.command});
    }
  }
  if (outputs == OutputUse::kSkip) return state;
  for (const std::string& output : kind->outputs) {
    for (const Damage& damage : CheckOutput(folder / output)) {
      state.damages.push_back({NameInStore(output, damage.path), damage.line, damage.text});
    }
    AddStale(folder / output, output, state.stale);
  }
  return state;
}

/** Which commands go on with a damaged store when they are told to. */
std::string DescribeAcceptance(const StoreKind* kind) {
  const std::string commands = kind == &kSessionStore ? "report, export, judge and run --resume do"
                               : kind == &kCampaignStore ? "report does"
                                                         : "";
  return commands.empty() ? "" : "; " + commands + " so as it is with --accept-damage";
}

}  // namespace

void SealNewStore(const StoreKind& kind, const fs::path& folder, const std::string& frozen) {
  Manifest manifest = MakeManifest(kind, folder);
  Remove(manifest.files, {kind.file});
  manifest.files.push_back({kind.file, frozen.size(), CalcSha256(frozen), std::nullopt});
  SortByPath(manifest.files);
  manifest.versions = ParseVersions(kind, frozen);
  WriteManifest(folder, manifest);
}

void WriteDerived(const StoreKind& kind, const fs::path& folder,
                  const std::map<std::string, std::string>& contents) {
  std::optional<Manifest> manifest = FindManifest(folder);
  std::vector<std::string> names;
  for (const auto& [name, content] : contents) {
    const ManifestFile* seal = manifest ? manifest->Find(name) : nullptr;
    if (!seal || seal->sha256 != CalcSha256(content)) names.push_back(name);
  }
  if (names.empty()) return;
  if (manifest) {  // a program that is killed between the two leaves no file with a wrong seal
    Remove(manifest->files, names);
    WriteManifest(folder, *manifest);
  }
  for (const auto& [name, content] : contents) WriteFileAtomically(folder / name, content);
  SealStore(kind, folder);
}

void SealStore(const StoreKind& kind, const fs::path& folder, const std::string& inputs) {
  const Manifest before = FindManifest(folder).value_or(Manifest());
  Manifest manifest = MakeManifest(kind, folder);
  for (const std::string& name : ListMatches(folder, kind.journals)) RemoveLeftOwner(folder / name);
  KeepFirstSeals(kind, before, manifest);
  manifest.versions = before.files.empty() ? LoadVersions(kind, folder) : before.versions;
  manifest.inputs = inputs.empty() ? before.inputs : inputs;
  manifest.is_made_anew = before.is_made_anew;
  WriteManifest(folder, manifest);
}

void UnsealOutput(const fs::path& output) {
  if (fs::is_symlink(output)) {
    throw Error(ErrorKind::kUsage, "\"" + output.string() +
                                       "\" is a link to a folder that may belong to somebody else; "
                                       "remove the link, or name another folder with --out");
  }
  for (const Damage& changed : CheckOutput(output)) {
    const fs::path file = output / changed.path;
    const bool is_there = fs::exists(fs::symlink_status(file));
    if (is_there && changed.path != kManifestFile) SetFileAside(file, kSetAside);
  }
  std::error_code status;
  if (fs::remove(output / kManifestFile, status)) SyncFolder(output);
  if (status) {
    throw Error(ErrorKind::kIo,
                "cannot remove \"" + (output / kManifestFile).string() + "\": " + status.message());
  }
}

void SealOutput(const fs::path& output, const std::vector<std::string>& files,
                const ManifestOrigin& origin) {
  Manifest manifest;
  manifest.kind = "output";
  manifest.origin = origin;
  for (const std::string& file : files) manifest.files.push_back(SealFile(output, file));
  SortByPath(manifest.files);
  WriteManifest(output, manifest);
}

StoreState CheckStore(const fs::path& folder) { return Check(folder, OutputUse::kCheck); }

StoreState VerifyStore(const fs::path& folder, OnDamage on_damage,
                       const std::vector<std::string>& only) {
  StoreState state = only.empty() ? Check(folder, OutputUse::kSkip)
                                  : CheckOwnFiles(*DemandKind(folder), folder, only);
  if (state.damages.empty() || on_damage == OnDamage::kAccept) return state;
  const std::string lost = DescribeLostFiles(folder, state.damages);
  throw Error(ErrorKind::kFormat,
              "the " + state.kind + " in \"" + folder.string() + "\" is damaged" +
                  FormatDamage(state.damages) + "\n" +
                  (lost.empty() ? "graspbench verify --repair " + folder.string() +
                                      " sets damaged lines aside and keeps all intact ones; then "
                                      "any command continues"
                                : lost) +
                  DescribeAcceptance(FindStoreKind(folder)));
}

std::string DescribeLostFiles(const fs::path& folder, const std::vector<Damage>& damages) {
  const StoreKind* kind = FindStoreKind(folder);
  if (!kind) return "";
  std::vector<std::string> lost;
  for (const Damage& damage : damages) {
    const bool never_changes = IsMatch(damage.path, kind->files) && damage.text != kIsUnsealed;
    if (never_changes) lost.push_back(damage.path);
  }
  if (lost.empty()) return "";
  return "no repair can restore " + lost[0] +
         (lost.size() > 1 ? " and " + std::to_string(lost.size() - 1) + " more" : "") +
         ": restore a copy, or use a new folder";
}

void SetJournalAside(const fs::path& folder, const std::string& journal) {
  const StoreKind* kind = DemandKind(folder);
  if (!kind) throw Error(ErrorKind::kUsage, "\"" + folder.string() + "\" has no journals");
  for (const std::string& store : ListStores(*kind, folder)) {
    if (journal.rfind(store + "/", 0) != 0) continue;
    return SetJournalAside(folder / store, journal.substr(store.size() + 1));
  }
  const std::vector<std::string> journals = ListMatches(folder, kind->journals);
  if (std::find(journals.begin(), journals.end(), journal) == journals.end()) {
    throw Error(ErrorKind::kUsage, "no journal \"" + journal + "\" in \"" + folder.string() + "\"" +
                                       SuggestNames(journal, journals));
  }
  VerifyStore(folder, OnDamage::kRefuse);
  if (std::optional<Manifest> manifest = FindManifest(folder)) {
    Remove(manifest->files, {journal});
    WriteManifest(folder, *manifest);
  }
  SetFileAside(folder / journal, kSetAside);
}

StoreRepair RepairStore(const fs::path& folder) {
  const StoreKind* kind = DemandKind(folder);
  StoreRepair repair;
  if (kind) {
    RepairOwnFiles(*kind, folder, repair);
    RepairOutputs(*kind, folder, repair);
    for (const std::string& store : ListStores(*kind, folder)) {
      const StoreRepair inner = RepairStore(folder / store);
      for (const std::string& action : inner.actions) {
        repair.actions.push_back(store + "/" + action);
      }
    }
  }
  repair.state = CheckStore(folder);
  return repair;
}

std::vector<std::string> FindUnverified(const fs::path& folder) {
  std::vector<std::string> files;
  const StoreKind* kind = FindStoreKind(folder);
  const std::optional<Manifest> manifest = FindManifest(folder);
  if (!kind || !manifest) return files;
  for (const std::string& file : ListMatches(folder, kind->derived)) {
    if (!manifest->Find(file) && fs::is_regular_file(folder / file)) files.push_back(file);
  }
  for (const std::string& output : kind->outputs) {
    if (HasManifest(folder / output) || !fs::is_directory(folder / output)) continue;
    for (const std::string& file : ListMatches(folder, {output + "/*"})) {
      if (fs::is_regular_file(folder / file)) files.push_back(file);
    }
  }
  for (const std::string& store : ListMatches(folder, kind->stores)) {
    for (const std::string& file : FindUnverified(folder / store)) {
      files.push_back(store + "/" + file);
    }
  }
  return files;
}

std::string DescribeUnverified(const std::string& file) {
  return file + ": cannot be verified, because it has no stored hash";
}

}  // namespace graspbench
