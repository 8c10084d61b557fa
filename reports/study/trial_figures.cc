#include "reports/study/trial_figures.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/files/files.h"
#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "human_study/study/run/trial_removal.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"
#include "reports/study/study_format.h"

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

/** Tabulates one row per digit with the accepted contact time, its uncertainty and the result of
every detector. */
Html DrawDigits(const StudyTrial& trial) {
  std::vector<Column> columns = {"Digit", "Believed", "\u00B1 95 % [ms]", "Reviewed"};
  for (const ContactDetector& detector : ContactDetectorList()) columns.push_back(detector.id);
  Table table("Contacts on the recording's clock.", columns);
  for (const DigitContactEvents& digit : trial.analysis->contacts) {
    std::vector<ContactReview> own;
    std::copy_if(trial.reviews.begin(), trial.reviews.end(), std::back_inserter(own),
                 [&](const ContactReview& review) { return review.digit == digit.digit; });
    std::vector<Cell> cells = {
        NameOfDigit(digit.digit), FormatEvent(digit.contact),
        digit.contact.IsFound() ? FormatFixed(1e3 * digit.contact.CalcHalfWidth(), 1) : "",
        DescribeReviews(own)};
    for (const EventTime& event : digit.by_detector) cells.push_back(FormatEvent(event));
    table.AddRow(cells);
  }
  return table.ToHtml();
}

struct ReviewRow {
  const StudyTrial* trial;
  const DigitContactEvents* digit;
  const ContactReview* review;  // null if not reviewed
};

std::vector<CsvColumn<ReviewRow>> ListReviewColumns() {
  using R = ReviewRow;
  return {{"trial", "", "its trial_id", [](const R& r) { return r.trial->id; }},
          {"digit", "", "thumb, index, ..", [](const R& r) { return NameOfDigit(r.digit->digit); }},
          {"verdict", "string", "", "confirmed, corrected or no_contact; empty: not looked at",
           [](const R& r) { return r.review ? Json(NameOf(r.review->verdict)) : Json(); }},
          {"contact_s", "s", "first contact on the recording's clock",
           [](const R& r) { return r.digit->contact.time; }},
          {"uncertainty_s", "number", "s", "standard uncertainty of a corrected contact",
           [](const R& r) { return r.review ? JsonNumber(r.review->uncertainty) : Json(); }},
          {"by", "string", "", "who looked",
           [](const R& r) { return r.review ? Json(r.review->by) : Json(); }},
          {"note", "string", "", "for people", [](const R&) { return Json(); }}};
}

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
  return FormatCsv(ListReviewColumns(), rows);
}

}  // namespace

Json MakeReviewSchema() { return MakeTableSchema(ListReviewColumns(), ""); }

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
  Table table("All trials, including removed trials.",
              {"Trial", "Kept", "GFT [ms]", "Reviewed", "Why not"});
  for (const StudyTrial& trial : result.trials) {
    const Html name = trial.analysis
                          ? Element("a", {{"href", "trials/" + NameOfPage(trial)}}, trial.id)
                          : Text(trial.id);
    table.AddRow({name, trial.IsKept() ? "yes" : "no",
                  trial.analysis ? FormatValue(trial.analysis->timing.gft, "s") : "",
                  DescribeReviews(trial.reviews), trial.removed});
  }
  const PageFrame frame = {result.study.config.name + ", review",
                           FormatCount(static_cast<int>(result.trials.size()), "trial")};
  const Html how = MakeParagraph(
      "Inspect each trial and enter a verdict per digit in reviews.csv: confirmed; corrected, with "
      "contact_s; or no_contact. Rows without a verdict are ignored. Copy the file beside "
      "study.yaml, name it there (reviews: reviews.csv), and run the study again: reviewed "
      "contacts are applied and named in the report.");
  WriteFile(folder_ / "index.html", MakePage(frame, {}, how + table.ToHtml()));
  WriteFile(folder_ / "reviews.csv", FormatReviews(result));
}

