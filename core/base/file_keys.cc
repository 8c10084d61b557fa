#include "core/base/file_keys.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace graspbench {
namespace {

// Longest suffix first.
constexpr std::pair<const char*, const char*> kUnits[] = {{"_grey_levels", "grey levels"},
                                                          {"_kg_per_m3", "kg/m3"},
                                                          {"_m_per_s2", "m/s2"},
                                                          {"_rad_per_m", "rad/m"},
                                                          {"_kg_m2", "kg m2"},
                                                          {"_nms_per_rad", "N m s/rad"},
                                                          {"_nm_per_rad", "N m/rad"},
                                                          {"_ns_per_m", "N s/m"},
                                                          {"_rad_per_nm", "rad/(N m)"},
                                                          {"_n_per_m", "N/m"},
                                                          {"_m_per_s", "m/s"},
                                                          {"_deg_per_s", "deg/s"},
                                                          {"_hz", "Hz"},
                                                          {"_pa", "Pa"},
                                                          {"_m2", "m2"},
                                                          {"_px", "px"},
                                                          {"_kg", "kg"},
                                                          {"_mm", "mm"},
                                                          {"_nm", "N m"},
                                                          {"_deg", "deg"},
                                                          {"_rad", "rad"},
                                                          {"_m", "m"},
                                                          {"_n", "N"},
                                                          {"_s", "s"}};

std::string FormatLimit(double value) { return fmt::format("{:.10g}", value); }

}  // namespace

const FileKey* FindFileKey(const FileKeys& keys, const std::string& key) {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const FileKey& row) { return row.key == key; });
  return found == keys.end() ? nullptr : &*found;
}

bool IsInRange(const FileKey& key, double value) { return value >= key.low && value <= key.high; }

std::string FormatRange(const FileKey& key) {
  const bool has_low = std::isfinite(key.low), has_high = std::isfinite(key.high);
  if (key.low == kAboveZero) {
    return has_high ? "above 0, at most " + FormatLimit(key.high) : "above 0";
  }
  if (has_low && has_high) return FormatLimit(key.low) + " to " + FormatLimit(key.high);
  if (has_low) return "at least " + FormatLimit(key.low);
  return has_high ? "at most " + FormatLimit(key.high) : "";
}

std::string FindUnit(const std::string& key) {
  // "pad_offsets_m.thumb" takes the unit of its map.
  for (size_t end = key.size(); end != key.npos;
       end = end == 0 ? key.npos : key.rfind('.', end - 1)) {
    for (const auto& [ending, unit] : kUnits) {
      const std::string tail = ending;
      if (end > tail.size() && key.compare(end - tail.size(), tail.size(), tail) == 0) return unit;
    }
  }
  return "";
}

std::string FormatFileKeys(const FileKeys& keys) {
  std::string text;
  for (const FileKey& key : keys) {
    std::string about;
    const auto add = [&about](const std::string& part) {
      if (!part.empty()) about += (about.empty() ? "" : "; ") + part;
    };
    const std::string range = FormatRange(key), unit = FindUnit(key.key);
    add(range + (range.empty() || unit.empty() ? "" : " ") + unit);
    add(key.fallback == kRequired ? "required"
        : key.fallback.empty()    ? "may be left out"
                                  : "default " + key.fallback);
    text += fmt::format("  {:<38} {}\n      {}\n", key.key, about, key.meaning);
  }
  return text;
}

}  // namespace graspbench
