// brushfire manual: the manual pages, in the language of man(7), made from what --help is made from.
#include "command_line.h"

#include <brushfire/core/error.h>
#include <brushfire/version.h>

#include <filesystem>
#include <fstream>
#include <memory>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire manual --verb distance > brushfire-distance.1
  brushfire manual --folder ~/.local/share/man/man1
)";

// Text in which man(7) finds no commands: hyphens that can be copied, no backslash, no dot or quote that begins a line.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool line_begins = out.empty() || out.back() == '\n';
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string heading(const std::string& page, const std::string& help) {
  return ".\\\" made by: brushfire manual\n.TH " + roff(page) + " 1 \"\" \"brushfire " + kVersion +
         "\" \"User commands\"\n.SH NAME\n" + roff(page) + " \\- " + roff(help) + "\n";
}

// As it stands there, line by line: examples, mostly.
std::string verbatim(const std::string& text) {
  return ".nf\n" + roff(text) + (text.ends_with('\n') ? "" : "\n") + ".fi\n";
}

std::string item(const OptionNames& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
  if (!option.placeholder.empty()) names += " " + italic(option.placeholder);
  return ".TP\n" + names + "\n" + roff(option.help) + "\n";
}

std::string page_of(const VerbNames& verb) {
  std::string page = heading("brushfire-" + verb.name, verb.help) + ".SH SYNOPSIS\n" + bold("brushfire " + verb.name);
  for (const OptionNames& argument : verb.arguments) page += " " + italic(argument.names.front());
  page += " [" + italic("options") + "]\n";
  if (!verb.arguments.empty()) page += ".SH ARGUMENTS\n";
  for (const OptionNames& argument : verb.arguments) page += item(argument);
  page += ".SH OPTIONS\n";
  for (const OptionNames& option : verb.options) page += item(option);
  if (!verb.refused.empty()) page += ".SH OPTIONS THAT OTHER VERBS HAVE\n";
  for (const OptionNames& option : verb.refused) page += item(option);
  if (!verb.footer.empty()) page += ".SH MORE\n" + verbatim(verb.footer);
  return page + ".SH SEE ALSO\n.BR brushfire (1)\n";
}

std::string page_of_program(const CommandLine& command_line) {
  std::string page = heading("brushfire", "geodesic distances and shortest paths on triangle meshes") +
                     ".SH SYNOPSIS\n" + bold("brushfire") + " " + italic("verb") + " [" + italic("options") +
                     "]\n.SH VERBS\n";
  for (const VerbNames& verb : command_line.names()) {
    page += ".TP\n.BR brushfire\\-" + roff(verb.name) + " (1)\n" + roff(verb.help) + "\n";
  }
  return page + ".SH MORE\n" + verbatim(command_line.footer());
}

void write_page(const std::filesystem::path& path, const std::string& page) {
  std::ofstream file(path, std::ios::binary);
  file << page;
  file.close();
  if (!file) throw Error(ErrorCode::FileNotWritable, path.string() + ": cannot be written");
}

void write_pages(const std::filesystem::path& folder, const CommandLine& command_line) {
  write_page(folder / "brushfire.1", page_of_program(command_line));
  for (const VerbNames& verb : command_line.names()) {
    write_page(folder / ("brushfire-" + verb.name + ".1"), page_of(verb));
  }
}

std::string page_named(const std::string& name, const CommandLine& command_line) {
  for (const VerbNames& verb : command_line.names()) {
    if (verb.name == name) return page_of(verb);
  }
  refuse("--verb: there is no verb '" + name + "'");
}

}  // namespace

void add_manual(CommandLine& command_line) {
  struct Arguments {
    std::string verb, folder;
  };
  const auto a = std::make_shared<Arguments>();
  command_line.add("manual", "Print a manual page, or write all of them", [&](Verb& verb) {
    verb.option("--verb", a->verb, "VERB", "The page of this verb; the program's own if not given");
    verb.option("--folder", a->folder, "DIR", "Write the pages of the program and of all verbs into this folder");
    verb.examples(kExamples);
    verb.run([a, &command_line](Talk&) {
      if (!a->folder.empty()) {
        write_pages(a->folder, command_line);
      } else {
        write_stdout(a->verb.empty() ? page_of_program(command_line) : page_named(a->verb, command_line));
      }
      return kOk;
    });
  });
}

}  // namespace brushfire::tool
