#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "core/statistics/summary.h"
#include "human_study/recording/importers/table_mapping.h"
#include "human_study/recording/importers/text_rows.h"

namespace graspbench {
namespace {

constexpr size_t kMaxRows = 400;  // that a proposal looks at
constexpr const char* kSeparators = " _.-:/()[]";

/** The beginning of a table. */
struct TableHead {
  std::vector<std::string> names;            ///< of its columns; "1", "2", .. without a heading
  std::vector<std::vector<double>> columns;  ///< NaN for what is no number
  bool has_heading = true;
};

TableHead ReadTableHead(LineReader& reader) {
  TableHead head;
  const std::string first(reader.Require("its first row"));
  const char delimiter = FindDelimiter(first);
  Cells cells;
  SplitRow(first, delimiter, 0, cells);
  head.names.assign(cells.begin(), cells.end());
  head.columns.resize(cells.size());
  const auto append = [&] {
    for (size_t i = 0; i < head.columns.size(); ++i) {
      const auto number = i < cells.size() ? ParseFiniteNumber(cells[i]) : std::nullopt;
      head.columns[i].push_back(number.value_or(std::nan("")));
    }
  };
  head.has_heading = std::none_of(cells.begin(), cells.end(),
                                  [](auto cell) { return ParseFiniteNumber(cell).has_value(); });
  if (!head.has_heading) {
    append();
    for (size_t i = 0; i < head.names.size(); ++i) head.names[i] = std::to_string(i + 1);
  }
  std::string_view line;
  while (head.columns[0].size() < kMaxRows && reader.Next(line)) {
    SplitRow(line, delimiter, head.names.size(), cells);
    if (!IsBlank(cells)) append();
  }
  return head;
}

/** Words of a name: "thumb_x (mm)" has thumb, x and mm. */
std::vector<std::string> ListWords(const std::string& name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if (std::string(kSeparators).find(c) != std::string::npos) {
      if (!words.back().empty()) words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

/** A unit among the words of a name; empty: none. */
std::string FindUnitWord(const std::string& name, const std::set<std::string>& units) {
  for (const std::string& word : ListWords(name)) {
    if (units.count(ToLower(word)) > 0) return ToLower(word);
  }
  return "";
}

const std::set<std::string>& LengthUnits() {
  static const std::set<std::string> units = {"m", "cm", "mm", "um", "in"};
  return units;
}

/** What is left of a name without its axis, which stands at `at`, and its unit. */
std::string MakeLabel(std::string name, size_t at) {
  name[at] = '_';
  std::string label;
  for (const std::string& word : ListWords(name)) {
    if (LengthUnits().count(ToLower(word)) > 0 || word.empty()) continue;
    label += (label.empty() ? "" : "_") + word;
  }
  return label.empty() ? "marker" : label;
}

/** Points: three names that differ by x, y and z in one place. */
std::vector<TableMapping::Point> FindTriples(const TableHead& head) {
  std::vector<TableMapping::Point> points;
  const std::set<std::string> names(head.names.begin(), head.names.end());
  std::set<std::string> labels;
  for (const std::string& name : head.names) {
    for (size_t at = name.size(); at-- > 0;) {
      const char axis = name[at];
      if (axis != 'x' && axis != 'X') continue;
      std::string y = name, z = name;
      y[at] = static_cast<char>(axis + 1);
      z[at] = static_cast<char>(axis + 2);
      if (names.count(y) == 0 || names.count(z) == 0) continue;
      std::string label = MakeLabel(name, at);
      for (int k = 2; !labels.insert(label).second; ++k) {
        label = MakeLabel(name, at) + "_" + std::to_string(k);
      }
      points.push_back({label, {name, y, z}});
      break;
    }
  }
  return points;
}

/** Without names: every three columns from `first` on. */
std::vector<TableMapping::Point> NumberTriples(const TableHead& head, size_t first) {
  std::vector<TableMapping::Point> points;
  for (size_t i = first; i + 2 < head.names.size(); i += 3) {
    points.push_back({"point_" + std::to_string(points.size() + 1),
                      {head.names[i], head.names[i + 1], head.names[i + 2]}});
  }
  return points;
}

std::vector<double> ListSteps(const std::vector<double>& column) {
  std::vector<double> steps;
  for (size_t i = 1; i < column.size(); ++i) steps.push_back(column[i] - column[i - 1]);
  return steps;
}

bool Increases(const std::vector<double>& column) {
  const std::vector<double> steps = ListSteps(column);
  // One file may hold several trials, each with times of its own.
  return !steps.empty() && std::isfinite(CalcMedian(steps)) && CalcMedian(steps) > 0.0;
}

bool CountsFrames(const std::vector<double>& column) {
  const std::vector<double> steps = ListSteps(column);
  return !steps.empty() && CalcMedian(steps) == 1.0;
}

/** SIZE_MAX: there is none. */
size_t FindTime(const TableHead& head) {
  for (size_t i = 0; i < head.names.size(); ++i) {
    const std::string name = ToLower(head.names[i]);
    const bool is_named = name.find("time") != name.npos || ListWords(name).front() == "t";
    if ((is_named || !head.has_heading) && Increases(head.columns[i]) &&
        !CountsFrames(head.columns[i])) {
      return i;
    }
    if (!head.has_heading && i == 1) break;  // what follows is a coordinate
  }
  return SIZE_MAX;
}

std::string FormatLine(const std::string& key, const std::string& value, const std::string& check) {
  std::string line = key + ": " + value;
  if (!check.empty())
    line += std::string(line.size() < 24 ? 24 - line.size() : 1, ' ') + "# check: " + check;
  return line + "\n";
}

std::string FormatTime(const TableHead& head, size_t time) {
  if (time == SIZE_MAX) {
    return FormatLine("rate_hz", "100", "the table has no times; write the rate of the recording");
  }
  const std::string& name = head.names[time];
  std::string text = "time: " + FormatYamlWord(name) + "\n";
  const std::string unit = FindUnitWord(name, {"s", "ms", "us"});
  if (!unit.empty()) return text + FormatLine("time_unit", unit, "");
  const double step = CalcMedian(ListSteps(head.columns[time]));
  const char* guess = step >= 500.0 ? "us" : step >= 0.5 ? "ms" : "s";
  return text + FormatLine("time_unit", guess,
                           "not stated; the times go on by " + FormatSignificant(step, 3));
}

/** How far apart the points of a row are, at most. */
double CalcSpread(const TableHead& head, const std::vector<TableMapping::Point>& points) {
  std::map<std::string, size_t> at;
  for (size_t i = 0; i < head.names.size(); ++i) at.emplace(head.names[i], i);
  double spread = 0.0;
  for (size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const TableMapping::Point& point : points) {
      for (const double value : head.columns[at[point.columns[axis]]]) {
        if (std::isfinite(value)) values.push_back(value);
      }
    }
    if (values.empty()) continue;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    spread = std::max(spread, *most - *least);
  }
  return spread;
}

std::string FormatLengthUnit(const TableHead& head,
                             const std::vector<TableMapping::Point>& points) {
  const std::string unit = FindUnitWord(points[0].columns[0], LengthUnits());
  if (!unit.empty()) return FormatLine("unit", unit, "");
  const double spread = CalcSpread(head, points);
  const char* guess = spread >= 100.0 ? "mm" : spread >= 5.0 ? "cm" : "m";
  return FormatLine(
      "unit", guess,
      "not stated; a reach spans some 0.5 m, these points " + FormatSignificant(spread, 3));
}

std::string FormatTrial(const TableHead& head) {
  for (const std::string& name : head.names) {
    if (ToLower(name).find("trial") == std::string::npos) continue;
    return FormatLine("trial", FormatYamlWord(name),
                      "one trial in a file needs no such line; else trials.csv needs table_trial");
  }
  return "";
}

/** The roles that labels name, as study.yaml has them. */
std::string FormatMarkers(const std::vector<TableMapping::Point>& points) {
  const std::vector<std::pair<const char*, std::vector<std::string>>> roles = {
      {"thumb", {"thumb"}},
      {"index", {"index"}},
      {"middle", {"middle"}},
      {"ring", {"ring"}},
      {"little", {"little", "pinky"}},
      {"wrist", {"wrist"}},
      {"object", {"obj", "target"}}};
  std::string text;
  for (const auto& [role, words] : roles) {
    std::string labels;
    for (const TableMapping::Point& point : points) {
      const std::string label = ToLower(point.label);
      const bool is_named = std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return label.find(word) != std::string::npos;
      });
      if (is_named) labels += (labels.empty() ? "" : ", ") + FormatYamlWord(point.label);
    }
    if (!labels.empty()) text += "#     " + std::string(role) + ": [" + labels + "]\n";
  }
  return text.empty() ? "#     thumb: LABEL\n#     index: LABEL\n" : text;
}

std::string FormatHead(const std::string& file) {
  return "# Columns of " + file +
         ", proposed from its first rows: look at every line with \"check\". Keys:\n"
         "# graspbench help columns.yaml. What it reads: graspbench mocap info FILE --mapping "
         "THIS\n";
}

std::string FormatStudyPart(const std::vector<TableMapping::Point>& points) {
  return "# In study.yaml, beside this file; a digit with several labels takes the first that a "
         "recording has:\n"
         "#   recording: {mapping: columns.yaml}\n#   markers:\n" +
         FormatMarkers(points);
}

}  // namespace

