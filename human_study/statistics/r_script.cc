#include "human_study/statistics/r_script.h"

#include "core/base/text/json.h"
#include "human_study/statistics/assets.h"

namespace graspbench {
namespace {

std::string QuoteForR(const std::string& text) {
  std::string quoted = "\"";
  for (char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter == '\n' ? ' ' : letter;
  }
  return quoted + "\"";
}

std::string FormatList(const std::vector<std::string>& texts) {
  std::string joined;
  for (const std::string& text : texts) joined += (joined.empty() ? "" : ", ") + QuoteForR(text);
  return joined.empty() ? std::string("character(0)") : "c(" + joined + ")";
}

std::string FormatNumbers(const std::vector<ScriptHypothesis>& hypotheses,
                          double ScriptHypothesis::*field) {
  std::string joined;
  for (const ScriptHypothesis& hypothesis : hypotheses) {
    const double value = hypothesis.*field;
    joined += (joined.empty() ? "" : ", ") + QuoteForR(hypothesis.measure) + " = " +
              (std::isnan(value) ? std::string("NA") : FormatJson(Json(value)));
  }
  return "c(" + (joined.empty() ? "none = NA" : joined) + ")";
}

}  // namespace

std::string FormatRScript(const MeasureTable& table,
                          const std::vector<ScriptHypothesis>& hypotheses) {
  std::vector<std::string> names, quantities, groups;
  std::string levels;
  for (const auto* list : {&table.factors, &table.groups}) {
    for (const Factor& factor : *list) {
      (list == &table.groups ? groups : names).push_back(factor.name);
      levels += std::string(levels.empty() ? "" : ",") + "\n  " + QuoteForR(factor.name) + " = " +
                FormatList(factor.levels);
    }
  }
  for (const Factor& factor : table.factors) {
    if (!factor.numbers.empty()) quantities.push_back(factor.name);
  }
  return "# Repeats the statistics of this study from tidy.csv. Run it in the folder it lies in:\n"
         "#   Rscript analysis.R\n"
         "# Base R does most of it; lme4 and lmerTest add the mixed models where they are "
         "installed.\n"
         "factors <- " +
         FormatList(names) + "\ngroups <- " + FormatList(groups) + "  # between persons\n" +
         "quantities <- " + FormatList(quantities) + "  # factors with numbers\n" +
         "levels_of <- list(" + levels + ")\nsession <- " + QuoteForR(kSessionColumn) +
         "\nsessions <- " + FormatList(table.sessions) +
         "\n# What is tested against, by measure.\nslope_of <- " +
         FormatNumbers(hypotheses, &ScriptHypothesis::slope) + "\nequal_within <- " +
         FormatNumbers(hypotheses, &ScriptHypothesis::equal_within) + "\n\n" +
         std::string(assets::kAnalysisR);
}

}  // namespace graspbench
