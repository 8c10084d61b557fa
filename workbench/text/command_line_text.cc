#include "workbench/text/command_line_text.h"

#include <CLI/CLI.hpp>
#include <functional>

#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

std::vector<const CLI::App*> GetSubcommands(const CLI::App& command) {
  const auto found = command.get_subcommands([](const CLI::App*) { return true; });
  return {found.begin(), found.end()};
}

/** visit(path, command): "graspbench hand import" and what it is, in the order of the help. */
void ForEachCommand(const CLI::App& command, const std::string& path,
                    const std::function<void(const std::string&, const CLI::App&)>& visit) {
  visit(path, command);
  for (const CLI::App* subcommand : GetSubcommands(command)) {
    ForEachCommand(*subcommand, path + " " + subcommand->get_name(), visit);
  }
}

std::string JoinByBlanks(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<std::string> ListOptionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> ListGraspIds() {
  std::vector<std::string> ids = {"best", "by-sight", "all"};
  for (const GraspTaxon& taxon : ListGraspTaxa()) ids.push_back(taxon.id);
  return ids;
}

/** What an option or argument may be, where that is a short list. */
std::vector<std::string> ListValues(const CLI::Option& option) {
  const std::string& name =
      option.get_lnames().empty() ? option.get_name(true) : option.get_lnames().front();
  if (name == "hand") return ListHands();
  if (name == "object") return ListObjects();
  if (name == "grasp") return ListGraspIds();
  if (name == "shell") return ListShells();
  // The parser describes a list of names as {a,b,c}.
  const std::string type = option.get_type_name();
  const size_t begin = type.find('{'), end = type.find('}');
  if (begin == type.npos || end == type.npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

bool TakesValue(const CLI::Option& option) { return option.get_expected_max() > 0; }

/** What may follow a command: subcommands, its arguments' values, its options. */
std::vector<std::string> ListWords(const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::App* subcommand : GetSubcommands(command)) {
    words.push_back(subcommand->get_name());
  }
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    for (const std::string& value : ListValues(*option)) words.push_back(value);
  }
  for (const std::string& name : ListOptionNames(command)) words.push_back(name);
  return words;
}

/** The part that bash and zsh share: $place is the command typed so far, $prev the word before the
cursor; sets $choices to what may stand there, empty: a file. */
std::string FormatCases(const CLI::App& program) {
  std::string commands, values, words;
  ForEachCommand(program, "graspbench", [&](const std::string& path, const CLI::App& command) {
    if (&command != &program) commands += (commands.empty() ? "\"" : "|\"") + path + "\"";
    words += "    \"" + path + "\") choices=\"" + JoinByBlanks(ListWords(command)) + "\" ;;\n";
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_lnames().empty() || !TakesValue(*option)) continue;
      values += "    \"" + path + " --" + option->get_lnames().front() + "\") choices=\"" +
                JoinByBlanks(ListValues(*option)) + "\"; is_value=1 ;;\n";
    }
  });
  return "  for word in \"${typed[@]}\"; do\n    case \"$place $word\" in\n      " + commands +
         ") place=\"$place $word\" ;;\n    esac\n  done\n  case \"$place $prev\" in\n" + values +
         "  esac\n  [ -n \"$is_value\" ] || case \"$place\" in\n" + words + "  esac\n";
}

std::string FormatBash(const CLI::App& program) {
  return "# bash completion of graspbench: source it, or put it into\n"
         "# ~/.local/share/bash-completion/completions/graspbench\n"
         "_graspbench() {\n  local place=graspbench choices= is_value= word\n"
         "  local cur=\"${COMP_WORDS[COMP_CWORD]}\" prev=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
         "  local typed=(\"${COMP_WORDS[@]:1:COMP_CWORD-1}\")\n" +
         FormatCases(program) +
         "  # The last of a list: tum,shadow\n  local before=\n"
         "  case \"$cur\" in *,*) [ -n \"$is_value\" ] && before=\"${cur%,*},\" ;; esac\n"
         "  COMPREPLY=($(compgen -P \"$before\" -W \"$choices\" -- \"${cur#\"$before\"}\"))\n}\n"
         "complete -o default -F _graspbench graspbench\n";
}

