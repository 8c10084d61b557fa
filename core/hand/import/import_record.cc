#include "core/hand/import/import_record.h"

#include <cmath>

#include "core/base/files/files.h"
#include "core/base/sha256.h"
#include "core/base/text/json.h"
#include "core/base/version.h"
#include "core/hand/import/checks/digit_rows.h"

namespace graspbench {
namespace {

Json DescribeGuesses(const Hand& hand) {
  Json digits = Json::array();
  for (const Digit& digit : hand.digits) {
    Json links = Json::array();
    for (const int link : digit.links) links.push_back(hand.links[link].name);
    digits.push_back({{"id", digit.id},
                      {"thumb", digit.is_thumb},
                      {"links", links},
                      {"tip_m", JsonVector(digit.p_LTip)},
                      {"pad_m", JsonVector(digit.p_LPad)}});
  }
  Json apart = Json::array();
  for (const auto& [a, b] : hand.apart) {
    apart.push_back({hand.links[a].name, hand.links[b].name});
  }
  Json drives = Json::array();
  for (const HandJoint& joint : hand.joints) {
    if (joint.coupled_to >= 0) continue;
    drives.push_back({{"joint", joint.name},
                      {"stiffness", JsonNumber(joint.drive.stiffness)},
                      {"damping", JsonNumber(joint.drive.damping)},
                      {"limit", JsonNumber(joint.drive.torque_limit)}});
  }
  return {{"palm",
           {{"link", hand.links[hand.palm_link].name},
            {"centre_m", JsonVector(hand.p_HCentre)},
            {"normal", JsonVector(hand.palm_normal)}}},
          {"longest_digit_m", JsonNumber(CalcLongestDigit(hand))},
          {"digits", digits},
          {"apart", apart},
          {"drives", drives}};
}

Json ListProtrusions(const std::vector<LinkProtrusion>& protrusions) {
  Json list = Json::array();
  for (const auto& [link, protrusion] : protrusions) {
    list.push_back({{"link", link}, {"outside_hull_mm", std::round(protrusion * 1e5) / 1e2}});
  }
  return list;
}

/** As one would give them in the description's folder. */
Json ListPackagePath(const HandSource& source) {
  Json paths = Json::array();
  const auto make_absolute = [](const std::filesystem::path& path) {
    const std::filesystem::path absolute = std::filesystem::absolute(path).lexically_normal();
    return absolute.has_filename() ? absolute : absolute.parent_path();  // "ros/" is "ros"
  };
  for (const std::filesystem::path& path : source.package_path) {
    paths.push_back(
        make_absolute(path).lexically_relative(make_absolute(source.folder)).generic_string());
  }
  return paths;
}

Json HashFiles(const std::set<std::filesystem::path>& paths) {
  Json hashes = Json::object();
  for (const std::filesystem::path& path : paths) {
    const std::string name = path.filename().string();
    std::string key = name;
    for (int n = 2; hashes.contains(key); ++n) key = name + " (" + std::to_string(n) + ")";
    hashes[key] = CalcSha256(ReadFile(path));
  }
  return hashes;
}

}  // namespace

std::string FormatImportRecord(const std::string& text, const std::set<std::filesystem::path>& read,
                               const HandSource& source, const std::string& palm,
                               const ImportedHand& imported, const Diagnostics& problems,
                               const std::map<std::string, std::string>& files) {
  Json repairs = Json::array();
  for (const Diagnostic& problem : problems.entries()) {
    repairs.push_back({{"line", problem.line}, {"text", problem.text}});
  }
  Json hashes = Json::object();
  for (const auto& [name, content] : files) hashes[name] = CalcSha256(content);
  const Json record = {
      {"format", 1},
      {"tool", std::string("graspbench ") + program_version()},
      {"source",
       {{"file", std::filesystem::path(source.file).filename().string()},
        {"sha256", CalcSha256(text)}}},
      {"read", HashFiles(read)},
      {"options",
       {{"palm", palm},
        {"palm_normal", source.palm_normal ? JsonVector(*source.palm_normal) : Json(nullptr)},
        {"unit_m", source.unit},
        {"mesh_unit_m", source.mesh_unit},
        {"package_path", ListPackagePath(source)},
        {"angle", !source.in_degrees   ? ""
                  : *source.in_degrees ? "deg"
                                       : "rad"}}},
      {"repairs", repairs},
      {"protrusion", ListProtrusions(imported.protrusions)},
      {"guesses", DescribeGuesses(imported.hand)},
      {"files", hashes}};
  return FormatJson(record, 2) + "\n";
}

}  // namespace graspbench
