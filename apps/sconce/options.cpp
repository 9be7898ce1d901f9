// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "app.h"
#include "config.h"
#include "core/error.h"
#include "core/text.h"
#include "declared.h"
#include "values.h"

namespace sconce::app {

namespace {

/// "--density" of "-d,--density"; the short name where there is no long one; the bare name of a positional.
std::string main_name(const std::string& names) {
  const std::vector<std::string> all = split(names, ',');
  for (const std::string& name : all) {
    if (name.starts_with("--")) return name;
  }
  return all.front();
}

std::string key_of(const std::string& names) {
  const std::string name = main_name(names);
  return name.substr(std::min(name.find_first_not_of('-'), name.size()));
}

UsageError unknown_option(const std::string& wrong, std::span<const Declared> declared) {
  const std::string name = wrong.substr(0, wrong.find('='));
  std::vector<std::string> known;
  for (const Declared& d : declared) {
    if (d.positional) continue;
    for (const std::string& n : split(d.names, ',')) known.push_back(n);
  }
  const std::optional<std::string> nearest = nearest_name(name, known);
  return UsageError({}, fmt::format("unknown option '{}'; {}", name,
                                    nearest ? "did you mean '" + *nearest + "'?" : "see --help"));
}

}  // namespace

struct Options::State {
  std::string verb, summary;
  Guide guide;
  std::vector<Declared> declared;
  bool help = false;

  Declared& add(const std::string& names, const std::string& doc, const char* placeholder) {
    Declared& d = declared.emplace_back();
    d.names = names;
    d.key = key_of(names);
    d.doc = doc;
    d.placeholder = placeholder;
    return d;
  }
  template <class T>
  Declared& add_value(const std::string& names, T* value, const std::string& doc, const char* placeholder,
                      T (*parse)(std::string_view), std::string (*show)(T)) {
    Declared& d = add(names, doc, placeholder);
    d.assign = [value, parse](const std::vector<std::string>& texts) { *value = parse(texts.front()); };
    d.show = [value, show] { return show(*value); };
    return d;
  }
  Declared& add_text(const std::string& names, std::string* value, const std::string& doc) {
    Declared& d = add(names, doc, "TEXT");
    d.assign = [value](const std::vector<std::string>& texts) { *value = texts.front(); };
    d.show = [value] { return *value; };
    return d;
  }
  Declared& add_texts(const std::string& names, std::vector<std::string>* values, const std::string& doc) {
    Declared& d = add(names, doc, "TEXT");
    d.many = true;
    d.assign = [values](const std::vector<std::string>& texts) { *values = texts; };
    d.show = [values] { return join(*values, " "); };
    return d;
  }
  Declared& add_flag(const std::string& names, bool* value, const std::string& doc) {
    Declared& d = add(names, doc, "");
    d.assign = [value](const std::vector<std::string>& texts) {
      if (texts.front() != "true" && texts.front() != "false") {
        throw UsageError({}, "expected true or false, got '" + texts.front() + "'");
      }
      *value = texts.front() == "true";
    };
    d.show = [value] { return *value ? "true" : "false"; };
    return d;
  }

