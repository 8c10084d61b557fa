#pragma once
/** @file
Sequential reader for JSON as this program writes it: no white space, keys in a known order. It is
ten times as fast as parsing into a tree. A cursor fails permanently at anything unexpected; the
text is then parsed as a tree, which reports the fault. Whatever a cursor accepts, the tree accepts
with the same values. */

#include <string>
#include <string_view>

namespace graspbench {

class JsonCursor {
 public:
  /** @param text  must live as long as the cursor. */
  explicit JsonCursor(std::string_view text) : rest_(text) {}

  bool has_failed() const { return has_failed_; }
  /** The text that has not been read yet. */
  std::string_view rest() const { return rest_; }
  void Fail() { has_failed_ = true; }

  /** Consumes these characters if they come next; returns whether they did. */
  bool Take(std::string_view letters) {
    if (has_failed_ || rest_.substr(0, letters.size()) != letters) return false;
    rest_.remove_prefix(letters.size());
    return true;
  }
  void Demand(std::string_view letters) {
    if (!Take(letters)) Fail();
  }

  /** Consumes `"key":`, preceded by a comma unless it is the first; returns whether it came
  next. */
  bool TakeKey(std::string_view key, bool is_first);

  /** Reads a finite number. */
  double ReadNumber();
  int ReadInt();
  /** Reads a string without escapes; fails at any other. */
  std::string_view ReadPlainText();
  /** Returns the characters of any value; also fails at a character that is escaped by its code
  point. */
  std::string_view ReadValue();

 private:
  /** Returns the characters of a number. */
  std::string_view ReadNumberLetters();
  void SkipString(bool may_be_escaped);
  void SkipList(char end, bool has_keys, int depth);
  void SkipValue(int depth);

  std::string_view rest_;
  bool has_failed_ = false;
};

/** Returns whether the text is one JSON value without white space; also false if ReadValue
fails. */
bool IsPlainJson(std::string_view text);

}  // namespace graspbench
