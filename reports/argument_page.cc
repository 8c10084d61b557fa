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

Html MakeStrong(const std::string& text) { return Element("strong", {}, text); }

Html MakeItems(const std::vector<Html>& items) {
  Html list;
  for (const Html& item : items) list += Element("li", {}, Element("p", {}, item));
  return Element("ul", {}, list);
}

Html MakeTexts(const std::vector<std::string>& texts) {
  std::vector<Html> items;
  for (const std::string& text : texts) items.push_back(Text(text));
  return MakeItems(items);
}

/** The number of the headline in words. */
std::string DescribeHeadline(const ArgumentNumber& number) {
  return number.subject + ": " + FormatNumber(number);
}

Html DrawAnswers(const Claims& claims) {
  std::vector<Html> answers;
  for (const ArgumentClaim& claim : claims) {
    const ArgumentNumber* const number = claim.headline();
    answers.push_back(
        LinkTo(NameSection(claim),
               std::string("(") + claim.question->id + ") " + claim.question->question) +
        Text(" ") + MakeStrong(Capitalise(FormatVerdict(claim)) + ".") +
        Text(" " + claim.sentence() +
             (number == nullptr ? "" : " Number: " + DescribeHeadline(*number) + ".")));
  }
  return MakeParagraph(
             "The thesis argues that people strive for simultaneous contact of all digits and that "
             "simultaneous contact also helps robot hands. Its first optimisation step makes the "
             "contacts of a grasp simultaneous. Its second step finds the most stable thumb "
             "posture. Each answer below is the evidence of simulated trials or of recordings for "
             "one part of this argument.") +
         MakeItems(answers) +
         MakeParagraph(
             "\"Not run\": no result decides the claim. \"Not decided\": an interval is too wide "
             "for "
             "a verdict, or a further condition of the rule is not met. The reason stands in "
             "brackets behind the hand.") +
         MakeParagraph("Terms used below:") +
         MakeTexts(
             {"GFT: time from the first to the last contact of the digits.",
              "GOT: time between the first contacts of the thumb and of a finger.",
              "GCT: time from the start of closure to the last contact.",
              "Floor of GFT: the GFT that remains when the times of each digit are shifted by "
              "their own median. No pre-grasp can remove it.",
              "Sigma: the smallest pull along the six half axes of the palm that the measured "
              "contact forces resist.",
              "Scene: one hand on one object. The values of (c) and (d) are medians of the "
              "scenes' changes; a median change need not equal the change of the medians. "
              "Each number has its own fresh draws, so that two numbers may begin at other "
              "times.",
              "Evolved grasps (hands named -evolved): grasps optimised on the objects of the "
              "catalogue, which are therefore their training set (seen objects)."});
}

/** Numbers of the headline's measure with their rule. */
Html DrawNumbers(const ArgumentClaim& claim) {
  const ArgumentMeasure& measure = *claim.numbers.front().measure;
  const std::string unit = *measure.unit ? std::string(" ") + measure.unit : "";
  const double line = measure.null_value + measure.sign * measure.least;
  IntervalPlot plot;
  plot.text = {claim.question->question,
               "One row per number with its 95 % interval, deciding numbers first."};
  plot.axis = *measure.unit ? measure.unit : "ratio";
  plot.holds_zero = false;
  plot.labels_above = true;
  plot.marks = {{measure.null_value, "no effect"},
                {line, FormatFixed(line, measure.least < 1.0 ? 2 : 0) + unit}};
  for (const bool decides : {true, false}) {
    bool is_first = true;
    for (const ArgumentNumber& number : claim.numbers) {
      if (number.measure != &measure || number.decides != decides) continue;
      if (is_first) plot.AddHeading(decides ? "decide the claim" : "do not decide the claim");
      is_first = false;
      plot.rows.push_back({number.subject, number.value, number.interval.low, number.interval.high,
                           NameOf(number.verdict), "", decides ? 0 : 1});
    }
  }
  const bool has_ceiling =
      std::any_of(claim.numbers.begin(), claim.numbers.end(),
                  [](const ArgumentNumber& number) { return number.why.rfind("ceiling", 0) == 0; });
  return MakeFigure(
      Capitalise(measure.text) + ", with 95 % intervals.",
      DescribeRule(measure) + (has_ceiling ? " At a ceiling nothing is refuted (see below)." : ""),
      MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

/** What each number rests on and what would decide it: related figures, folders, command. */
Html DrawOrigins(const ArgumentClaim& claim) {
  std::vector<Html> items;
  for (const ArgumentNumber& number : claim.numbers) {
    std::string text = ": " + FormatVerdict(number) + ".";
    if (!number.detail.empty()) text += " " + Capitalise(number.detail);
    if (text.back() != '.') text += ".";
    if (number.decides && !number.would_decide.empty()) {
      text += " Would decide: " + number.would_decide + ".";
    }
    items.push_back(MakeStrong(number.subject) +
                    Text(text + " From the folder " + number.source + ", made by ") +
                    Element("code", {}, number.command) + Text("."));
  }
  return MakeParagraph("What the numbers rest on:") + MakeItems(items);
}

template <size_t kClaim>
Html DrawClaim(const Claims& claims) {
  const ArgumentClaim& claim = claims.at(kClaim);
  Html content =
      Element("p", {{"id", NameSection(claim)}},
              MakeStrong(Capitalise(FormatVerdict(claim)) + ".") + Text(" " + claim.sentence()));
  if (const ArgumentNumber* const number = claim.headline()) {
    content +=
        MakeParagraph(Capitalise(number->measure->text) + ", " + DescribeHeadline(*number) + ".");
    if (claim.verdict == ArgumentVerdict::kNotDecided) {
      content += MakeParagraph("Would decide: " + claim.would_decide() + ".");
    }
  } else if (!claim.numbers.empty()) {
    content += MakeParagraph("None of the numbers below decides the claim.");
  }
  if (!claim.numbers.empty()) {
    content += DrawNumbers(claim);
    content += MakeTable(std::string("All numbers of claim ") + claim.question->id + ".",
                         ShowTable(ListArgumentColumns(), claim.numbers));
    content += DrawOrigins(claim);
  }
  std::vector<Html> missing;
  for (const NotRun& one : claim.not_run) {
    missing.push_back(Text(one.what + ": ") + Element("code", {}, one.command));
  }
  if (!missing.empty()) content += MakeParagraph("Not run:") + MakeItems(missing);
  return content;
}

Html DrawRules(const Claims&) {
  std::vector<Html> rules;
  for (const ArgumentMeasure* measure : {&kPeopleRatio, &kLateSuccess, &kLateThreshold,
                                         &kFormingTime, &kStability, &kSuccessChange}) {
    rules.push_back(MakeStrong(Capitalise(measure->text)) + Text(". " + DescribeRule(*measure)));
  }
  return MakeParagraph(
             "Each number is judged by its 95 % interval and its smallest effect of interest "
             "(proposed):") +
         MakeItems(rules) +
         MakeParagraph(
             "A ceiling refutes nothing. If less than the smallest effect can be gained, because "
             "nearly all trials before succeed, the number is not decided. The exception is an "
             "interval that shows an opposite effect of the smallest size or more; it refutes.") +
         MakeParagraph(
             "A claim is shown if all deciding numbers show it, and refuted if one of them refutes "
             "it. Experiments that were not run decide nothing. Candidates of steps 1 and 2 are "
             "measured on fresh initial poses before they are accepted or rejected.");
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
