#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/text/text.h"
#include "core/trial/policy/policy_messages.h"
#include "core/trial/policy/policy_terms.h"
#include "workbench/experiments/policies/policy_server.h"
#include "workbench/experiments/policies/resize_picture.h"

namespace graspbench {
namespace {

[[noreturn]] void FailMapping(const PolicyServer& server, const std::string& text) {
  throw PolicyLost(server.source + ": " + text);
}

std::vector<std::string> ListTexts(const PackedValue& facts, const char* name) {
  std::vector<std::string> texts;
  const PackedValue* value = facts.Find(name);
  const auto* list = value ? std::get_if<PackedValue::List>(&value->value) : nullptr;
  if (!list) return texts;
  for (const PackedValue& item : *list) texts.push_back(item.text() ? *item.text() : "");
  return texts;
}

PackedArray FindSource(const PolicyServer& server, const ServerValue& value,
                       const std::string& name, const PackedValue& facts,
                       const PackedValue& observation) {
  const PackedValue* found = observation.Find(name);
  if (!found) found = facts.Find(name);
  if (!found) {
    FailMapping(server, "observation, " + value.key + ": \"" + name +
                            "\" is not given in this trial; the manual's page controllers says "
                            "which setting gives it");
  }
  try {
    return ReadPackedArray(*found, name);
  } catch (const Error&) {
    FailMapping(server, "observation, " + value.key + ": \"" + name + "\" is no numbers");
  }
}

std::vector<double> PickJoints(const PolicyServer& server, const ServerValue& value,
                               const std::string& name, const PackedArray& source,
                               const PackedValue& facts) {
  if (value.joints.empty()) return source.values;
  std::vector<double> picked;
  for (const char* fact : {"joints", "driven"}) {
    const std::vector<std::string> joints = ListTexts(facts, fact);
    if (joints.size() != source.values.size()) continue;
    for (const std::string& joint : value.joints) {
      const auto found = std::find(joints.begin(), joints.end(), joint);
      if (found == joints.end()) {
        FailMapping(server, "observation, " + value.key + ": no joint \"" + joint + "\" in " +
                                name + SuggestNames(joint, joints));
      }
      picked.push_back(source.values[static_cast<size_t>(found - joints.begin())]);
    }
    return picked;
  }
  FailMapping(server, "observation, " + value.key + ": " + name + " is not one number per joint");
}

template <class T>
std::string PackNumbers(const std::vector<double>& values) {
  std::string bytes;
  bytes.reserve(values.size() * sizeof(T));
  for (const double value : values) {
    const auto number = static_cast<T>(value);
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  return bytes;
}

uint8_t RoundToByte(double value) {
  return static_cast<uint8_t>(std::clamp(std::floor(value + 0.5), 0.0, 255.0));
}

void WritePicture(const ServerValue& value, const PackedArray& source, MessagePackWriter& writer) {
  BytePicture picture = {source.shape[0], source.shape[1], {}};
  picture.rgb.reserve(source.values.size());
  for (const double number : source.values) picture.rgb.push_back(RoundToByte(number));
  if (!value.size.empty()) {
    picture = ResizeWithPadding(picture, static_cast<size_t>(value.size[0]),
                                static_cast<size_t>(value.size[1]));
  }
  writer.RawArray({reinterpret_cast<const char*>(picture.rgb.data()), picture.rgb.size()}, "|u1",
                  {picture.height, picture.width, 3});
}

void WriteNumbers(const ServerValue& value, const std::vector<double>& numbers,
                  MessagePackWriter& writer) {
  if (value.dtype == "float64") return writer.Array(numbers);
  if (value.dtype != "uint8") {
    return writer.RawArray(PackNumbers<float>(numbers), "<f4", {numbers.size()});
  }
  std::string bytes;
  for (const double number : numbers) bytes.push_back(static_cast<char>(RoundToByte(number)));
  writer.RawArray(bytes, "|u1", {numbers.size()});
}

/** With facts in the place of {name}. */
std::string FillText(const PolicyServer& server, const ServerValue& value,
                     const PackedValue& facts) {
  std::string text;
  for (size_t at = 0; at < value.text.size();) {
    const size_t end = value.text[at] == '{' ? value.text.find('}', at) : value.text.npos;
    if (end == value.text.npos) {
      text += value.text[at++];
      continue;
    }
    const std::string name = value.text.substr(at + 1, end - at - 1);
    const PackedValue* fact = facts.Find(name);
    if (!fact || !fact->text()) {
      FailMapping(server, "observation, " + value.key + ": {" + name +
                              "} is no fact of the trial that is a text, as {object} or {hand}");
    }
    text += *fact->text();
    at = end + 1;
  }
  return text;
}

void WriteValue(const PolicyServer& server, const ServerValue& value, const PackedValue& facts,
                const PackedValue& observation, MessagePackWriter& writer) {
  writer.Text(value.key);
  if (value.from.empty()) return writer.Text(FillText(server, value, facts));
  std::vector<double> numbers;
  for (const std::string& name : value.from) {
    const PackedArray source = FindSource(server, value, name, facts, observation);
    const bool is_picture =
        source.shape.size() == 3 && source.shape[2] == 3 && !source.values.empty();
    if (is_picture && value.from.size() == 1) return WritePicture(value, source, writer);
    if (is_picture || !value.size.empty()) {
      FailMapping(server, "observation, " + value.key +
                              ": a picture stands alone, and only a picture has a size");
    }
    const std::vector<double> picked = PickJoints(server, value, name, source, facts);
    numbers.insert(numbers.end(), picked.begin(), picked.end());
  }
  WriteNumbers(value, numbers, writer);
}

/** Where the columns of the server's rows go: places among the driven joints, in the hand's pose and
twist; -1: not there. */
struct ColumnPlaces {
  std::vector<int> joint, pose, twist;
  int done = -1, hold = -1;  ///< columns

  size_t width() const { return joint.size(); }
};

int FindPlace(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

ColumnPlaces FindColumns(const PolicyServer& server, const std::vector<std::string>& driven) {
  ColumnPlaces places;
  for (const std::string& column :
       server.actions.columns.empty() ? driven : server.actions.columns) {
    if (column == "done") places.done = static_cast<int>(places.width());
    if (column == "hold") places.hold = static_cast<int>(places.width());
    places.joint.push_back(FindPlace(driven, column));
    places.pose.push_back(FindPlace(ListPoseColumns(), column));
    places.twist.push_back(FindPlace(ListTwistColumns(), column));
  }
  return places;
}

/** Rows of ours, each begun as `fill`; empty where no column goes there. */
std::vector<double> PickColumns(const PackedArray& rows, const std::vector<int>& places,
                                size_t num_rows, const std::vector<double>& fill) {
  std::vector<double> picked;
  if (std::all_of(places.begin(), places.end(), [](int place) { return place < 0; })) return picked;
  for (size_t row = 0; row < num_rows; ++row) {
    picked.insert(picked.end(), fill.begin(), fill.end());
    for (size_t i = 0; i < places.size(); ++i) {
      if (places[i] < 0) continue;
      picked[row * fill.size() + static_cast<size_t>(places[i])] =
          rows.values[row * places.size() + i];
    }
  }
  return picked;
}

/** Ours, of rows of the server. */
std::string TranslateRows(const PolicyServer& server, const ColumnPlaces& places,
                          const PackedArray& rows, const std::vector<double>& last) {
  const size_t width = places.width();
  const size_t num_sizes = rows.shape.size();
  if (num_sizes < 1 || num_sizes > 2 || rows.shape.back() != width || rows.values.empty()) {
    std::string shape;
    for (const size_t size : rows.shape)
      shape += (shape.empty() ? "" : ", ") + std::to_string(size);
    throw PolicyFault(server.actions.key + " has the shape (" + shape +
                      "); expected one row or more of " + std::to_string(width) +
                      (server.actions.columns.empty()
                           ? " driven joints; actions.columns names other columns"
                           : " columns"));
  }
  const auto says = [&](int column, size_t row) {
    return column >= 0 && rows.values[row * width + static_cast<size_t>(column)] > 0.5;
  };
  const auto ends = [&](size_t row) { return says(places.done, row) || says(places.hold, row); };
  size_t num_rows = 1;  // the answer after these says it with its first row
  while (!ends(0) && num_rows < rows.values.size() / width && !ends(num_rows)) ++num_rows;
  const std::pair<const char*, std::vector<double>> parts[] = {
      {server.actions.are_increments ? "increments" : "targets",
       PickColumns(rows, places.joint, num_rows,
                   server.actions.are_increments ? std::vector<double>(last.size(), 0.0) : last)},
      {"hand_pose", PickColumns(rows, places.pose, num_rows, std::vector<double>(7, 0.0))},
      {"hand_twist", PickColumns(rows, places.twist, num_rows, std::vector<double>(6, 0.0))}};
  MessagePackWriter writer;
  writer.Map(
      1 + (says(places.hold, 0) ? 1 : 0) +
      static_cast<size_t>(std::count_if(std::begin(parts), std::end(parts),
                                        [](const auto& part) { return !part.second.empty(); })));
  writer.Text("done");
  writer.Bool(says(places.done, 0));
  if (says(places.hold, 0)) {
    writer.Text("hold");
    writer.Text("margin");
  }
  for (const auto& [name, values] : parts) {
    if (values.empty()) continue;
    writer.Text(name);
    writer.Array(values.data(), {num_rows, values.size() / num_rows});
  }
  return writer.bytes();
}

}  // namespace

std::string FormatServerQuestion(const PolicyServer& server, const PackedValue& facts,
                                 const PackedValue& observation, bool is_first) {
  MessagePackWriter writer;
  if (!server.is_mapped) {
    const auto& values = std::get<PackedValue::Map>(observation.value);
    writer.Map(values.size() + (is_first ? 1 : 0));
    for (const auto& [name, value] : values) {
      writer.Text(name);
      writer.Value(value);
    }
    if (is_first) {
      writer.Text("reset");
      writer.Value(facts);
    }
    return writer.bytes();
  }
  std::vector<std::string> maps;  // of the server's observation, in the order of the file
  size_t num_plain = 0;
  for (const ServerValue& value : server.observation) {
    if (value.under.empty()) ++num_plain;
    if (value.under.empty() || std::count(maps.begin(), maps.end(), value.under) > 0) continue;
    maps.push_back(value.under);
  }
  const auto write = [&](const std::string& under) {
    for (const ServerValue& value : server.observation) {
      if (value.under == under) WriteValue(server, value, facts, observation, writer);
    }
  };
  writer.Map(num_plain + maps.size());
  write("");
  for (const std::string& name : maps) {
    writer.Text(name);
    writer.Map(static_cast<size_t>(
        std::count_if(server.observation.begin(), server.observation.end(),
                      [&name = name](const ServerValue& value) { return value.under == name; })));
    write(name);
  }
  return writer.bytes();
}

PolicyAction ReadServerAnswer(const PolicyServer& server, const PackedValue& facts,
                              const PackedValue& observation, std::string_view answer) {
  const std::vector<std::string> driven = ListTexts(facts, "driven");
  const auto num_driven = static_cast<Eigen::Index>(driven.size());
  const ColumnPlaces places = FindColumns(server, driven);
  try {
    const PackedValue value = ParseMessagePack(answer);
    if (server.is_mapped) {
      const PackedValue* rows = value.Find(server.actions.key);
      if (!rows) throw PolicyFault("the answer has no " + server.actions.key);
      const PackedValue* last = observation.Find("targets");
      const std::string ours = TranslateRows(
          server, places, ReadPackedArray(*rows, server.actions.key),
          last ? ReadPackedArray(*last, "targets").values : std::vector<double>(driven.size()));
      return ReadPolicyAction(ours, num_driven);
    }
    PackedValue::Map known;  // what servers add beside our names is theirs
    if (const PackedValue* rows = value.Find("actions")) known.emplace_back("targets", *rows);
    for (const PolicyTerm& term : ListPolicyActions()) {
      if (const PackedValue* found = value.Find(term.name)) known.emplace_back(term.name, *found);
    }
    MessagePackWriter writer;
    writer.Value({known});
    return ReadPolicyAction(writer.bytes(), num_driven);
  } catch (const Error& error) {
    throw PolicyFault(error.what());
  }
}

}  // namespace graspbench