namespace {

constexpr size_t kMaxTipPoints = 400;  // points per fingertip, dense enough for close inspection

/** Distance from the position during the hold [m], shown when no shape is known. */
ScalarCurve CalcFromHold(const TipAgainstObject& tip, const Hold& hold) {
  ScalarCurve curve = tip.speed;
  const int at = FindHoldSample(tip.speed, hold);
  for (Eigen::Index i = 0; i < curve.values.size(); ++i) {
    curve.values(i) =
        at < 0 ? std::nan("") : (tip.smooth.path.p.col(i) - tip.smooth.path.p.col(at)).norm();
  }
  return curve;
}

LinePlot::Series MakeSeries(const std::string& label, const ScalarCurve& curve, size_t max_points) {
  LinePlot::Series series;
  series.label = label;
  const size_t stride = std::max<size_t>(1, curve.size() / max_points);
  for (size_t i = 0; i < curve.size(); i += stride) {
    series.x.push_back(curve.times[i]);
    series.y.push_back(curve.IsValid(i) ? 1e3 * curve.values[static_cast<Eigen::Index>(i)]
                                        : std::nan(""));
  }
  return series;
}

void AddMark(const EventTime& event, const std::string& label, LinePlot& plot) {
  if (event.IsFound()) plot.marks.push_back({event.time, label});
}

/** Plots a curve of the whole hand over the trial. */
LinePlot MakeCurvePlot(const std::string& title, const char* axis, const char* label,
                       const ScalarCurve& curve, const StudyTrial& trial) {
  LinePlot plot;
  plot.text.title = title + ", trial " + trial.id;
  plot.text.description = title + " over time with the events used for the measures.";
  plot.x_axis = "time [s]";
  plot.y_axis = axis;
  plot.series.push_back(MakeSeries(label, curve, kNumDrawn));
  return plot;
}

/** Speed threshold of the onset rule [m/s]; NaN for rules without one. */
double FindThresholdOf(const Movement& movement, const MovementOptions& options) {
  if (options.rule == "threshold" || options.rule == "longest_run") return options.speed_threshold;
  if (options.rule == "peak_fraction") return options.peak_fraction * movement.peak_speed;
  return std::nan("");
}

LinePlot MakeTipPlot(const StudyTrial& trial, const char* title, const char* axis) {
  LinePlot plot;
  plot.text.title = std::string(title) + ", trial " + trial.id;
  plot.text.description = std::string(title) + " of every digit with the accepted contacts.";
  plot.x_axis = "time [s]";
  plot.y_axis = axis;
  for (const DigitContactEvents& digit : trial.analysis->contacts) {
    AddMark(digit.contact, NameOfDigit(digit.digit), plot);
  }
  return plot;
}

/** Symbol of the detector at this index of the list. */
const char* SignOfDetector(size_t place) {
  constexpr const char* kSigns[] = {"\u25CB", "\u25B3", "\u25C7", "\u25A1", "\u00D7", "+"};
  return kSigns[place % std::size(kSigns)];
}

}  // namespace

Html DrawTrialSpeed(const StudyTrial& trial, const MovementOptions& options) {
  const TrialAnalysis& analysis = *trial.analysis;
  LinePlot plot =
      MakeCurvePlot("Speed of the wrist", "speed [mm/s]", "speed", analysis.speed, trial);
  const double level = FindThresholdOf(analysis.movement, options);
  if (std::isfinite(level) && analysis.speed.size() > 0) {
    const std::vector<double>& times = analysis.speed.times;
    plot.series.push_back(
        {"threshold", {times.front(), times.back()}, {1e3 * level, 1e3 * level}, {}, {}});
  }
  AddMark(analysis.movement.onset, "onset", plot);
  if (std::isfinite(analysis.movement.peak_time)) {
    plot.marks.push_back({analysis.movement.peak_time, "peak"});
  }
  AddMark(analysis.movement.end, "end", plot);
  return MakeScroll(plot.text.title, DrawLinePlot(plot));
}

Html DrawTrialOpening(const StudyTrial& trial) {
  const TrialAnalysis& analysis = *trial.analysis;
  LinePlot plot = MakeCurvePlot("Hand opening", "opening [mm]", "opening", analysis.opening, trial);
  plot.is_y_from_zero = false;
  AddMark(analysis.movement.onset, "onset", plot);
  AddMark(analysis.closure_start, "widest", plot);
  for (const DigitContactEvents& digit : analysis.contacts) {
    AddMark(digit.contact, NameOfDigit(digit.digit), plot);
  }
  AddMark(analysis.object.lift_off, "lift-off", plot);
  if (!analysis.object.lift_off.IsFound() && analysis.hold.IsFound()) {
    plot.marks.push_back({analysis.hold.time, "hold"});
  }
  return MakeScroll(plot.text.title, DrawLinePlot(plot));
}