std::string FormatProposedMapping(std::istream& stream, const std::string& name) {
  LineReader reader(stream, name);
  const TableHead head = ReadTableHead(reader);
  const std::string file = name.substr(name.find_last_of('/') + 1);
  if (head.names[0] == "scorer") {
    return FormatHead(file) + "layout: deeplabcut\n" +
           FormatLine("unit", "mm", "that in which scale is given") +
           FormatLine("scale", "1", "the length of one square of the checkerboard") +
           FormatLine("rate_hz", "100", "the rate of the cameras");
  }
  const size_t time = FindTime(head);
  const size_t first = time == SIZE_MAX ? head.names.size() % 3 : time + 1;
  const std::vector<TableMapping::Point> points =
      head.has_heading ? FindTriples(head) : NumberTriples(head, first);
  if (points.empty()) {
    std::string names;
    for (const std::string& column : head.names) names += (names.empty() ? "" : ", ") + column;
    throw Error(ErrorKind::kFormat,
                name +
                    ":1: no three columns differ by x, y and z alone, so none is proposed as a "
                    "point; write the mapping yourself (graspbench help columns.yaml). Columns: " +
                    names.substr(0, 400));
  }
  std::string text = FormatHead(file) + FormatStudyPart(points) + FormatLengthUnit(head, points) +
                     FormatTime(head, time) + FormatTrial(head);
  if (!head.has_heading) text += "heading: false\n";
  text += "points:\n";
  for (const TableMapping::Point& point : points) {
    text += "  " + FormatYamlWord(point.label) + ": [";
    for (size_t i = 0; i < 3; ++i) text += (i > 0 ? ", " : "") + FormatYamlWord(point.columns[i]);
    text += "]\n";
  }
  return text;
}

}  // namespace graspbench
