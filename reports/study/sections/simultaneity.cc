#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "human_study/study/inference/closure_ends.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

const char* TextOfClock(size_t clock) {
  constexpr const char* kTexts[] = {"since the movement's onset", "since the widest opening",
                                    "onset, adjusted for movement duration"};
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
      {"Independent digits", "mean and 95 % range under permutation"},
      {"p", "two-sided"},
      {"Found [%]", "relative difference detected with a power of 80 %"}};
  if (has_persons) columns.push_back({"Ratio over persons", "95 % interval"});
  Table table(
      "Participants compared with independent digits: contact times of each digit permuted 999 "
      "times among the trials of one person and condition.",
      columns);
  AddTests("GFT [ms]", null.gft, MsFromS(1.0), has_persons, table);
  AddTests("GFT% [%]", null.gft_ratio, 100.0, has_persons, table);
  return table.ToHtml();
}

/** Shows how the closure time depends on the event that ends the closure. */
Html DrawClosureEnds(const StudyPageData& data) {
  Table table("Closure time from the widest opening, by definition of its end.",
              {"End of closure",
               {"Trials", "with this end"},
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
  return table.ToHtml() + MakeParagraph(
                              "GCT ends with the last contact; GFT% and GOT% depend on it. Other "
                              "definitions end the closure when the object first moves or when the "
                              "fingertips are slow relative to the object.");
}

Html DrawSimultaneity(const StudyPageData& data) {
  if (data.result.CountKept() == 0) return MakeParagraph("No trial counts.");
  const Answer<IndependenceNull>& null = data.result.statistics.independence;
  Html html = MakeParagraph(DescribeIndependence(null));
  if (!null) return html + DrawClosureEnds(data);
  std::string note =
      "Timing that all digits share with the clock is not coordination of digits. Therefore three "
      "clocks are used and the most conservative decides. \"More simultaneous\" is tested against "
      "digits without the stated clock errors, \"less simultaneous\" against digits with their "
      "full spread. All digits also share an error of the clock, so the shared timing must exceed "
      "a bound of that error; otherwise the result is not decided.";
  if (null->num_incomplete > 0) {
    note += " " + std::to_string(null->num_incomplete) +
            " of the included trials lacked a contact or a clock and " +
            (null->num_incomplete == 1 ? "was" : "were") + " left out.";
  }
  return html + DrawTests(*null) + MakeParagraph(note) + DrawClosureEnds(data) +
         Element("p", {}, LinkTo("robot", "GFT% of robots and participants"));
}

}  // namespace

StudySection simultaneity_study_section() {
  return {"simultaneity", "Participants and independent digits", DrawSimultaneity};
}

}  // namespace graspbench
