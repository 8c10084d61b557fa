#pragma once
/** @file
A sink for faults inside one file: the reader goes on, and all problems are reported at once. */

#include <string>
#include <vector>

#include "core/base/error.h"

namespace graspbench {

enum class Severity { kWarning, kError };

struct Diagnostic {
  Severity severity = Severity::kError;
  std::string file;
  int line = 0;  ///< one-based; 0 = the file as a whole
  std::string text;
};

class Diagnostics {
 public:
  void Warn(const std::string& file, int line, const std::string& text) {
    entries_.push_back({Severity::kWarning, file, line, text});
  }
  void Fail(const std::string& file, int line, const std::string& text) {
    entries_.push_back({Severity::kError, file, line, text});
  }
  const std::vector<Diagnostic>& entries() const { return entries_; }
  int num_errors() const;

  /** One line each: "hand.urdf:12: error: ...". */
  std::string Format() const;

  /** Throws Error(kind) with all entries when there is at least one error. */
  void ThrowIfErrors(ErrorKind kind, const std::string& headline) const;

 private:
  std::vector<Diagnostic> entries_;
};

}  // namespace graspbench
