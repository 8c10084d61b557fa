#include "reports/study/study_format.h"

#include <cmath>

#include "core/base/text.h"

namespace graspbench {

DisplayUnit FindDisplayUnit(const std::string& si_unit) {
  if (si_unit == "s") return {"ms", 1e3, 1};
  if (si_unit == "m") return {"mm", 1e3, 1};
  if (si_unit == "m/s") return {"mm/s", 1e3, 0};
  if (si_unit == "1") return {"%", 1e2, 1};
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

std::string NameOfCell(const std::string& cell) { return cell.empty() ? "all trials" : cell; }

std::string DescribeFactors(const std::vector<Factor>& factors) {
  std::string text;
  for (const Factor& factor : factors) text += (text.empty() ? " by " : ", ") + factor.name;
  return text;
}

}  // namespace graspbench
