#include "datasets/journal/manifest.h"

#include <algorithm>
#include <limits>

#include "core/base/error.h"
#include "core/base/files/file_pieces.h"
#include "core/base/files/files.h"
#include "core/base/sha256.h"
#include "core/base/text/json_cursor.h"
#include "core/base/text/text.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

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

Json ToJson(const ManifestFile& file) {
  Json json = {{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}};
  if (file.lines) json["lines"] = *file.lines;
  return json;
}

ManifestFile ManifestFileFromJson(const Json& json) {
  ManifestFile file;
  file.path = json.at("path").get<std::string>();
  file.bytes = json.at("bytes").get<uintmax_t>();
  file.sha256 = json.at("sha256").get<std::string>();
  if (json.contains("lines")) file.lines = IntFrom(json.at("lines"));
  return file;
}

Json ToJson(const ManifestOrigin& origin) {
  Json inputs = Json::array();
  for (const ManifestSource& source : origin.inputs) {
    inputs.push_back({{"path", source.path}, {"sha256", source.sha256}});
  }
  return {{"command", origin.command}, {"versions", origin.versions}, {"inputs", inputs}};
}

ManifestOrigin OriginFromJson(const Json& json) {
  ManifestOrigin origin = {json.at("command").get<std::string>(), json.at("versions"), {}};
  for (const Json& source : json.at("inputs")) {
    origin.inputs.push_back(
        {source.at("path").get<std::string>(), source.at("sha256").get<std::string>()});
  }
  return origin;
}

Json MakeBody(const Manifest& manifest) {
  Json json = {{"kind", manifest.kind}, {"versions", manifest.versions}};
  if (!manifest.inputs.empty()) json["inputs"] = manifest.inputs;
  if (manifest.origin) json["made"] = ToJson(*manifest.origin);
  if (manifest.is_made_anew) json["made_anew"] = true;
  json["files"] = Json::array();
  for (const ManifestFile& file : manifest.files) json["files"].push_back(ToJson(file));
  return json;
}

std::string FormatBytes(uintmax_t bytes) { return std::to_string(bytes) + " bytes"; }

void AddJournalDamage(const fs::path& folder, const ManifestFile& file, const ManifestFile& now,
                      std::vector<Damage>& damages) {
  if (now.bytes < file.bytes) {
    damages.push_back({file.path, 0,
                       "has " + FormatBytes(now.bytes) + " and " + std::to_string(*now.lines) +
                           " lines; " + FormatBytes(file.bytes) + " and " +
                           std::to_string(*file.lines) + " lines were committed"});
  } else if (now.sha256 != file.sha256) {
    damages.push_back({file.path, 0, "its committed lines have changed"});
  } else {
    const std::vector<Damage> bad = FindBadLines(folder, file.path, file.bytes);
    damages.insert(damages.end(), bad.begin(), bad.end());
    return;
  }
  const std::vector<Damage> bad = FindBadLines(folder, file.path, 0);
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

std::optional<Manifest> FindManifest(const fs::path& folder) {
  try {
    if (HasManifest(folder)) return LoadManifest(folder);
  } catch (const Error&) {
  }
  return std::nullopt;
}

Manifest LoadManifest(const fs::path& folder) {
  const fs::path path = folder / kManifestFile;
  const std::string text = ReadFile(path);
  Manifest manifest;
  try {
    const Json json = Json::parse(text);
    manifest.kind = json.at("kind").get<std::string>();
    manifest.versions = json.at("versions");
    if (json.contains("inputs")) manifest.inputs = json.at("inputs").get<std::string>();
    if (json.contains("made")) manifest.origin = OriginFromJson(json.at("made"));
    manifest.is_made_anew = json.value("made_anew", false);
    for (const Json& file : json.at("files")) manifest.files.push_back(ManifestFileFromJson(file));
    // The text is compared, so that no byte of it can change, not even a blank.
    if (FormatManifest(manifest) == text) return manifest;
  } catch (const Json::exception&) {
  } catch (const Error&) {
  }
  throw Error(
      ErrorKind::kFormat,
      "\"" + path.string() +
          "\" is damaged: the integrity of the files beside it cannot be verified; take it from a "
          "backup, or make it again with graspbench verify --repair");
}

std::string FormatManifest(const Manifest& manifest) {
  Json json = MakeBody(manifest);
  json["sha256"] = CalcSha256(FormatJson(json));
  return FormatJson(json, 2) + "\n";
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
