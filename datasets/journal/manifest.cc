#include "datasets/journal/manifest.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/sha256.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kManifest[] = "manifest.json";

int CountLines(std::string_view text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
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

Json MakeBody(const Manifest& manifest) {
  Json files = Json::array();
  for (const ManifestFile& file : manifest.files) files.push_back(ToJson(file));
  return Json{{"kind", manifest.kind}, {"versions", manifest.versions}, {"files", files}};
}

/** Empty: it is as the manifest says. */
std::string DescribeDamage(const std::string& text, const ManifestFile& file) {
  const bool is_journal = file.lines.has_value();
  if (text.size() < file.bytes) {
    return is_journal ? "has " + std::to_string(CountLines(text)) + " lines; " +
                            std::to_string(*file.lines) + " were committed"
                      : "has " + std::to_string(text.size()) + " bytes instead of " +
                            std::to_string(file.bytes);
  }
  if (!is_journal && text.size() > file.bytes) {
    return "has " + std::to_string(text.size()) + " bytes instead of " + std::to_string(file.bytes);
  }
  if (CalcSha256(std::string_view(text).substr(0, file.bytes)) != file.sha256) {
    return is_journal ? "its committed lines have changed" : "its bytes have changed";
  }
  return "";
}

}  // namespace

ManifestFile SealFile(const fs::path& folder, const std::string& path) {
  const std::string text = ReadFile(folder / path);
  return {path, text.size(), CalcSha256(text), std::nullopt};
}

ManifestFile SealJournal(const fs::path& folder, const std::string& path) {
  std::string text = ReadFile(folder / path);
  text.resize(text.rfind('\n') + 1);  // npos + 1 is 0: no whole line
  return {path, text.size(), CalcSha256(text), CountLines(text)};
}

bool HasManifest(const fs::path& folder) {
  std::error_code status;
  return fs::exists(folder / kManifest, status);
}

Manifest LoadManifest(const fs::path& folder) {
  const fs::path path = folder / kManifest;
  const std::string text = ReadFile(path);
  Manifest manifest;
  try {
    Json json = Json::parse(text);
    const auto sum = json.at("sha256").get<std::string>();
    json.erase("sha256");
    manifest.kind = json.at("kind").get<std::string>();
    manifest.versions = json.at("versions");
    for (const Json& file : json.at("files")) manifest.files.push_back(ManifestFileFromJson(file));
    // The text is compared, so that no byte of it can change, not even a blank.
    if (CalcSha256(FormatJson(MakeBody(manifest))) == sum && FormatManifest(manifest) == text) {
      return manifest;
    }
  } catch (const Json::exception&) {
  } catch (const Error&) {
  }
  throw Error(ErrorKind::kFormat,
              "\"" + path.string() +
                  "\" is damaged, so that nothing vouches for the files beside it; take it from a "
                  "backup, or make it anew with graspbench verify --repair");
}

std::string FormatManifest(const Manifest& manifest) {
  Json json = MakeBody(manifest);
  json["sha256"] = CalcSha256(FormatJson(json));
  return FormatJson(json, 2) + "\n";
}

void WriteManifest(const fs::path& folder, const Manifest& manifest) {
  WriteFileAtomically(folder / kManifest, FormatManifest(manifest));
}

std::vector<Damage> FindDamage(const fs::path& folder, const Manifest& manifest) {
  std::vector<Damage> damages;
  for (const ManifestFile& file : manifest.files) {
    std::string text;
    try {
      text = DescribeDamage(ReadFile(folder / file.path), file);
    } catch (const Error& e) {
      text = e.kind() == ErrorKind::kNotFound ? "is missing" : e.what();
    }
    if (!text.empty()) damages.push_back({file.path, text});
  }
  return damages;
}

}  // namespace graspbench
