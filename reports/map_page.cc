#include <algorithm>
#include <cmath>

#include "core/base/enum_table.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/base/version.h"
#include "datasets/analysis/map/simultaneity_map.h"
#include "datasets/plan/scene_names.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "reports/plots/svg_plot.h"

namespace graspbench {
namespace {

struct MapView {
  const Session& session;
  const MapResult& result;
};

/** One plane of a map: the results of one part for one measure, hand and late digit. */
struct Plane {
  const MapPartResult& part;
  const MapMeasureRow& measure;
  std::string hand;
  LateDigit late;

  std::string Name() const {
    return hand + ", late " + NameLateDigit(late) + " digit: " + measure.label;
  }
};

std::vector<Plane> ListPlanes(const MapResult& result) {
  std::vector<Plane> planes;
  for (const MapPartResult& part : result.parts) {
    for (const MapMeasureRow& measure : kMapMeasures) {
      // Success and push are measured in every trial, so only the first part, with the most trials,
      // shows them.
      const bool is_general =
          measure.value == MapMeasure::kSuccess || measure.value == MapMeasure::kPush;
      if (is_general && &part != &result.parts.front()) continue;
      for (const std::string& hand : part.map.hands) {
        for (const LateDigit late : {LateDigit::kLast, LateDigit::kFirst}) {
          if (FindCell(part.map, measure.value, hand, late, {})) {
            planes.push_back({part, measure, hand, late});
          }
        }
      }
    }
  }
  return planes;
}

bool ExcludesZero(const MapCell& cell) {
  return cell.interval && (cell.interval->low > 0.0 || cell.interval->high < 0.0);
}

double FindLargestEffect(const Plane& plane) {
  double largest = 0.0;
  for (const MapCell& cell : plane.part.map.cells) {
    if (cell.measure != plane.measure.value || cell.hand != plane.hand) continue;
    if (cell.late == plane.late && ExcludesZero(cell)) {
      largest = std::max(largest, std::abs(cell.estimate));
    }
  }
  return largest;
}

HeatMap::Cell DrawCell(const Plane& plane, const std::vector<MapLevel>& where, double largest) {
  const MapCell* const cell =
      FindCell(plane.part.map, plane.measure.value, plane.hand, plane.late, where);
  HeatMap::Cell drawn;
  if (!cell || cell->num_pairs == 0) return drawn;
  drawn.text = FormatFixed(plane.measure.scale * cell->estimate, plane.measure.decimals);
  drawn.hint = NameWhere(plane.part.map, *cell) + ": " + FormatEffect(*cell) + ", " +
               std::to_string(cell->num_pairs) + " pairs of " +
               FormatCount(cell->num_objects, "object") + ", " +
               RowOf(kMapVerdicts, cell->verdict).name;
  const double cost = plane.measure.harm * cell->estimate;
  drawn.is_gain = cost < 0.0;
  drawn.rate = ExcludesZero(*cell) ? std::abs(cost) / largest : kUnset;
  return drawn;
}

Html DrawPlane(const Plane& plane) {
  const SimultaneityMap& map = plane.part.map;
  std::vector<MapLevel> levels;
  HeatMap drawn;
  drawn.text.title = plane.Name();
  drawn.text.description = "A table of levels: each alone, and with each level of later factors.";
  drawn.columns.emplace_back("alone");
  drawn.groups.emplace_back();
  for (size_t factor = 0; factor < map.factors.size(); ++factor) {
    for (size_t level = 0; level < map.factors[factor].levels.size(); ++level) {
      const MapCell* const alone =
          FindCell(map, plane.measure.value, plane.hand, plane.late, {{factor, level}});
      if (!alone || alone->num_pairs == 0) continue;
      levels.push_back({factor, level});
      drawn.rows.push_back(map.factors[factor].name + " " + map.factors[factor].levels[level]);
      if (factor == 0) continue;  // every level occurs once with each level of another factor
      drawn.columns.push_back(map.factors[factor].levels[level]);
      drawn.groups.push_back(map.factors[factor].name);
    }
  }
  const double largest = FindLargestEffect(plane);
  for (const MapLevel& row : levels) {
    drawn.cells.push_back(DrawCell(plane, {row}, largest));
    for (const MapLevel& column : levels) {
      if (column.factor == 0) continue;
      drawn.cells.push_back(row.factor < column.factor ? DrawCell(plane, {row, column}, largest)
                                                       : HeatMap::Cell());
    }
  }
  return MakeFigure(plane.Name() + ". Hatched: the 95 % interval includes 0.",
                    "shaded rows or columns: factors under which a delay has an effect; blue is a "
                    "loss, ochre a gain, darker is more.",
                    MakeScroll(plane.Name(), DrawHeatMap(drawn)));
}

Html DrawFindings(const MapView& view) {
  Html content = MakeList(view.result.findings());
  for (const Diagnostic& entry : view.session.findings.entries()) {
    content += MakeParagraph(entry.text);
  }
  for (const MapPartResult& part : view.result.parts) {
    if (part.num_trials < part.num_planned) {
      content += MakeParagraph(part.title + ": " + std::to_string(part.num_trials) + " of " +
                               FormatCount(part.num_planned, "planned trial") + " are there.");
    }
  }
  return content;
}

Html DrawPlanes(const MapView& view) {
  Html content = MakeParagraph(
      "A region is one level, or two levels of two factors, over all levels of the other factors. "
      "Hover over an entry for interval, pairs and verdict.");
  for (const Plane& plane : ListPlanes(view.result)) content += DrawPlane(plane);
  return content;
}

/** The first changed item, as commands accept it. */
Html NameChanged(const std::vector<std::string>& changed) {
  return changed.empty() ? Text("-") : Element("code", {}, Text(changed.front()));
}

/** Lists by hand which of the large regions resolve success to 5 percentage points. */
Html DrawPrecision(const SimultaneityMap& map) {
  Html content;
  for (const std::string& hand : map.hands) {
    const MapPrecision precision = FindPrecision(map, hand);
    content += MakeParagraph(hand + ": " + DescribePrecision(precision));
    std::vector<std::string> wide;
    for (const MapCell* cell : precision.wide) {
      wide.push_back(std::string("late ") + NameLateDigit(cell->late) + " digit, " +
                     NameWhere(map, *cell) + ": " +
                     (cell->interval ? FormatFixed(100.0 * CalcHalfWidth(*cell), 1) + " points"
                                     : cell->interval.reason()));
    }
    if (wide.empty()) continue;
    content += MakeDetails(hand + ": " + FormatCount(static_cast<int>(wide.size()), "region") +
                               " with a larger half-width",
                           MakeList(wide));
  }
  return content;
}

Html DrawRegions(const MapView& view) {
  const std::vector<MapRow> all = ListMapRows(view.result);
  std::vector<MapRow> found;
  std::copy_if(all.begin(), all.end(), std::back_inserter(found), [](const MapRow& row) {
    const MapVerdict verdict = row.cell->verdict;
    return verdict == MapVerdict::kCosts || verdict == MapVerdict::kGains ||
           row.cell->where.empty();
  });
  return DrawPrecision(view.result.parts.front().map) +
         MakeTable("All regions together, and the regions in which a delay changes success.",
                   ShowRegions(found)) +
         MakeDetails("All " + FormatCount(static_cast<int>(all.size()), "region"),
                     MakeTable("Every region of every measure.", ShowRegions(all)));
}

Html DrawObjects(const MapView& view) {
  if (view.result.objects.empty()) return MakeParagraph("There are no pairs.");
  std::vector<Column> columns = {"Hand", "Late digit", "Object", "Pairs"};
  const std::vector<RateWithDelay>& delays = view.result.objects.front().rates;
  for (const RateWithDelay& rate : delays) {
    columns.push_back({FormatFixed(rate.delay, 1) + " s late [%]", "successes"});
  }
  columns.push_back("Points for 100 ms (95 % interval)");
  columns.push_back(
      {"A trial that changed", "name of the first such trial: graspbench trial DIR NAME"});
  Table table("Success by object over all regions.", columns);
  for (const ObjectEffect& effect : view.result.objects) {
    std::vector<Cell> row = {effect.hand, NameLateDigit(effect.late), effect.object,
                             effect.num_pairs};
    for (size_t i = 0; i < delays.size(); ++i) {
      row.push_back(i < effect.rates.size() ? FormatFixed(100.0 * effect.rates[i].rate, 0) : "n/a");
    }
    const std::string interval = effect.interval
                                     ? FormatFixed(100.0 * effect.interval->low, 1) + " to " +
                                           FormatFixed(100.0 * effect.interval->high, 1)
                                     : effect.interval.reason();
    row.push_back(FormatFixed(100.0 * effect.estimate, 1) + " (" + interval + ")");
    row.push_back(NameChanged(effect.changed));
    table.AddRow(row);
  }
  return MakeParagraph(
             "Intervals resample the pairs of an object and hold for this object in these regions. "
             "Of twenty objects, one interval excludes 0 by chance.") +
         table.ToHtml();
}

Html DrawNatural(const MapView& view) {
  Table table("Late digits and success in trials without delay.",
              {"Hand", "Trials", "Objects", "Correlation (95 % interval)",
               "Partial correlation (95 % interval)", "Goes back to"});
  const auto format = [](double value, const Interval& interval) {
    return FormatFixed(value, 2) + " (" + FormatFixed(interval.low, 2) + " to " +
           FormatFixed(interval.high, 2) + ")";
  };
  for (const auto& [hand, relation] : view.result.natural) {
    if (!relation) {
      table.AddRow({hand, "-", "-", relation.reason(), "-", "-"});
      continue;
    }
    std::string held;
    for (const NaturalRelation::Cause& cause : relation->causes) {
      held += (held.empty() ? "" : "; ") + cause.name + " " + format(cause.partial, cause.interval);
    }
    table.AddRow({hand, relation->num_trials, relation->num_objects,
                  format(relation->correlation, relation->interval), held,
                  relation->cause.empty() ? "-" : relation->cause});
  }
  return MakeParagraph(
             "A correlation, not an effect: negative values mean that late digits accompany "
             "failures between draws of one object and region. The delays above test causation.") +
         table.ToHtml();
}

Html DrawMethods(const MapView& view) {
  std::string factors;
  for (const MapFactor& factor : view.result.parts.front().map.factors) {
    factors += (factors.empty() ? "" : "; ") + factor.name + " (";
    for (size_t i = 0; i < factor.levels.size(); ++i) {
      factors += (i > 0 ? ", " : "") + factor.levels[i];
    }
    factors += ")";
  }
  return MakeMethodsText(
      {"Grasps were simulated with graspbench " + std::string(program_version()) + " on " +
       DescribeObjectNames(view.session.config.objects) +
       ", in a regular fraction of the combinations of " + factors +
       ". In every region each draw was tested without delay and with a delay of the last or first "
       "digit. Effects are means over such pairs, scaled to a delay of 100 ms by a line through "
       "the trial without delay. For the push, the effect is the share of pairs with a longer push "
       "minus the share with a shorter push; a digit that never touches counts as the longest "
       "push. 95 % intervals resample objects. P values come from the signs of object sums and are "
       "adjusted for a false discovery rate of 5 %: overall effects over hands and delayed digits, "
       "regions over all regions of a measure."});
}

}  // namespace

std::string MakeMapPage(const Session& session, const MapResult& result) {
  static const std::vector<PageSection<MapView>> sections = {
      {"findings", "Where simultaneous contact matters", &DrawFindings},
      {"maps", "Maps", &DrawPlanes},
      {"regions", "Regions", &DrawRegions},
      {"objects", "Object by object", &DrawObjects},
      {"natural", "Without delays", &DrawNatural},
      {"methods", "Methods", &DrawMethods}};
  int num_trials = 0, num_planned = 0;
  for (const MapPartResult& part : result.parts) {
    num_trials += part.num_trials;
    num_planned += part.num_planned;
  }
  const std::string trials =
      std::to_string(num_trials) + " of " + FormatCount(num_planned, "planned trial") + " finished";
  PageFrame frame = {"Map of simultaneity", trials + DescribeDamage(session.damage) +
                                                DescribePhysics(session.physics_version)};
  frame.commands = {"graspbench map simultaneity --out DIR", "graspbench report DIR"};
  frame.facts = {{"Seed", std::to_string(session.config.seed)},
                 {"Objects", DescribeObjectNames(session.config.objects)},
                 {"Trials", trials},
                 {"Hash of the configuration", CalcHashHex(FormatJson(ToJson(session.config)))}};
  frame.references = {"roethling2007", "sherman2011", "efron1987"};
  return MakeSectionedPage(frame, sections, MapView{session, result});
}

}  // namespace graspbench