Html DrawDecidingCurve(const StudyTrial& trial, const MovementOptions& options) {
  const bool is_speed =
      !trial.IsKept() && FindRemovalAdvice(trial.removed_code).curve == RemovalCurve::kSpeed;
  return is_speed ? DrawTrialSpeed(trial, options) : DrawTrialOpening(trial);
}

Html DrawTrialContacts(const StudyTrial& trial) {
  const std::vector<ContactDetector>& detectors = ContactDetectorList();
  StripChart chart;
  chart.text.title = "Contacts, trial " + trial.id;
  chart.text.description = "Contact times of each digit by each detector.";
  chart.axis = "time [s]";
  chart.kinds = {"accepted contact, 95 % interval"};
  for (size_t i = 0; i < detectors.size(); ++i) {
    const auto has_found = [&](const DigitContactEvents& digit) {
      return digit.by_detector[i].IsFound();
    };
    const std::vector<DigitContactEvents>& contacts = trial.analysis->contacts;
    if (std::any_of(contacts.begin(), contacts.end(), has_found)) {
      chart.symbols.emplace_back(SignOfDetector(i), detectors[i].id);
    }
  }
  for (const DigitContactEvents& digit : trial.analysis->contacts) {
    StripChart::Row row;
    row.label = NameOfDigit(digit.digit);
    if (digit.contact.IsFound() && std::isfinite(digit.contact.uncertainty)) {
      const double half = digit.contact.CalcHalfWidth();
      row.spans.push_back({digit.contact.time - half, digit.contact.time + half, 0,
                           FormatValue(digit.contact.time, "s") + " ms"});
    }
    for (size_t i = 0; i < detectors.size(); ++i) {
      const EventTime& event = digit.by_detector[i];
      if (!event.IsFound()) continue;
      row.marks.push_back({event.time, SignOfDetector(i),
                           std::string(detectors[i].id) + ": " + FormatValue(event.time, "s") +
                               " ms" + (event.is_in_gap ? ", in a gap" : "") +
                               (event.is_filled ? ", filled" : "")});
    }
    if (row.marks.empty()) row.label += ": none";
    chart.rows.push_back(row);
  }
  return MakeScroll(chart.text.title, DrawStripChart(chart));
}

std::string DescribeTrial(const StudyTrial& trial, const std::vector<Factor>& factors) {
  const ContactTiming& timing = trial.analysis->timing;
  std::string cell;
  for (const std::string& level : trial.levels) cell += (cell.empty() ? "" : ", ") + level;
  std::string text = trial.id + (cell.empty() ? "" : ", " + NameOfCell(cell, factors));
  text += ": GFT " + FormatWithUnit(timing.gft, "s") + ", GOT " + FormatWithUnit(timing.got, "s") +
          ", GFT% " + FormatWithUnit(timing.gft_ratio, "1");
  const std::string flags = FormatFlags(*trial.analysis);
  if (!trial.IsKept()) {
    text += " \u2013 removed: " + trial.removed;
  } else if (!flags.empty()) {
    text += " \u2013 " + flags;
  }
  return text;
}

Html DrawTrialTips(const StudyTrial& trial, const ReachTrial& reach,
                   const AnalysisOptions& options) {
  FilteredTrial filtered(reach);
  const ContactOptions contact = FitCutoffs(options, CalcRate(reach)).contact;
  const std::vector<TipAgainstObject>& tips =
      filtered.FilterTipsAgainstObject(contact.cutoff, contact.object_cutoff);
  const bool has_shape = std::any_of(tips.begin(), tips.end(), [](const TipAgainstObject& tip) {
    return tip.distance.size() > 0;
  });
  LinePlot speeds = MakeTipPlot(trial, "Speed of the tips relative to the object", "speed [mm/s]");
  LinePlot distances =
      MakeTipPlot(trial,
                  has_shape ? "Distance of the markers from the surface"
                            : "Distance of the tips from their position in the hold",
                  "distance [mm]");
  for (size_t i = 0; i < tips.size(); ++i) {
    const std::string name = NameOfDigit(reach.digits[i].digit);
    speeds.series.push_back(MakeSeries(name, tips[i].speed, kMaxTipPoints));
    distances.series.push_back(
        MakeSeries(name, has_shape ? tips[i].distance : CalcFromHold(tips[i], trial.analysis->hold),
                   kMaxTipPoints));
  }
  return MakeScroll(speeds.text.title, DrawLinePlot(speeds)) +
         MakeScroll(distances.text.title, DrawLinePlot(distances));
}

}  // namespace graspbench