std::string FormatZsh(const CLI::App& program) {
  return "#compdef graspbench\n"
         "# zsh completion of graspbench: source it, or put it as _graspbench into a folder of "
         "$fpath\n"
         "_graspbench() {\n  local place=graspbench choices= is_value= word\n"
         "  local prev=\"${words[CURRENT-1]}\"\n"
         "  local -a typed\n  typed=(\"${(@)words[2,CURRENT-1]}\")\n" +
         FormatCases(program) +
         "  [ -n \"$is_value\" ] && compset -P '*,'  # the last of a list: tum,shadow\n"
         "  [ -n \"$choices\" ] && compadd -- ${=choices}\n"
         "  [ -n \"$is_value\" ] && [ -n \"$choices\" ] || _files\n"
         "}\n"
         "if [ \"${funcstack[1]}\" = _graspbench ]; then _graspbench; "
         "else compdef _graspbench graspbench; fi\n";
}

/** In single quotes of fish. */
std::string QuoteForFish(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? ' ' : c;
  }
  return "'" + quoted + "'";
}

std::string FormatFish(const CLI::App& program) {
  std::string text =
      "# fish completion of graspbench: as ~/.config/fish/completions/graspbench.fish\n"
      "complete -c graspbench -e\n";
  ForEachCommand(program, "", [&](const std::string& path, const CLI::App& command) {
    std::string condition = "__fish_use_subcommand";
    if (!path.empty()) {
      condition.clear();
      for (const std::string& word : CLI::detail::split(path.substr(1), ' ')) {
        condition += (condition.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + word);
      }
    }
    const std::string start = "complete -c graspbench -n " + QuoteForFish(condition);
    for (const CLI::App* subcommand : GetSubcommands(command)) {
      text += start + " -f -a " + subcommand->get_name() + " -d " +
              QuoteForFish(subcommand->get_description()) + "\n";
    }
    for (const CLI::Option* option : command.get_options()) {
      const std::vector<std::string> values = ListValues(*option);
      if (option->get_positional() && !values.empty()) {
        text += start + " -a " + QuoteForFish(JoinByBlanks(values)) + "\n";
      }
      if (option->get_lnames().empty()) continue;
      text += start + " -l " + option->get_lnames().front() + (TakesValue(*option) ? " -r" : "") +
              (values.empty() ? "" : " -f -a " + QuoteForFish(JoinByBlanks(values))) + " -d " +
              QuoteForFish(option->get_description()) + "\n";
    }
  });
  return text;
}

/** Text of a man page: no line is taken for a request, no hyphen for a dash. */
std::string EscapeForMan(const std::string& text) {
  std::string escaped;
  bool is_at_start = true;
  for (const char c : text) {
    if (is_at_start && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
    is_at_start = c == '\n';
  }
  return escaped;
}

}  // namespace

std::vector<std::string> ListShells() { return {"bash", "zsh", "fish"}; }

std::string FormatCompletion(const CLI::App& program, const std::string& shell) {
  if (shell == "zsh") return FormatZsh(program);
  return shell == "fish" ? FormatFish(program) : FormatBash(program);
}

std::string FormatManPage(const CLI::App& program) {
  std::string text = ".TH GRASPBENCH 1\n.SH NAME\ngraspbench \\- " +
                     EscapeForMan(program.get_description()) +
                     "\n.SH SYNOPSIS\n.B graspbench\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH COMMANDS\n";
  ForEachCommand(program, "graspbench", [&](const std::string& path, const CLI::App& command) {
    if (&command == &program) return;
    text += ".SS " + EscapeForMan(path) + "\n" + EscapeForMan(command.get_description()) +
            "\n.PP\n.nf\n" + EscapeForMan(command.get_footer()) + "\n.fi\n";
    for (const CLI::Option* option : command.get_options()) {
      const bool is_argument = option->get_positional();
      const std::string value = option->get_option_text();
      if (option->get_name() == "--help" || option->get_name() == "-h,--help") continue;
      text += ".TP\n";
      if (is_argument) {
        text += ".I " + EscapeForMan(value.empty() ? option->get_name(true) : value) + "\n";
      } else {
        text += ".B " + EscapeForMan(option->get_name()) +
                (TakesValue(*option) ? " \\fI" + EscapeForMan(value) + "\\fR" : "") + "\n";
      }
      const std::string usual = option->get_default_str();
      text += EscapeForMan(option->get_description() +
                           (usual.empty() ? "" : " (default " + usual + ")")) +
              "\n";
    }
  });
  return text +
         ".SH EXIT STATUS\n0 ok, 1 failed, 2 usage, 3 bad input file, 4 some trials failed "
         "numerically, 5 environment, 75 interrupted and resumable\n.SH FILES\n"
         "\\fBgraspbench help\\fR \\fIFILE\\fR explains every key of the files that people "
         "write.\n";
}

}  // namespace graspbench
