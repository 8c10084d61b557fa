#include "workbench/terminal/command_line.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <sstream>
#include <type_traits>

#include "core/base/error.h"
#include "core/base/text/text.h"

namespace graspbench {

std::vector<std::string> SplitWords(const std::string& line) {
  std::vector<std::string> words;
  bool is_inside = false;
  char quote = 0;
  for (const char c : line) {
    if (quote != 0) {
      if (c == quote) {
        quote = 0;
      } else {
        words.back() += c;
      }
    } else if (c == ' ' || c == '\t' || c == '\r') {
      is_inside = false;
    } else {
      if (c == '#' && !is_inside) break;
      const bool begins = !is_inside;
      if (begins) words.emplace_back();
      is_inside = true;
      if (begins && (c == '"' || c == '\'')) {
        quote = c;
      } else {
        words.back() += c;
      }
    }
  }
  if (quote != 0) {
    throw Error(ErrorKind::kUsage,
                fmt::format("a quote {} is not closed; close it or leave it out", quote));
  }
  return words;
}

double ParseNumber(const std::string& word, const std::string& what, const std::string& unit,
                   double low, double high) {
  std::string digits = word;
  if (!unit.empty() && digits.size() > unit.size() &&
      digits.compare(digits.size() - unit.size(), unit.size(), unit) == 0) {
    digits.resize(digits.size() - unit.size());
  }
  double value = 0.0;
  if (ReadNumber(digits, value) && value >= low && value <= high) return value;
  throw Error(ErrorKind::kUsage,
              fmt::format("{} is \"{}\"; expected a number from {} to {}{}{}", what, word,
                          FormatSignificant(low, 6), FormatSignificant(high, 6),
                          unit.empty() ? "" : " ", unit));
}

int ParseCount(const std::string& word, const std::string& what, int low, int high) {
  int value = 0;
  if (ReadNumber(word, value) && value >= low && value <= high) return value;
  throw Error(ErrorKind::kUsage, fmt::format("{} is \"{}\"; expected a whole number from {} to {}",
                                             what, word, low, high));
}

namespace {

/** The examples, kept in the footer, come first. */
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    return "Examples:\n" + app->get_footer() + "\n\n" + CLI::Formatter::make_help(app, name, mode);
  }
  std::string make_footer(const CLI::App*) const override { return {}; }
  /** The default stands at the end, taken from where the program has it. */
  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string text = CLI::Formatter::make_option_desc(option);
    const std::string value = option->get_default_str();
    return value.empty() ? text : text + " (default " + value + ")";
  }
};

/** The command that the user was typing when the parser gave up. */
const CLI::App& FindCurrentCommand(const CLI::App& program) {
  const std::vector<CLI::App*> parsed = program.get_subcommands();
  return parsed.empty() ? program : FindCurrentCommand(*parsed.back());
}

std::vector<std::string> ListSubcommands(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(subcommand->get_name());
  }
  return names;
}

std::vector<std::string> ListOptions(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) names.push_back(option->get_name());
  }
  return names;
}

/** The parser's complaint in our words, with suggestions. */
std::string Explain(const CLI::ParseError& fault, const CLI::App& program) {
  const CLI::App& command = FindCurrentCommand(program);
  const std::vector<std::string> subcommands = ListSubcommands(command);
  std::string typed = "graspbench";
  if (&command != &program) {
    if (command.get_parent() != &program) typed += " " + command.get_parent()->get_name();
    typed += " " + command.get_name();
  }
  std::vector<std::string> extras = command.remaining();
  std::string text;
  if (!extras.empty() && extras.front().rfind('-', 0) == 0) {
    extras.front() = extras.front().substr(0, extras.front().find('='));
    text = "unknown option \"" + extras.front() + "\"" +
           SuggestNames(extras.front(), ListOptions(command));
  } else if (!extras.empty() && !subcommands.empty()) {
    text = "unknown command \"" + extras.front() + "\"" + SuggestNames(extras.front(), subcommands);
  } else if (!extras.empty()) {
    text = "unexpected argument \"" + extras.front() + "\"";
  } else if (fault.get_name() == "RequiredError" && !subcommands.empty()) {
    text = "a command is missing" + SuggestNames("", subcommands);
  } else if (fault.get_name() == "ConversionError") {
    const std::string what = fault.what();  // "Could not convert: --trials = ten"
    text = what.substr(what.find("--")) + ": a whole number is expected";
  } else {
    text = fault.what();
  }
  return text + "\nsee: " + typed + " --help";
}

}  // namespace

