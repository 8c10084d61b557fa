#include "workbench/text/command_line_text.h"

#include <functional>

#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "objects/catalogue.h"
#include "workbench/terminal/command_line.h"

namespace graspbench {
namespace {

/** visit(path, command): "graspbench hand import" and what it is, in the order of the help. */
void ForEachCommand(const Command& command, const std::string& path,
                    const std::function<void(const std::string&, const Command&)>& visit) {
  visit(path, command);
  for (const auto& subcommand : command.subcommands()) {
    ForEachCommand(*subcommand, path + " " + subcommand->name(), visit);
  }
}

std::string JoinByBlanks(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<std::string> ListOptionNames(const Command& command) {
  std::vector<std::string> names;
  for (const auto& option : command.options()) {
    for (const std::string& name : option->long_names()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> ListGraspIds() {
  std::vector<std::string> ids = {"best", "predicted", "rehearsed", "by-sight", "all"};
  for (const GraspTaxon& taxon : ListGraspTaxa()) ids.push_back(taxon.id);
  return ids;
}

/** What an option or argument may be, where that is a short list. */
std::vector<std::string> ListValues(const Option& option) {
  const std::string name =
      option.long_names().empty() ? option.name() : option.long_names().front();
  if (name == "hand") return ListHands();
  if (name == "object") return ListObjects();
  if (name == "grasp") return ListGraspIds();
  if (name == "shell") return ListShells();
  return option.choices();
}

/** What may follow a command: subcommands, its arguments' values, its options. */
std::vector<std::string> ListWords(const Command& command) {
  std::vector<std::string> words;
  for (const auto& subcommand : command.subcommands()) {
    words.push_back(subcommand->name());
  }
  for (const auto& option : command.options()) {
    if (!option->is_argument()) continue;
    for (const std::string& value : ListValues(*option)) words.push_back(value);
  }
  for (const std::string& name : ListOptionNames(command)) words.push_back(name);
  return words;
}

/** The part that bash and zsh share: $place is the command typed so far, $prev the word before the
cursor; sets $choices to what may stand there, empty: a file. */
std::string FormatCases(const Command& program) {
  std::string commands, values, words;
  ForEachCommand(program, "graspbench", [&](const std::string& path, const Command& command) {
    if (&command != &program) commands += (commands.empty() ? "\"" : "|\"") + path + "\"";
    words += "    \"" + path + "\") choices=\"" + JoinByBlanks(ListWords(command)) + "\" ;;\n";
    for (const auto& option : command.options()) {
      if (option->long_names().empty() || !option->takes_value()) continue;
      values += "    \"" + path + " --" + option->long_names().front() + "\") choices=\"" +
                JoinByBlanks(ListValues(*option)) + "\"; is_value=1 ;;\n";
    }
  });
  return "  for word in \"${typed[@]}\"; do\n    case \"$place $word\" in\n      " + commands +
         ") place=\"$place $word\" ;;\n    esac\n  done\n  case \"$place $prev\" in\n" + values +
         "  esac\n  [ -n \"$is_value\" ] || case \"$place\" in\n" + words + "  esac\n";
}

std::string FormatBash(const Command& program) {
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

std::string FormatZsh(const Command& program) {
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

std::string FormatFish(const Command& program) {
  std::string text =
      "# fish completion of graspbench: as ~/.config/fish/completions/graspbench.fish\n"
      "complete -c graspbench -e\n";
  ForEachCommand(program, "", [&](const std::string& path, const Command& command) {
    std::string condition = "__fish_use_subcommand";
    if (!path.empty()) {
      condition.clear();
      for (const std::string& word : SplitWords(path.substr(1))) {
        condition += (condition.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + word);
      }
    }
    const std::string start = "complete -c graspbench -n " + QuoteForFish(condition);
    for (const auto& subcommand : command.subcommands()) {
      text += start + " -f -a " + subcommand->name() + " -d " +
              QuoteForFish(subcommand->description()) + "\n";
    }
    for (const auto& option : command.options()) {
      const std::vector<std::string> values = ListValues(*option);
      if (option->is_argument() && !values.empty()) {
        text += start + " -a " + QuoteForFish(JoinByBlanks(values)) + "\n";
      }
      if (option->long_names().empty()) continue;
      text += start + " -l " + option->long_names().front() + (option->takes_value() ? " -r" : "") +
              (values.empty() ? "" : " -f -a " + QuoteForFish(JoinByBlanks(values))) + " -d " +
              QuoteForFish(option->description()) + "\n";
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

std::string FormatCompletion(const Command& program, const std::string& shell) {
  if (shell == "zsh") return FormatZsh(program);
  return shell == "fish" ? FormatFish(program) : FormatBash(program);
}

std::string FormatManPage(const Command& program) {
  std::string text = ".TH GRASPBENCH 1\n.SH NAME\ngraspbench \\- " +
                     EscapeForMan(program.description()) +
                     "\n.SH SYNOPSIS\n.B graspbench\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH COMMANDS\n";
  ForEachCommand(program, "graspbench", [&](const std::string& path, const Command& command) {
    if (&command == &program) return;
    text += ".SS " + EscapeForMan(path) + "\n" + EscapeForMan(command.description()) +
            "\n.PP\n.nf\n" + EscapeForMan(command.examples()) + "\n.fi\n";
    for (const auto& option : command.options()) {
      const bool is_argument = option->is_argument();
      const std::string value = option->value_name();
      if (option->name() == "--help") continue;
      text += ".TP\n";
      if (is_argument) {
        text += ".I " + EscapeForMan(value.empty() ? option->name() : value) + "\n";
      } else {
        text += ".B " + EscapeForMan(option->name()) +
                (option->takes_value() ? " \\fI" + EscapeForMan(value) + "\\fR" : "") + "\n";
      }
      const std::string usual = option->shown_default();
      text +=
          EscapeForMan(option->description() + (usual.empty() ? "" : " (default " + usual + ")")) +
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
