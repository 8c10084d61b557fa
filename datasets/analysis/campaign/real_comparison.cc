#include "datasets/analysis/campaign/real_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using ScenePlace = std::pair<size_t, int>;  ///< of a scene, and its variant

/** The contacts of the digits that the scene's grasp closes; empty when not all were measured. */
std::vector<DigitContact> FindGraspContacts(const RealTrial& trial, const CellSummary& cell) {
  std::vector<DigitContact> contacts;
  if (cell.records.empty()) return contacts;
  for (const DigitContact& simulated : cell.records.front()->result.contacts) {
    const auto found =
        std::find_if(trial.contacts.begin(), trial.contacts.end(),
                     [&](const DigitContact& contact) { return contact.digit == simulated.digit; });
    if (found == trial.contacts.end()) return {};
    contacts.push_back(simulated);
    contacts.back().time = found->time;
  }
  return contacts;
}

RealCell MakeCell(const SceneVariants& scene, Variant variant,
                  const std::vector<const RealTrial*>& trials) {
  RealCell cell;
  cell.scene = &scene;
  cell.variant = variant;
  const CellSummary& simulated = scene.cell(variant);
  for (const RealTrial* trial : trials) {
    ++cell.real.planned;
    if (trial->is_success) {
      cell.real.Count(Outcome::kSuccess);
    } else {
      ++cell.real.finished;  // why it failed is not known
    }
    const std::vector<DigitContact> contacts = FindGraspContacts(*trial, simulated);
    if (contacts.empty()) continue;
    const ContactTiming timing = CalcContactTiming(contacts, 0.0);
    if (timing.contact_before_start || std::isnan(timing.gft_ratio)) continue;
    cell.gft_ratios.push_back(timing.gft_ratio);
  }
  cell.success_p = CalcFisherExactTwoSided(cell.real.successes(), cell.real.finished,
                                           simulated.tally.successes(), simulated.tally.finished);
  return cell;
}

struct RealStep {
  const char* name;
  Variant before, after;
};
constexpr RealStep kRealSteps[] = {{"step 1", kStandardGrasp, kNewPreGrasp},
                                   {"step 2", kNewPreGrasp, kNewTarget},
                                   {"both steps", kStandardGrasp, kNewTarget}};

double CalcRealSuccess(const RealCell& cell) { return cell.real.rate(); }
double CalcRealGft(const RealCell& cell) { return cell.median_gft_ratio(); }

struct RealMeasure {
  const char* name;  ///< as in ListVariantMeasures
  double (*of_real)(const RealCell& cell);
};
constexpr RealMeasure kRealMeasures[] = {{"success", CalcRealSuccess}, {"GFT%", CalcRealGft}};

RealAgreement FindAgreement(const std::map<ScenePlace, RealCell>& cells, size_t num_scenes,
                            const RealStep& step, const RealMeasure& measure) {
  RealAgreement agreement;
  agreement.step = step.name;
  agreement.measure = measure.name;
  for (size_t scene = 0; scene < num_scenes; ++scene) {
    const auto before = cells.find({scene, step.before}), after = cells.find({scene, step.after});
    if (before == cells.end() || after == cells.end()) continue;
    const VariantMeasure& simulated = FindVariantMeasure(measure.name);
    const SceneVariants& variants = *before->second.scene;
    const double real = measure.of_real(after->second) - measure.of_real(before->second);
    const double change = CalcCellValue(simulated, variants.cell(step.after)) -
                          CalcCellValue(simulated, variants.cell(step.before));
    if (std::isnan(real * change) || real * change == 0.0) continue;
    ++agreement.num_scenes;
    agreement.num_alike += real * change > 0.0 ? 1 : 0;
  }
  agreement.share = CalcWilsonInterval(agreement.num_alike, agreement.num_scenes);
  return agreement;
}

}  // namespace

double RealCell::median_gft_ratio() const { return CalcMedian(gft_ratios); }

RealComparison CompareWithReal(const std::vector<RealTrial>& real,
                               const std::vector<SceneVariants>& scenes) {
  RealComparison comparison;
  std::map<ScenePlace, std::vector<const RealTrial*>> trials;
  for (const RealTrial& trial : real) {
    comparison.num_made_up += trial.is_made_up ? 1 : 0;
    const auto scene =
        std::find_if(scenes.begin(), scenes.end(), [&](const SceneVariants& candidate) {
          return candidate.hand == trial.hand && candidate.object == trial.object;
        });
    if (scene == scenes.end() || !scene->IsComplete()) {
      ++comparison.num_unmatched;
    } else {
      trials[{static_cast<size_t>(scene - scenes.begin()), trial.variant}].push_back(&trial);
    }
  }
  std::map<ScenePlace, RealCell> cells;
  for (const auto& [place, of_place] : trials) {
    cells[place] = MakeCell(scenes[place.first], static_cast<Variant>(place.second), of_place);
    comparison.cells.push_back(cells[place]);
  }
  const auto has_all_variants = [&](size_t scene) {
    return std::all_of(std::begin(kVariants), std::end(kVariants), [&](const VariantRow& variant) {
      return cells.count({scene, variant.value}) > 0;
    });
  };
  for (const VariantRow& variant : kVariants) {
    RealTotal total;
    total.variant = variant.value;
    for (const auto& [place, cell] : cells) {
      if (place.second != variant.value || !has_all_variants(place.first)) continue;
      ++total.num_scenes;
      AddTally(cell.real, total.real);
      AddTally(cell.scene->cell(variant.value).tally, total.simulated);
    }
    if (total.num_scenes > 0) comparison.totals.push_back(total);
  }
  for (const RealStep& step : kRealSteps) {
    for (const RealMeasure& measure : kRealMeasures) {
      comparison.agreements.push_back(FindAgreement(cells, scenes.size(), step, measure));
    }
  }
  return comparison;
}

}  // namespace graspbench
