#pragma once
/** @file
The command line: commands, their options and arguments, and the parser. The parser is CLI11, which
command_line.cc alone includes: it takes 4 s to compile. */

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

/** An option ("--jobs"), a flag ("--json") or an argument ("folder") of a command. What changes it
returns it. */
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /** The help shows the value that the variable has now, or `text`, as the default. */
  Option* ShowDefault();
  Option* ShowDefault(const std::string& text);
  Option* Require();
  /** Only these values. */
  Option* OneOf(const std::vector<std::string>& values);
  /** These values are completed, others allowed. */
  Option* Suggest(const std::vector<std::string>& values);
  Option* Within(int low, int high);
  Option* Within(double low, double high);
  /** @param find_fault  of a value; "" when there is none. */
  Option* Check(const std::function<std::string(const std::string&)>& find_fault);
  /** What is stored instead of the word typed. */
  Option* Transform(const std::function<std::string(const std::string&)>& change);
  /** How many words follow the option. */
  Option* NumValues(int low, int high);
  /** One word follows the option, which may be repeated. */
  Option* OneValueEach();
  /** "a,b" are two values. */
  Option* SplitAtCommas();
  ///@{
  /** Needs another option, by name or itself; does not go with another. */
  Option* Needs(const std::string& other);
  Option* Needs(const Option* other);
  Option* Excludes(const std::string& other);
  Option* Excludes(const Option* other);
  ///@}

  /** Whether it was typed. */
  bool IsGiven() const;
  bool is_argument() const;
  bool is_required() const;
  /** False of a flag. */
  bool takes_value() const;
  /** "--help"; "-c" of an option without a long name; "folder". */
  std::string name() const;
  /** Those that begin with "--", without it. */
  std::vector<std::string> long_names() const;
  std::string description() const;
  std::string value_name() const;
  std::string shown_default() const;
  /** Those of OneOf() or Suggest(). */
  std::vector<std::string> choices() const;

 private:
  CLI::Option* option_;  ///< of the parser
};

/** The program, or a command of it or of another command. */
class Command {
 public:
  /** What the parser found besides commands that it called. */
  struct Parsed {
    std::optional<std::string> answer;  ///< the text that --help or --version asks for
    std::string fault;                  ///< in the words that were typed; empty: none
    ExitCode exit_code = kExitOk;       ///< of the actions
  };

  Command();
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;
  ~Command();

  /** @param examples  the help starts with them, one indented line each. */
  void Describe(const std::string& name, const std::string& description,
                const std::string& examples);
  /** The heading in the help of the command above. */
  void SetHeading(const std::string& heading);
  /** "--version,-V". */
  void AddVersionFlag(const std::string& names, const std::string& version,
                      const std::string& text);
  /** What it does when it is typed. @param action  returns the exit code, or nothing: kExitOk. */
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
  /** It does nothing alone. */
  void RequireSubcommand();

  ///@{
  /** Options and arguments; `value` outlives the command. Which types a value may have stands at
  the end of command_line.cc. @param form  what the help shows in the place of the value: "N",
  "DIR". */
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

  /** Calls what the words after the program's name ask for.
  @throws as the actions of commands. */
  Parsed Parse(std::vector<std::string> words);

  /** Whether an option or argument was typed. @pre it has one of this name. */
  bool IsGiven(const std::string& option) const;
  std::string name() const;
  std::string description() const;
  std::string examples() const;
  /** @param above  the commands above it, "graspbench hand". */
  std::string FormatHelp(const std::string& above) const;
  /** In the order of the help. */
  const std::vector<std::unique_ptr<Command>>& subcommands() const { return subcommands_; }
  const std::vector<std::unique_ptr<Option>>& options() const { return options_; }
  /** @pre it has one of this name. */
  Command& Subcommand(const std::string& name) const;

 private:
  friend Command& AddSubcommand(Command& parent, const std::string& name,
                                const std::string& description, const std::string& examples);
  explicit Command(std::shared_ptr<CLI::App> app);
  void SetCodedAction(const std::function<ExitCode()>& action);
  Option* Keep(CLI::Option* option, const std::string& form = "");

  std::shared_ptr<CLI::App> app_;  ///< of the parser; a subcommand's belongs to that above
  std::shared_ptr<ExitCode> exit_code_ = std::make_shared<ExitCode>(kExitOk);  ///< of all together
  std::vector<std::unique_ptr<Command>> subcommands_;
  std::vector<std::unique_ptr<Option>> options_;
};

/** Adds a subcommand whose help starts with `examples`, one indented line each. */
Command& AddSubcommand(Command& parent, const std::string& name, const std::string& description,
                       const std::string& examples);

///@{
/** Reads a number as the parser reads that of an option; false when the word is none. */
bool ReadNumber(const std::string& word, double& number);
bool ReadNumber(const std::string& word, int& number);
///@}

/** The words of a line of the shell: they are parted by blanks; a quote of either kind at the start
of a word keeps blanks up to its like; "#" at the start of a word begins a comment. @throws
Error(kUsage) for a quote without end. */
std::vector<std::string> SplitWords(const std::string& line);

/** "1.25", or "1.25s" with the unit "s".
@throws Error(kUsage) naming `what` and the range when it is no finite number within it. */
double ParseNumber(const std::string& word, const std::string& what, const std::string& unit,
                   double low, double high);
int ParseCount(const std::string& word, const std::string& what, int low, int high);

}  // namespace graspbench
