#include "workbench/terminal/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <sstream>

#include "core/base/error.h"

namespace graspbench {
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

Option* Option::ValueName(const std::string& text) {
  option_->option_text(text);
  return this;
}

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

Option* Command::Keep(CLI::Option* option) {
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

void Command::SetAction(const std::function<void()>& action) { app_->callback(action); }

void Command::RequireSubcommand() { app_->require_subcommand(1); }

template <class T>
Option* Command::AddOption(const std::string& name, T& value, const std::string& text) {
  return Keep(app_->add_option(name, value, text));
}

template <class T>
Option* Command::AddOptionFunction(const std::string& name,
                                   const std::function<void(const T&)>& set,
                                   const std::string& text) {
  return Keep(app_->add_option_function<T>(name, set, text));
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
    if (fault.get_exit_code() != 0) return {std::nullopt, Explain(fault, *app_)};
    std::ostringstream answer, none;
    app_->exit(fault, answer, none);
    return {answer.str(), ""};
  }
  return {};
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
  return *parent.subcommands_.emplace_back(
      new Command(std::shared_ptr<CLI::App>(parent.app_, app)));
}

bool ReadNumber(const std::string& word, double& number) {
  return CLI::detail::lexical_cast(word, number);
}

bool ReadNumber(const std::string& word, int& number) {
  return CLI::detail::lexical_cast(word, number);
}

// The types that a value may have.
template Option* Command::AddOption(const std::string&, int&, const std::string&);
template Option* Command::AddOption(const std::string&, double&, const std::string&);
template Option* Command::AddOption(const std::string&, std::string&, const std::string&);
template Option* Command::AddOption(const std::string&, std::filesystem::path&, const std::string&);
template Option* Command::AddOption(const std::string&, std::optional<int>&, const std::string&);
template Option* Command::AddOption(const std::string&, std::optional<double>&, const std::string&);
template Option* Command::AddOption(const std::string&, std::vector<int>&, const std::string&);
template Option* Command::AddOption(const std::string&, std::vector<double>&, const std::string&);
template Option* Command::AddOption(const std::string&, std::vector<std::string>&,
                                    const std::string&);
template Option* Command::AddOption(const std::string&, std::vector<std::filesystem::path>&,
                                    const std::string&);
template Option* Command::AddOptionFunction(const std::string&,
                                            const std::function<void(const std::string&)>&,
                                            const std::string&);
template Option* Command::AddOptionFunction(
    const std::string&, const std::function<void(const std::vector<std::string>&)>&,
    const std::string&);

}  // namespace graspbench
