#pragma once
/** @file
A name from a small set (digits, rules, conventions) that very many records repeat. Each string is
stored once per process, and a name has the size of a pointer. */

#include <ostream>
#include <string>

#include "core/base/text/json.h"

namespace graspbench {

class InternedName {
 public:
  InternedName() : InternedName(std::string()) {}
  InternedName(const std::string& text);
  InternedName(const char* text) : InternedName(std::string(text)) {}

  const std::string& str() const { return *text_; }
  operator const std::string&() const { return *text_; }
  bool empty() const { return text_->empty(); }

  friend bool operator==(InternedName a, InternedName b) { return a.text_ == b.text_; }
  friend bool operator==(InternedName a, const std::string& b) { return *a.text_ == b; }
  friend bool operator==(const std::string& a, InternedName b) { return a == *b.text_; }
  friend bool operator==(InternedName a, const char* b) { return *a.text_ == b; }
  friend std::ostream& operator<<(std::ostream& out, InternedName name) {
    return out << *name.text_;
  }

 private:
  const std::string* text_;  ///< has the lifetime of the process
};

Json ToJson(InternedName name);
/** @throws Json::exception if it is not a string. */
void ReadJson(const Json& json, InternedName& name);

}  // namespace graspbench