Option* Option::ShowDefault() {
  option_->capture_default_str();
  return this;
}

Option* Option::ShowDefault(const std::string& text) {
  option_->default_str(text);
  return this;
}

Option* Option::Require() {
  option_->required();
  return this;
}

Option* Option::OneOf(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values));
  return this;
}

Option* Option::Suggest(const std::vector<std::string>& values) {
  option_->type_name("{" + CLI::detail::join(values) + "}");
  return this;
}

Option* Option::Within(int low, int high) {
  option_->check(CLI::Range(low, high));
  return this;
}

Option* Option::Within(double low, double high) {
  option_->check(CLI::Range(low, high));
  return this;
}

Option* Option::Check(const std::function<std::string(const std::string&)>& find_fault) {
  option_->check(find_fault);
  return this;
}

Option* Option::Transform(const std::function<std::string(const std::string&)>& change) {
  option_->transform(change);
  return this;
}

Option* Option::NumValues(int low, int high) {
  low == high ? option_->expected(low) : option_->expected(low, high);
  return this;
}

Option* Option::OneValueEach() {
  option_->allow_extra_args(false);
  return this;
}

Option* Option::SplitAtCommas() {
  option_->delimiter(',');
  return this;
}

Option* Option::Needs(const std::string& other) {
  option_->needs(other);
  return this;
}

Option* Option::Needs(const Option* other) {
  option_->needs(other->option_);
  return this;
}

Option* Option::Excludes(const std::string& other) {
  option_->excludes(other);
  return this;
}

Option* Option::Excludes(const Option* other) {
  option_->excludes(other->option_);
  return this;
}

bool Option::IsGiven() const { return !option_->empty(); }

bool Option::is_argument() const { return option_->get_positional(); }

bool Option::is_required() const { return option_->get_required(); }

bool Option::takes_value() const { return option_->get_expected_max() > 0; }

std::string Option::name() const { return option_->get_name(); }

std::vector<std::string> Option::long_names() const { return option_->get_lnames(); }

std::string Option::description() const { return option_->get_description(); }

std::string Option::value_name() const { return option_->get_option_text(); }

std::string Option::shown_default() const { return option_->get_default_str(); }

