#include "reports/format.h"
#include "reports/study/study_format.h"
#include "reports/study/study_section.h"

namespace graspbench {
namespace {

Html DrawAnova(const MeasureStatistics& statistics) {
  if (!statistics.anova) {
    return MakeParagraph("Not tested: " + statistics.anova.reason() + ".");
  }
  const Align number = Align::kNumber;
  Table table("Repeated-measures analysis of variance, " +
                  FormatCount(statistics.anova->num_persons, "person") + ".",
              {{"Effect"},
               {"F", number},
               {"df", number, "of effect and error, uncorrected"},
               {"p", number, "uncorrected: holds under sphericity"},
               {"Mauchly W", number, "sphericity"},
               {"p of W", number},
               {"GG epsilon", number, "Greenhouse-Geisser"},
               {"p (GG)", number},
               {"p (HF)", number, "Huynh-Feldt"},
               {"Partial eta\u00B2", number},
               {"Generalised eta\u00B2", number}});
  for (const WithinEffect& effect : statistics.anova->effects) {
    const std::string df =
        FormatSignificant(effect.df_effect, 3) + ", " + FormatSignificant(effect.df_error, 3);
    if (!effect.test) {
      std::vector<Html> row(11, Text("n/a"));
      row[0] = Text(effect.name + " (" + effect.test.reason() + ")");
      row[2] = Text(df);
      table.AddRow(row);
      continue;
    }
    const WithinTest& test = *effect.test;
    const auto& mauchly = test.mauchly;
    table.AddRow({Text(effect.name), Text(FormatFixed(test.f, 2)), Text(df), Text(FormatP(test.p)),
                  Text(mauchly ? FormatFixed(mauchly->w, 3) : "n/a"),
                  Text(mauchly ? FormatP(mauchly->p) : "n/a"),
                  Text(FormatFixed(test.greenhouse_geisser.epsilon, 3)),
                  Text(FormatP(test.greenhouse_geisser.p)),
                  Text(test.huynh_feldt ? FormatP(test.huynh_feldt->p) : "n/a"),
                  Text(FormatFixed(test.partial_eta_squared, 3)),
                  Text(FormatFixed(test.generalised_eta_squared, 3))});
  }
  Html html = table.ToHtml();
  for (const LeftOut& person : statistics.cells->left_out) {
    html += MakeParagraph("Left out: " + person.person + " (" + person.reason + ").");
  }
  return html;
}

Html DrawPairs(const MeasureStatistics& statistics) {
  if (statistics.pairs.empty() || statistics.cells->persons.size() < 2) return {};
  const Align number = Align::kNumber;
  const char* unit = statistics.measure.unit;
  Table table("Differences of all pairs of conditions; p after Holm over all pairs.",
              {{"Pair"},
               {"Difference [" + std::string(FindDisplayUnit(unit).name) + "]", number},
               {"95 % interval", number, "of the difference, uncorrected"},
               {"t", number},
               {"p (Holm)", number},
               {"d_z", number}});
  const std::vector<std::string>& cells = statistics.cells->cells;
  for (const PairComparison& pair : statistics.pairs) {
    const std::string name = cells[pair.b] + " - " + cells[pair.a];
    if (!pair.test) {
      table.AddRow({Text(name + " (" + pair.test.reason() + ")"), Text("n/a"), Text("n/a"),
                    Text("n/a"), Text("n/a"), Text("n/a")});
      continue;
    }
    const TTest& test = *pair.test;
    table.AddRow({Text(name), Text(FormatValue(test.mean, unit)),
                  Text(FormatValue(test.interval.low, unit) + " to " +
                       FormatValue(test.interval.high, unit)),
                  Text(FormatFixed(test.t, 2)), Text(FormatP(pair.p_holm)),
                  Text(FormatFixed(test.d_z, 2))});
  }
  return MakeDetails("Pairs of conditions (" + std::to_string(statistics.pairs.size()) + ")",
                     table.ToHtml());
}

Html Draw(const StudyPageData& data) {
  const std::vector<MeasureStatistics>& measures = data.result.statistics.measures;
  Html html;
  if (data.result.study.factors.empty()) {
    return MakeParagraph("The study names no factor, so there is nothing to compare.");
  }
  for (const MeasureStatistics& statistics : measures) {
    html +=
        Element("h3", {}, statistics.measure.name) + DrawAnova(statistics) + DrawPairs(statistics);
  }
  return html;
}

}  // namespace

StudySection tests_study_section() { return {"tests", "Tests", Draw}; }

}  // namespace graspbench
