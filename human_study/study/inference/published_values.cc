#include "human_study/study/inference/published_values.h"

#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

const std::vector<PublishedValue>& PublishedValueList() {
  static const std::vector<PublishedValue> values = {
      {"relative_reacceleration", false, "",
       "about 75 % of movement time, at every distance of the object",
       "Jeannerod 1984, J. Mot. Behav. 16:235-254"},
      {"reacceleration_to_peak_opening_s", false, "",
       "near 0: the hand begins to close when the low-velocity phase begins",
       "Jeannerod 1984, J. Mot. Behav. 16:235-254"},
      {"peak_opening_m", true, "_m",
       "thumb and index open by 0.82 m more per metre of size (review); 0.70 (SD 0.12) over 11 "
       "people and sticks of 50 to 110 mm",
       "Smeets and Brenner 1999, Motor Control 3:237-271; data of mocapGrip"},
      {"contact_to_lift_s", false, "", "about 200 ms",
       "Johansson and Westling 1984, Exp. Brain Res. 56:550-564"},
      {"contact_to_lift_s", true, "_kg", "above 0: heavier things are loaded for longer",
       "Johansson and Westling 1984, Exp. Brain Res. 56:550-564"},
  };
  return values;
}

std::vector<ComparedValue> ComparePublished(const StudyResult& result) {
  std::vector<ComparedValue> compared;
  if (result.CountKept() == 0) return compared;
  for (const PublishedValue& value : PublishedValueList()) {
    const TrialMeasure& measure = FindMeasure(value.measure);
    const MeasureTable table = MakeMeasureTable(result, measure);
    if (!value.is_slope) {
      compared.push_back({&value, &measure, SummariseRows(table), "", {}});
      continue;
    }
    for (size_t factor = 0; factor < table.factors.size(); ++factor) {
      const std::string& name = table.factors[factor].name;
      if (!EndsWith(name, value.unit_end)) continue;
      const Answer<std::vector<PersonPoint>> points = ListPoints(table, factor);
      if (!points) continue;
      compared.push_back(
          {&value, &measure, SummariseRows(table), name, CalcPersonSlopes(*points, 0.0)});
    }
  }
  return compared;
}

}  // namespace graspbench
