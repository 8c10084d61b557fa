#pragma once
/** @file
Numbers and names as they stand in XML. */

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace graspbench {

/** Finite numbers below 1e9, blanks or commas between them; nothing when something else stands
there. */
std::optional<std::vector<double>> ParseNumbers(const char* text);

/** The first three in quotes, "a", "b", "c" and 4 more. */
std::string JoinSome(const std::vector<std::string>& names);

/** Names of one kind of thing ("link"), each given once. */
class NameList {
 public:
  explicit NameList(std::string kind) : kind_(std::move(kind)) {}

  /** The name; another one where it is no text or taken, and then `changes` says so. */
  std::string Add(const char* text, std::vector<std::string>& changes);

 private:
  std::string kind_;
  std::set<std::string> taken_;
};

}  // namespace graspbench
