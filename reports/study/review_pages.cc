#include "reports/study/review_pages.h"

#include <algorithm>
#include <cmath>

#include "core/base/files/files.h"
#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "reports/page/layout.h"
#include "reports/study/study_format.h"
#include "reports/study/trial_figures.h"

namespace graspbench {
namespace {

std::string NameOfPage(const StudyTrial& trial) {
  return MakePlainKey({"trial", trial.participant, trial.trial}) + ".html";
}

std::string FormatEvent(const EventTime& event) {
  if (!event.IsFound()) return event.missing;
  return FormatFixed(event.time, 4) + " s" + (event.is_in_gap ? ", in a gap" : "") +
         (event.is_filled ? ", filled" : "");
}

/** A row a digit: what is believed, how well it is known, what every detector says. */
Html DrawDigits(const StudyTrial& trial) {
  std::vector<Column> columns = {
      {"Digit"}, {"Believed"}, {"\u00B1 95 % [ms]", Align::kNumber}, {"Reviewed"}};
  for (const ContactDetector& detector : ContactDetectorList()) columns.push_back({detector.id});
  Table table("Contacts on the recording's clock.", columns);
  for (const DigitContactEvents& digit : trial.analysis->contacts) {
    std::vector<ContactReview> own;
    std::copy_if(trial.reviews.begin(), trial.reviews.end(), std::back_inserter(own),
                 [&](const ContactReview& review) { return review.digit == digit.digit; });
    std::vector<Html> cells = {
        Text(NameOfDigit(digit.digit)), Text(FormatEvent(digit.contact)),
        Text(digit.contact.IsFound() ? FormatFixed(1e3 * digit.contact.CalcHalfWidth(), 1) : ""),
        Text(DescribeReviews(own))};
    for (const EventTime& event : digit.by_detector) cells.push_back(Text(FormatEvent(event)));
    table.AddRow(cells);
  }
  return table.ToHtml();
}

struct ReviewRow {
  const StudyTrial* trial;
  const DigitContactEvents* digit;
  const ContactReview* review;  // null: not looked at
};

std::string FormatReviews(const StudyResult& result) {
  std::vector<ReviewRow> rows;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.analysis) continue;
    for (const DigitContactEvents& digit : trial.analysis->contacts) {
      const auto review =
          std::find_if(trial.reviews.begin(), trial.reviews.end(),
                       [&](const ContactReview& r) { return r.digit == digit.digit; });
      rows.push_back({&trial, &digit, review == trial.reviews.end() ? nullptr : &*review});
    }
  }
  using R = ReviewRow;
  const std::vector<CsvColumn<R>> columns = {
      {"trial", "", "", [](const R& r) { return r.trial->id; }},
      {"digit", "", "", [](const R& r) { return NameOfDigit(r.digit->digit); }},
      {"verdict", "string", "", "",
       [](const R& r) { return r.review ? Json(NameOf(r.review->verdict)) : Json(); }},
      {"contact_s", "", "", [](const R& r) { return r.digit->contact.time; }},
      {"uncertainty_s", "number", "", "",
       [](const R& r) { return r.review ? JsonNumber(r.review->uncertainty) : Json(); }},
      {"by", "string", "", "", [](const R& r) { return r.review ? Json(r.review->by) : Json(); }},
      {"note", "string", "", "", [](const R&) { return Json(); }}};
  return FormatCsv(columns, rows);
}

}  // namespace

ReviewPages::ReviewPages(const std::filesystem::path& folder) : folder_(folder) {
  MakeFolder(folder_ / "trials");
}

void ReviewPages::WriteTrial(const StudyTrial& trial, const ReachTrial& reach,
                             const std::vector<Factor>& factors, const AnalysisOptions& options) {
  const PageFrame frame = {"Trial " + trial.id, DescribeTrial(trial, factors)};
  const Html body = DrawTrialTips(trial, reach, options) + DrawTrialContacts(trial) +
                    DrawDigits(trial) + DrawTrialSpeed(trial, options.movement) +
                    DrawTrialOpening(trial);
  WriteFile(folder_ / "trials" / NameOfPage(trial), MakePage(frame, {}, body));
}

void ReviewPages::Finish(const StudyResult& result) const {
  Table table("All trials; what was removed may still be looked at.", {{"Trial"},
                                                                       {"Kept"},
                                                                       {"GFT [ms]", Align::kNumber},
                                                                       {"Reviewed"},
                                                                       {"Why not", Align::kProse}});
  for (const StudyTrial& trial : result.trials) {
    const Html name = trial.analysis
                          ? Element("a", {{"href", "trials/" + NameOfPage(trial)}}, trial.id)
                          : Text(trial.id);
    table.AddRow({name, Text(trial.IsKept() ? "yes" : "no"),
                  Text(trial.analysis ? FormatValue(trial.analysis->timing.gft, "s") : ""),
                  Text(DescribeReviews(trial.reviews)), Text(trial.removed)});
  }
  const PageFrame frame = {result.study.config.name + ", review",
                           FormatCount(static_cast<int>(result.trials.size()), "trial")};
  const Html how = MakeParagraph(
      "Look at each trial and write a verdict beside its digits in reviews.csv: confirmed; "
      "corrected, with contact_s; no_contact. Rows without a verdict count for nothing. Copy the "
      "file beside study.yaml, name it there (reviews: reviews.csv), and run the study again: "
      "reviewed contacts are replayed and named in the report.");
  WriteFile(folder_ / "index.html", MakePage(frame, {}, how + table.ToHtml()));
  WriteFile(folder_ / "reviews.csv", FormatReviews(result));
}

}  // namespace graspbench
