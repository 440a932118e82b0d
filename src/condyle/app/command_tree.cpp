#include "condyle/app/command_tree.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace condyle {
namespace {

/// CLI11 writes the words that will do as {a,b,c} behind the type.
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  std::vector<std::string> words;
  std::istringstream list(type.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(list, word, ',');) words.push_back(word);
  return words;
}

OptionFacts facts_of(const CLI::Option& option) {
  OptionFacts facts;
  for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
  facts.positional = facts.names.empty();
  if (facts.positional) facts.names.push_back(option.get_name());
  facts.description = option.get_description();
  facts.default_value = option.get_default_str();
  facts.choices = choices_of(option.get_type_name());
  facts.takes_value = option.get_items_expected_max() > 0;
  facts.required = option.get_required();
  return facts;
}

std::vector<OptionFacts> options_of(const CLI::App& app) {
  std::vector<OptionFacts> options;
  for (const CLI::Option* option : app.get_options()) options.push_back(facts_of(*option));
  return options;
}

enum class Kind { kText, kNumber, kWhole, kCount };

Kind kind_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type.rfind("FLOAT", 0) == 0) return Kind::kNumber;
  if (type.rfind("INT", 0) == 0) return Kind::kWhole;
  return type.rfind("UINT", 0) == 0 ? Kind::kCount : Kind::kText;
}

/// What is wrong with a value; nothing where it will do, or where CLI11 says it.
std::string fault_of(Kind kind, const std::string& text) {
  if (text.empty()) return kind == Kind::kText ? "expected a value" : "expected a number";
  if (kind == Kind::kText) return {};
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size()) return {};
  if (!std::isfinite(number)) return text + ", expected a finite number";
  if (kind == Kind::kNumber) return {};
  if (text.find_first_of(".eExXpP") != std::string::npos) return text + ", expected a whole number";
  return kind == Kind::kCount && number < 0 ? text + ", expected a whole number >= 0" : "";
}

}  // namespace

void check_values(CLI::App& program) {
  for (CLI::App* command : program.get_subcommands(nullptr)) {
    for (CLI::Option* option : command->get_options()) {
      if (option->get_items_expected_max() == 0) continue;
      option->transform(CLI::Validator(  // before its other checks, which say less
          [kind = kind_of(*option)](const std::string& text) { return fault_of(kind, text); }, ""));
    }
  }
}

ProgramFacts program_facts(const CLI::App& program) {
  ProgramFacts facts{program.get_name(), program.get_description(), options_of(program), {}};
  for (const CLI::App* command : program.get_subcommands(nullptr)) {
    facts.commands.push_back({command->get_name(), command->get_description(),
                              command->get_footer(), options_of(*command)});
  }
  return facts;
}

}  // namespace condyle
