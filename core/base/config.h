#pragma once
/** @file
Configurations as plain structs. A struct lists each field once, with its default beside it:

    struct SimConfig {
      double step = 0.002;

      template <class V>
      void Visit(V&& v) {
        v("step_s", step, {"time step of the physics", 1e-4, 1e-2});
      }
    };

This listing drives reading YAML, writing and reading JSON, `--set sim.step_s=0.001`, range checks,
and the rows of help and schema (KeyInfo, FileKeys). A field is an int, double, bool, std::string,
std::vector<std::string> or another such struct. A list of strings may be given as one string with
commas: "tum, shadow". */

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/file_keys.h"
#include "core/base/text/json.h"
#include "core/base/text/yaml.h"

namespace graspbench {

namespace internal {

struct AnyVisitor {
  template <class T>
  void operator()(const char*, T&, const KeyInfo& = {}) const {}
};

template <class T, class = void>
struct HasVisit : std::false_type {};
template <class T>
struct HasVisit<T, std::void_t<decltype(std::declval<T&>().Visit(AnyVisitor()))>> : std::true_type {
};

class JsonConfigWriter {
 public:
  template <class T>
  void operator()(const char* key, T& value, const KeyInfo& = {}) {
    if constexpr (HasVisit<T>::value) {
      JsonConfigWriter inner;
      value.Visit(inner);
      json_[key] = inner.json_;
    } else {
      json_[key] = value;
    }
  }
  const Json& json() const { return json_; }

 private:
  Json json_ = Json::object();
};

/** Reads a stored configuration, which must be complete: every key must be present, and no
other. */
class JsonConfigReader {
 public:
  /** @param where  prefix of the full keys: "" or "sim.". */
  JsonConfigReader(const Json& json, std::string file, std::string where, Diagnostics& problems);

  template <class T>
  void operator()(const char* key, T& value, const KeyInfo& = {}) {
    const Json* child = FindChild(key);
    if (!child) return;
    if constexpr (HasVisit<T>::value) {
      JsonConfigReader inner(*child, file_, where_ + key + ".", *problems_);
      value.Visit(inner);
      inner.FinishKnownKeys();
    } else {
      Read(key, *child, value);
    }
  }
  void FinishKnownKeys();

 private:
  const Json* FindChild(const std::string& key);
  void Read(const std::string& key, const Json& json, int& value);
  void Read(const std::string& key, const Json& json, double& value);
  void Read(const std::string& key, const Json& json, bool& value);
  void Read(const std::string& key, const Json& json, std::string& value);
  void Read(const std::string& key, const Json& json, std::vector<std::string>& value);
  void Fail(const std::string& key, const std::string& text);

  const Json* json_;
  std::string file_;
  std::string where_;
  Diagnostics* problems_;
  std::vector<std::string> known_;
};

/** Reads a YAML map; fields whose keys are absent keep their defaults. */
class YamlConfigReader {
 public:
  YamlConfigReader(const YAML::Node& node, const std::string& file, const std::string& where,
                   Diagnostics& problems)
      : map_(node, file, where, problems), file_(file), problems_(&problems) {}

  template <class T>
  void operator()(const char* key, T& value, const KeyInfo& = {}) {
    if constexpr (HasVisit<T>::value) {
      const YAML::Node child = map_.Child(key, Needed::kNo);
      if (child.IsNull()) return;
      YamlConfigReader inner(child, file_, key, *problems_);
      value.Visit(inner);
      inner.FinishKnownKeys();
    } else {
      Read(key, value);
    }
  }
  void FinishKnownKeys() { map_.FinishKnownKeys(); }

 private:
  template <class T>
  void Read(const char* key, T& value) {
    map_.Read(key, value, Needed::kNo);
  }
  void Read(const char* key, std::vector<std::string>& value);

  YamlMap map_;
  std::string file_;
  Diagnostics* problems_;
};

template <class T>
constexpr KeyType KeyTypeOf() {
  if (std::is_same_v<T, bool>) return KeyType::kBoolean;
  const bool is_number = std::is_arithmetic_v<T> || std::is_same_v<T, std::vector<double>>;
  return is_number ? KeyType::kNumber : KeyType::kAny;
}

class KeyLister {
 public:
  /** @param group  attributes of the visited struct; they apply to fields that have none. */
  KeyLister(std::string where, const KeyInfo& group, FileKeys& keys)
      : where_(std::move(where)), group_(group), keys_(&keys) {}
  template <class T>
  void operator()(const char* key, T& value, const KeyInfo& info = {}) {
    if constexpr (HasVisit<T>::value) {
      value.Visit(KeyLister(where_ + key + ".", info, *keys_));
    } else {
      Add(key, value, KeyTypeOf<T>(), info);
    }
  }

