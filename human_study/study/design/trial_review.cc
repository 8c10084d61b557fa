#include "human_study/study/design/trial_review.h"

#include <algorithm>
#include <map>

#include "core/base/error.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"
#include "human_study/study/design/study_config.h"

namespace graspbench {
namespace {

constexpr ReviewVerdict kVerdicts[] = {ReviewVerdict::kConfirmed, ReviewVerdict::kCorrected,
                                       ReviewVerdict::kNoContact};

/** By name or id; empty for neither. */
std::string FindDigitId(const std::string& text) {
  for (int digit = 0; digit < PerDigit<int>::kNumDigits; ++digit) {
    if (text == NameOfDigit(digit) || text == IdOfDigit(digit)) return IdOfDigit(digit);
  }
  return "";
}

ContactReview ReadReview(DataTable& table, size_t row, Diagnostics& problems) {
  ContactReview review;
  review.line = table.LineOfRow(row);
  const auto fail = [&](const std::string& text) {
    problems.Fail(table.file(), review.line, text);
  };
  review.trial = table.Text(row, "trial");
  review.by = table.Text(row, "by");
  if (review.trial.empty()) fail("trial: empty; expected its id, as in trials.csv");
  review.digit = FindDigitId(table.Text(row, "digit"));
  if (review.digit.empty()) {
    fail("digit \"" + table.Text(row, "digit") + "\" is not known" +
         SuggestNames(table.Text(row, "digit"), {"thumb", "index", "middle", "ring", "little"}));
  }
  const std::string& text = table.Text(row, "verdict");
  const auto verdict = std::find_if(std::begin(kVerdicts), std::end(kVerdicts),
                                    [&](ReviewVerdict v) { return text == NameOf(v); });
  if (verdict == std::end(kVerdicts)) {
    fail("verdict \"" + text + "\" is not known" +
         SuggestNames(text, {"confirmed", "corrected", "no_contact"}));
    return review;
  }
  review.verdict = *verdict;
  if (review.verdict == ReviewVerdict::kNoContact) return review;
  review.contact = table.Number(row, "contact_s");
  if (review.verdict != ReviewVerdict::kCorrected) return review;
  review.uncertainty = table.Number(row, "uncertainty_s");
  if (std::isnan(review.contact)) fail("corrected without a time: contact_s is empty");
  if (review.uncertainty <= 0.0) fail("uncertainty_s: expected more than 0, or an empty cell");
  return review;
}

}  // namespace

const char* NameOf(ReviewVerdict verdict) {
  switch (verdict) {
    case ReviewVerdict::kConfirmed:
      return "confirmed";
    case ReviewVerdict::kCorrected:
      return "corrected";
    case ReviewVerdict::kNoContact:
      return "no_contact";
  }
  return "";
}

std::vector<ContactReview> ReadReviews(DataTable& table, Diagnostics& problems) {
  for (const char* column : {"trial", "digit", "verdict"}) table.Require(column);
  std::vector<ContactReview> reviews;
  std::map<std::pair<std::string, std::string>, int> lines;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    if (table.Text(row, "verdict").empty()) continue;
    const ContactReview review = ReadReview(table, row, problems);
    const auto [first, is_new] = lines.insert({{review.trial, review.digit}, review.line});
    if (!is_new) {
      problems.Fail(table.file(), review.line,
                    "trial " + review.trial + " has a verdict on the " + NameOfDigit(review.digit) +
                        " already in line " + std::to_string(first->second));
    }
    reviews.push_back(review);
  }
  return reviews;
}

std::vector<std::string> DropLapsed(const TrialAnalysis& analysis, double frame,
                                    std::vector<ContactReview>& reviews) {
  constexpr double kSlack = 1e-6;  // times were written with so many digits [s]
  std::vector<std::string> texts;
  const auto has_lapsed = [&](const ContactReview& review) {
    if (review.verdict != ReviewVerdict::kConfirmed || std::isnan(review.contact)) return false;
    for (const DigitContactEvents& digit : analysis.contacts) {
      if (digit.digit != review.digit) continue;
      const bool is_found = digit.contact.IsFound();
      if (is_found && std::abs(digit.contact.time - review.contact) <= frame + kSlack) return false;
      texts.push_back("line " + std::to_string(review.line) + ": contact of the " +
                      NameOfDigit(review.digit) + " in trial " + review.trial + " confirmed at " +
                      FormatFixed(review.contact, 4) + " s, now " +
                      (is_found ? "at " + FormatFixed(digit.contact.time, 4) + " s"
                                : "none (" + digit.contact.missing + ")") +
                      "; it counts as not confirmed, look again");
      return true;
    }
    return false;
  };
  reviews.erase(std::remove_if(reviews.begin(), reviews.end(), has_lapsed), reviews.end());
  return texts;
}

void ApplyReviews(const std::vector<ContactReview>& reviews, const AnalysisOptions& options,
                  double begin, double end, double frame, TrialAnalysis& analysis) {
  if (reviews.empty()) return;
  for (const ContactReview& review : reviews) {
    const auto fail = [&](const std::string& text) {
      throw Error(ErrorKind::kFormat, "reviews, line " + std::to_string(review.line) + ": " + text);
    };
    const auto digit =
        std::find_if(analysis.contacts.begin(), analysis.contacts.end(),
                     [&](const DigitContactEvents& d) { return d.digit == review.digit; });
    if (digit == analysis.contacts.end()) {
      fail("the " + NameOfDigit(review.digit) + " is not recorded in this study");
    }
    digit->is_reviewed = true;
    if (review.verdict == ReviewVerdict::kConfirmed) {
      if (!digit->contact.IsFound()) {
        fail("there is no contact of the " + NameOfDigit(review.digit) + " to confirm in trial " +
             review.trial + " (" + digit->contact.missing +
             "); expected corrected with a time, or no_contact");
      }
    } else if (review.verdict == ReviewVerdict::kNoContact) {
      digit->contact = MissingEvent("a person saw no contact");
    } else {
      if (!(review.contact >= begin && review.contact <= end)) {
        fail("contact_s " + FormatFixed(review.contact, 3) + " lies outside of trial " +
             review.trial + ", " + FormatFixed(begin, 3) + " to " + FormatFixed(end, 3) + " s");
      }
      EventTime contact;
      contact.time = review.contact;
      contact.uncertainty =
          std::isnan(review.uncertainty) ? frame / std::sqrt(12.0) : review.uncertainty;
      digit->contact = contact;
      digit->own_uncertainty = contact.uncertainty;
    }
    digit->is_verified = digit->contact.IsFound();
  }
  RecalcMeasures(options, analysis);
}

std::string DescribeReviews(const std::vector<ContactReview>& reviews) {
  std::string text;
  for (const ContactReview& review : reviews) {
    text += (text.empty() ? "" : ", ") + NameOfDigit(review.digit) + " ";
    if (review.verdict == ReviewVerdict::kNoContact) {
      text += "without contact";
    } else {
      text += NameOf(review.verdict);
    }
    if (review.verdict == ReviewVerdict::kCorrected) {
      text += " to " + FormatFixed(review.contact, 3) + " s";
    }
    if (!review.by.empty()) text += " (" + review.by + ")";
  }
  return text;
}

}  // namespace graspbench
