#include "condyle/app/list_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace condyle {
namespace {

/// Items between commas, empty ones too.
std::vector<std::string> items_of(const std::string& list) {
  std::vector<std::string> items;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    items.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return items;
}

bool take(const std::string& item, double& number) {
  char* end = nullptr;
  number = std::strtod(item.c_str(), &end);
  return !item.empty() && end == item.c_str() + item.size() && std::isfinite(number);
}

bool take(const std::string& item, std::string& word) {
  word = item;
  return !item.empty();
}

template <class T>
CLI::Option* add_list_of(CLI::App& command,
                         const std::string& name,
                         std::vector<T>& list,
                         const std::string& help,
                         const char* expected) {
  const auto take_lists = [&list, name, expected](const CLI::results_t& texts) {
    list.clear();
    for (const std::string& text : texts) {
      for (const std::string& item : items_of(text)) {
        if (!take(item, list.emplace_back()))
          throw CLI::ValidationError(fmt::format("{} = {}, expected {}", name, text, expected));
      }
    }
    return true;
  };
  return command.add_option(name, take_lists, help)
      ->type_name(CLI::detail::type_name<T>())
      ->type_size(1)
      ->expected(-1)
      ->allow_extra_args(false);
}

}  // namespace

void add_list(CLI::App& command,
              const std::string& name,
              std::vector<double>& numbers,
              const std::string& help) {
  add_list_of(command, name, numbers, help, "numbers with a comma between two");
}

void add_list(CLI::App& command,
              const std::string& name,
              std::vector<std::string>& words,
              const std::string& help) {
  CLI::Option* option = add_list_of(command, name, words, help, "words with a comma between two");
  if (!words.empty()) option->default_str(CLI::detail::join(words));
}

}  // namespace condyle