 private:
  void Add(const char* key, const Json& value, KeyType type, const KeyInfo& info);

  std::string where_;
  KeyInfo group_;
  FileKeys* keys_;
};

/** Parses "sim.step_s=0.001" into {sim: {step_s: 0.001}}.
@throws Error(kUsage) if it is not of that form or if the key is unknown. */
YAML::Node ParseSetting(const std::string& assignment, const std::vector<std::string>& known);

std::vector<std::pair<std::string, std::string>> FindOutOfRange(
    const Json& config, const Json& defaults, const std::vector<std::string>& names,
    const FileKeys& keys);

/** @pre both come from ConfigToJson of the same struct. */
void FindDifferences(const Json& a, const Json& b, const std::string& where,
                     std::vector<std::string>& differences);

}  // namespace internal

/** Returns the complete configuration, in the order of its fields. */
template <class Config>
Json ConfigToJson(Config config) {
  internal::JsonConfigWriter writer;
  config.Visit(writer);
  return writer.json();
}

/** Returns whether all values are equal; NaN is not equal to anything. */
template <class Config>
[[nodiscard]] bool HaveEqualValues(Config a, Config b) {
  return ConfigToJson(std::move(a)) == ConfigToJson(std::move(b));
}

/** Reads a complete configuration; missing and unknown keys and wrong types go into `problems`. */
template <class Config>
Config ConfigFromJson(const Json& json, const std::string& file, Diagnostics& problems) {
  Config config;
  internal::JsonConfigReader reader(json, file, "", problems);
  config.Visit(reader);
  reader.FinishKnownKeys();
  return config;
}

/** Overwrites the values in `config` that a YAML document gives; an empty document gives none.
@param what  name of what the document describes, for messages: "session". */
template <class Config>
void ReadConfig(const YAML::Node& root, const std::string& file, const std::string& what,
                Config& config, Diagnostics& problems) {
  if (!root.IsDefined() || root.IsNull()) return;
  internal::YamlConfigReader reader(root, file, what, problems);
  config.Visit(reader);
  reader.FinishKnownKeys();
}

/** Returns the rows of a configuration's keys, in the order of its fields, with the defaults of
`config`. */
template <class Config>
FileKeys DescribeConfig(Config config) {
  FileKeys keys;
  config.Visit(internal::KeyLister("", {}, keys));
  return keys;
}

/** Returns the full names of all values: "trials", "sim.step_s", ... */
template <class Config>
std::vector<std::string> ListConfigKeys(const Config& config) {
  std::vector<std::string> names;
  for (FileKey& row : DescribeConfig(config)) names.push_back(std::move(row.key));
  return names;
}

/** Returns the numbers that are outside the ranges of their rows, as pairs of the key and a text:
"-1 is out of range; expected 0 to 1". NaN is accepted where the default is NaN. */
template <class Config>
std::vector<std::pair<std::string, std::string>> FindOutOfRange(const Config& config,
                                                                const FileKeys& keys) {
  return internal::FindOutOfRange(ConfigToJson(config), ConfigToJson(Config()),
                                  ListConfigKeys(config), keys);
}

/** Applies a setting such as "sim.step_s=0.001".
@throws Error(kUsage) naming the known keys or the expected type. */
template <class Config>
void SetConfigValue(const std::string& assignment, Config& config) {
  const YAML::Node node = internal::ParseSetting(assignment, ListConfigKeys(config));
  Diagnostics problems;
  ReadConfig(node, "", "setting", config, problems);
  if (problems.num_errors() > 0) {
    throw Error(ErrorKind::kUsage,
                "--set \"" + assignment + "\": " + problems.entries().front().text);
  }
}

/** Lists where two configurations differ, in the order of the fields: "sim.step_s: 0.002 and
0.001". */
template <class Config>
std::vector<std::string> FindConfigDifferences(const Config& a, const Config& b) {
  std::vector<std::string> differences;
  internal::FindDifferences(ConfigToJson(a), ConfigToJson(b), "", differences);
  return differences;
}

/** Returns the line of a full key in a YAML document; 0 if the key is absent. */
int FindConfigLine(const YAML::Node& root, std::string_view full_key);

}  // namespace graspbench
