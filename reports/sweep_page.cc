#include <algorithm>
#include <cmath>

#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/base/version.h"
#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"
#include "reports/plots/svg_plot.h"

namespace graspbench {
namespace {

struct SweepView {
  const Session& session;
  const SweepSummary& summary;
};

std::string NameCondition(const std::string& name) { return name.empty() ? "base" : name; }

/** Summarises a hand: "tum: base 75 %, lowest 25 % (..); success changes with ..". */
std::string DescribeHand(const SweepSummary& summary, const std::string& hand) {
  const ConditionRow* base = nullptr;
  const ConditionRow* lowest = nullptr;
  const ConditionRow* highest = nullptr;
  for (const ConditionRow& row : summary.rows) {
    if (row.hand != hand || row.num_finished == 0) continue;
    if (row.name.empty()) base = &row;
    if (!lowest || row.medians[0] < lowest->medians[0]) lowest = &row;
    if (!highest || row.medians[0] > highest->medians[0]) highest = &row;
  }
  if (!lowest) return hand + ": no trial is finished.";
  const auto name = [](const ConditionRow& row) {
    return FormatFixed(100.0 * row.medians[0], 1) + " % (" + NameCondition(row.name) + ")";
  };
  std::string text = hand + ": success from " + name(*lowest) + " to " + name(*highest);
  if (base && base != lowest && base != highest) text += ", " + name(*base);
  int num_effects = 0;
  std::string changed;
  for (const SweepEffect& effect : summary.effects) {
    if (effect.hand != hand || effect.measure != ListSweepMeasures()[0].id) continue;
    ++num_effects;
    if (!effect.excludes_zero()) continue;
    changed += (changed.empty() ? "" : ", ") + effect.factors[0] + "=" + effect.levels[0] + " by " +
               FormatFixed(100.0 * effect.change.estimate, 1) + " points";
  }
  if (num_effects == 0) return text + ".";
  return text + (changed.empty() ? "; no factor level changes success significantly."
                                 : "; changed by " + changed + " (95 % intervals exclude 0).");
}

Html DrawConditions(const SweepView& view) {
  return MakeTable("Results by condition; success is a rate, other columns are medians.",
                   ShowConditions(view.summary));
}

/** "10 pairs of 5 objects, 3 not finished". */
std::string CountDraws(const SweepEffect& effect) {
  return FormatCount(effect.change.num_draws, "pair") + " of " +
         FormatCount(effect.change.num_objects, "object") +
         (effect.num_left_out == 0 ? "" : "; left out " + effect.why_left_out);
}

/** Plots the effects on one measure and hand, one row per level; empty if no effect has a value. */
Html DrawEffectPlot(const SweepSummary& summary, const std::string& hand,
                    const SweepMeasure& measure) {
  IntervalPlot plot;
  plot.text.title = "Change of " + std::string(measure.label) + " by each level, " + hand;
  plot.text.description = "Mean changes with 95 % intervals, one row per level.";
  plot.axis = measure.threshold ? "change of the " + std::string(measure.label) + " [doublings]"
              : measure.scale == 100.0 ? "change [percentage points]"
                                       : "change of " + std::string(measure.label);
  for (const SweepEffect& effect : summary.effects) {
    if (effect.hand != hand || effect.measure != measure.id) continue;
    const ChangeEstimate& change = effect.change;
    const Interval interval = change.interval ? *change.interval : Interval{kUnset, kUnset};
    IntervalPlot::Row row;
    row.label = FormatSetting(NameEffect(effect));
    row.value = measure.scale * change.estimate;
    row.low = measure.scale * interval.low;
    row.high = measure.scale * interval.high;
    if (change.num_draws > 0) {
      row.text = FormatChange(measure, change.estimate) +
                 (change.interval ? " (" + FormatChangeInterval(measure, interval) + ")" : "") +
                 ", ";
    }
    row.text += CountDraws(effect);
    plot.rows.push_back(row);
  }
  if (plot.rows.empty()) return {};
  return MakeFigure(plot.text.title + ", relative to the base level, on the same draws.",
                    "intervals that exclude 0. A row without an interval is not testable; the "
                    "table gives the reason.",
                    MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

/** Returns the condition with these levels of the first factors and base levels of the others, or
null. */
const ConditionRow* FindRowAt(const SweepSummary& summary, const std::string& hand,
                              std::vector<std::string> levels) {
  for (size_t i = levels.size(); i < summary.factors.size(); ++i) {
    levels.push_back(summary.factors[i].levels.front());
  }
  const auto found = std::find_if(
      summary.rows.begin(), summary.rows.end(),
      [&](const ConditionRow& row) { return row.hand == hand && row.levels == levels; });
  return found == summary.rows.end() ? nullptr : &*found;
}

/** Range of the shades. It covers the measure's values in all maps of a hand; for success it is 0
to 1. */
struct ShadeRange {
  double low = 0.0, high = 1.0;
  double CalcShade(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

ShadeRange FindRange(const SweepSummary& summary, const std::string& hand, size_t measure) {
  ShadeRange range;
  if (measure == 0) return range;
  bool is_first = true;
  for (const ConditionRow& row : summary.rows) {
    const double value = row.medians[measure];
    if (row.hand != hand || !std::isfinite(value)) continue;
    range.low = is_first ? value : std::min(range.low, value);
    range.high = is_first ? value : std::max(range.high, value);
    is_first = false;
  }
  return range;
}

Html DrawMap(const SweepSummary& summary, const std::string& hand, size_t measure,
             const std::string& third) {
  const SweepMeasure& shown = ListSweepMeasures()[measure];
  const ShadeRange range = FindRange(summary, hand, measure);
  HeatMap map;
  map.text.title = std::string(shown.label) + ", " + hand +
                   (third.empty() ? "" : ", " + summary.factors[2].key + "=" + third);
  map.text.description = "A table with " + summary.factors[0].key + " in rows and " +
                         summary.factors[1].key + " in columns.";
  for (const std::string& column : summary.factors[1].levels) {
    map.columns.push_back(FormatSetting(column));
    map.groups.push_back(summary.factors[1].key);
  }
  bool has_any = false;
  for (const std::string& level : summary.factors[0].levels) {
    map.rows.push_back(FormatSetting(summary.factors[0].key + "=" + level));
    for (const std::string& column : summary.factors[1].levels) {
      std::vector<std::string> levels = {level, column};
      if (!third.empty()) levels.push_back(third);
      HeatMap::Cell cell;
      if (const ConditionRow* row = FindRowAt(summary, hand, levels)) {
        const double value = row->medians[measure];
        has_any = has_any || std::isfinite(value);
        cell.rate = std::isfinite(value) ? range.CalcShade(value) : kUnset;
        cell.text = FormatValue(shown, value);
        cell.hint = NameCondition(row->name) + ": " + cell.text + ", " +
                    std::to_string(row->num_successes) + " of " +
                    FormatCount(row->num_finished, "trial") + " succeed";
      }
      map.cells.push_back(cell);
    }
  }
  return has_any ? DrawHeatMap(map) : Html();
}

Html DrawMaps(const SweepView& view) {
  const SweepSummary& summary = view.summary;
  if (summary.factors.size() < 2) {
    return MakeParagraph("A map needs two factors; this sweep has one.");
  }
  std::vector<std::string> thirds = {""};
  if (summary.factors.size() >= 3) thirds = summary.factors[2].levels;
  Html content;
  for (const std::string& hand : summary.hands) {
    for (size_t measure = 0; measure < ListSweepMeasures().size(); ++measure) {
      Html maps;
      for (const std::string& third : thirds) maps += DrawMap(summary, hand, measure, third);
      if (maps.empty()) continue;
      const std::string label = std::string(ListSweepMeasures()[measure].label) + ", " + hand;
      content += MakeFigure(
          label + ": " + summary.factors[0].key + " by " + summary.factors[1].key +
              (summary.factors.size() >= 3 ? ", a map for each level of " + summary.factors[2].key
                                           : "") +
              (summary.factors.size() > 3 ? "; all other factors at their base level" : "") +
              ". Success is a rate, the rest are medians over the trials that have a value.",
          "rows or columns that change together; a deviating corner is an interaction.",
          MakeScroll(label, maps));
    }
  }
  return content;
}

Html DrawEffects(const SweepView& view) {
  const std::vector<SweepMeasure>& measures = ListSweepMeasures();
  Html content, others;
  for (const std::string& hand : view.summary.hands) {
    content += Element("p", {{"class", "verdict"}}, DescribeHand(view.summary, hand)) +
               DrawEffectPlot(view.summary, hand, measures.front());
    for (size_t i = 1; i < measures.size(); ++i) {
      others += DrawEffectPlot(view.summary, hand, measures[i]);
    }
  }
  if (!others.empty()) content += MakeDetails("Changes of the other measures", others);
  return content + MakeTable(
                       "Effect of each level: means over draws with 95 % intervals. One interval "
                       "in twenty excludes 0 by chance.",
                       ShowEffects(view.summary.effects));
}

Html DrawInteractions(const SweepView& view) {
  const std::vector<SweepEffect>& all = view.summary.interactions;
  if (all.empty()) {
    return MakeParagraph(
        "No two factors of the design change both alone and together, so interactions are not "
        "testable.");
  }
  const std::vector<SweepEffect> named = view.summary.FindInteractions();
  const Html list =
      MakeDetails("All " + FormatCount(static_cast<int>(all.size()), "interaction"),
                  MakeTable("Interactions: effect of two levels beyond the sum of their effects.",
                            ShowEffects(all)));
  if (named.empty()) {
    return MakeParagraph("There is no significant interaction (95 % CI).") + list;
  }
  return MakeTable("Significant interactions (95 % CI excludes 0).", ShowEffects(named)) + list;
}

Html DrawSweepThresholds(const SweepView& view) {
  if (view.summary.thresholds.empty()) {
    return Element("p", {},
                   Text("Grip thresholds were not determined; ") +
                       Element("code", {}, "graspbench threshold") +
                       Text(" with the folder of the sweep adds them."));
  }
  return MakeParagraph(
             "The smallest grip with which each draw succeeds, by bisection. Medians are listed "
             "with the conditions, ratios with the effects. A draw that no grip holds counts there "
             "as one step above the largest grip.") +
         MakeTable("Grip thresholds of the draws under each condition.",
                   ShowThresholds(view.summary));
}

Html DrawSweepFindings(const SweepView& view) {
  std::vector<std::string> findings;
  for (const Diagnostic& entry : view.session.findings.entries()) findings.push_back(entry.text);
  for (const ConditionRow& row : view.summary.rows) {
    const std::string name = NameCondition(row.name) + ", " + row.hand;
    if (row.num_numerical > 0) {
      findings.push_back(name + ": " + FormatCount(row.num_numerical, "trial") +
                         " failed numerically; numerical failures count as failures of the grasp.");
    }
    if (!row.undecided.empty()) findings.push_back(name + ": " + row.undecided + ".");
  }
  return findings.empty() ? MakeParagraph("No errors and no warnings.") : MakeList(findings);
}

Html DrawSweepMethods(const SweepView& view) {
  std::string factors;
  for (const SweepFactor& factor : view.summary.factors) {
    factors += (factors.empty() ? "" : "; ") + factor.key + " (";
    for (size_t i = 0; i < factor.levels.size(); ++i) {
      factors += (i > 0 ? ", " : "") + factor.levels[i];
    }
    factors += ")";
  }
  return MakeMethodsText(
      {"Grasps were simulated with graspbench " + std::string(program_version()) + " under " +
       FormatCount(static_cast<int>(view.session.config.conditions.size()) + 1, "condition") +
       " of the factors " + factors +
       ", base level first. All conditions have the same draws of object pose and joint errors. " +
       (ChoosesGraspAgain(view.session.config.conditions.front())
            ? "Best grasps were chosen under each condition. "
            : "Best grasps were chosen at the base levels. ") +
       "Effects are mean differences over draws between conditions that differ in one factor only "
       "(or, if the design has none, between means over conditions). Interactions are differences "
       "of such differences. 95 % intervals are BCa bootstrap intervals that resample objects."});
}

}  // namespace

std::string MakeSweepPage(const Session& session, const SweepSummary& summary) {
  static const std::vector<PageSection<SweepView>> sections = {
      {"effects", "Effect of each level", &DrawEffects},
      {"conditions", "Conditions", &DrawConditions},
      {"maps", "Maps", &DrawMaps},
      {"interactions", "Interactions", &DrawInteractions},
      {"thresholds", "Grip thresholds", &DrawSweepThresholds},
      {"findings", "Errors and warnings", &DrawSweepFindings},
      {"methods", "Methods", &DrawSweepMethods}};
  const std::string trials = std::to_string(session.records.size()) + " of " +
                             FormatCount(static_cast<int>(session.plan.size()), "planned trial") +
                             " finished";
  PageFrame frame = {
      "Sweep",
      FormatCount(static_cast<int>(summary.factors.size()), "factor") + ", " +
          FormatCount(static_cast<int>(session.config.conditions.size()) + 1, "condition") + ", " +
          trials + DescribeDamage(session.damage) + DescribePhysics(session.physics_version)};
  frame.commands = {"graspbench run DIR/session.json --out ANOTHER", "graspbench report DIR"};
  frame.facts = {{"Seed", std::to_string(session.config.seed)},
                 {"Trials", trials},
                 {"Hash of the configuration", CalcHashHex(FormatJson(ToJson(session.config)))}};
  frame.references = {"roethling2007", "sherman2011", "efron1987"};
  return MakeSectionedPage(frame, sections, SweepView{session, summary});
}

}  // namespace graspbench
