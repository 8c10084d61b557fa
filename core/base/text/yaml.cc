#include "core/base/text/yaml.h"

#include <fmt/core.h>
#include <yaml-cpp/depthguard.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "core/base/files/files.h"
#include "core/base/text/json.h"
#include "core/base/text/text.h"

namespace graspbench {

YAML::Node LoadYaml(const std::filesystem::path& path, Diagnostics& problems) {
  return ParseYaml(ReadFile(path), path.string(), problems);
}

YAML::Node ParseYaml(const std::string& text, const std::string& file, Diagnostics& problems) {
  try {
    return YAML::Load(text);
  } catch (const YAML::DeepRecursion& e) {  // its own message is "bad file"
    problems.Fail(file, e.mark.line + 1,
                  fmt::format("nested deeper than {} levels; expected fewer", e.depth()));
    return YAML::Node();
  } catch (const YAML::Exception& e) {
    problems.Fail(file, e.mark.line + 1, "not valid YAML: " + e.msg);
    return YAML::Node();
  }
}

int LineOf(const YAML::Node& node) { return node.IsDefined() ? node.Mark().line + 1 : 0; }

namespace {

thread_local KeyRecorder* recorder = nullptr;

}  // namespace

KeyRecorder::KeyRecorder() : outer_(std::exchange(recorder, this)) {}
KeyRecorder::~KeyRecorder() { recorder = outer_; }

YamlMap::YamlMap(const YAML::Node& node, std::string file, std::string where, Diagnostics& problems,
                 const FileKeys* keys, std::string prefix)
    : node_(node),
      file_(std::move(file)),
      where_(std::move(where)),
      keys_(keys),
      prefix_(std::move(prefix)),
      problems_(&problems) {
  if (!node_.IsMap()) {
    problems_->Fail(file_, LineOf(node_), where_ + ": expected a map of keys and values");
    node_ = YAML::Node(YAML::NodeType::Map);
  }
}

bool YamlMap::Has(const std::string& key) const {
  const YAML::Node& node = node_;  // the const operator[] does not create the key
  return node[key].IsDefined();
}

void YamlMap::Note(const std::string& key, const std::string& fallback, Needed needed) const {
  if (recorder == nullptr || keys_ == nullptr) return;
  FileKeys& keys = recorder->keys_;
  if (FindFileKey(keys, prefix_ + key) != nullptr) return;
  keys.push_back({prefix_ + key, needed == Needed::kYes ? kRequired : fallback, ""});
}

YAML::Node YamlMap::Child(const std::string& key, Needed needed) {
  Note(key, "", needed);
  return Find(key, needed);
}

YAML::Node YamlMap::Find(const std::string& key, Needed needed) {
  known_.push_back(key);
  const YAML::Node& node = node_;
  const YAML::Node child = node[key];
  if (child.IsDefined()) return child;
  if (needed == Needed::kYes) {
    problems_->Fail(file_, LineOf(node_), where_ + ": the key \"" + key + "\" is missing");
  }
  return YAML::Node();
}

void YamlMap::Fail(const std::string& key, const std::string& text) {
  const YAML::Node& node = node_;
  const YAML::Node child = node[key];
  YAML::Node place = child.IsDefined() ? child : node_;
  if (place.IsNull()) {  // a missing value would be located at the next token
    for (const auto& entry : node) {
      if (entry.first.IsScalar() && entry.first.Scalar() == key) place.reset(entry.first);
    }
  }
  problems_->Fail(file_, LineOf(place), where_ + (key.empty() ? "" : ", " + key) + ": " + text);
}

namespace {

bool IsFinite(double value) { return std::isfinite(value); }
bool IsFinite(const Eigen::Vector3d& value) { return value.allFinite(); }
bool IsFinite(const std::vector<double>& value) {
  return std::all_of(value.begin(), value.end(), [](double v) { return std::isfinite(v); });
}
template <class T>
bool IsFinite(const T&) {
  return true;
}

std::string FormatValue(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }
std::string FormatValue(int value) { return std::to_string(value); }
std::string FormatValue(bool value) { return value ? "true" : "false"; }
std::string FormatValue(const std::string& value) { return value; }
std::string FormatValue(const Eigen::Vector3d& value) {
  return value.allFinite() ? fmt::format("[{}, {}, {}]", value.x(), value.y(), value.z()) : "";
}
template <class T>
std::string FormatValue(const std::vector<T>& values) {
  std::string text;
  for (const T& value : values) text += (text.empty() ? "" : ", ") + FormatValue(value);
  return values.empty() ? "" : "[" + text + "]";
}

std::vector<double> ListNumbers(double value) { return {value}; }
std::vector<double> ListNumbers(int value) { return {static_cast<double>(value)}; }
std::vector<double> ListNumbers(const Eigen::Vector3d& value) {
  return {value.x(), value.y(), value.z()};
}
std::vector<double> ListNumbers(const std::vector<double>& values) { return values; }
template <class T>
std::vector<double> ListNumbers(const T&) {
  return {};
}

void Convert(const YAML::Node& node, Eigen::Vector3d& value) {
  const auto numbers = node.as<std::vector<double>>();
  if (numbers.size() != 3) throw YAML::Exception(node.Mark(), "three numbers");
  value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}
template <class T>
void Convert(const YAML::Node& node, T& value) {
  value = node.as<T>();
}

/** What is expected where a value of this type is read, for messages. */
template <class T>
constexpr const char* kExpected = nullptr;
template <>
constexpr const char* kExpected<std::string> = "a text";
template <>
constexpr const char* kExpected<double> = "a finite number";
template <>
constexpr const char* kExpected<int> = "a whole number";
template <>
constexpr const char* kExpected<bool> = "true or false";
template <>
constexpr const char* kExpected<Eigen::Vector3d> = "three finite numbers in brackets";
template <>
constexpr const char* kExpected<std::vector<double>> = "a list of finite numbers";
template <>
constexpr const char* kExpected<std::vector<std::string>> = "a list of texts";

}  // namespace

template <class T>
void YamlMap::Read(const std::string& key, T& value, Needed needed) {
  Note(key, FormatValue(value), needed);
  const YAML::Node child = Find(key, needed);
  if (!child.IsDefined() || child.IsNull()) {
    if (Has(key)) Fail(key, "the value is missing; one that begins with # needs quotes");
    return;
  }
  try {
    T read{};
    Convert(child, read);
    if (!IsFinite(read)) throw YAML::Exception(child.Mark(), "not finite");
    value = read;
    const FileKey* row = keys_ == nullptr ? nullptr : FindFileKey(*keys_, prefix_ + key);
    for (const double number : ListNumbers(read)) {
      if (row == nullptr || IsInRange(*row, number)) continue;
      Fail(key, fmt::format("{:.10g} is out of range; expected {}", number, FormatRange(*row)));
      break;
    }
  } catch (const YAML::Exception&) {
    Fail(key, std::string("expected ") + kExpected<T>);
  }
}

template void YamlMap::Read(const std::string&, std::string&, Needed);
template void YamlMap::Read(const std::string&, double&, Needed);
template void YamlMap::Read(const std::string&, int&, Needed);
template void YamlMap::Read(const std::string&, bool&, Needed);
template void YamlMap::Read(const std::string&, Eigen::Vector3d&, Needed);
template void YamlMap::Read(const std::string&, std::vector<double>&, Needed);
template void YamlMap::Read(const std::string&, std::vector<std::string>&, Needed);

void YamlMap::FinishKnownKeys() {
  std::set<std::string> seen;
  for (const auto& item : node_) {
    const std::string key = item.first.as<std::string>("");
    if (!seen.insert(key).second) {
      problems_->Fail(file_, LineOf(item.first), where_ + ": \"" + key + "\" is given twice");
    }
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
      problems_->Fail(file_, LineOf(item.first),
                      where_ + ": unknown key \"" + key + "\"" + SuggestNames(key, known_));
    }
  }
}

std::string QuoteYaml(const std::string& text) { return FormatJson(Json(text)); }

std::string FormatYamlWord(const std::string& text) {
  constexpr std::array<std::string_view, 9> kTaken = {"null", "true", "false", "yes", "no",
                                                      "on",   "off",  "y",     "n"};
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_plain = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
  };
  const bool is_word = !text.empty() && is_letter(text[0]) &&
                       std::all_of(text.begin(), text.end(), is_plain) &&
                       std::count(kTaken.begin(), kTaken.end(), ToLower(text)) == 0;
  return is_word ? text : QuoteYaml(text);
}

}  // namespace graspbench
