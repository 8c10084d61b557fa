#include "datasets/journal/manifest.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/json_cursor.h"
#include "core/base/text/text.h"
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

/** Bytes, hash and line breaks of a file's first `limit` bytes. */
ManifestFile Measure(const fs::path& folder, const std::string& path, uintmax_t limit) {
  ManifestFile file{path, 0, "", 0};
  Sha256 sum;
  ReadPieces(folder / path, [&](std::string_view piece) {
    piece =
        piece.substr(0, static_cast<size_t>(std::min<uintmax_t>(piece.size(), limit - file.bytes)));
    sum.Add(piece);
    file.bytes += piece.size();
    *file.lines += static_cast<int>(std::count(piece.begin(), piece.end(), '\n'));
    return file.bytes < limit;
  });
  file.sha256 = sum.CalcDigest();
  return file;
}

/** Length of the file up to its last line break. */
uintmax_t FindEndOfLines(const fs::path& path) {
  uintmax_t length = 0, end = 0;
  ReadPieces(path, [&](std::string_view piece) {
    const size_t last = piece.rfind('\n');
    if (last != piece.npos) end = length + last + 1;
    length += piece.size();
    return true;
  });
  return end;
}

std::string FormatManifest(const Manifest& manifest) {
  Json json = {{"kind", manifest.kind}, {"versions", manifest.versions}};
  if (!manifest.inputs.empty()) json["inputs"] = manifest.inputs;
  if (manifest.origin) json["made"] = RecordToJson(*manifest.origin);
  if (manifest.is_made_anew) json["made_anew"] = true;
  json["files"] = Json::array();
  for (const ManifestFile& file : manifest.files) json["files"].push_back(RecordToJson(file));
  json["sha256"] = CalcSha256(FormatJson(json));
  return FormatJson(json, 2) + "\n";
}

/** The text is compared, so that no byte of it can change, not even a blank; none: it is another. */
std::optional<Manifest> ParseManifest(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    Manifest manifest;
    manifest.kind = json.at("kind").get<std::string>();
    manifest.versions = json.at("versions");
    if (json.contains("inputs")) manifest.inputs = json.at("inputs").get<std::string>();
    if (json.contains("made")) ReadRecord(json.at("made"), manifest.origin.emplace());
    manifest.is_made_anew = json.value("made_anew", false);
    for (const Json& file : json.at("files")) ReadRecord(file, manifest.files.emplace_back());
    if (FormatManifest(manifest) == text) return manifest;
  } catch (const Json::exception&) {
  } catch (const Error&) {
  }
  return std::nullopt;
}

std::string FormatBytes(uintmax_t bytes) { return std::to_string(bytes) + " bytes"; }

void AddJournalDamage(const fs::path& folder, const ManifestFile& file, const ManifestFile& now,
                      std::vector<Damage>& damages) {
  uintmax_t committed = 0;  // bytes whose lines need no look
  if (now.bytes < file.bytes) {
    damages.push_back({file.path, 0,
                       "has " + FormatBytes(now.bytes) + " and " + std::to_string(*now.lines) +
                           " lines; " + FormatBytes(file.bytes) + " and " +
                           std::to_string(*file.lines) + " lines were committed"});
  } else if (now.sha256 != file.sha256) {
    damages.push_back({file.path, 0, "its committed lines have changed"});
  } else {
    committed = file.bytes;
  }
  const std::vector<Damage> bad = FindBadLines(folder, file.path, committed);
  damages.insert(damages.end(), bad.begin(), bad.end());
}

void AddDamage(const fs::path& folder, const ManifestFile& file, std::vector<Damage>& damages) {
  try {
    const uintmax_t limit = file.lines ? file.bytes : file.bytes + 1;
    const ManifestFile now = Measure(folder, file.path, limit);
    if (file.lines) {
      AddJournalDamage(folder, file, now, damages);
    } else if (now.bytes != file.bytes) {
      damages.push_back(
          {file.path, 0,
           "has " + (now.bytes > file.bytes
                         ? "more than " + FormatBytes(file.bytes)
                         : FormatBytes(now.bytes) + " instead of " + FormatBytes(file.bytes))});
    } else if (now.sha256 != file.sha256) {
      damages.push_back({file.path, 0, "its bytes have changed"});
    }
  } catch (const Error& e) {
    RethrowUnlessDamage(folder / file.path);
    damages.push_back(
        {file.path, 0, e.kind() == ErrorKind::kNotFound ? "is missing" : std::string(e.what())});
  }
}

