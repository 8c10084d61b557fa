#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "reports/plots/line_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

Html DrawFigure(const std::vector<BiasRow>& rows) {
  IntervalPlot plot;
  plot.text.title = "Error of GFT by choice";
  plot.text.description = "Mean error of the grasp forming time for each choice and asynchrony.";
  plot.axis = "found - true GFT [ms]";
  std::string text;
  int series = -1;
  for (const BiasRow& bias : rows) {
    if (bias.text != text) {
      plot.AddHeading(bias.text);
      text = bias.text;
      ++series;
    }
    IntervalPlot::Row row;
    row.label = "true " + FormatWithUnit(bias.true_gft, "s");
    const Interval range = bias.gft_error_range();
    row.value = MsFromS(bias.gft_error());
    row.low = MsFromS(range.low);
    row.high = MsFromS(range.high);
    row.text = FormatFixed(row.value, 1) + " \u00B1 " + FormatValue(bias.sd_gft, "s") + " ms";
    row.series = series % 8;
    plot.rows.push_back(row);
  }
  return MakeFigure(
      "Error of GFT for known asynchronies; lines are one standard deviation over "
      "trials.",
      "marks off zero: a bias of all trials. GFT cannot be negative, so noise alone raises a true "
      "zero.",
      MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

Html DrawTable(const std::vector<BiasRow>& rows) {
  Table table("Recovery of a known asynchrony with these choices.",
              {"Choice",
               "True GFT [ms]",
               "n",
               {"Missing", "trials without a GFT"},
               {"Found GFT [ms]", "mean"},
               "SD [ms]",
               {"Contact bias [ms]", "found - true contact time, all digits"},
               "Contact SD [ms]",
               {"Coverage [%]",
                "contacts whose error lies within the stated 95 % interval; nominal value: 95"}});
  for (const BiasRow& row : rows) {
    table.AddRow({row.text, FormatValue(row.true_gft, "s"), row.num_trials, row.num_missing,
                  FormatValue(row.mean_gft, "s"), FormatValue(row.sd_gft, "s"),
                  FormatValue(row.contact_bias, "s"), FormatValue(row.contact_sd, "s"),
                  FormatFixed(100.0 * row.coverage, 1)});
  }
  return MakeDetails("All numbers", table.ToHtml());
}

Html DrawBias(const StudyPageData& data) {
  const StudyResult& result = data.result;
  const std::vector<BiasRow>& rows = result.statistics.bias;
  if (result.study.config.bias_trials == 0) return MakeParagraph("Not run: bias_trials is 0.");
  if (rows.empty()) {
    return MakeParagraph(
        "Not computed: the noise of the recordings is unknown, because no trial has one second of "
        "the thumb without a gap.");
  }
  return MakeParagraph(
             "Reaches with a known GFT were simulated at this study's " +
             FormatFixed(result.rate, 1) + " Hz and noise (" + FormatFixed(1e3 * result.noise, 2) +
             " mm, one coordinate) and analysed with its choices and with others. Objects are "
             "rigid and paths smooth; real hands are at least as difficult.") +
         DrawFigure(rows) + DrawTable(rows);
}

}  // namespace

StudySection bias_study_section() { return {"bias", "Bias card", DrawBias}; }

}  // namespace graspbench
