#include "core/trial/policy/policy_messages.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/text/message_pack.h"
#include "core/base/text/text.h"
#include "core/trial/policy/policy_terms.h"
#include "core/trial/trial_setup.h"

namespace graspbench {
namespace {

constexpr char kNumber[] = "number";
constexpr size_t kMostRows = 1000;
constexpr size_t kMostQuoted = 200;

void WriteJson(const Json& json, MessagePackWriter& writer) {
  switch (json.type()) {
    case Json::Type::kBoolean:
      return writer.Bool(json.get<bool>());
    case Json::Type::kInteger:
    case Json::Type::kUnsigned:
      if (json.get<double>() >= 0.0) return writer.Integer(json.get<uint64_t>());
      return writer.Number(json.get<double>());
    case Json::Type::kFloat:
      return writer.Number(json.get<double>());
    case Json::Type::kString:
      return writer.Text(json.get<std::string>());
    case Json::Type::kArray:
      writer.List(json.size());
      for (const Json& item : json) WriteJson(item, writer);
      return;
    case Json::Type::kObject:
      writer.Map(json.size());
      for (const auto& [key, value] : json.items()) {
        writer.Text(key);
        WriteJson(value, writer);
      }
      return;
    default:
      return writer.Number(kUnset);
  }
}

std::string Quote(const std::string& text) {
  const std::string part = text.substr(0, kMostQuoted);
  return IsUtf8(part) ? "\"" + part + "\"" : "a text that is not UTF-8";
}

PackedValue ParseAnswer(std::string_view answer) {
  try {
    return ParseMessagePack(answer);
  } catch (const Error& error) {
    throw PolicyFault(std::string("the answer is no MessagePack that is understood: ") +
                      error.what());
  }
}

/** @throws PolicyFault for keys that no answer has, and for an error of the controller. */
void CheckKeys(const PackedValue& answer) {
  const auto* map = std::get_if<PackedValue::Map>(&answer.value);
  if (!map) throw PolicyFault("the answer is no map");
  if (const PackedValue* error = answer.Find("error")) {
    throw PolicyFault("the controller gave up: " +
                      (error->text() ? Quote(*error->text()) : std::string("no text")));
  }
  for (const auto& [key, value] : *map) {
    const auto& actions = ListPolicyActions();
    const bool is_known = key == kNumber || std::any_of(actions.begin(), actions.end(),
                                                        [&name = key](const auto& term) {
                                                          return name == term.name;
                                                        });
    if (!is_known) {
      throw PolicyFault("the answer has the key " + Quote(key) +
                        "; expected targets or increments, and done");
    }
  }
}

std::string FormatShape(const std::vector<size_t>& shape) {
  std::string text = "(";
  for (size_t i = 0; i < shape.size(); ++i) text += (i ? ", " : "") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

Eigen::MatrixXd ReadRows(const PackedValue& value, const std::string& name,
                         Eigen::Index num_driven) {
  PackedArray array;
  try {
    array = ReadPackedArray(value, name);
  } catch (const Error& error) {
    throw PolicyFault(error.what());
  }
  const auto columns = static_cast<size_t>(num_driven);
  const bool is_row = array.shape.size() == 1 && array.shape[0] == columns;
  const bool is_table = array.shape.size() == 2 && array.shape[1] == columns && array.shape[0] > 0;
  if (!is_row && !is_table) {
    throw PolicyFault(fmt::format("{} has the shape {}; expected ({},) or (rows, {})", name,
                                  FormatShape(array.shape), columns, columns));
  }
  const size_t num_rows = is_row ? 1 : array.shape[0];
  if (num_rows > kMostRows) {
    throw PolicyFault(
        fmt::format("{} has {} rows; at most {} are taken", name, num_rows, kMostRows));
  }
  for (size_t i = 0; i < array.values.size(); ++i) {
    if (std::isfinite(array.values[i])) continue;
    throw PolicyFault(fmt::format("{} holds {} in row {}, column {}; expected finite numbers", name,
                                  std::isnan(array.values[i]) ? "NaN" : "an infinite number",
                                  i / columns, i % columns));
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(array.values.data(), static_cast<Eigen::Index>(num_rows),
                                    num_driven);
}

}  // namespace

std::string FormatPolicyReset(uint64_t number, const PolicyView& view) {
  Json facts = Json::object();
  for (const PolicyFact& fact : ListPolicyFacts()) {
    Json value = fact.find(view);
    if (!value.is_null()) facts[fact.term.name] = std::move(value);
  }
  MessagePackWriter writer;
  writer.Map(2);
  writer.Text(kNumber);
  writer.Integer(number);
  writer.Text("reset");
  WriteJson(facts, writer);
  return writer.bytes();
}

std::string FormatPolicyQuestion(uint64_t number, const PolicyView& view) {
  const std::vector<PolicyObservation>& all = ListPolicyObservations();
  MessagePackWriter writer;
  writer.Map(2);
  writer.Text(kNumber);
  writer.Integer(number);
  writer.Text("observation");
  writer.Map(static_cast<size_t>(
      std::count_if(all.begin(), all.end(), [&](const auto& one) { return one.is_given(view); })));
  RandomStream noise(std::to_string(view.setup.policy_seed) + "/" + std::to_string(view.question),
                     "controller noise");
  std::vector<double> values;
  for (const PolicyObservation& one : all) {
    if (!one.is_given(view)) continue;
    values.clear();
    one.find(view, values);
    if (one.noise && view.setup.policy.*one.noise > 0.0) {
      for (double& value : values) value += view.setup.policy.*one.noise * noise.NextNormal();
    }
    writer.Text(one.term.name);
    if (one.is_number) {
      writer.Number(values.front());
    } else {
      writer.Array(values);
    }
  }
  return writer.bytes();
}

uint64_t ReadPolicyAnswerNumber(std::string_view answer) {
  const PackedValue value = ParseAnswer(answer);
  const PackedValue* number = value.Find(kNumber);
  const double* read = number ? std::get_if<double>(&number->value) : nullptr;
  if (!read || !(*read >= 0.0) || *read > 1e15) {
    throw PolicyFault("the answer lacks the number of its question");
  }
  return static_cast<uint64_t>(*read);
}

PolicyAction ReadPolicyAction(std::string_view answer, Eigen::Index num_driven) {
  const PackedValue value = ParseAnswer(answer);
  CheckKeys(value);
  PolicyAction action;
  if (const PackedValue* done = value.Find("done")) {
    const bool* is_done = std::get_if<bool>(&done->value);
    if (!is_done) throw PolicyFault("done is neither true nor false");
    action.is_done = *is_done;
  }
  const PackedValue* targets = value.Find("targets");
  const PackedValue* increments = value.Find("increments");
  if (targets && increments) throw PolicyFault("the answer has targets and increments; give one");
  if (!targets && !increments) {
    if (!action.is_done) throw PolicyFault("the answer has no targets, no increments and no done");
    return action;
  }
  action.are_increments = increments != nullptr;
  action.rows = targets ? ReadRows(*targets, "targets", num_driven)
                        : ReadRows(*increments, "increments", num_driven);
  return action;
}

void CheckPolicyReset(std::string_view answer) {
  const PackedValue value = ParseAnswer(answer);
  CheckKeys(value);
  if (std::get<PackedValue::Map>(value.value).size() == 1) return;
  throw PolicyFault("the answer to a reset has an action; nothing was asked yet");
}

}  // namespace graspbench
