#include "workbench/tables/map_tables.h"

#include "core/base/enum_table.h"
#include "core/base/text/text.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

void AddRows(const MapPartResult& part, TextTable& table) {
  for (const MapCell& cell : part.map.cells) {
    if (cell.where.size() > 1 || cell.late != LateDigit::kLast || cell.num_pairs == 0) continue;
    table.AddRow({cell.hand, RowOf(kMapMeasures, cell.measure).label, NameWhere(part.map, cell),
                  std::to_string(cell.num_pairs), FormatEffect(cell),
                  RowOf(kMapVerdicts, cell.verdict).name});
  }
}

}  // namespace

std::string FormatMap(const MapResult& result) {
  std::string text;
  for (const std::string& finding : result.findings()) text += finding + "\n";
  TextTable table({"hand", "measure", "where", "pairs", "late last digit", "verdict"});
  for (const MapPartResult& part : result.parts) AddRows(part, table);
  return text + "\n" + table.Format() +
         "means over pairs with 95 % intervals from drawing objects; verdicts at a false discovery "
         "rate of 5 %\n";
}

}  // namespace graspbench
