// The parser, and the one place where failures become exit codes.
#include "command_line.h"

#include "interrupt.h"

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/version.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <new>
#include <set>

namespace brushfire::tool {
namespace {

// Where to look next, for those who typed something wrong.
std::string help_hint(const CLI::App& app) {
  std::string name = app.get_name();
  for (const CLI::App* up = app.get_parent(); up != nullptr; up = up->get_parent())
    name.insert(0, up->get_name() + " ");
  return " (see " + name + " --help)";
}

int exit_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::InvalidArgument:
    case ErrorCode::IndexOutOfRange:
      return kUsage;
    case ErrorCode::InvalidMesh:
    case ErrorCode::FileNotReadable:
    case ErrorCode::FileMalformed:
    case ErrorCode::UnknownFormat:
      return kBadInput;
    case ErrorCode::Cancelled:
      return interrupted_exit_code();
    case ErrorCode::FileNotWritable:
    case ErrorCode::TooLarge:
    case ErrorCode::Internal:
      return kInternal;
  }
  return kInternal;
}

// An error is one line, whatever stands in a file name.
int fail(int code, std::string message) {
  std::replace_if(message.begin(), message.end(), [](unsigned char c) { return c < ' '; }, ' ');
  std::fprintf(stderr, "brushfire: %s\n", message.c_str());
  return code;
}

// A script whose variable is empty means something else than a script that leaves the option away.
CLI::Validator not_empty() {
  return CLI::Validator([](const std::string& text) { return std::string(text.empty() ? "an empty value" : ""); }, "");
}

}  // namespace

struct Verb::Parser {
  CLI::App* app = nullptr;
  Talk talk;
  std::function<int(Talk&)> body;
  std::map<const CLI::Option*, std::vector<std::string>> choices;
  std::map<const CLI::Option*, std::string> refused;  // with the reasons
  std::set<const CLI::Option*> numbers;
  std::string group;

  CLI::Option* placed(CLI::Option* option) const { return group.empty() ? option : option->group(group); }
  void number(const char* names, const std::function<void(const std::string&)>& parse, const char* placeholder,
              const Range& range, const char* help) {
    const CLI::Option* option =
        placed(app->add_option_function<std::string>(names, parse, help)->type_name(placeholder));
    numbers.insert(option);
    for (const NumberWord& w : range.words) choices[option].emplace_back(w.first);
  }
  CLI::Option* choice(CLI::Option* option, const char* help, const std::vector<std::string>& words, bool may_go_on);
};

struct CommandLine::Implementation {
  CLI::App app{"Geodesic distances and shortest paths on triangle meshes.", "brushfire"};
  std::vector<std::unique_ptr<Verb::Parser>> verbs;
};

void Verb::argument(const char* name, std::string& value, const char* help) {
  parser_.app->add_option(name, value, help)->required()->check(not_empty())->type_name("");
}

void Verb::arguments(const char* name, std::vector<std::string>& values, const char* help) {
  parser_.app->add_option(name, values, help)->check(not_empty())->type_name("");
}

void Verb::required_option(const char* names, std::string& value, const char* placeholder, const char* help) {
  parser_.placed(parser_.app->add_option(names, value, help)->required()->check(not_empty())->type_name(placeholder));
}

void Verb::option(const char* names, std::string& value, const char* placeholder, const char* help) {
  parser_.placed(parser_.app->add_option(names, value, help)->check(not_empty())->type_name(placeholder));
}

namespace {

// "--radius" of "-r,--radius".
std::string long_name(std::string_view names) {
  const std::size_t at = names.find("--");
  return std::string(names.substr(at, names.find(',', at) - at));
}

}  // namespace

void Verb::option(const char* names, std::optional<double>& value, const char* placeholder, const Range& range,
                  const char* help) {
  const auto parse = [&value, range, name = long_name(names)](const std::string& text) {
    value = number_in(range, name, text);
  };
  parser_.number(names, parse, placeholder, range, help);
}

