#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "reports/plots/svg_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

std::string NameRow(const Universe& universe) {
  return MakeWords(universe.opening) + ", " + FormatSignificant(universe.cutoff, 3) + " Hz";
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

/** States how far the choices move the measure and how often the test agrees. */
std::string DescribeVerdicts(const std::vector<Universe>& universes, const char* unit) {
  const UniverseSummary summary = SummariseUniverses(universes);
  std::string text;
  if (summary.num_values > 0) {
    text = "Its median lies between " + FormatWithUnit(summary.lowest, unit) + " and " +
           FormatWithUnit(summary.highest, unit) + ". ";
  }
  if (summary.num_tests > 0) {
    text += "p is below 0.05 in " + std::to_string(summary.num_significant) + " of " +
            FormatCount(summary.num_tests, "combination") + " with a test. ";
  }
  return text;
}

/** Detectors that found a value under some choice, and the others with their reasons. */
struct Detectors {
  std::vector<std::string> with_value;
  std::vector<std::string> without;
};

Detectors ListDetectors(const StudyResult& result) {
  std::vector<std::string> all, with_value;
  for (const Universe& universe : result.universes) {
    FindPlace(all, universe.detector);
    if (universe.summary) FindPlace(with_value, universe.detector);
  }
  Detectors detectors;
  for (const std::string& id : all) {
    const bool has_value = std::find(with_value.begin(), with_value.end(), id) != with_value.end();
    if (has_value) {
      detectors.with_value.push_back(id);
    } else {
      const ContactDetector& detector = ContactDetectorList()[FindContactDetector(id)];
      detectors.without.push_back(id + " (needs " + detector.needs + ")");
    }
  }
  return detectors;
}

/** Maps the universes of one onset rule: opening and cut-off in rows, detectors in columns. */
HeatMap MakeMap(const StudyResult& result, const std::string& onset,
                const std::vector<std::string>& detectors) {
  const TrialMeasure& measure = FindMeasure(result.study.config.multiverse.measure);
  HeatMap map;
  map.text.title = "Main test under every choice, onset by " + onset;
  map.text.description = std::string(measure.name) + " by opening, cut-off and detector.";
  map.columns = detectors;
  for (const Universe& universe : result.universes) FindPlace(map.rows, NameRow(universe));
  map.cells.resize(map.rows.size() * map.columns.size());
  for (const Universe& universe : result.universes) {
    const auto column = std::find(detectors.begin(), detectors.end(), universe.detector);
    if (universe.onset != onset || column == detectors.end()) continue;
    const size_t row = FindPlace(map.rows, NameRow(universe));
    map.cells[row * map.columns.size() + static_cast<size_t>(column - detectors.begin())] =
        MakeCell(universe, measure.unit);
  }
  return map;
}

bool HaveSameNumbers(const HeatMap& a, const HeatMap& b) {
  return std::equal(a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end(),
                    [](const auto& x, const auto& y) { return x.hint == y.hint; });
}

/** Draws a map for each onset rule; rules whose map equals the first one are only named. */
Html DrawMaps(const StudyResult& result, const std::vector<std::string>& detectors) {
  std::vector<std::string> onsets;
  for (const Universe& universe : result.universes) FindPlace(onsets, universe.onset);
  const HeatMap own = MakeMap(result, onsets.front(), detectors);
  Html html;
  std::string alike = onsets.front();
  for (size_t i = 1; i < onsets.size(); ++i) {
    const HeatMap map = MakeMap(result, onsets[i], detectors);
    if (HaveSameNumbers(own, map)) {
      alike += " or " + onsets[i];
    } else {
      html += MakeParagraph("Onset by " + MakeWords(onsets[i]) + ":") +
              MakeScroll(map.text.title, DrawHeatMap(map));
    }
  }
  return MakeParagraph("Onset by " + MakeWords(alike) +
                       (alike == onsets.front() ? ":" : " (the same to the digits shown):")) +
         MakeScroll(own.text.title, DrawHeatMap(own)) + html;
}

Html DrawMultiverse(const StudyPageData& data) {
  const StudyResult& result = data.result;
  if (result.universes.empty()) return MakeParagraph("No trial counts.");
  const TrialMeasure& measure = FindMeasure(result.study.config.multiverse.measure);
  const bool has_test = std::any_of(result.universes.begin(), result.universes.end(),
                                    [](const Universe& u) { return u.test.has_value(); });
  const std::string what =
      has_test
          ? "p of the effect of " +
                NameOfFactor(
                    (result.study.factors.empty() ? result.study.groups : result.study.factors)
                        .front()
                        .name) +
                " (Greenhouse-Geisser); the shade is partial eta squared."
          : "Medians, because no test is possible: " + result.universes.front().test.reason() + ".";
  const Detectors detectors = ListDetectors(result);
  std::string without;
  for (const std::string& detector : detectors.without) {
    without += (without.empty() ? "" : ", ") + detector;
  }
  if (detectors.with_value.empty()) return MakeParagraph("No combination gives a value.");
  return MakeParagraph("Every threshold is a choice. The table shows the main measure, " +
                       std::string(measure.name) +
                       ", under each combination of onset rule, measure of opening, cut-off of the "
                       "contact detectors (rows) and detector (columns). " +
                       DescribeVerdicts(result.universes, measure.unit) +
                       (without.empty() ? "" : "Without a value in any trial: " + without + ".")) +
         MakeFigure(what + " \u25B6 marks the study's own choices.",
                    "whether the answer depends on one choice.",
                    DrawMaps(result, detectors.with_value));
}

}  // namespace

StudySection multiverse_study_section() { return {"multiverse", "Multiverse", DrawMultiverse}; }

}  // namespace graspbench
