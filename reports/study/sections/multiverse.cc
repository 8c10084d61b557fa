#include <algorithm>
#include <cmath>

#include "reports/format.h"
#include "reports/study/study_format.h"
#include "reports/study/study_section.h"
#include "reports/svg_plot.h"

namespace graspbench {
namespace {

std::string NameRow(const Universe& universe) {
  return universe.opening + ", " + FormatSignificant(universe.cutoff, 3) + " Hz";
}

size_t FindPlace(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  const auto place = static_cast<size_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return place;
}

HeatMap::Cell MakeCell(const Universe& universe, const char* unit) {
  HeatMap::Cell cell;
  cell.rate = std::nan("");
  if (!universe.summary) {
    cell.text = "no value";
    cell.hint = universe.summary.reason();
    return cell;
  }
  const std::string median = FormatWithUnit(universe.summary->median, unit);
  cell.hint = "median " + median + " over " + FormatCount(universe.summary->count, "trial");
  if (universe.test) {
    cell.rate = universe.test->partial_eta_squared;
    cell.text = "p " + FormatP(universe.test->greenhouse_geisser.p);
    cell.hint += ", F = " + FormatFixed(universe.test->f, 2) + ", partial eta squared " +
                 FormatFixed(cell.rate, 2);
  } else {
    cell.text = median;
    cell.hint += "; no test: " + universe.test.reason();
  }
  if (universe.is_own) cell.text = "\u25B6 " + cell.text;
  return cell;
}

/** In how many combinations the test says the same. */
std::string DescribeVerdicts(const std::vector<Universe>& universes) {
  int num_tests = 0, num_significant = 0, num_without = 0;
  double lowest = std::nan(""), highest = std::nan("");
  for (const Universe& universe : universes) {
    if (!universe.summary) {
      ++num_without;
      continue;
    }
    lowest = std::fmin(lowest, universe.summary->median);
    highest = std::fmax(highest, universe.summary->median);
    if (!universe.test) continue;
    ++num_tests;
    num_significant += universe.test->greenhouse_geisser.p < 0.05;
  }
  std::string text;
  if (num_tests > 0) {
    text = "p is below 0.05 in " + std::to_string(num_significant) + " of " +
           FormatCount(num_tests, "combination") + " with a test. ";
  }
  if (num_without > 0) {
    text += FormatCount(num_without, "combination") + " found no value in any trial.";
  }
  return text;
}

/** The universes of one onset rule: opening and cut-off down, detectors across. */
Html DrawMap(const StudyResult& result, const std::string& onset, const TrialMeasure& measure) {
  HeatMap map;
  map.text.title = "The main test under every choice, onset by " + onset;
  map.text.description = std::string(measure.name) + " by opening, cut-off and detector.";
  for (const Universe& universe : result.universes) {
    FindPlace(map.rows, NameRow(universe));
    FindPlace(map.columns, universe.detector);
  }
  map.cells.resize(map.rows.size() * map.columns.size());
  for (const Universe& universe : result.universes) {
    if (universe.onset != onset) continue;
    const size_t row = FindPlace(map.rows, NameRow(universe));
    const size_t column = FindPlace(map.columns, universe.detector);
    map.cells[row * map.columns.size() + column] = MakeCell(universe, measure.unit);
  }
  return MakeParagraph("Onset by " + onset + ":") + MakeScroll(map.text.title, DrawHeatMap(map));
}

Html Draw(const StudyPageData& data) {
  const StudyResult& result = data.result;
  if (result.universes.empty()) return MakeParagraph("No trial counts.");
  const TrialMeasure& measure = FindMeasure(result.study.config.multiverse.measure);
  const bool has_test = std::any_of(result.universes.begin(), result.universes.end(),
                                    [](const Universe& u) { return u.test.has_value(); });
  const std::string what =
      has_test
          ? "p of the effect of " + result.study.factors.front().name +
                " (Greenhouse-Geisser); the shade is partial eta squared."
          : "Medians, because there is no test: " + result.universes.front().test.reason() + ".";
  std::vector<std::string> onsets;
  Html maps;
  for (const Universe& universe : result.universes) {
    const size_t num_known = onsets.size();
    if (FindPlace(onsets, universe.onset) == num_known) {
      maps += DrawMap(result, universe.onset, measure);
    }
  }
  return MakeParagraph("Every threshold is a choice. The main measure, " +
                       std::string(measure.name) +
                       ", under each combination of onset rule, measure of opening, cut-off of the "
                       "contact detectors (rows) and detector (columns). " +
                       DescribeVerdicts(result.universes)) +
         MakeFigure(what + " \u25B6 marks the study's own choices.",
                    "whether the answer hangs on one choice.", maps);
}

}  // namespace

StudySection multiverse_study_section() { return {"multiverse", "Multiverse", Draw}; }

}  // namespace graspbench
