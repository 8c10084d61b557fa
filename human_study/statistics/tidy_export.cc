#include "human_study/statistics/tidy_export.h"

#include <algorithm>

#include "core/base/csv.h"
#include "core/base/files.h"

namespace graspbench {
namespace {

struct TidyRow {
  const MeasureTable* table;
  const Observation* trial;
};

std::vector<TidyRow> ListRows(const std::vector<MeasureTable>& measures) {
  std::vector<TidyRow> rows;
  for (const MeasureTable& table : measures) {
    for (const Observation& trial : table.rows) rows.push_back({&table, &trial});
  }
  return rows;
}

using Column = CsvColumn<TidyRow>;

std::vector<Column> ListColumns(const std::vector<Factor>& factors) {
  std::vector<Column> columns = {{"person", "string", "", "who reached",
                                  [](const TidyRow& row) { return Json(row.trial->person); }},
                                 {"trial", "string", "", "which of the person's trials",
                                  [](const TidyRow& row) { return Json(row.trial->trial); }}};
  for (size_t i = 0; i < factors.size(); ++i) {
    const Factor& factor = factors[i];
    columns.push_back(
        {factor.name, "string", "",
         factor.description.empty() ? "varied within each person" : factor.description,
         [i](const TidyRow& row) { return Json(row.trial->levels[i]); }});
    if (factor.numbers.empty()) continue;
    columns.push_back(
        {factor.name + "_number", "number", "",
         "the level of \"" + factor.name + "\" as a quantity, in SI units",
         [i](const TidyRow& row) {
           const Factor& own = row.table->factors[i];
           const auto level = std::find(own.levels.begin(), own.levels.end(), row.trial->levels[i]);
           return JsonNumber(own.numbers[static_cast<size_t>(level - own.levels.begin())]);
         }});
  }
  columns.push_back({"measure", "string", "", "what was measured",
                     [](const TidyRow& row) { return Json(row.table->measure); }});
  columns.push_back({"value", "number", "", "of the measure in this trial, in the measure's unit",
                     [](const TidyRow& row) { return JsonNumber(row.trial->value); }});
  return columns;
}

std::string QuoteForR(const std::string& text) {
  std::string quoted = "\"";
  for (char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter == '\n' ? ' ' : letter;
  }
  return quoted + "\"";
}

void CheckMeasures(const std::vector<MeasureTable>& measures) {
  const std::vector<Column> columns = ListColumns(measures.front().factors);
  for (auto column = columns.begin(); column != columns.end(); ++column) {
    const auto has_name = [&](const Column& other) { return other.name == column->name; };
    if (std::any_of(columns.begin(), column, has_name)) {
      throw Error(ErrorKind::kFormat,
                  "tidy.csv would have two columns \"" + column->name + "\"; rename the factor");
    }
  }
  for (const MeasureTable& table : measures) {
    const auto is_same = [](const Factor& a, const Factor& b) {
      return a.name == b.name && a.levels == b.levels && a.numbers == b.numbers;
    };
    const auto& first = measures.front();
    if (!std::equal(table.factors.begin(), table.factors.end(), first.factors.begin(),
                    first.factors.end(), is_same)) {
      throw Error(ErrorKind::kFormat, "measures \"" + first.measure + "\" and \"" + table.measure +
                                          "\" have different factors; export them apart");
    }
    for (const Observation& row : table.rows) {
      const Answer<size_t> cell = FindCell(table.factors, row);
      if (!cell)
        throw Error(ErrorKind::kFormat, "measure \"" + table.measure + "\": " + cell.reason());
    }
  }
}

std::string FormatDictionary(const std::vector<MeasureTable>& measures) {
  Json schema = MakeTableSchema(ListColumns(measures.front().factors), "");
  for (Json& field : schema["fields"]) {
    for (const Factor& factor : measures.front().factors) {
      if (field["name"] == factor.name) field["constraints"]["enum"] = factor.levels;
    }
  }
  for (const MeasureTable& table : measures) {
    schema["measures"].push_back(
        {{"name", table.measure}, {"unit", table.unit}, {"description", table.description}});
  }
  return FormatJson(schema, 2) + "\n";
}

/** Everything that does not depend on the study. */
constexpr char kRBody[] = R"R(
d <- read.csv("tidy.csv", check.names = FALSE, na.strings = "",
              colClasses = c(person = "character", trial = "character", measure = "character",
                             setNames(rep("character", length(factors)), factors)))
for (f in factors) d[[f]] <- factor(d[[f]], levels = levels_of[[f]])
quoted <- function(names) paste0("`", gsub("([`\\\\])", "\\\\\\1", names), "`")
options(digits = 10)

for (m in unique(d$measure)) {
  cat("\n==== ", m, " ====\n", sep = "")
  trials <- d[d$measure == m & !is.na(d$value), ]

  # Mean of each person in each condition; persons with an empty condition are left out.
  cell <- interaction(trials[factors], sep = ", ", lex.order = TRUE)
  y <- tapply(trials$value, list(trials$person, cell), mean)
  left_out <- rownames(y)[!complete.cases(y)]
  if (length(left_out) > 0) cat("left out:", paste(left_out, collapse = ", "), "\n")
  y <- y[complete.cases(y), , drop = FALSE]
  if (nrow(y) < 2 || ncol(y) < 2) { cat("too few persons or conditions\n"); next }
  print(rbind(mean = colMeans(y), sd = apply(y, 2, sd)))

  # Repeated-measures analysis of variance with sphericity and both corrections.
  design <- rev(expand.grid(rev(levels_of[factors])))
  fit <- lm(y ~ 1)
  for (k in seq_along(factors)) for (effect in combn(factors, k, simplify = FALSE)) {
    inner <- reformulate(paste(quoted(effect), collapse = "*"))
    outer <- if (k == 1) ~1 else
      reformulate(combn(effect, k - 1, function(part) paste(quoted(part), collapse = "*")))
    contrasts <- prod(sapply(levels_of[effect], length) - 1)
    cat("\n-- ", paste(effect, collapse = " x "), " --\n", sep = "")
    print(try(anova(fit, M = inner, X = outer, idata = design, test = "Spherical")))
    if (contrasts > 1 && nrow(y) > contrasts)
      print(try(mauchly.test(fit, M = inner, X = outer, idata = design)))
  }
  if (requireNamespace("afex", quietly = TRUE)) {
    long <- aggregate(trials["value"], trials[c("person", factors)], mean)
    long <- long[long$person %in% rownames(y), ]
    print(try(afex::aov_ez("person", "value", long, within = factors,
                           anova_table = list(es = c("ges", "pes")))))
  }

  # All pairs of conditions (Holm), and ranks.
  cells <- factor(rep(colnames(y), each = nrow(y)), levels = colnames(y))
  print(try(pairwise.t.test(as.vector(y), cells, paired = TRUE, p.adjust.method = "holm")))
  print(try(friedman.test(y)))

  # A line for each person, and the mixed model over all trials.
  for (f in quantities) {
    trials$x <- trials[[paste0(f, "_number")]]
    slopes <- sapply(split(trials, trials$person), function(own)
      if (length(unique(own$x)) > 1) coef(lm(value ~ x, own))[["x"]] else NA)
    cat("\n-- slope over ", f, " --\n", sep = "")
    print(slopes)
    print(try(t.test(slopes)))
    if (requireNamespace("lme4", quietly = TRUE)) {
      lmer <- if (requireNamespace("lmerTest", quietly = TRUE)) lmerTest::lmer else lme4::lmer
      # The default optimiser stops after three or four digits.
      exact <- lme4::lmerControl(optimizer = "bobyqa", optCtrl = list(rhoend = 1e-12))
      print(try(summary(lmer(value ~ x + (x | person), trials, control = exact))))
    }
  }
}
)R";

std::string FormatRScript(const std::vector<Factor>& factors) {
  const auto list = [](const std::vector<std::string>& texts) {
    std::string joined;
    for (const std::string& text : texts) joined += (joined.empty() ? "" : ", ") + QuoteForR(text);
    return joined.empty() ? std::string("character(0)") : "c(" + joined + ")";
  };
  std::vector<std::string> names, quantities;
  std::string levels;
  for (const Factor& factor : factors) {
    names.push_back(factor.name);
    if (!factor.numbers.empty()) quantities.push_back(factor.name);
    levels += std::string(levels.empty() ? "" : ",") + "\n  " + QuoteForR(factor.name) + " = " +
              list(factor.levels);
  }
  return "# Repeats the statistics of this study from tidy.csv. Run it in the folder it lies in:\n"
         "#   Rscript analysis.R\n"
         "# Base R is enough; afex, lme4 and lmerTest add their parts where they are installed.\n"
         "factors <- " +
         list(names) + "\n" +                                                  //
         "quantities <- " + list(quantities) + "  # factors with numbers\n" +  //
         "levels_of <- list(" + levels + ")\n" + kRBody;
}

}  // namespace

TidyExport FormatTidyExport(const std::vector<MeasureTable>& measures) {
  if (measures.empty()) throw Error(ErrorKind::kFormat, "no measure to export");
  CheckMeasures(measures);
  return {FormatCsv(ListColumns(measures.front().factors), ListRows(measures)),
          FormatDictionary(measures), FormatRScript(measures.front().factors)};
}

void SaveTidyExport(const std::vector<MeasureTable>& measures,
                    const std::filesystem::path& folder) {
  const TidyExport files = FormatTidyExport(measures);
  MakeFolder(folder);
  WriteFileAtomically(folder / "tidy.csv", files.csv);
  WriteFileAtomically(folder / "tidy.json", files.dictionary);
  WriteFileAtomically(folder / "analysis.R", files.r_script);
}

}  // namespace graspbench
