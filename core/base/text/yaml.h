#pragma once
/** @file
YAML with positions: every wrong key or value is reported with file and line, all at once.

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

/** Reads a YAML file. A syntax error goes into `problems` with its line and gives a null node. */
YAML::Node LoadYaml(const std::filesystem::path& path, Diagnostics& problems);
/** The same for text in memory; `file` is its name in messages. */
YAML::Node ParseYaml(const std::string& text, const std::string& file, Diagnostics& problems);

/** One-based line of a node, 0 when unknown. */
int LineOf(const YAML::Node& node);

class YamlMap {
 public:
  /** @param where   what this map is, for messages: "grasp g2".
  @param keys    the format's rows: numbers must lie in their ranges. Null: none.
  @param prefix  of this map's keys there: "palm.". */
  YamlMap(const YAML::Node& node, std::string file, std::string where, Diagnostics& problems,
          const FileKeys* keys = nullptr, std::string prefix = "");

  bool Has(const std::string& key) const;
  /** A text, number, whole number, truth value, vector of three, or list of numbers or texts. */
  template <class T>
  void Read(const std::string& key, T& value, Needed needed = Needed::kYes);
  /** A child node of any shape; marks the key as known. Null when absent. */
  YAML::Node Child(const std::string& key, Needed needed = Needed::kYes);
  /** Records a problem at the line of `key` (or of the map when absent). */
  void Fail(const std::string& key, const std::string& text);
  /** Every key nobody asked for is an error with a suggestion, and so is a key given twice. Call
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

/** For tests: while it lives, what maps with rows are asked for on this thread. */
class KeyRecorder {
 public:
  KeyRecorder();
  ~KeyRecorder();
  KeyRecorder(const KeyRecorder&) = delete;
  KeyRecorder& operator=(const KeyRecorder&) = delete;
  /** In the order of asking, each once; without meaning and range. */
  const FileKeys& keys() const { return keys_; }

 private:
  friend class YamlMap;
  FileKeys keys_;
  KeyRecorder* outer_;
};

/** In double quotes, as YAML and JSON have them. Bytes that are no UTF-8 become U+FFFD. */
std::string QuoteYaml(const std::string& text);

/** As it is where that can only be read as this text: letters, digits, _, - and points behind a
letter, and no word that YAML takes for something else. Else in quotes. */
std::string FormatYamlWord(const std::string& text);

}  // namespace graspbench
