#include "core/base/config.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace graspbench {
namespace {

std::string Trim(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  for (size_t start = 0; start <= text.size();) {
    const size_t comma = std::min(text.find(',', start), text.size());
    parts.push_back(Trim(text.substr(start, comma - start)));
    start = comma + 1;
  }
  return parts;
}

}  // namespace

namespace internal {

JsonConfigReader::JsonConfigReader(const Json& json, std::string file, std::string where,
                                   Diagnostics& problems)
    : json_(&json), file_(std::move(file)), where_(std::move(where)), problems_(&problems) {
  if (!json.is_object()) Fail("", "expected an object of keys and values");
}

const Json* JsonConfigReader::FindChild(const std::string& key) {
  known_.push_back(key);
  if (!json_->is_object()) return nullptr;
  if (const Json* const child = json_->find(key)) return child;
  Fail(key, "is missing");
  return nullptr;
}

void JsonConfigReader::Fail(const std::string& key, const std::string& text) {
  problems_->Fail(file_, 0, where_ + key + ": " + text);
}

void JsonConfigReader::Read(const std::string& key, const Json& json, int& value) {
  try {
    value = IntFrom(json);
  } catch (const Error& e) {
    Fail(key, e.what());
  }
}

void JsonConfigReader::Read(const std::string& key, const Json& json, double& value) {
  if (!json.is_number()) return Fail(key, "expected a number");
  value = json.get<double>();
}

void JsonConfigReader::Read(const std::string& key, const Json& json, bool& value) {
  if (!json.is_boolean()) return Fail(key, "expected true or false");
  value = json.get<bool>();
}

void JsonConfigReader::Read(const std::string& key, const Json& json, std::string& value) {
  if (!json.is_string()) return Fail(key, "expected a text");
  value = json.get<std::string>();
}

void JsonConfigReader::Read(const std::string& key, const Json& json,
                            std::vector<std::string>& value) {
  const auto is_string = [](const Json& item) { return item.is_string(); };
  if (!json.is_array() || !std::all_of(json.begin(), json.end(), is_string)) {
    return Fail(key, "expected a list of texts");
  }
  value = json.get<std::vector<std::string>>();
}

void JsonConfigReader::FinishKnownKeys() {
  if (!json_->is_object()) return;
  for (const auto& [key, value] : json_->items()) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
      Fail(key, "unknown key" + SuggestNames(key, known_));
    }
  }
}

void YamlConfigReader::Read(const char* key, std::vector<std::string>& value) {
  const YAML::Node child = map_.Child(key, Needed::kNo);
  if (child.IsNull()) return;
  try {
    value = child.IsScalar() ? SplitAtCommas(child.Scalar()) : child.as<std::vector<std::string>>();
  } catch (const YAML::Exception&) {
    map_.Fail(key, "expected a list of texts");
  }
}

YAML::Node ParseSetting(const std::string& assignment, const std::vector<std::string>& known) {
  const size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Error(
        ErrorKind::kUsage,
        "--set \"" + assignment + "\": expected KEY=VALUE, for example " + known.front() + "=...");
  }
  const std::string key = Trim(assignment.substr(0, equals));
  if (std::find(known.begin(), known.end(), key) == known.end()) {
    const std::string group = key.substr(0, key.find('.')) + ".";  // of "policy.x" and of "policy"
    std::vector<std::string> beside;
    std::copy_if(known.begin(), known.end(), std::back_inserter(beside),
                 [&](const std::string& other) { return other.rfind(group, 0) == 0; });
    throw Error(ErrorKind::kUsage, "--set \"" + assignment + "\": no setting \"" + key + "\"" +
                                       SuggestNames(key, beside.empty() ? known : beside));
  }
  YAML::Node node;
  try {
    node = YAML::Load(assignment.substr(equals + 1));
  } catch (const YAML::Exception& e) {
    throw Error(ErrorKind::kUsage, "--set \"" + assignment + "\": not a YAML value: " + e.msg);
  }
  if (node.IsNull() && assignment[equals + 1] == '#') node = assignment.substr(equals + 1);
  if (node.IsNull()) {
    throw Error(ErrorKind::kUsage, "--set \"" + assignment + "\": the value is missing");
  }
  for (size_t end = key.size(); end != std::string::npos;) {
    const size_t dot = key.rfind('.', end - 1);
    const size_t start = dot == std::string::npos ? 0 : dot + 1;
    YAML::Node outer(YAML::NodeType::Map);
    outer[key.substr(start, end - start)] = node;
    node.reset(outer);
    end = dot;
  }
  return node;
}

