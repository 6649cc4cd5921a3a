// brushfire completion: scripts that make bash and zsh complete verbs, options and their values.
#include "command_line.h"

#include <memory>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  source <(brushfire completion bash)
  brushfire completion bash > ~/.local/share/bash-completion/completions/brushfire
  brushfire completion zsh > "${fpath[1]}/_brushfire"
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
          cases += ":value:_files";
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

}  // namespace

void add_completion(CommandLine& command_line) {
  const auto shell = std::make_shared<std::string>();
  command_line.add("completion", "Print a completion script for bash or zsh", [&](Verb& verb) {
    verb.choice("shell", *shell, {"bash", "zsh"}, "For which shell");
    verb.examples(kExamples);
    verb.run([shell, &command_line](Talk&) {
      write_stdout(*shell == "zsh" ? zsh(command_line.names()) : bash(command_line.names()));
      return kOk;
    });
  });
}

}  // namespace brushfire::tool