std::vector<std::string> ListDamage(const std::vector<Damage>& damages) {
  constexpr size_t kMaxListed = 10;
  std::vector<std::string> lines;
  for (size_t i = 0; i < damages.size() && i < kMaxListed; ++i) {
    const Damage& damage = damages[i];
    const std::string line = damage.line > 0 ? ":" + std::to_string(damage.line) : "";
    lines.push_back(damage.path + line + ": " + damage.text);
  }
  if (damages.size() > kMaxListed) {
    lines.push_back("and " + std::to_string(damages.size() - kMaxListed) + " more");
  }
  return lines;
}

}  // namespace

void RethrowUnlessDamage(const fs::path& path) {
  try {
    throw;
  } catch (const Error& error) {
    std::error_code status;
    const fs::file_status now = fs::status(path, status);
    const bool is_replaced = !status && fs::exists(now) && !fs::is_regular_file(now);
    if (error.kind() == ErrorKind::kIo && !is_replaced) throw;
  }
}

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

std::string FormatDamage(const std::vector<Damage>& damages) {
  std::string text;
  for (const std::string& line : ListDamage(damages)) text += "\n  " + line;
  return text;
}

std::string DescribeDamage(const std::vector<Damage>& damages) {
  std::string text;
  for (const std::string& line : ListDamage(damages)) text += (text.empty() ? "" : "; ") + line;
  return text.empty() ? "" : ". READ IN SPITE OF DAMAGE: " + text;
}

ManifestFile SealFile(const fs::path& folder, const std::string& path) {
  ManifestFile file = Measure(folder, path, std::numeric_limits<uintmax_t>::max());
  file.lines.reset();
  return file;
}

ManifestFile SealJournal(const fs::path& folder, const std::string& path, bool with_torn_line) {
  return Measure(
      folder, path,
      with_torn_line ? std::numeric_limits<uintmax_t>::max() : FindEndOfLines(folder / path));
}

bool HasManifest(const fs::path& folder) {
  std::error_code status;
  return fs::exists(fs::symlink_status(folder / kManifestFile, status));
}

const ManifestFile* Manifest::Find(const std::string& path) const {
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const ManifestFile& file) { return file.path == path; });
  return found == files.end() ? nullptr : &*found;
}

std::optional<Manifest> FindManifest(const fs::path& folder) {
  try {
    if (HasManifest(folder)) return ParseManifest(ReadFile(folder / kManifestFile));
  } catch (const Error&) {
    RethrowUnlessDamage(folder / kManifestFile);
  }
  return std::nullopt;
}

Manifest LoadManifest(const fs::path& folder) {
  const fs::path path = folder / kManifestFile;
  if (std::optional<Manifest> manifest = ParseManifest(ReadFile(path))) return *manifest;
  throw Error(ErrorKind::kFormat,
              "\"" + path.string() +
                  "\" is damaged: the integrity of the files beside it cannot be verified; restore "
                  "it from a backup, or rebuild it with graspbench verify --repair");
}

void WriteManifest(const fs::path& folder, const Manifest& manifest) {
  WriteFileAtomically(folder / kManifestFile, FormatManifest(manifest));
}

std::vector<Damage> FindDamage(const fs::path& folder, const Manifest& manifest) {
  std::vector<Damage> damages;
  for (const ManifestFile& file : manifest.files) AddDamage(folder, file, damages);
  return damages;
}

std::vector<Damage> FindLostBytes(const fs::path& folder) {
  std::vector<Damage> damages;
  for (const ManifestFile& file : FindManifest(folder).value_or(Manifest()).files) {
    std::error_code status;
    const uintmax_t bytes = fs::file_size(folder / file.path, status);
    if (status) {
      damages.push_back({file.path, 0, "is missing"});
    } else if (bytes < file.bytes) {
      damages.push_back({file.path, 0,
                         "has " + FormatCount(static_cast<int64_t>(bytes), "byte") + ", " +
                             std::to_string(file.bytes) + " were committed"});
    }
  }
  return damages;
}

std::vector<Damage> FindBadLines(const fs::path& folder, const std::string& path,
                                 uintmax_t committed) {
  std::vector<Damage> damages;
  ForEachLineOfFile(folder / path, [&](const FileLine& line) {
    const uintmax_t end = line.start + line.text.size();
    if (end <= committed || line.text.empty()) return;
    try {
      // What was torn and then committed is closed by a line break before anything follows.
      if (line.start < committed) throw Error(ErrorKind::kFormat, "a torn line was continued");
      if (!line.is_whole || (IsCheckedLine(line.text) && IsPlainJson(line.text))) return;
      ParseCheckedLine(line.text);
    } catch (const Error& e) {
      damages.push_back({path, line.number, e.what()});
    }
  });
  return damages;
}

}  // namespace graspbench
