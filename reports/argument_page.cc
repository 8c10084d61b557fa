#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"

namespace graspbench {
namespace {

using Claims = std::vector<ArgumentClaim>;

std::string NameSection(const ArgumentClaim& claim) {
  return std::string("claim-") + claim.question->id;
}

/** The verdict as text, for example "(b) refuted, not run". */
std::string FormatVerdict(const ArgumentClaim& claim) {
  return std::string(NameOf(claim.verdict)) + (claim.was_run() ? "" : ", not run");
}

/** Subject and number of the headline. */
std::string DescribeHeadline(const ArgumentClaim& claim) {
  const ArgumentNumber* const number = claim.headline();
  if (number == nullptr) return "none";
  return number->subject + ": " + FormatNumber(*number);
}

Html DrawAnswers(const Claims& claims) {
  Table table("The five questions and their answers.",
              {"", "Question", "Verdict", "Answer", {"Number", "value, 95 % interval, n"}});
  for (const ArgumentClaim& claim : claims) {
    table.AddRow({LinkTo(NameSection(claim), std::string("(") + claim.question->id + ")"),
                  claim.question->question, FormatVerdict(claim), claim.sentence(),
                  DescribeHeadline(claim)});
  }
  return MakeParagraph(
             "The thesis argues that people strive for simultaneous contact of all digits and that "
             "simultaneous contact also helps robot hands. Its first optimisation step makes the "
             "contacts of a grasp simultaneous. Its second step finds the most stable thumb "
             "posture. Each answer below is the evidence of simulated trials or of recordings for "
             "one part of this argument. \"Not decided\" means that there are too few trials.") +
         table.ToHtml();
}

/** Plots the headline measure minus its null value, so that zero means no effect. */
Html DrawNumbers(const ArgumentClaim& claim) {
  const ArgumentMeasure& measure = *claim.numbers.front().measure;
  const std::string less =
      measure.null_value == 0.0 ? "" : ", less " + FormatFixed(measure.null_value, 0);
  IntervalPlot plot;
  plot.text = {claim.question->question,
               "One row per number with its 95 % interval, deciding numbers first."};
  plot.axis = measure.text + less + (*measure.unit ? std::string(" [") + measure.unit + "]" : "");
  for (const bool decides : {true, false}) {
    bool is_first = true;
    for (const ArgumentNumber& number : claim.numbers) {
      if (number.measure != &measure || number.decides != decides) continue;
      if (is_first) plot.AddHeading(decides ? "decides" : "beside it");
      is_first = false;
      plot.rows.push_back({number.subject, number.value - measure.null_value,
                           number.interval.low - measure.null_value,
                           number.interval.high - measure.null_value,
                           std::string(NameOf(number.verdict)) + ", n " + std::to_string(number.n),
                           "", decides ? 0 : 1});
    }
  }
  const std::string side = measure.sign > 0.0 ? "right" : "left";
  return MakeFigure(
      Capitalise(measure.text) + ", with 95 % intervals.",
      "an interval all to the " + side + " of zero shows the claim; one that ends before " +
          FormatFixed(measure.sign * measure.least, measure.least < 1.0 ? 2 : 0) +
          (*measure.unit ? std::string(" ") + measure.unit : "") + " on that side refutes it.",
      MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

template <size_t kClaim>
Html DrawClaim(const Claims& claims) {
  const ArgumentClaim& claim = claims.at(kClaim);
  Html content = Element(
      "p", {{"id", NameSection(claim)}},
      Element("strong", {}, Capitalise(FormatVerdict(claim)) + ".") + Text(" " + claim.sentence()));
  if (const ArgumentNumber* const number = claim.headline()) {
    content += MakeParagraph(Capitalise(number->measure->text) + ", " + DescribeHeadline(claim) +
                             (number->detail.empty() ? "" : "; " + number->detail) + ".");
    content += Element("p", {},
                       Text("Made by ") + Element("code", {}, number->command) +
                           Text(" (" + number->source + ")."));
    if (claim.verdict == ArgumentVerdict::kNotDecided) {
      content += MakeParagraph("Would decide: " + claim.would_decide() + ".");
    }
  }
  if (!claim.numbers.empty()) {
    content += DrawNumbers(claim);
    content += MakeTable(std::string("All numbers of claim ") + claim.question->id + ".",
                         ShowTable(ListArgumentColumns(), claim.numbers));
  }
  for (const NotRun& one : claim.not_run) {
    content +=
        Element("p", {}, Text("Not run: " + one.what + ". ") + Element("code", {}, one.command));
  }
  return content;
}

Html DrawRules(const Claims&) {
  Table table("Measured quantities and smallest effects of interest.",
              {"Number", "Claim expects", {"Smallest effect of interest", "proposed"}});
  for (const ArgumentMeasure* measure : {&kPeopleRatio, &kLateSuccess, &kLateThreshold,
                                         &kFormingTime, &kStability, &kSuccessChange}) {
    const std::string unit = *measure->unit ? std::string(" ") + measure->unit : "";
    table.AddRow({Capitalise(measure->text),
                  (measure->sign > 0.0 ? "more than " : "less than ") +
                      FormatFixed(measure->null_value, 0) + unit,
                  FormatFixed(measure->least, measure->least < 1.0 ? 2 : 0) + unit});
  }
  return MakeParagraph(
             "A number shows its claim if its 95 % interval lies on the claimed side of the null "
             "value. A number refutes its claim if the interval ends before the smallest effect of "
             "interest. Otherwise the number is inconclusive. A claim is shown if all deciding "
             "numbers show it, and refuted if one of them refutes it. Experiments that were not "
             "run decide nothing.") +
         table.ToHtml() +
         MakeParagraph(
             "GFT is the time from the first to the last contact of the digits, GOT that between "
             "the thumb and the first finger, GCT that from the start of closure to the last "
             "contact. The floor of GFT is the GFT that remains when the times of each digit are "
             "shifted by their own median; no pre-grasp can remove it. Candidates of steps 1 and 2 "
             "are measured on fresh initial poses before they are accepted or rejected. Hands "
             "ending in -evolved have grasps that were optimised on the catalogue objects "
             "(training set).");
}

}  // namespace

std::string MakeArgumentPage(const Claims& claims, const std::string& sources) {
  static_assert(kNumArgumentClaims == 5);
  const std::vector<PageSection<Claims>> sections = {
      {"answers", "Five answers", DrawAnswers},
      {"people", "(a) People", DrawClaim<0>},
      {"robots", "(b) Robots", DrawClaim<1>},
      {"pregrasp", "(c) Step 1: the pre-grasp", DrawClaim<2>},
      {"target", "(d) Step 2: the thumb's target posture", DrawClaim<3>},
      {"success", "(e) Success before and after", DrawClaim<4>},
      {"rules", "How it is decided", DrawRules}};
  PageFrame frame = {"The argument", "read: " + sources};
  frame.commands = {"graspbench argument FOLDER.. --out DIR"};
  frame.references = {"wilson1927"};
  return MakeSectionedPage(frame, sections, claims);
}

}  // namespace graspbench
