#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "human_study/study/inference/closure_ends.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

const char* TextOfClock(size_t clock) {
  constexpr const char* kTexts[] = {"since the movement's onset", "since the widest opening",
                                    "onset, length of the movement taken out"};
  return kTexts[clock];
}

std::string FormatOverPersons(const IndependenceTest& test) {
  const JackknifeInterval& ratio = *test.over_persons;
  return FormatWithRange(std::exp(ratio.estimate), std::exp(ratio.interval.low),
                         std::exp(ratio.interval.high), 2);
}

void AddTests(const char* name, const std::array<IndependenceTest, kNumClocks>& tests,
              double factor, bool has_persons, Table& table) {
  for (size_t clock = 0; clock < kNumClocks; ++clock) {
    const IndependenceTest& test = tests[clock];
    std::vector<Cell> cells = {
        name,
        TextOfClock(clock),
        FormatFixed(factor * test.observed, 1),
        FormatWithRange(factor * test.expected, factor * test.low, factor * test.high, 1),
        FormatP(test.p),
        FormatFixed(100.0 * test.detectable, 0)};
    if (has_persons) cells.push_back(FormatOverPersons(test));
    table.AddRow(cells);
  }
}

Html DrawTests(const IndependenceNull& null) {
  const bool has_persons = static_cast<bool>(null.gft[0].over_persons);
  std::vector<Column> columns = {
      "Measure",
      "Times counted",
      {"People", "mean over the trials"},
      {"Independent digits", "mean, and 95 % of the dealings"},
      {"p", "two-sided"},
      {"Found [%]", "smaller by so much is found in 8 of 10 such studies"}};
  if (has_persons) columns.push_back({"Ratio over persons", "95 % interval"});
  Table table(
      "People against digits that move independently: contact times of each digit permuted "
      "among the trials of one person and condition, 999 times.",
      columns);
  AddTests("GFT [ms]", null.gft, MsFromS(1.0), has_persons, table);
  AddTests("GFT% [%]", null.gft_ratio, 100.0, has_persons, table);
  return table.ToHtml();
}

/** How the closure time depends on what ends the closure. */
Html DrawClosureEnds(const StudyPageData& data) {
  Table table("Closure time, from the widest opening, by what ends the closure.",
              {"End of closure",
               {"Trials", "that have this end"},
               {"Median [ms]", "and quartiles"},
               {"After the last contact [ms]", "median over the trials that have both"}});
  for (const ClosureEnd& end : ListClosureEnds(data.result.trials)) {
    const auto format = [](double time) { return FormatFixed(MsFromS(time), 0); };
    table.AddRow({end.text, end.num_trials,
                  end.num_trials == 0 ? "n/a"
                                      : format(end.median) + " (" + format(end.lower_quartile) +
                                            " to " + format(end.upper_quartile) + ")",
                  std::isfinite(end.median_after_contact) ? format(end.median_after_contact)
                                                          : std::string("n/a")});
  }
  return table.ToHtml() +
         MakeParagraph(
             "GCT, and with it GFT% and GOT%, ends with the last contact. Other definitions end "
             "the closure when the object first moves, or when the fingertips are slow against "
             "it.");
}

Html DrawSimultaneity(const StudyPageData& data) {
  if (data.result.CountKept() == 0) return MakeParagraph("No trial counts.");
  const Answer<IndependenceNull>& null = data.result.statistics.independence;
  Html html = MakeParagraph(DescribeIndependence(null));
  if (!null) return html + DrawClosureEnds(data);
  std::string note =
      "What all digits share with the clock is no coordination of digits, so three clocks are "
      "asked and the one that speaks least for a difference decides. Who is more "
      "simultaneous is so against digits without the clock's stated errors, who is less, against "
      "digits with all their spread. An error of the clock is shared by all digits just as "
      "coordination is: what they share must exceed a bound of that error, else nothing is "
      "decided.";
  if (null->num_incomplete > 0) {
    note += " " + FormatCount(null->num_incomplete, "trial") +
            " of those that count lacked the contact of a digit or a clock and took no part.";
  }
  return html + DrawTests(*null) + MakeParagraph(note) + DrawClosureEnds(data) +
         Element("p", {}, LinkTo("robot", "The robot's GFT% beside that of people"));
}

}  // namespace

StudySection simultaneity_study_section() {
  return {"simultaneity", "People against independent digits", DrawSimultaneity};
}

}  // namespace graspbench
