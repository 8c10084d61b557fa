#include "datasets/pipeline/stable_files.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <set>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/yaml.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/manifest.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/journal/store_kind.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

bool LeadsOutside(const fs::path& folder, const std::string& value) {
  const fs::path path(value);
  const bool goes_up = std::find(path.begin(), path.end(), "..") != path.end();
  std::error_code status;
  return (path.is_absolute() || goes_up) && value.find('\n') == value.npos &&
         fs::exists(path.is_absolute() ? path : folder / path, status);
}

class HiddenInputs {
 public:
  HiddenInputs(const PipelineStage& stage, const fs::path& file, Diagnostics& problems)
      : stage_(stage), file_(file), problems_(problems) {}

  void Check(const YAML::Node& node) {
    if (node.IsMap()) {
      for (const auto& item : node) Check(item.second);
    } else if (node.IsSequence()) {
      for (const auto& item : node) Check(item);
    } else if (node.IsScalar() && LeadsOutside(file_.parent_path(), node.Scalar())) {
      problems_.Fail(
          file_.string(), node.Mark().line + 1,
          "stage " + stage_.name + " would read \"" + node.Scalar() +
              "\", which the pipeline does not name: changes would stay undetected, and packs "
              "would lack it; copy it beside the pipeline and list it under inputs or files");
    }
  }

 private:
  const PipelineStage& stage_;
  const fs::path& file_;
  Diagnostics& problems_;
};

void CheckFile(const PipelineStage& stage, const fs::path& file, Diagnostics& problems) {
  const std::string ending = file.extension().string();
  if (ending != ".yaml" && ending != ".yml") return;
  Diagnostics syntax;  // which the stage's own command tells
  const YAML::Node root = ParseYaml(ReadFile(file), file.string(), syntax);
  if (syntax.num_errors() == 0) HiddenInputs(stage, file, problems).Check(root);
}

/** In a store: clocks, hosts and what depends on them. */
constexpr const char* kVaryingFiles[] = {kManifestFile, "run.json", "ro-crate-metadata.json"};
constexpr const char* kVaryingFolders[] = {"progress", "workers"};

template <class Names>
bool IsOneOf(const std::string& name, const Names& names) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/** What a killed process left of a file that it was writing (core/base/files/files.h). */
bool IsLeftPart(const std::string& name) {
  const size_t part = name.rfind(".part");
  return part != name.npos && part + 5 < name.size() &&
         std::isdigit(static_cast<unsigned char>(name[part + 5])) &&
         name.find('-', part) != name.npos;
}

// "journal/*.jsonl": a folder whose files are named after workers.
bool IsOfWorkers(const std::string& pattern) {
  const size_t slash = pattern.find('/');
  return slash != pattern.npos && pattern.substr(slash) == "/*.jsonl" &&
         pattern.find('*') == slash + 1;
}

struct Found {
  std::function<void(const std::string& path)> file;
  std::function<void(const fs::path& store, const std::string& pattern)> journal;
  std::function<void(const fs::path& store, const StoreKind& kind)> store;
};

/** In no order. @param inside  of the whole folder. */
void Walk(const fs::path& folder, const fs::path& inside, const Found& found) {
  const StoreKind* kind = FindStoreKind(folder / inside);
  std::set<std::string> journals;
  if (kind) {
    for (const std::string& pattern : kind->journals) {
      if (IsOfWorkers(pattern)) journals.insert(pattern.substr(0, pattern.find('/')));
    }
  }
  for (const auto& entry : fs::directory_iterator(folder / inside)) {
    const std::string name = entry.path().filename().string();
    const bool is_folder = entry.is_directory() && !entry.is_symlink();
    if (is_folder) {
      if (kind && IsOneOf(name, kVaryingFolders)) continue;
      if (kind && journals.count(name) > 0) {
        found.journal(inside, name + "/*.jsonl");
      } else {
        Walk(folder, inside / name, found);
      }
    } else if (!(kind && IsOneOf(name, kVaryingFiles)) && !IsLeftPart(name)) {
      found.file((inside / name).generic_string());
    }
  }
  if (kind) found.store(inside, *kind);
}

