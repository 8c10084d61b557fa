#include <algorithm>

#include "core/base/text/text.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

std::string FormatIcc(const OpeningReliability& row) {
  if (!row.reliability || !row.reliability->one_way) return "n/a";
  const Icc& icc = row.reliability->one_way->single;
  return FormatWithRange(icc.value, icc.interval.low, icc.interval.high, 2);
}

std::string FormatNeeded(const OpeningReliability& row) {
  if (!row.reliability || !row.reliability->trials_needed) return "n/a";
  return std::to_string(row.reliability->trials_needed->num_trials);
}

Html DrawReliability(const OpeningFamily& family) {
  // With one participant there is no ICC; a sentence says so instead of a column of n/a.
  const bool has_icc = family.num_persons > 1;
  std::vector<Column> columns = {
      "Opening",
      "Mean [mm]",
      {"SEM [mm]", "standard deviation within persons and conditions (error of one trial)"},
      {"MDC [mm]", "minimal detectable change between two single trials"}};
  if (has_icc) {
    columns.push_back({"ICC(1,1)", "share of the variance that is due to persons, 95 %"});
    columns.push_back({"Trials for 0.9", "number of trials whose mean reaches an ICC of 0.9"});
  }
  columns.push_back({"d'", "open and closed hand"});
  if (!family.slope_factor.empty()) {
    columns.push_back(
        {"Slope / SEM", "mean slope over " + family.slope_factor + ", its unit inverted"});
  }
  columns.push_back({"d' left", "without the digit whose loss costs most"});
  Table table("Peak opening of each trial, with condition means removed.", columns);
  for (const OpeningReliability& row : family.rows) {
    if (!row.open) continue;
    std::vector<Cell> cells = {
        Element("code", {}, row.opening->id), FormatValue(row.open->mean, "m"),
        FormatValue(row.within_person_sd, "m"), FormatValue(row.minimal_detectable_change, "m")};
    if (has_icc) {
      cells.push_back(FormatIcc(row));
      cells.push_back(FormatNeeded(row));
    }
    for (size_t i = 1; i < kNumOpeningCriteria; ++i) {
      if (i == 2 && family.slope_factor.empty()) continue;
      cells.push_back(row.criteria[i] ? FormatSignificant(*row.criteria[i], 3) : "n/a");
    }
    table.AddRow(cells);
  }
  return table.ToHtml();
}

std::string FormatRatio(const OpeningComparison& comparison) {
  if (!comparison.no_answer.empty()) return "not tested";
  const std::string p = comparison.p_holm < 0.05 ? ", p " + FormatP(comparison.p_holm) : "";
  return FormatWithRange(comparison.ratio, comparison.low, comparison.high, 2) + p;
}

/** Lists why single comparisons have no answer, each reason once. */
Html DrawUntested(const OpeningFamily& family) {
  std::vector<std::string> reasons;
  for (size_t i = 1; i < family.rows.size(); ++i) {
    for (size_t k = 0; k < kNumOpeningCriteria; ++k) {
      const std::string& reason = family.rows[i].against_aperture[k].no_answer;
      if (reason.empty()) continue;
      const std::string text = std::string(ListOpeningCriteria()[k].text) + ": " + reason;
      if (std::find(reasons.begin(), reasons.end(), text) == reasons.end()) {
        reasons.push_back(text);
      }
    }
  }
  if (reasons.empty()) return {};
  return MakeParagraph("Not tested:") + MakeList(reasons);
}

Html DrawComparisons(const OpeningFamily& family) {
  if (family.num_tests == 0) return {};
  std::vector<Column> columns = {"Opening"};
  for (const OpeningCriterion& criterion : ListOpeningCriteria()) {
    columns.push_back(criterion.text);
  }
  Table table(
      "Ratio of each criterion to that of the aperture (above 1: more reliable) with its 95 % "
      "interval (jackknife over persons); p after Holm over all " +
          std::to_string(family.num_tests) + " comparisons where it is below 0.05.",
      columns);
  for (size_t i = 1; i < family.rows.size(); ++i) {
    std::vector<Cell> cells = {Element("code", {}, family.rows[i].opening->id)};
    for (const OpeningComparison& comparison : family.rows[i].against_aperture) {
      cells.push_back(FormatRatio(comparison));
    }
    table.AddRow(cells);
  }
  return table.ToHtml() + DrawUntested(family);
}

Html DrawLosses(const StudyResult& result) {
  if (result.digits.size() < 3) return {};
  std::vector<Column> columns = {"Opening"};
  for (size_t i = 1; i < result.digits.size(); ++i) {
    columns.push_back({"without " + NameOfDigit(result.digits[i]), "d' without / d' with it"});
  }
  Table table(
      "Ratio of d' without one digit's marker to d' with it; below 1: worse separation of the open "
      "and the closed hand.",
      columns);
  for (const OpeningReliability& row : result.statistics.openings.rows) {
    if (!row.open) continue;
    std::vector<Cell> cells = {Element("code", {}, row.opening->id)};
    for (size_t i = 1; i < result.digits.size(); ++i) {
      const Answer<double>& kept = row.kept_without[i];
      cells.push_back(kept ? FormatFixed(*kept, 2) : "n/a");
    }
    table.AddRow(cells);
  }
  return table.ToHtml();
}

Html DrawMeaning() {
  std::vector<std::string> items;
  for (const HandOpening& opening : HandOpeningList()) {
    items.push_back(std::string(opening.id) + ": " + opening.text);
  }
  return MakeDetails("Definition of each opening", MakeList(items));
}

Html DrawOpenings(const StudyPageData& data) {
  if (data.result.CountKept() == 0) return MakeParagraph("No trial counts.");
  const OpeningFamily& family = data.result.statistics.openings;
  Html html = MakeParagraph(DescribeOpeningArgument(data.result)) +
              MakeParagraph(
                  "All measures on the same trials, by criteria that are invariant to an offset "
                  "and to the unit.");
  const Answer<Reliability>& reliability = family.rows.front().reliability;
  if (!reliability) html += MakeParagraph("No ICC: " + reliability.reason() + ".");
  return html + DrawReliability(family) + DrawComparisons(family) + DrawLosses(data.result) +
         DrawMeaning();
}

}  // namespace

StudySection openings_study_section() {
  return {"openings", "Reliability of hand opening", DrawOpenings};
}

}  // namespace graspbench