void Verb::option(const char* names, std::optional<int>& value, const char* placeholder, const Range& range,
                  const char* help) {
  const auto parse = [&value, range, name = long_name(names)](const std::string& text) {
    value = static_cast<int>(number_in(range, name, text));
  };
  parser_.number(names, parse, placeholder, range, help);
}

void Verb::option(const char* names, std::vector<std::string>& values, const char* placeholder, const char* help) {
  parser_.placed(parser_.app->add_option(names, values, help)
                     ->allow_extra_args(false)
                     ->check(not_empty())
                     ->type_name(placeholder));
}

// The choices stand in the help, in lines that fit beside the names. `may_go_on`: behind a colon.
CLI::Option* Verb::Parser::choice(CLI::Option* option, const char* help, const std::vector<std::string>& words,
                                  bool may_go_on) {
  constexpr std::size_t kLine = 88;
  std::string listed, help_text = help + std::string(": ");
  for (const std::string& c : words) {
    listed += (listed.empty() ? "" : ", ") + c;
    const std::size_t line = help_text.size() - (help_text.rfind('\n') + 1);  // npos + 1 is 0
    if (c != words.front()) help_text += line + c.size() < kLine ? ", " : ",\n";
    help_text += c;
  }
  const auto one_of = [words, listed, may_go_on](const std::string& text) {
    const std::string word = may_go_on ? text.substr(0, text.find(':')) : text;
    return std::find(words.begin(), words.end(), word) != words.end() ? std::string()
                                                                      : "'" + word + "' is none of " + listed;
  };
  choices[option] = words;
  return placed(option->description(help_text)->check(CLI::Validator(one_of, ""))->type_name("NAME"));
}

void Verb::choice(const char* names, std::string& value, const std::vector<std::string>& choices, const char* help) {
  CLI::Option* option = parser_.choice(parser_.app->add_option(names, value), help, choices, false);
  option->capture_default_str();
  if (names[0] != '-') option->required();
}

void Verb::choice(const char* names, std::vector<std::string>& values, const std::vector<std::string>& choices,
                  const char* help) {
  parser_.choice(parser_.app->add_option(names, values), help, choices, true)->allow_extra_args(false);
}

void Verb::flag(const char* names, bool& value, const char* help) {
  parser_.placed(parser_.app->add_flag(names, value, help));
}

void Verb::refused(const char* names, bool takes_value, const std::string& reason) {
  const auto refuse_it = [name = long_name(names), reason] { refuse(name + ": " + reason); };
  CLI::Option* option =
      takes_value ? parser_.app->add_option_function<std::string>(names, [=](const std::string&) { refuse_it(); })
                  : parser_.app->add_flag_callback(names, refuse_it);
  option->group("")->allow_extra_args(false);
  parser_.refused[option] = reason;
}

void Verb::group(const char* title) { parser_.group = title; }

void Verb::talks() {
  flag("--json", parser_.talk.json, "Print one JSON object with stable keys instead of words");
  flag("-q,--quiet", parser_.talk.quiet, "No remarks and no progress bar on stderr");
}

void Verb::examples(const char* text) { parser_.app->footer(text); }

void Verb::run(std::function<int(Talk&)> body) { parser_.body = std::move(body); }

CommandLine::CommandLine() : implementation_(std::make_unique<Implementation>()) {
  CLI::App& app = implementation_->app;
  app.set_version_flag("--version", std::string("brushfire ") + kVersion);
  app.set_help_flag("-h,--help", "Print this help");
  app.require_subcommand(0, 1);
  app.get_formatter()->label("SUBCOMMAND", "VERB");
  app.get_formatter()->label("Positionals", "Arguments");
  app.get_formatter()->label("REQUIRED", "");
  app.get_formatter()->column_width(28);
  app.failure_message([](const CLI::App*, const CLI::Error& e) { return std::string(e.what()); });
  app.footer(
      "brushfire VERB --help tells more, with examples.\n"
      "\n"
      "Begin with:\n"
      "  brushfire info bunny.ply\n"
      "  brushfire distance bunny.ply --source 0 -o bunny-distance.ply\n"
      "\n"
      "Exit codes: 0 done, 1 internal error or output not writable, 2 usage, 3 unusable input file,\n"
      "4 target unreachable, 5 field proven wrong, 130 interrupted (Ctrl-C), 143 terminated.");
}