std::string CalcFileSha256(const fs::path& folder, const std::string& path) {
  // A link to nowhere, a pipe: it is there, and is no file of a result.
  if (!fs::is_regular_file(folder / path)) return "no file";
  return SealFile(folder, path).sha256;
}

/** Lines of all files, each once. */
std::set<std::string> ReadLines(const fs::path& store, const std::string& pattern) {
  std::set<std::string> lines;
  for (const std::string& journal : ListMatches(store, {pattern})) {
    ForEachLineOfFile(store / journal, [&](const FileLine& line) {
      if (line.is_whole && IsCheckedLine(line.text)) lines.emplace(line.text);
    });
  }
  return lines;
}

/** The system's faults in our words. */
template <class Work>
void WithFiles(const fs::path& path, const Work& work) {
  try {
    work();
  } catch (const fs::filesystem_error& fault) {
    throw Error(ErrorKind::kIo,
                "cannot read or copy \"" + path.string() + "\": " + fault.code().message());
  }
}

}  // namespace

void CheckHiddenInputs(const Pipeline& pipeline, const PipelineStage& stage,
                       Diagnostics& problems) {
  for (const StageInput& input : stage.inputs) {
    if (!input.stage.empty()) continue;
    const fs::path path = fs::path(pipeline.folder) / input.path;
    if (!fs::is_directory(path)) {
      if (fs::is_regular_file(path)) CheckFile(stage, path, problems);
      continue;
    }
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(path)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) CheckFile(stage, file, problems);
  }
}

std::map<std::string, std::string> ListStableFiles(const fs::path& path) {
  std::map<std::string, std::string> files;
  WithFiles(path, [&] {
    if (!fs::is_directory(path)) {
      const std::string name = path.filename().string();
      files[name] = SealFile(path.parent_path().empty() ? "." : path.parent_path(), name).sha256;
      return;
    }
    Walk(path, {},
         {[&](const std::string& file) { files[file] = CalcFileSha256(path, file); },
          [&](const fs::path& store, const std::string& pattern) {
            files[(store / pattern).generic_string()] = CalcJournalSha256(path / store, pattern);
          },
          [&](const fs::path& store, const StoreKind&) {
            // Its bytes vary with the workers; without it no command opens the store.
            if (!HasManifest(path / store)) return;
            files[(store / kManifestFile).generic_string()] =
                FindManifest(path / store) ? "whole" : "damaged";
          }});
  });
  return files;
}

std::string CalcStableSha256(const std::map<std::string, std::string>& files) {
  Sha256 sum;
  for (const auto& [path, sha256] : files) sum.Add(path + '\n' + sha256 + '\n');
  return sum.CalcDigest();
}

void CopyStableFiles(const fs::path& from, const fs::path& to) {
  std::vector<std::pair<fs::path, const StoreKind*>> stores;  // inner ones first
  WithFiles(from, [&] {
    MakeFolder(to);
    Walk(from, {},
         {[&](const std::string& file) {
            MakeFolder((to / file).parent_path());
            fs::copy_file(from / file, to / file);
          },
          [&](const fs::path& store, const std::string& pattern) {
            std::string text;
            for (const std::string& line : ReadLines(from / store, pattern)) text += line + "\n";
            const fs::path folder = to / store / fs::path(pattern).parent_path();
            if (text.empty()) return;
            MakeFolder(folder);
            WriteFile(folder / "0.jsonl", text);
          },
          [&](const fs::path& store, const StoreKind& kind) {
            stores.push_back({store, &kind});
          }});
  });
  for (const auto& [store, kind] : stores) {
    SealStore(*kind, to / store, FindManifest(from / store).value_or(Manifest()).inputs);
  }
}

}  // namespace graspbench
