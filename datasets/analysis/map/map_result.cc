#include "datasets/analysis/map/map_result.h"

#include <algorithm>

#include "core/base/text/csv.h"
#include "datasets/analysis/map/map_precision.h"
#include "datasets/analysis/map/map_trials.h"
#include "datasets/plan/map_design.h"

namespace graspbench {
namespace {

struct TableRow {
  const MapPartResult* part;
  const MapCell* cell;

  const MapMeasureRow& measure() const { return RowOf(kMapMeasures, cell->measure); }
};

/** The level of a factor of the cell's, or its name; null: it has no such. */
Json FindPlace(const TableRow& row, size_t place, bool is_name) {
  if (row.cell->where.size() <= place) return {};
  const MapLevel& level = row.cell->where[place];
  const MapFactor& factor = row.part->map.factors[level.factor];
  return is_name ? factor.name : factor.levels[level.level];
}

std::vector<CsvColumn<TableRow>> ListMapColumns() {
  using Row = TableRow;
  return {
      {"part", "", "session of the map", [](const Row& row) { return row.part->id; }},
      {"measure", "",
       "success (0 or 1), threshold (binary logarithm of the margin), push (net share of pairs), "
       "breaking_force [N]",
       [](const Row& row) { return row.measure().name; }},
      {"hand", "", "id of the hand", [](const Row& row) { return row.cell->hand; }},
      {"late_digit", "", "last or first to touch without delay",
       [](const Row& row) { return NameLateDigit(row.cell->late); }},
      {"factor", "string", "", "of the region; empty: everywhere",
       [](const Row& row) { return FindPlace(row, 0, true); }},
      {"level", "string", "", "its level", [](const Row& row) { return FindPlace(row, 0, false); }},
      {"with_factor", "string", "", "a second factor of the region",
       [](const Row& row) { return FindPlace(row, 1, true); }},
      {"with_level", "string", "", "and its level",
       [](const Row& row) { return FindPlace(row, 1, false); }},
      {"pairs", "", "of a trial without delay and its late ones",
       [](const Row& row) { return row.cell->num_pairs; }},
      {"objects", "", "in these pairs", [](const Row& row) { return row.cell->num_objects; }},
      {"undelayed", "", "mean of the measure without delay",
       [](const Row& row) { return row.cell->undelayed; }},
      {"effect", "", "mean over pairs, for 100 ms of delay; of push not by time",
       [](const Row& row) { return row.cell->estimate; }},
      {"low", "", "lower end of the 95 % interval from drawing objects",
       [](const Row& row) { return row.cell->interval ? row.cell->interval->low : kUnset; }},
      {"high", "", "upper end of the 95 % interval",
       [](const Row& row) { return row.cell->interval ? row.cell->interval->high : kUnset; }},
      {"no_interval", "", "why there is none",
       [](const Row& row) { return row.cell->interval ? "" : row.cell->interval.reason(); }},
      {"p", "", "of no effect, by the signs of objects",
       [](const Row& row) { return row.cell->p; }},
      {"adjusted_p", "",
       "for the false discovery rate: everywhere over hands and late digits, a region over all",
       [](const Row& row) { return row.cell->adjusted_p; }},
      {"verdict", "", "costs, gains, none, ceiling, floor, undecided",
       [](const Row& row) { return RowOf(kMapVerdicts, row.cell->verdict).name; }}};
}

MapMeasure FindMeasure(const MapPart& part) {
  if (part.with_judge) return MapMeasure::kBreakingForce;
  return part.with_thresholds ? MapMeasure::kThreshold : MapMeasure::kSuccess;
}

MapPartResult MakePart(const MapPart& part, const Session& session, const MapData& data) {
  return {part.id,
          part.title,
          static_cast<int>(session.records.size()),
          static_cast<int>(session.plan.size()),
          FindMeasure(part),
          MapSimultaneity(data)};
}

}  // namespace

std::vector<std::string> MapResult::findings() const {
  std::vector<std::string> sentences;
  for (const std::string& hand : parts.front().map.hands) {
    sentences.push_back(DescribeFinding(parts.front().map, natural.at(hand), hand));
    for (const MapPartResult& part : parts) {
      const std::string regions = DescribeMap(part.map, hand, part.measure);
      if (!regions.empty()) sentences.push_back(hand + ": " + regions);
    }
    const std::string by_object = DescribeObjects(objects, hand);
    if (!by_object.empty()) sentences.push_back(hand + ": " + by_object);
  }
  return sentences;
}

MapResult LoadMap(const Session& session) {
  MapResult result;
  for (const MapPart& part : ListMapParts(false)) {
    if (result.parts.empty()) {
      const MapData data = ListMapTrials(session, {});
      result.parts.push_back(MakePart(part, session, data));
      result.objects = ListObjectEffects(data);
      for (const std::string& hand : result.parts.front().map.hands) {
        result.natural[hand] = FindNaturalRelation(data, hand);
      }
      continue;
    }
    const std::filesystem::path folder = session.folder / "map" / part.id;
    if (!HasSession(folder)) continue;
    const Session rest = LoadSession(folder, OnDamage::kAccept, RecordParts::kBrief);
    result.parts.push_back(MakePart(part, rest, ListMapTrials(rest, LoadThresholds(rest))));
  }
  return result;
}

namespace {

/** Of success with the delay at this place; NaN: there is no such. */
double FindRate(const ObjectEffect& effect, size_t place) {
  return effect.rates.size() > place ? effect.rates[place].rate : kUnset;
}

std::vector<CsvColumn<ObjectEffect>> ListObjectColumns() {
  using Row = ObjectEffect;
  return {{"hand", "", "id of the hand", &Row::hand},
          {"object", "", "id of the object", &Row::object},
          {"late_digit", "", "last or first to touch without delay",
           [](const Row& row) { return NameLateDigit(row.late); }},
          {"pairs", "", "of a trial without delay and its late ones", &Row::num_pairs},
          {"undelayed", "", "rate of success without delay",
           [](const Row& row) { return FindRate(row, 0); }},
          {"rate_at_shorter_delay", "", "rate of success with the shorter delay",
           [](const Row& row) { return FindRate(row, 1); }},
          {"rate_at_longer_delay", "", "rate of success with the longer delay",
           [](const Row& row) { return FindRate(row, 2); }},
          {"effect", "", "change of the rate for 100 ms of delay", &Row::estimate},
          {"low", "", "lower end of the 95 % interval from drawing pairs",
           [](const Row& row) { return row.interval ? row.interval->low : kUnset; }},
          {"high", "", "upper end of the 95 % interval",
           [](const Row& row) { return row.interval ? row.interval->high : kUnset; }},
          {"no_interval", "", "why there is none",
           [](const Row& row) { return row.interval ? "" : row.interval.reason(); }}};
}

}  // namespace

std::vector<ExportTable> MakeMapTables(const MapResult& result) {
  std::vector<TableRow> rows;
  for (const MapPartResult& part : result.parts) {
    for (const MapCell& cell : part.map.cells) {
      if (cell.num_pairs > 0) rows.push_back({&part, &cell});
    }
  }
  const auto columns = ListMapColumns();
  const auto object_columns = ListObjectColumns();
  return {{"map", FormatCsv(columns, rows), MakeTableSchema(columns, "")},
          {"map_objects", FormatCsv(object_columns, result.objects),
           MakeTableSchema(object_columns, "")}};
}

Json ToJson(const MapResult& result) {
  Json parts = Json::array();
  for (const MapPartResult& part : result.parts) {
    Json json = ToJson(part.map);
    json["id"] = part.id;
    json["trials"] = part.num_trials;
    json["planned"] = part.num_planned;
    parts.push_back(json);
  }
  Json objects = Json::array();
  for (const ObjectEffect& effect : result.objects) {
    Json rates = Json::array();
    for (const RateWithDelay& rate : effect.rates) {
      rates.push_back({{"delay_s", rate.delay}, {"success", JsonNumber(rate.rate)}});
    }
    objects.push_back({{"hand", effect.hand},
                       {"object", effect.object},
                       {"late_digit", NameLateDigit(effect.late)},
                       {"pairs", effect.num_pairs},
                       {"rates", rates},
                       {"effect", JsonNumber(effect.estimate)},
                       {"low", effect.interval ? JsonNumber(effect.interval->low) : Json()},
                       {"high", effect.interval ? JsonNumber(effect.interval->high) : Json()},
                       {"changed", effect.changed}});
  }
  const SimultaneityMap& map = result.parts.front().map;
  Json precision = Json::object();
  for (const std::string& hand : map.hands) {
    const MapPrecision found = FindPrecision(map, hand);
    Json wide = Json::array();
    for (const MapCell* cell : found.wide) {
      wide.push_back({{"late_digit", NameLateDigit(cell->late)},
                      {"where", NameWhere(map, *cell)},
                      {"half_width", JsonNumber(CalcHalfWidth(*cell))}});
    }
    precision[hand] = {{"regions", found.num_regions},
                       {"large", found.num_large},
                       {"narrow", found.num_narrow()},
                       {"wide", wide}};
  }
  Json natural = Json::object();
  for (const auto& [hand, relation] : result.natural) {
    if (!relation) {
      natural[hand] = {{"none", relation.reason()}};
      continue;
    }
    natural[hand] = {{"trials", relation->num_trials},
                     {"objects", relation->num_objects},
                     {"correlation", JsonNumber(relation->correlation)},
                     {"low", JsonNumber(relation->interval.low)},
                     {"high", JsonNumber(relation->interval.high)},
                     {"cause", relation->cause}};
  }
  return {{"findings", result.findings()},
          {"parts", parts},
          {"objects", objects},
          {"precision", precision},
          {"natural", natural}};
}

}  // namespace graspbench