  void read_command_line(int argc, const char* const* argv);
  void take(Declared& d, const std::vector<std::string>& texts);
  void take_file(const std::string& path, const std::string& source_name, bool table_required);
};

void Options::State::take(Declared& d, const std::vector<std::string>& texts) {
  const std::string name = main_name(d.names);
  if (!d.many && texts.size() > 1)
    throw UsageError({}, fmt::format("option '{}' is given more than once", name));
  for (const std::string& text : texts) {
    if (!d.positional && text.starts_with("--")) {
      throw UsageError({}, fmt::format("option '{}' needs a value, got '{}'", name, text));
    }
  }
  try {
    d.assign(texts);
  } catch (const UsageError& error) {
    throw UsageError(d.positional ? name : "option '" + name + "'", error.what());
  }
  d.source = "command line";
}

void Options::State::read_command_line(int argc, const char* const* argv) {
  CLI::App app(summary, verb);
  app.set_help_flag();
  app.allow_extras();
  std::vector<CLI::Option*> handles;
  for (const Declared& d : declared) {
    CLI::Option* handle =
        d.is_flag() ? app.add_flag(d.names) : app.add_option(d.names, CLI::callback_t{}, d.doc, false);
    handle->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    if (!d.is_flag() && d.positional && d.many) {
      handle->expected(-1);
    } else if (!d.is_flag()) {
      handle->expected(1)->allow_extra_args(false);
    }
    handles.push_back(handle);
  }
  std::vector<std::string> reversed(argv, argv + argc);  // without the program's name, as CLI11 wants it
  std::reverse(reversed.begin(), reversed.end());
  std::optional<std::string> complaint;
  try {
    app.parse(reversed);
  } catch (const CLI::ArgumentMismatch&) {
    complaint = fmt::format("option '{}' needs a value", argv[argc - 1]);
  } catch (const CLI::ParseError& error) {
    complaint = error.what();
  }
  for (std::size_t i = 0; i < declared.size(); ++i) {
    if (declared[i].key == "help" && handles[i]->count() > 0) {
      help = true;
      return;
    }
  }
  const std::vector<std::string> extras = app.remaining();
  for (const std::string& extra : extras) {
    if (extra.size() > 1 && extra.front() == '-') throw unknown_option(extra, declared);
  }
  if (complaint) throw UsageError({}, *complaint);
  if (!extras.empty())
    throw UsageError({}, fmt::format("unexpected argument '{}'; see --help", extras.front()));
  for (std::size_t i = 0; i < declared.size(); ++i) {
    Declared& d = declared[i];
    if (handles[i]->count() > 0) {
      take(d, d.is_flag() ? std::vector<std::string>{handles[i]->results().back()} : handles[i]->results());
    } else if (d.required) {
      throw UsageError({}, fmt::format("missing argument {}: {}", d.names, d.doc));
    }
  }
}

void Options::State::take_file(const std::string& path, const std::string& source_name, bool table_required) {
  const ConfigFile file = read_config(path);
  if (table_required && !file.has_table) throw UsageError(path, "has no table [options]");
  std::vector<std::string> known;
  for (const Declared& d : declared) {
    if (d.in_files && !d.positional) known.push_back(d.key);
  }
  for (const ConfigEntry& entry : file.entries) {
    const auto match = std::find_if(declared.begin(), declared.end(), [&](const Declared& d) {
      return d.in_files && !d.positional && d.key == entry.key;
    });
    if (match == declared.end()) {
      throw UsageError(entry.where,
                       fmt::format("unknown option '{}'{}", entry.key, did_you_mean(entry.key, known)),
                       join(known, ", "));
    }
    const std::string where = entry.where + ": option '" + entry.key + "'";
    if (match->is_flag() != entry.is_boolean) {
      throw UsageError(where, entry.is_boolean ? "takes a value" : "is a switch",
                       entry.is_boolean ? "a text or a number" : "true, false");
    }
    if (!match->many && entry.values.size() != 1) throw UsageError(where, "takes one value, not a list");
    if (match->source != "default") continue;
    try {
      match->assign(entry.values);
    } catch (const UsageError& error) {
      throw UsageError(where, error.what());
    }
    match->source = fmt::format("{}:{}", source_name, entry.line);
  }
}

Options::Options(std::string verb, std::string summary, Guide guide) : state_(std::make_unique<State>()) {
  state_->verb = std::move(verb);
  state_->summary = std::move(summary);
  state_->guide = guide;
}

Options::~Options() = default;

void Options::positional(const std::string& name, std::string* value, const std::string& doc, bool required) {
  Declared& d = state_->add_text(name, value, doc);
  d.positional = true;
  d.required = required;
}

void Options::positionals(const std::string& name, std::vector<std::string>* values, const std::string& doc,
                          bool required) {
  Declared& d = state_->add_texts(name, values, doc);
  d.positional = true;
  d.required = required;
}

void Options::option(const std::string& names, std::string* value, const std::string& doc) {
  state_->add_text(names, value, doc);
}

void Options::option(const std::string& names, std::vector<std::string>* values, const std::string& doc) {
  state_->add_texts(names, values, doc);
}

void Options::option(const std::string& names, int* value, const std::string& doc) {
  state_->add_value<int>(names, value, doc, "N", parse_int, [](int v) { return std::to_string(v); });
}

void Options::option(const std::string& names, double* value, const std::string& doc) {
  state_->add_value<double>(names, value, doc, "NUMBER", parse_real, show_real);
}

void Options::duration(const std::string& names, double* seconds, const std::string& doc) {
  state_->add_value<double>(names, seconds, doc, "TIME", parse_duration,
                            [](double v) { return show_real(v) + "s"; });
}

void Options::flag(const std::string& names, bool* value, const std::string& doc) {
  state_->add_flag(names, value, doc);
}

std::optional<int> Options::parse(int argc, const char* const* argv) {
  flag("--json", &json, "report as JSON on standard output");
  flag("--quiet", &quiet, "no progress line, no closing summary");
  option("--threads", &threads, "worker threads, 0 = all of the machine");
  state_->add_text("--config", &config, "file whose [options] apply where the command line says nothing")
      .in_files = false;
  state_->add_flag("-h,--help", &state_->help, "show this").in_files = false;
  try {
    state_->read_command_line(argc, argv);
    if (state_->help) {
      std::fputs(help_text(state_->verb, state_->summary, state_->declared, state_->guide).c_str(), stdout);
      return kDone;
    }
    if (!config.empty()) state_->take_file(config, config, true);
    if (threads < 0) throw UsageError("option '--threads'", "expected 0 or more");
  } catch (const UsageError& error) {
    print_error(state_->verb, error.what());
    return kUsage;
  }
  return std::nullopt;
}

void Options::apply_file(const std::string& path, const std::string& source_name) {
  if (std::filesystem::exists(path)) state_->take_file(path, source_name, false);
}

std::map<std::string, Options::Value> Options::provenance() const {
  std::map<std::string, Value> values;
  for (const Declared& d : state_->declared) {
    if (d.key != "help") values[d.key] = {d.show(), d.source};
  }
  return values;
}

void Options::next(const std::vector<std::string>& files) const {
  if (quiet || json) return;
  std::fputs(("next: " + next_step(state_->guide.next, files) + "\n").c_str(), stdout);
}

}  // namespace sconce::app