CommandLine::~CommandLine() = default;

void CommandLine::add(const char* name, const char* help, const std::function<void(Verb&)>& describe) {
  Verb::Parser& parser = *implementation_->verbs.emplace_back(std::make_unique<Verb::Parser>());
  parser.app = implementation_->app.add_subcommand(name, help);
  parser.app->group("Verbs")->set_help_flag("-h,--help", "Print this help");
  Verb verb(parser);
  describe(verb);
}

int CommandLine::run(int argc, const char* const* argv) {
  CLI::App& app = implementation_->app;
  try {
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& e) {  // --help, --version
      const bool version = dynamic_cast<const CLI::CallForVersion*>(&e) != nullptr;
      write_stdout(version ? std::string(e.what()) + "\n" : app.help());
      return kOk;
    } catch (const CLI::ParseError& e) {
      const CLI::App* at = &app;
      for (const CLI::App* sub : app.get_subcommands()) at = sub;
      const bool has_word = at == &app && argc > 1 && argv[1][0] != '-';
      const std::string what = has_word ? "there is no verb " + in_quotes(argv[1]) : e.what();
      return fail(kUsage, what + help_hint(*at));
    }
    for (const auto& verb : implementation_->verbs) {
      if (!verb->app->parsed()) continue;
      cancel_on_interrupt();
      const CancelScope listen(&cancel_token());
      return verb->body(verb->talk);
    }
    write_stdout(app.help());
    return kOk;
  } catch (const Error& e) {
    if (e.code() != ErrorCode::Cancelled) return fail(exit_code(e.code()), e.what());
    say_interrupted();
    return interrupted_exit_code();
  } catch (const Unreachable& e) {
    return fail(kUnreachable, e.what());
  } catch (const std::bad_alloc&) {
    return fail(kInternal, "not enough memory");
  } catch (const std::exception& e) {
    return fail(kInternal, std::string("internal error: ") + e.what());
  }
}

void refuse(const std::string& what) { throw Error(ErrorCode::InvalidArgument, what); }

std::string CommandLine::footer() const { return implementation_->app.get_footer(); }

std::vector<VerbNames> CommandLine::names() const {
  std::vector<VerbNames> verbs;
  for (const auto& parser : implementation_->verbs) {
    VerbNames& verb = verbs.emplace_back();
    verb.name = parser->app->get_name();
    verb.help = parser->app->get_description();
    verb.footer = parser->app->get_footer();
    for (const CLI::Option* option : parser->app->get_options()) {
      const bool dashed = option->nonpositional();
      const auto reason = parser->refused.find(option);
      std::vector<OptionNames>& list = !dashed                           ? verb.arguments
                                       : reason == parser->refused.end() ? verb.options
                                                                         : verb.refused;
      OptionNames& names = list.emplace_back();
      for (const std::string& s : option->get_snames()) names.names.push_back("-" + s);
      for (const std::string& l : option->get_lnames()) names.names.push_back("--" + l);
      if (!dashed) names.names = {option->get_name()};
      names.takes_value = option->get_items_expected_max() > 0;
      names.is_number = parser->numbers.contains(option);
      if (names.takes_value) names.placeholder = option->get_type_name();
      names.help = reason == parser->refused.end() ? option->get_description() : reason->second;
      std::replace(names.help.begin(), names.help.end(), '\n', ' ');
      if (const auto found = parser->choices.find(option); found != parser->choices.end()) {
        names.choices = found->second;
      }
    }
  }
  return verbs;
}

}  // namespace brushfire::tool