namespace {

const Json& FindValue(const Json& config, const std::string& full_key) {
  const Json* value = &config;
  size_t begin = 0;
  for (size_t dot = full_key.find('.'); dot != full_key.npos; dot = full_key.find('.', begin)) {
    value = &value->at(full_key.substr(begin, dot - begin));
    begin = dot + 1;
  }
  return value->at(full_key.substr(begin));
}

std::string FormatDefault(const Json& value) {
  if (value.is_number() && std::isnan(value.get<double>())) return "";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_array()) {
    std::string text;
    for (const Json& item : value) text += (text.empty() ? "" : ", ") + FormatDefault(item);
    return value.empty() ? "" : "[" + text + "]";
  }
  return FormatJson(value);
}

}  // namespace

void KeyLister::Add(const char* key, const Json& value, KeyType type, const KeyInfo& info) {
  const bool has_range = std::isfinite(info.low) || std::isfinite(info.high);
  const KeyInfo& range = has_range ? info : group_;
  std::string fallback(info.fallback.empty() ? group_.fallback : info.fallback);
  if (fallback.empty()) fallback = FormatDefault(value);
  keys_->emplace_back(where_ + key, fallback, info.type == KeyType::kAny ? type : info.type,
                      *info.meaning == '\0' ? group_.meaning : info.meaning, range.low, range.high);
}

std::vector<std::pair<std::string, std::string>> FindOutOfRange(
    const Json& config, const Json& defaults, const std::vector<std::string>& names,
    const FileKeys& keys) {
  std::vector<std::pair<std::string, std::string>> found;
  for (const std::string& name : names) {
    const FileKey* row = FindFileKey(keys, name);
    if (row == nullptr || FormatRange(*row).empty()) continue;
    const Json &value = FindValue(config, name), &usual = FindValue(defaults, name);
    const bool may_be_unset = usual.is_number() && std::isnan(usual.get<double>());
    const Json list = value.is_array() ? value : Json::array({value});
    for (const Json& item : list) {
      const double number = NumberFrom(item);
      if (IsInRange(*row, number) || (std::isnan(number) && may_be_unset)) continue;
      found.emplace_back(
          name, fmt::format("{:.10g} is out of range; expected {}", number, FormatRange(*row)));
      break;
    }
  }
  return found;
}

void FindDifferences(const Json& a, const Json& b, const std::string& where,
                     std::vector<std::string>& differences) {
  for (const auto& [key, value] : a.items()) {
    const Json& other = b.at(key);
    if (value.is_object()) {
      FindDifferences(value, other, where + key + ".", differences);
    } else if (value != other) {
      differences.push_back(where + key + ": " + FormatJson(value) + " and " + FormatJson(other));
    }
  }
}

}  // namespace internal

int FindConfigLine(const YAML::Node& root, std::string_view full_key) {
  if (!root.IsMap()) return 0;
  const size_t dot = full_key.find('.');
  const YAML::Node child = root[std::string(full_key.substr(0, dot))];
  if (!child.IsDefined()) return 0;
  if (dot == std::string_view::npos) return LineOf(child);
  return FindConfigLine(child, full_key.substr(dot + 1));
}

}  // namespace graspbench
