#pragma once
/** @file
The command line: commands, their options and arguments, and the parser. The parser is CLI11, which
only command_line.cc includes because it takes 4 s to compile. */

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/error.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace graspbench {

/** An option ("--jobs"), a flag ("--json") or an argument ("folder") of a command. Setters return
`this`. */
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /** Shows the variable's current value, or `text`, as the default in the help. */
  Option* ShowDefault();
  Option* ShowDefault(const std::string& text);
  Option* Require();
  /** Accepts only these values. */
  Option* OneOf(const std::vector<std::string>& values);
  /** Completes these values; others are accepted, too. */
  Option* Suggest(const std::vector<std::string>& values);
  Option* Within(int low, int high);
  Option* Within(double low, double high);
  /** @param find_fault  returns what is wrong with a value; "" if nothing. */
  Option* Check(const std::function<std::string(const std::string&)>& find_fault);
  /** Stores change(word) instead of the word typed. */
  Option* Transform(const std::function<std::string(const std::string&)>& change);
  /** Sets how many words may follow the option. */
  Option* NumValues(int low, int high);
  /** Takes one word each time; the option may be repeated. */
  Option* OneValueEach();
  /** Splits "a,b" into two values. */
  Option* SplitAtCommas();
  ///@{
  /** Requires or excludes another option, given by name or pointer. */
  Option* Needs(const std::string& other);
  Option* Needs(const Option* other);
  Option* Excludes(const std::string& other);
  Option* Excludes(const Option* other);
  ///@}

  /** Whether the option was typed. */
  bool IsGiven() const;
  bool is_argument() const;
  bool is_required() const;
  /** False for a flag. */
  bool takes_value() const;
  /** "--help"; "-c" of an option without a long name; "folder". */
  std::string name() const;
  /** The names that begin with "--", without these dashes. */
  std::vector<std::string> long_names() const;
  std::string description() const;
  std::string value_name() const;
  std::string shown_default() const;
  /** The values of OneOf() or Suggest(). */
  std::vector<std::string> choices() const;

 private:
  CLI::Option* option_;  ///< owned by the parser
};

/** The program, one of its commands, or a subcommand. */
class Command {
 public:
  /** Outcome of parsing, besides the actions that were called. */
  struct Parsed {
    std::optional<std::string> answer;  ///< the text that --help or --version asks for
    std::string fault;                  ///< what is wrong with the words typed; empty: nothing
    ExitCode exit_code = kExitOk;       ///< of the actions
  };

  Command();
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;
  ~Command();

  /** @param examples  shown at the start of the help, one indented line each. */
  void Describe(const std::string& name, const std::string& description,
                const std::string& examples);
  /** Sets the heading under which the parent's help lists the command. */
  void SetHeading(const std::string& heading);
  /** Adds the version flag. @param names  "--version,-V". */
  void AddVersionFlag(const std::string& names, const std::string& version,
                      const std::string& text);
  /** Sets what the command does. @param action  returns the exit code, or void for kExitOk. */
  template <class Action>
  void SetAction(const Action& action) {
    if constexpr (std::is_void_v<std::invoke_result_t<Action>>) {
      SetCodedAction([action] {
        action();
        return kExitOk;
      });
    } else {
      SetCodedAction(action);
    }
  }
  /** Demands that a subcommand is typed. */
  void RequireSubcommand();

  ///@{
  /** Adds options and arguments; `value` must outlive the command. The end of command_line.cc lists
  the supported value types. @param form  placeholder for the value in the help: "N", "DIR". */
  template <class T>
  Option* AddOption(const std::string& name, T& value, const std::string& text,
                    const std::string& form = "");
  template <class T>
  Option* AddRequired(const std::string& name, T& value, const std::string& text,
                      const std::string& form = "") {
    return AddOption(name, value, text, form)->Require();
  }
  template <class T>
  Option* AddOptionFunction(const std::string& name, const std::function<void(const T&)>& set,
                            const std::string& text, const std::string& form = "");
  Option* AddFlag(const std::string& name, const std::string& text);
  Option* AddFlag(const std::string& name, bool& value, const std::string& text);
  Option* AddFlag(const std::string& name, const std::function<void()>& set,
                  const std::string& text);
  ///@}

  /** Parses the words after the program's name and calls the action of the command.
  @throws as the actions of commands. */
  Parsed Parse(std::vector<std::string> words);

  /** Whether an option or argument was typed. @pre the command has one of this name. */
  bool IsGiven(const std::string& option) const;
  std::string name() const;
  std::string description() const;
  std::string examples() const;
  /** @param above  the parent commands: "graspbench hand". */
  std::string FormatHelp(const std::string& above) const;
  /** In the order of the help. */
  const std::vector<std::unique_ptr<Command>>& subcommands() const { return subcommands_; }
  const std::vector<std::unique_ptr<Option>>& options() const { return options_; }
  /** @pre the command has a subcommand of this name. */
  Command& Subcommand(const std::string& name) const;

 private:
  friend Command& AddSubcommand(Command& parent, const std::string& name,
                                const std::string& description, const std::string& examples);
  explicit Command(std::shared_ptr<CLI::App> app);
  void SetCodedAction(const std::function<ExitCode()>& action);
  Option* Keep(CLI::Option* option, const std::string& form = "");

  std::shared_ptr<CLI::App> app_;  ///< of the parser; a subcommand's is owned by its parent's
  std::shared_ptr<ExitCode> exit_code_ = std::make_shared<ExitCode>(kExitOk);  ///< shared by all
  std::vector<std::unique_ptr<Command>> subcommands_;
  std::vector<std::unique_ptr<Option>> options_;
};

/** Adds a subcommand whose help starts with `examples`, one indented line each. */
Command& AddSubcommand(Command& parent, const std::string& name, const std::string& description,
                       const std::string& examples);

///@{
/** Reads a number as the parser reads that of an option; false when the word is not a number. */
bool ReadNumber(const std::string& word, double& number);
bool ReadNumber(const std::string& word, int& number);
///@}

/** Splits a line of the shell into words at blanks. A single or double quote at the start of a word
preserves blanks up to the matching quote. "#" at the start of a word begins a comment.
@throws Error(kUsage) for an unterminated quote. */
std::vector<std::string> SplitWords(const std::string& line);

/** Parses "1.25", or "1.25s" with the unit "s".
@throws Error(kUsage) naming `what` and the range when the word is not a finite number within the
range. */
double ParseNumber(const std::string& word, const std::string& what, const std::string& unit,
                   double low, double high);
int ParseCount(const std::string& word, const std::string& what, int low, int high);

}  // namespace graspbench