std::vector<std::string> Option::choices() const {
  // The parser describes a list of names as {a,b,c}.
  const std::string type = option_->get_type_name();
  const size_t begin = type.find('{'), end = type.find('}');
  if (begin == type.npos || end == type.npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

Command::Command() : Command(std::make_shared<CLI::App>()) {
  app_->formatter(std::make_shared<HelpFormatter>());
}

Command::Command(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {
  for (CLI::Option* option : app_->get_options()) Keep(option);  // --help
}

Command::~Command() = default;

Option* Command::Keep(CLI::Option* option, const std::string& form) {
  if (!form.empty()) option->option_text(form);
  return options_.emplace_back(std::make_unique<Option>(option)).get();
}

void Command::Describe(const std::string& name, const std::string& description,
                       const std::string& examples) {
  app_->name(name);
  app_->description(description);
  app_->footer(examples);
}

void Command::SetHeading(const std::string& heading) { app_->group(heading); }

void Command::AddVersionFlag(const std::string& names, const std::string& version,
                             const std::string& text) {
  Keep(app_->set_version_flag(names, version, text));
}

void Command::SetCodedAction(const std::function<ExitCode()>& action) {
  app_->callback([action, code = exit_code_] { *code = action(); });
}

void Command::RequireSubcommand() { app_->require_subcommand(1); }

namespace {

/** CLI11 reads 010 as 8. @returns what is wrong; empty: a decimal number, or none. */
std::string FindOctal(const std::string& text) {
  const size_t first = text.find_first_not_of("+-");
  const bool is_octal = first != std::string::npos && first + 1 < text.size() &&
                        text[first] == '0' && std::isalnum(text[first + 1] & 0x7f) != 0;
  return is_octal ? text + ": a whole number without leading zeros is expected" : "";
}

}  // namespace

template <class T>
Option* Command::AddOption(const std::string& name, T& value, const std::string& text,
                           const std::string& form) {
  CLI::Option* option = app_->add_option(name, value, text);
  if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::optional<int>>) {
    option->check(&FindOctal, "", "");
  }
  return Keep(option, form);
}

template <class T>
Option* Command::AddOptionFunction(const std::string& name,
                                   const std::function<void(const T&)>& set,
                                   const std::string& text, const std::string& form) {
  return Keep(app_->add_option_function<T>(name, set, text), form);
}

Option* Command::AddFlag(const std::string& name, const std::string& text) {
  return Keep(app_->add_flag(name, text));
}

Option* Command::AddFlag(const std::string& name, bool& value, const std::string& text) {
  return Keep(app_->add_flag(name, value, text));
}

Option* Command::AddFlag(const std::string& name, const std::function<void()>& set,
                         const std::string& text) {
  return Keep(app_->add_flag_callback(name, set, text));
}

Command::Parsed Command::Parse(std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // as the parser takes them
  try {
    app_->parse(std::move(words));
  } catch (const CLI::ParseError& fault) {
    if (fault.get_exit_code() != 0) return {std::nullopt, Explain(fault, *app_), kExitUsage};
    std::ostringstream answer, none;
    app_->exit(fault, answer, none);
    return {answer.str(), ""};
  }
  return {std::nullopt, "", *exit_code_};
}

bool Command::IsGiven(const std::string& option) const { return app_->count(option) > 0; }

std::string Command::name() const { return app_->get_name(); }

std::string Command::description() const { return app_->get_description(); }

std::string Command::examples() const { return app_->get_footer(); }

std::string Command::FormatHelp(const std::string& above) const {
  return app_->get_formatter()->make_help(app_.get(), above.empty() ? name() : above + " " + name(),
                                          CLI::AppFormatMode::Normal);
}

Command& Command::Subcommand(const std::string& name) const {
  return **std::find_if(subcommands_.begin(), subcommands_.end(),
                        [&](const auto& command) { return command->name() == name; });
}

Command& AddSubcommand(Command& parent, const std::string& name, const std::string& description,
                       const std::string& examples) {
  CLI::App* app = parent.app_->add_subcommand(name, description);
  app->footer(examples);
  app->group("Subcommands");  // not the heading that the parent stands under
  auto* command = new Command(std::shared_ptr<CLI::App>(parent.app_, app));
  command->exit_code_ = parent.exit_code_;
  return *parent.subcommands_.emplace_back(command);
}

bool ReadNumber(const std::string& word, double& number) {
  return CLI::detail::lexical_cast(word, number);
}

bool ReadNumber(const std::string& word, int& number) {
  return CLI::detail::lexical_cast(word, number);
}

// The types that a value may have.
using OptionText = const std::string&;
template Option* Command::AddOption(OptionText, int&, OptionText, OptionText);
template Option* Command::AddOption(OptionText, double&, OptionText, OptionText);
template Option* Command::AddOption(OptionText, std::string&, OptionText, OptionText);
template Option* Command::AddOption(OptionText, std::filesystem::path&, OptionText, OptionText);
template Option* Command::AddOption(OptionText, std::optional<int>&, OptionText, OptionText);
template Option* Command::AddOption(OptionText, std::optional<double>&, OptionText, OptionText);
template Option* Command::AddOption(OptionText, std::vector<int>&, OptionText, OptionText);
template Option* Command::AddOption(OptionText, std::vector<double>&, OptionText, OptionText);
template Option* Command::AddOption(OptionText, std::vector<std::string>&, OptionText, OptionText);
template Option* Command::AddOption(OptionText, std::vector<std::filesystem::path>&, OptionText,
                                    OptionText);
template Option* Command::AddOptionFunction(OptionText,
                                            const std::function<void(const std::string&)>&,
                                            OptionText, OptionText);
template Option* Command::AddOptionFunction(
    OptionText, const std::function<void(const std::vector<std::string>&)>&, OptionText,
    OptionText);

}  // namespace graspbench
