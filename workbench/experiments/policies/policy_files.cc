#include "workbench/experiments/policies/policy_files.h"

#include <cstring>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/json.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kPolicyFiles[] = "inputs/policies.json";
constexpr size_t kShownDigits = 16;

/** Words of a shell command, without quotes; "--weights=a.pt" is two. */
std::vector<std::string> ListCommandWords(const std::string& command) {
  std::vector<std::string> words(1);
  char quote = '\0';
  for (const char c : command) {
    if (quote != '\0' ? c == quote : c == '\'' || c == '"') {
      quote = quote != '\0' ? '\0' : c;
    } else if (quote == '\0' && std::strchr(" \t\n;|&<>()=", c)) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

/** Empty: there is no such file. */
std::string CalcFileDigest(const std::string& name) {
  std::error_code status;
  if (name.empty() || !fs::is_regular_file(name, status)) return "";
  Sha256 digest;
  ReadPieces(name, [&digest](std::string_view piece) {
    digest.Add(piece);
    return true;
  });
  return digest.CalcDigest();
}

bool IsOfSystem(const std::string& name) {
  std::error_code status;
  const fs::path path = fs::canonical(name, status);
  return !status && path.string().compare(0, 5, "/usr/") == 0;
}

}  // namespace

std::map<std::string, std::string> FindPolicyFiles(const SessionConfig& config,
                                                   const SessionInputs& inputs) {
  std::vector<std::string> commands = {config.policy.command};
  for (const auto& [name, condition] : inputs.conditions) {
    commands.push_back(condition.config.policy.command);
  }
  std::map<std::string, std::string> files;
  for (const std::string& command : commands) {
    for (const std::string& word : ListCommandWords(command)) {
      if (files.count(word) > 0 || IsOfSystem(word)) continue;
      std::string digest = CalcFileDigest(word);
      if (!digest.empty()) files[word] = std::move(digest);
    }
  }
  return files;
}

void KeepPolicyFiles(const std::map<std::string, std::string>& files, const fs::path& folder) {
  if (files.empty()) return;
  const fs::path path = folder / kPolicyFiles;
  MakeFolder(path.parent_path());
  WriteFileAtomically(path, Json(files).dump(1) + "\n");
}

void CheckPolicyFiles(const fs::path& folder) {
  std::error_code status;
  const fs::path own = folder / kPolicyFiles;
  const fs::path path = fs::exists(own, status) ? own : folder / ".." / ".." / kPolicyFiles;
  if (!fs::exists(path, status)) return;
  std::string changed;
  const Json kept = Json::parse(ReadFile(path));
  for (const auto& [name, before] : kept.items()) {
    const std::string now = CalcFileDigest(name);
    const std::string digest = before.get<std::string>();
    if (now == digest) continue;
    changed += "\n  " + name + ": SHA-256 " + digest.substr(0, kShownDigits) +
               (now.empty() ? ".., but the file is missing now"
                            : ".., now " + now.substr(0, kShownDigits) + "..");
  }
  if (changed.empty()) return;
  throw Error(ErrorKind::kUsage,
              "the session's policy has changed since it was started:" + changed +
                  "\nA session must not mix two policies. Restore the files in the folder in which "
                  "the session was started, or start another session with --out");
}

}  // namespace graspbench
