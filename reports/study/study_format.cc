#include "reports/study/study_format.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/text/text.h"
#include "core/base/units.h"

namespace graspbench {

DisplayUnit FindDisplayUnit(const std::string& si_unit) {
  if (si_unit == "s") return {"ms", 1e3, 1};
  if (si_unit == "m") return {"mm", 1e3, 1};
  if (si_unit == "m/s") return {"mm/s", 1e3, 0};
  if (si_unit == "1") return {"%", 1e2, 1};
  if (si_unit == "rad") return {"deg", 180.0 / kPi, 1};
  return {"", 1.0, 1};  // a count
}

std::string FormatHead(const TrialMeasure& measure) {
  const std::string unit = FindDisplayUnit(measure.unit).name;
  return measure.name + (unit.empty() ? "" : " [" + unit + "]");
}

std::string FormatValue(double value, const std::string& si_unit) {
  const DisplayUnit unit = FindDisplayUnit(si_unit);
  return FormatFixed(value * unit.factor, unit.decimals);
}

std::string FormatWithUnit(double value, const std::string& si_unit) {
  const std::string number = FormatValue(value, si_unit);
  const std::string unit = FindDisplayUnit(si_unit).name;
  return std::isfinite(value) && !unit.empty() ? number + "\u00A0" + unit : number;
}

std::string FormatP(double p) { return p < 0.001 ? "< 0.001" : FormatFixed(p, 3); }

namespace {

struct FactorUnit {
  const char* ending;  ///< of the factor's name
  const char* si;      ///< of the numbers, in slopes
  const char* shown;
  double factor;
};
constexpr FactorUnit kFactorUnits[] = {{"_m", "m", "mm", 1e3},
                                       {"_mm", "mm", "mm", 1.0},
                                       {"_kg", "kg", "g", 1e3},
                                       {"_s", "s", "ms", 1e3},
                                       {"_deg", "deg", "deg", 1.0}};

const FactorUnit* FindFactorUnit(const std::string& factor) {
  const size_t at = factor.rfind('_');
  if (at == std::string::npos || at == 0) return nullptr;
  for (const FactorUnit& unit : kFactorUnits) {
    if (factor.substr(at) == unit.ending) return &unit;
  }
  return nullptr;
}

std::string NameOfLevel(const std::string& level, const Factor& factor) {
  const FactorUnit* unit = FindFactorUnit(factor.name);
  std::string text = level;
  for (size_t i = 0; unit && i < factor.numbers.size(); ++i) {
    if (factor.levels[i] != level) continue;
    text = FormatSignificant(unit->factor * factor.numbers[i], 4) + "\u00A0" + unit->shown;
  }
  return NameOfFactor(factor.name) + " " + text;
}

/** Replaces every occurrence in the text. */
std::string Replace(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

}  // namespace

std::string MakeWords(std::string id) {
  std::replace(id.begin(), id.end(), '_', ' ');
  return id;
}

std::string NameOfFactor(const std::string& factor) {
  return MakeWords(FindFactorUnit(factor) ? factor.substr(0, factor.rfind('_')) : factor);
}

std::string NameOfCell(const std::string& cell, const std::vector<Factor>& factors) {
  if (cell.empty()) return "all trials";
  std::string text;
  size_t begin = 0;
  for (const Factor& factor : factors) {
    const size_t end = std::min(cell.find(", ", begin), cell.size());
    if (begin > cell.size()) return cell;  // a level contains a comma
    text += (text.empty() ? "" : ", ") + NameOfLevel(cell.substr(begin, end - begin), factor);
    begin = end + 2;
  }
  return begin < cell.size() ? cell : text;
}

std::string FormatSlopeUnit(const std::string& unit) {
  constexpr std::string_view kPer = " per ";
  const size_t at = unit.find(kPer);
  if (at == std::string::npos) return unit;
  const std::string factor = unit.substr(at + kPer.size()), of = unit.substr(0, at);
  const FactorUnit* known = FindFactorUnit(factor);
  return (of == "1" || of.empty() ? "" : of + " ") + "per " +
         (known ? std::string(known->si) + " of " : "") + NameOfFactor(factor);
}

std::string NameOfEffect(const std::string& effect, const std::vector<Factor>& factors) {
  const size_t minus = effect.find(" - ");
  if (minus != std::string::npos) {
    return NameOfCell(effect.substr(0, minus), factors) + " minus " +
           NameOfCell(effect.substr(minus + 3), factors);
  }
  constexpr std::string_view kMean = "mean in ";
  if (effect.rfind(kMean, 0) == 0) return NameOfCell(effect.substr(kMean.size()), factors);
  std::string text = effect;
  for (const Factor& factor : factors) text = Replace(text, factor.name, NameOfFactor(factor.name));
  return text;
}

std::string DescribeFactors(const std::vector<Factor>& factors) {
  std::string text;
  for (const Factor& factor : factors)
    text += (text.empty() ? " by " : ", ") + NameOfFactor(factor.name);
  return text;
}

}  // namespace graspbench
