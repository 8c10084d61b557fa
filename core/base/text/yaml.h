#pragma once
/** @file
YAML with positions: all wrong keys and values are reported together, with file and line.

    Diagnostics problems;
    const YAML::Node root = LoadYaml(path, problems);
    YamlMap map(root, path.string(), "hand", problems);
    map.Read("name", name);                        // required
    map.Read("trials", trials, Needed::kNo);       // keeps the default when absent
    map.FinishKnownKeys();                         // unknown keys are errors
    problems.ThrowIfErrors(ErrorKind::kFormat, "the hand cannot be used"); */

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/file_keys.h"

namespace graspbench {

enum class Needed { kYes, kNo };

/** Reads a YAML file. A syntax error is added to `problems` with its line, and a null node is
returned. */
YAML::Node LoadYaml(const std::filesystem::path& path, Diagnostics& problems);
/** Parses YAML text; `file` is its name in messages. */
YAML::Node ParseYaml(const std::string& text, const std::string& file, Diagnostics& problems);

/** Returns the one-based line of a node; 0 if unknown. */
int LineOf(const YAML::Node& node);

class YamlMap {
 public:
  /** @param where   name of this map for messages: "grasp g2".
  @param keys    rows of the format with the ranges of its numbers; null: none.
  @param prefix  prefix of this map's keys in `keys`: "palm.". */
  YamlMap(const YAML::Node& node, std::string file, std::string where, Diagnostics& problems,
          const FileKeys* keys = nullptr, std::string prefix = "");

  bool Has(const std::string& key) const;
  /** Reads a string, number, integer, boolean, vector of three, or list of numbers or strings. */
  template <class T>
  void Read(const std::string& key, T& value, Needed needed = Needed::kYes);
  /** Returns a child node of any type and marks the key as known; null if absent. */
  YAML::Node Child(const std::string& key, Needed needed = Needed::kYes);
  /** Reports a problem at the line of `key`, or at the line of the map if the key is absent. */
  void Fail(const std::string& key, const std::string& text);
  /** Reports every key that was never requested, with a suggestion, and every duplicate key. Call
  once, last. */
  void FinishKnownKeys();

 private:
  YAML::Node Find(const std::string& key, Needed needed);
  void Note(const std::string& key, const std::string& fallback, Needed needed) const;

  YAML::Node node_;
  std::string file_;
  std::string where_;
  const FileKeys* keys_;
  std::string prefix_;
  Diagnostics* problems_;
  std::vector<std::string> known_;
};

/** For tests: records, during its lifetime, the keys that this thread requests from maps with
rows. */
class KeyRecorder {
 public:
  KeyRecorder();
  ~KeyRecorder();
  KeyRecorder(const KeyRecorder&) = delete;
  KeyRecorder& operator=(const KeyRecorder&) = delete;
  /** Each requested key once, in the order of requests; without meaning and range. */
  const FileKeys& keys() const { return keys_; }

 private:
  friend class YamlMap;
  FileKeys keys_;
  KeyRecorder* outer_;
};

/** Formats a string in double quotes, as in YAML and JSON. Bytes that are not UTF-8 become
U+FFFD. */
std::string QuoteYaml(const std::string& text);

/** Returns the text unchanged if YAML can only read it as this string, otherwise quoted. Unquoted
text begins with a letter and has only letters, digits, _, - and points. It is no word that has
another meaning in YAML, such as "yes". */
std::string FormatYamlWord(const std::string& text);

}  // namespace graspbench
