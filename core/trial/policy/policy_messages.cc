#include "core/trial/policy/policy_messages.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
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

/** @throws PolicyFault for unknown keys, and for an error reported by the controller. */
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
                        "; expected targets or increments, done, and what else the manual's page "
                        "controllers lists");
    }
  }
}

std::string FormatShape(const std::vector<size_t>& shape) {
  std::string text = "(";
  for (size_t i = 0; i < shape.size(); ++i) text += (i ? ", " : "") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

/** Reads one row or several. @param columns  number of columns. */
Eigen::MatrixXd ReadRows(const PackedValue& value, const std::string& name, size_t columns) {
  PackedArray array;
  try {
    array = ReadPackedArray(value, name);
  } catch (const Error& error) {
    throw PolicyFault(error.what());
  }
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
                                    static_cast<Eigen::Index>(columns));
}

/** Reads the rows of an answer; one row applies to all. @throws PolicyFault for other numbers of
rows. */
class ActionReader {
 public:
  explicit ActionReader(const PackedValue& answer) : answer_(answer) {}

  /** Returns no rows if there is no such key. */
  Eigen::MatrixXd Read(const char* name, size_t columns) {
    const PackedValue* value = answer_.Find(name);
    if (!value) return {};
    Eigen::MatrixXd rows = ReadRows(*value, name, columns);
    if (num_rows_ > 1 && rows.rows() > 1 && rows.rows() != num_rows_) {
      throw PolicyFault(fmt::format("{} has {} rows; expected {}, as {} has, or one", name,
                                    rows.rows(), num_rows_, longest_));
    }
    if (rows.rows() > num_rows_) {
      num_rows_ = rows.rows();
      longest_ = name;
    }
    return rows;
  }
  void Fill(Eigen::MatrixXd& rows) const {
    if (rows.rows() == 1) rows = Eigen::MatrixXd(rows.replicate(num_rows_, 1));
  }
  Eigen::Index num_rows() const { return num_rows_; }
  /** Reads one of two keys, or neither. */
  void CheckOne(const char* a, const char* b) const {
    if (answer_.Find(a) && answer_.Find(b)) {
      throw PolicyFault(fmt::format("the answer has {} and {}; give one", a, b));
    }
  }

 private:
  const PackedValue& answer_;
  Eigen::Index num_rows_ = 0;
  const char* longest_ = "";
};

std::vector<Pose> ReadPoses(const Eigen::MatrixXd& rows) {
  constexpr double kNotUnit = 0.01;
  std::vector<Pose> poses;
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    const Eigen::Quaterniond q(rows(row, 3), rows(row, 4), rows(row, 5), rows(row, 6));
    if (std::abs(q.norm() - 1.0) > kNotUnit) {
      throw PolicyFault(fmt::format(
          "the quaternion of hand_pose in row {} has the length {:g}; expected 1", row, q.norm()));
    }
    poses.push_back(MakePose(q.normalized().toRotationMatrix(), rows.row(row).head<3>()));
  }
  return poses;
}

std::optional<GripMode> ReadHold(const PackedValue& answer) {
  const PackedValue* hold = answer.Find("hold");
  if (!hold) return std::nullopt;
  const std::string name = hold->text() ? *hold->text() : std::string();
  for (const GripMode mode : {GripMode::kForce, GripMode::kMargin}) {
    if (name == RowOf(kGripModes, mode).name) return mode;
  }
  throw PolicyFault("hold is " + (hold->text() ? Quote(name) : std::string("no text")) +
                    "; expected force or margin");
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

PolicyValues FindPolicyValues(const PolicyView& view) {
  PolicyValues found;
  RandomStream noise(std::to_string(view.setup.policy_seed) + "/" + std::to_string(view.question),
                     "controller noise");
  for (const PolicyObservation& one : ListPolicyObservations()) {
    if (!one.is_given(view)) continue;
    PackedArray& array = found.emplace_back(one.term.name, PackedArray()).second;
    one.find(view, array.values);
    if (one.noise && view.setup.policy.*one.noise > 0.0) {
      for (double& value : array.values) {
        value += view.setup.policy.*one.noise * noise.NextNormal();
      }
    }
    const auto side = static_cast<size_t>(view.setup.policy.picture);
    if (one.is_picture) {
      array.shape = {side, side, 3};
    } else if (!one.is_number) {
      array.shape = {array.values.size()};
    }
  }
  return found;
}

void WritePolicyValues(const PolicyValues& values, MessagePackWriter& writer) {
  for (const auto& [name, array] : values) {
    writer.Text(name);
    if (array.shape.empty()) {
      writer.Number(array.values.front());
    } else if (array.shape.size() == 3) {
      std::string bytes;
      for (const double value : array.values) {
        bytes.push_back(static_cast<char>(static_cast<uint8_t>(value)));
      }
      writer.RawArray(bytes, "|u1", array.shape);
    } else {
      writer.Array(array.values.data(), array.shape);
    }
  }
}

std::string FormatPolicyQuestion(uint64_t number, const PolicyView& view) {
  const PolicyValues values = FindPolicyValues(view);
  MessagePackWriter writer;
  writer.Map(2);
  writer.Text(kNumber);
  writer.Integer(number);
  writer.Text("observation");
  writer.Map(values.size());
  WritePolicyValues(values, writer);
  return writer.bytes();
}

PackedValue ParsePolicyAnswer(std::string_view answer) {
  try {
    return ParseMessagePack(answer);
  } catch (const Error& error) {
    throw PolicyFault(std::string("the answer is no MessagePack that is understood: ") +
                      error.what());
  }
}

uint64_t ReadPolicyAnswerNumber(const PackedValue& answer) {
  const PackedValue* number = answer.Find(kNumber);
  const double* read = number ? std::get_if<double>(&number->value) : nullptr;
  if (!read || !(*read >= 0.0) || *read > 1e15) {
    throw PolicyFault("the answer lacks the number of its question");
  }
  return static_cast<uint64_t>(*read);
}

PolicyAction ReadPolicyAction(const PackedValue& answer, Eigen::Index num_driven) {
  CheckKeys(answer);
  PolicyAction action;
  if (const PackedValue* done = answer.Find("done")) {
    const bool* is_done = std::get_if<bool>(&done->value);
    if (!is_done) throw PolicyFault("done is neither true nor false");
    action.is_done = *is_done;
  }
  action.hold = ReadHold(answer);
  ActionReader reader(answer);
  reader.CheckOne("targets", "increments");
  reader.CheckOne("hand_pose", "hand_twist");
  action.are_increments = answer.Find("increments") != nullptr;
  const auto columns = static_cast<size_t>(num_driven);
  action.rows = reader.Read(action.are_increments ? "increments" : "targets", columns);
  action.stiffness = reader.Read("stiffness", columns);
  Eigen::MatrixXd poses = reader.Read("hand_pose", 7), twists = reader.Read("hand_twist", 6);
  if (reader.num_rows() == 0 && !action.is_done && !action.hold) {
    throw PolicyFault(
        "the answer has no targets, no increments, no motion of the hand and no done: true; "
        "increments of zeros keep the digits still");
  }
  for (Eigen::MatrixXd* rows : {&action.rows, &action.stiffness, &poses, &twists}) {
    reader.Fill(*rows);
  }
  action.poses = ReadPoses(poses);
  if (twists.rows() > 0) action.twists = twists;
  return action;
}

void CheckPolicyReset(const PackedValue& answer) {
  CheckKeys(answer);
  if (std::get<PackedValue::Map>(answer.value).size() == 1) return;
  throw PolicyFault("the answer to a reset has an action; nothing was asked yet");
}

}  // namespace graspbench
