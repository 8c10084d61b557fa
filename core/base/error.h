#pragma once
/** @file
The only error class: a fault of the user, of a file or of the environment, reported to a person.

Three cases have three mechanisms:
- our own bug: GRASPBENCH_DEMAND aborts with file, line and values;
- the user's or a file's fault: throw Error (several faults in one file: Diagnostics);
- the outcome of an experiment (dropped, diverged): a status in the result, never an exception.

A message says what was found, where, what was expected, and what to do about it. */

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace graspbench {

enum class ErrorKind {
  kUsage,        ///< the command line asks for something that does not exist or contradicts itself
  kNotFound,     ///< no hand, object, grasp or file of that name
  kFormat,       ///< a file's content violates its format
  kRange,        ///< a value is outside its range, or not finite
  kVersion,      ///< written by another version
  kIo,           ///< reading or writing failed (disk full, no permission)
  kUnsupported,  ///< valid, but not possible here
  kEnvironment,  ///< the machine lacks something (no off-screen renderer, ...)
  kInterrupted,  ///< stopped on request; can be resumed
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/** The program's exit codes. 0 is success and 1 is failed work; the others follow from the
error. */
enum ExitCode : int {
  kExitOk = 0,
  kExitFailed = 1,
  kExitUsage = 2,
  kExitBadInput = 3,
  kExitNumericalFailures = 4,
  kExitEnvironment = 5,
  kExitInterrupted = 75,
};
ExitCode ExitCodeOf(ErrorKind kind);

/** Returns "; did you mean "mug"? Known: a, b, c" for a misspelt name. A name is suggested if its
edit distance is at most a third of the misspelt name's length (at least 1). At most 24 known names
are listed, and none if there is a suggestion and more than 8 names are known. */
std::string SuggestNames(std::string_view misspelt, const std::vector<std::string>& known);

enum class Severity { kWarning, kError };

struct Diagnostic {
  Severity severity = Severity::kError;
  std::string file;
  int line = 0;  ///< one-based; 0: the file as a whole
  std::string text;
};

/** Collects the faults of one file: its reader continues, and all problems are reported at once. */
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

  /** Returns one line per entry: "hand.urdf:12: error: ...". */
  std::string Format() const;

  /** Throws Error(kind) with all entries when there is at least one error. */
  void ThrowIfErrors(ErrorKind kind, const std::string& headline) const;

 private:
  std::vector<Diagnostic> entries_;
};

namespace internal {
[[noreturn]] void DemandFailed(const char* condition, const char* file, int line,
                               const std::string& values);
}  // namespace internal

}  // namespace graspbench

/** Aborts the program on a bug of ours. `values` is a std::string that shows the offending values.
User input must never trigger it. */
#define GRASPBENCH_DEMAND(condition, values)                                          \
  do {                                                                                \
    if (!(condition))                                                                 \
      ::graspbench::internal::DemandFailed(#condition, __FILE__, __LINE__, (values)); \
  } while (false)
