#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/text/text.h"
#include "core/trial/policy/policy_terms.h"
#include "workbench/experiments/policies/policy_server.h"
#include "workbench/experiments/policies/resize_picture.h"

namespace graspbench {
namespace {

std::vector<std::string> ListTexts(const PackedValue& facts, const char* name) {
  std::vector<std::string> texts;
  const PackedValue* value = facts.Find(name);
  const auto* list = value ? std::get_if<PackedValue::List>(&value->value) : nullptr;
  if (!list) return texts;
  for (const PackedValue& item : *list) texts.push_back(item.text() ? *item.text() : "");
  return texts;
}

int FindNamePlace(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

std::vector<int> FindNamePlaces(const std::vector<std::string>& names,
                                const std::vector<std::string>& wanted) {
  std::vector<int> places;
  for (const std::string& name : wanted) places.push_back(FindNamePlace(names, name));
  return places;
}

const PackedArray* FindObserved(const PolicyValues& observation, std::string_view name) {
  const auto found = std::find_if(observation.begin(), observation.end(),
                                  [name](const auto& one) { return one.first == name; });
  return found == observation.end() ? nullptr : &found->second;
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

template <class T>
void WriteAs(const char* dtype, const std::vector<T>& numbers, MessagePackWriter& writer) {
  writer.RawArray({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)},
                  dtype, {numbers.size()});
}

void WriteNumbers(const ServerValue& value, const std::vector<double>& numbers,
                  MessagePackWriter& writer) {
  if (value.dtype == "float64") return writer.Array(numbers);
  if (value.dtype != "uint8") {
    return WriteAs("<f4", std::vector<float>(numbers.begin(), numbers.end()), writer);
  }
  std::vector<uint8_t> bytes;
  for (const double number : numbers) bytes.push_back(RoundToByte(number));
  WriteAs("|u1", bytes, writer);
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

}  // namespace

ServerExchange::ServerExchange(const PolicyServer& server, PackedValue facts)
    : server_(server),
      facts_(std::move(facts)),
      joints_(ListTexts(facts_, "joints")),
      driven_(ListTexts(facts_, "driven")) {
  for (const ServerValue& value : server.observation) {
    picked_.push_back(
        {FindNamePlaces(joints_, value.joints), FindNamePlaces(driven_, value.joints)});
    if (value.under.empty() || FindNamePlace(maps_, value.under) >= 0) continue;
    maps_.push_back(value.under);
  }
  const std::vector<std::string>& columns =
      server.actions.columns.empty() ? driven_ : server.actions.columns;
  columns_ = {FindNamePlaces(driven_, columns), FindNamePlaces(ListPoseColumns(), columns),
              FindNamePlaces(ListTwistColumns(), columns), FindNamePlace(columns, "done"),
              FindNamePlace(columns, "hold")};
}

void ServerExchange::Fail(const std::string& key, const std::string& text) const {
  throw PolicyLost(server_.source + ": observation, " + key + ": " + text);
}

PackedArray ServerExchange::FindSource(const ServerValue& value, const std::string& name,
                                       const PolicyValues& observation) const {
  if (const PackedArray* found = FindObserved(observation, name)) return *found;
  const PackedValue* fact = facts_.Find(name);
  if (!fact) {
    Fail(value.key, "\"" + name +
                        "\" is not available in this trial; the manual page controllers names the "
                        "setting that provides it");
  }
  try {
    return ReadPackedArray(*fact, name);
  } catch (const Error&) {
    Fail(value.key, "\"" + name + "\" is not numeric");
  }
}

void ServerExchange::AppendJoints(size_t number, const std::string& name, const PackedArray& source,
                                  std::vector<double>& numbers) const {
  const ServerValue& value = server_.observation[number];
  const bool is_of_all = source.values.size() == joints_.size();
  if (!is_of_all && source.values.size() != driven_.size()) {
    Fail(value.key, name + " is not one number per joint");
  }
  const std::vector<int>& places = is_of_all ? picked_[number].of_all : picked_[number].of_driven;
  for (size_t i = 0; i < places.size(); ++i) {
    if (places[i] < 0) {
      Fail(value.key, "no joint \"" + value.joints[i] + "\" in " + name +
                          SuggestNames(value.joints[i], is_of_all ? joints_ : driven_));
    }
    numbers.push_back(source.values[static_cast<size_t>(places[i])]);
  }
}

/** With facts in the place of {name}. */
std::string ServerExchange::FillText(const ServerValue& value) const {
  std::string text;
  for (size_t at = 0; at < value.text.size();) {
    const size_t end = value.text[at] == '{' ? value.text.find('}', at) : value.text.npos;
    if (end == value.text.npos) {
      text += value.text[at++];
      continue;
    }
    const std::string name = value.text.substr(at + 1, end - at - 1);
    const PackedValue* fact = facts_.Find(name);
    if (!fact || !fact->text()) {
      Fail(value.key, "{" + name + "} is not a text fact of the trial, such as {object} or {hand}");
    }
    text += *fact->text();
    at = end + 1;
  }
  return text;
}

void ServerExchange::WriteValue(size_t number, const PolicyValues& observation,
                                MessagePackWriter& writer) const {
  const ServerValue& value = server_.observation[number];
  writer.Text(value.key);
  if (value.from.empty()) return writer.Text(FillText(value));
  std::vector<double> numbers;
  for (const std::string& name : value.from) {
    const PackedArray source = FindSource(value, name, observation);
    const bool is_picture =
        source.shape.size() == 3 && source.shape[2] == 3 && !source.values.empty();
    if (is_picture && value.from.size() == 1) return WritePicture(value, source, writer);
    if (is_picture || !value.size.empty()) {
      Fail(value.key, "a picture must be the only source, and only a picture has a size");
    }
    if (value.joints.empty()) {
      numbers.insert(numbers.end(), source.values.begin(), source.values.end());
    } else {
      AppendJoints(number, name, source, numbers);
    }
  }
  WriteNumbers(value, numbers, writer);
}

std::string ServerExchange::FormatQuestion(const PolicyValues& observation) {
  MessagePackWriter writer;
  if (!server_.is_mapped) {
    writer.Map(observation.size() + (is_first_ ? 1 : 0));
    WritePolicyValues(observation, writer);
    if (is_first_) {
      writer.Text("reset");
      writer.Value(facts_);
    }
    is_first_ = false;
    return writer.bytes();
  }
  const std::vector<ServerValue>& values = server_.observation;
  const auto count = [&](const std::string& under) {
    return static_cast<size_t>(std::count_if(
        values.begin(), values.end(), [&](const auto& value) { return value.under == under; }));
  };
  const auto write = [&](const std::string& under) {
    for (size_t i = 0; i < values.size(); ++i) {
      if (values[i].under == under) WriteValue(i, observation, writer);
    }
  };
  writer.Map(count("") + maps_.size());
  write("");
  for (const std::string& name : maps_) {
    writer.Text(name);
    writer.Map(count(name));
    write(name);
  }
  return writer.bytes();
}

/** An answer of ours, of rows of the server. */
PackedValue ServerExchange::TranslateRows(const PackedArray& rows,
                                          const PolicyValues& observation) const {
  const size_t width = columns_.joint.size();
  const size_t num_sizes = rows.shape.size();
  if (num_sizes < 1 || num_sizes > 2 || rows.shape.back() != width || rows.values.empty()) {
    std::string shape;
    for (const size_t size : rows.shape)
      shape += (shape.empty() ? "" : ", ") + std::to_string(size);
    throw PolicyFault(server_.actions.key + " has the shape (" + shape +
                      "); expected one row or more of " + std::to_string(width) +
                      (server_.actions.columns.empty()
                           ? " driven joints; actions.columns names other columns"
                           : " columns"));
  }
  const auto says = [&](int column, size_t row) {
    return column >= 0 && rows.values[row * width + static_cast<size_t>(column)] > 0.5;
  };
  const auto ends = [&](size_t row) {
    return says(columns_.done, row) || says(columns_.hold, row);
  };
  size_t num_rows = 1;  // the answer after these says it with its first row
  while (!ends(0) && num_rows < rows.values.size() / width && !ends(num_rows)) ++num_rows;
  const PackedArray* last = FindObserved(observation, "targets");
  const bool begins_at_zero = server_.actions.are_increments || !last;
  PackedValue::Map answer = {{"done", {says(columns_.done, 0)}}};
  if (says(columns_.hold, 0)) answer.emplace_back("hold", PackedValue{std::string("margin")});
  const auto add = [&](const char* name, const std::vector<int>& places,
                       const std::vector<double>& fill) {
    std::vector<double> values = PickColumns(rows, places, num_rows, fill);
    if (values.empty()) return;
    answer.emplace_back(name, PackedValue{PackedArray{{num_rows, fill.size()}, std::move(values)}});
  };
  add(server_.actions.are_increments ? "increments" : "targets", columns_.joint,
      begins_at_zero ? std::vector<double>(driven_.size()) : last->values);
  add("hand_pose", columns_.pose, std::vector<double>(ListPoseColumns().size()));
  add("hand_twist", columns_.twist, std::vector<double>(ListTwistColumns().size()));
  return {std::move(answer)};
}

PolicyAction ServerExchange::ReadAnswer(const PolicyValues& observation,
                                        std::string_view answer) const {
  const auto num_driven = static_cast<Eigen::Index>(driven_.size());
  try {
    const PackedValue value = ParseMessagePack(answer);
    if (server_.is_mapped) {
      const PackedValue* rows = value.Find(server_.actions.key);
      if (!rows) throw PolicyFault("the answer has no " + server_.actions.key);
      return ReadPolicyAction(
          TranslateRows(ReadPackedArray(*rows, server_.actions.key), observation), num_driven);
    }
    PackedValue::Map known;  // what servers add beside our names is theirs
    if (const PackedValue* rows = value.Find("actions")) known.emplace_back("targets", *rows);
    for (const PolicyTerm& term : ListPolicyActions()) {
      if (const PackedValue* found = value.Find(term.name)) known.emplace_back(term.name, *found);
    }
    return ReadPolicyAction({std::move(known)}, num_driven);
  } catch (const Error& error) {
    throw PolicyFault(error.what());
  }
}

}  // namespace graspbench
