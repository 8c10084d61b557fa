#include <cmath>

#include "core/base/range_text.h"
#include "core/base/text.h"
#include "reports/study/study_format.h"
#include "reports/study/study_section.h"

namespace graspbench {
namespace {

std::string FormatIcc(const OpeningReliability& row) {
  if (!row.reliability || !row.reliability->one_way) return "n/a";
  const Icc& icc = row.reliability->one_way->single;
  return FormatWithRange(icc.value, icc.interval.low, icc.interval.high, 2);
}

std::string FormatAgainst(const OpeningReliability& row) {
  if (!row.against_aperture) return "n/a";
  const BootstrapInterval& b = *row.against_aperture;
  return FormatWithRange(b.estimate, b.interval.low, b.interval.high, 2);
}

std::string FormatNeeded(const OpeningReliability& row) {
  if (!row.reliability || !row.reliability->trials_needed) return "n/a";
  return std::to_string(row.reliability->trials_needed->num_trials);
}

Html DrawReliability(const std::vector<OpeningReliability>& rows) {
  const Align number = Align::kNumber;
  Table table(
      "Largest opening of each trial, the means of conditions taken out. Intervals are 95 %.",
      {{"Opening"},
       {"Mean [mm]", number},
       {"SEM [mm]", number, "standard deviation within persons: the error of a single trial"},
       {"CV [%]", number, "SEM / mean"},
       {"MDC [mm]", number, "minimal detectable change: two single trials differ by less"},
       {"ICC(1,1)", number, "share of the variance that is due to persons"},
       {"ICC - aperture's", number, "persons resampled"},
       {"Trials for 0.9", number, "whose mean reaches an ICC of 0.9"},
       {"d' open, closed", number, "mean over persons"}});
  for (const OpeningReliability& row : rows) {
    const double mean = row.open ? row.open->mean : std::nan("");
    table.AddRow({Element("code", {}, row.opening->id), Text(FormatValue(mean, "m")),
                  Text(FormatValue(row.within_person_sd, "m")),
                  Text(FormatFixed(100.0 * row.within_person_cv, 1)),
                  Text(FormatValue(row.minimal_detectable_change, "m")), Text(FormatIcc(row)),
                  Text(FormatAgainst(row)), Text(FormatNeeded(row)),
                  Text(FormatFixed(row.d_prime, 2))});
  }
  return table.ToHtml();
}

Html DrawLosses(const StudyResult& result) {
  if (result.digits.size() < 3) return {};
  std::vector<Column> columns = {{"Opening"}};
  for (size_t i = 1; i < result.digits.size(); ++i) {
    columns.push_back({"without " + NameOfDigit(result.digits[i]), Align::kNumber,
                       "CV without the digit / CV with it"});
  }
  Table table(
      "Loss of precision when one digit's marker is missing: above 1 the measure becomes "
      "less precise.",
      columns);
  for (const OpeningReliability& row : result.statistics.openings) {
    std::vector<Html> cells = {Element("code", {}, row.opening->id)};
    for (size_t i = 1; i < result.digits.size(); ++i) {
      const Answer<double>& ratio = row.without_digit[i].cv_ratio;
      cells.push_back(Text(ratio ? FormatFixed(*ratio, 2) : "n/a"));
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
  return MakeDetails("What each opening is", MakeList(items));
}

Html DrawOpenings(const StudyPageData& data) {
  const std::vector<OpeningReliability>& rows = data.result.statistics.openings;
  if (data.result.CountKept() == 0) return MakeParagraph("No trial counts.");
  Html html = MakeParagraph(
      "Is a measure over all fingers more reliable than the distance of thumb and index? The whole "
      "family on the same trials. A higher ICC and d' and a smaller CV are better.");
  if (!rows.front().reliability) {
    html += MakeParagraph("No ICC: " + rows.front().reliability.reason() + ".");
  }
  return html + DrawReliability(rows) + DrawLosses(data.result) + DrawMeaning();
}

}  // namespace

StudySection openings_study_section() {
  return {"openings", "Reliability of hand opening", DrawOpenings};
}

}  // namespace graspbench
