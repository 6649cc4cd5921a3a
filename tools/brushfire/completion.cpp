// brushfire completion: scripts that make bash, zsh and fish complete verbs, options and their values.
#include "command_line.h"

#include <memory>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  source <(brushfire completion bash)
  brushfire completion bash > ~/.local/share/bash-completion/completions/brushfire
  brushfire completion zsh > "${fpath[1]}/_brushfire"
  brushfire completion fish > ~/.config/fish/completions/brushfire.fish
)";

std::string joined(const std::vector<std::string>& words, const char* separator) {
  std::string text;
  for (const std::string& w : words) text += (text.empty() ? "" : separator) + w;
  return text;
}

std::string bash(const std::vector<VerbNames>& verbs) {
  std::vector<std::string> names;
  std::string cases, values;
  for (const VerbNames& verb : verbs) {
    names.push_back(verb.name);
    std::vector<std::string> options;
    for (const OptionNames& option : verb.options) {
      for (const std::string& name : option.names) {
        options.push_back(name);
        if (option.is_number) values += "    " + verb.name + ":" + name + ") return ;;\n";
        if (!option.choices.empty()) {
          values += "    " + verb.name + ":" + name + ") COMPREPLY=($(compgen -W \"" + joined(option.choices, " ") +
                    "\" -- \"$word\")); return ;;\n";
        }
      }
    }
    cases += "    " + verb.name + ") options=\"" + joined(options, " ") + "\" ;;\n";
  }
  return "# bash completion of brushfire; made by: brushfire completion bash\n"
         "_brushfire() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} verb=${COMP_WORDS[1]} options=\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W \"" +
         joined(names, " ") +
         " --help --version\" -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case \"$verb:${COMP_WORDS[COMP_CWORD-1]}\" in\n" +
         values +
         "  esac\n"
         "  case \"$verb\" in\n" +
         cases +
         "  esac\n"
         "  case \"$word\" in\n"
         "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
         "    *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
         "  esac\n"
         "}\n"
         "complete -o filenames -F _brushfire brushfire\n";
}

// For a word between single quotes that zsh reads as name[help]:values.
std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else if (c == '[' || c == ']' || c == ':') {
      out += std::string("\\") + c;
    } else {
      out += c;
    }
  }
  return out;
}

std::string zsh(const std::vector<VerbNames>& verbs) {
  std::string names, cases;
  for (const VerbNames& verb : verbs) {
    names += "    '" + verb.name + ":" + quoted(verb.help) + "'\n";
    cases += "    " + verb.name + ")\n      _arguments \\\n";
    for (const OptionNames& option : verb.options) {
      for (const std::string& name : option.names) {
        cases += "        '*" + name + "[" + quoted(option.help) + "]";
        if (!option.choices.empty()) {
          cases += ":value:(" + joined(option.choices, " ") + ")";
        } else if (option.takes_value) {
          cases += option.is_number ? ":number:" : ":value:_files";
        }
        cases += "' \\\n";
      }
    }
    cases += "        '*:file:_files' ;;\n";
  }
  return "#compdef brushfire\n"
         "# zsh completion of brushfire; made by: brushfire completion zsh\n"
         "_brushfire() {\n"
         "  local -a verbs=(\n" +
         names +
         "  )\n"
         "  if (( CURRENT == 2 )); then\n"
         "    _describe verb verbs\n"
         "    return\n"
         "  fi\n"
         "  local verb=$words[2]\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $verb in\n" +
         cases +
         "  esac\n"
         "}\n"
         "if [ \"$funcstack[1]\" = _brushfire ]; then _brushfire \"$@\"; else compdef _brushfire brushfire; fi\n";
}

// Between single quotes, as fish reads them.
std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

std::string fish(const std::vector<VerbNames>& verbs) {
  std::string lines =
      "# fish completion of brushfire; made by: brushfire completion fish\n"
      "complete -c brushfire -n __fish_use_subcommand -f -l help -d 'Print help'\n"
      "complete -c brushfire -n __fish_use_subcommand -f -l version -d 'Print the version'\n";
  for (const VerbNames& verb : verbs) {
    lines +=
        "complete -c brushfire -n __fish_use_subcommand -f -a " + verb.name + " -d " + fish_quoted(verb.help) + "\n";
    const std::string within = "complete -c brushfire -n '__fish_seen_subcommand_from " + verb.name + "'";
    for (const OptionNames& argument : verb.arguments) {
      if (!argument.choices.empty()) lines += within + " -f -a " + fish_quoted(joined(argument.choices, " ")) + "\n";
    }
    for (const OptionNames& option : verb.options) {
      lines += within;
      for (const std::string& name : option.names) {
        lines += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      if (!option.choices.empty()) {
        lines += " -x -a " + fish_quoted(joined(option.choices, " "));
      } else if (option.takes_value) {
        lines += option.is_number ? " -x" : " -r";
      }
      lines += " -d " + fish_quoted(option.help) + "\n";
    }
  }
  return lines;
}

std::string script(const std::string& shell, const std::vector<VerbNames>& verbs) {
  if (shell == "fish") return fish(verbs);
  return shell == "zsh" ? zsh(verbs) : bash(verbs);
}

}  // namespace

void add_completion(CommandLine& command_line) {
  const auto shell = std::make_shared<std::string>();
  command_line.add("completion", "Print a completion script for bash, zsh or fish", [&](Verb& verb) {
    verb.choice("shell", *shell, {"bash", "zsh", "fish"}, "For which shell");
    verb.examples(kExamples);
    verb.run([shell, &command_line](Talk&) {
      write_stdout(script(*shell, command_line.names()));
      return kOk;
    });
  });
}

}  // namespace brushfire::tool
