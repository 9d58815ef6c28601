#include "options/option_list.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

namespace burin::host {

bool Option::isGiven() const {
  return !option_->empty();
}

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::needs(const std::string& name) {
  option_->needs(name);
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

Option OptionList::text(const std::string& name, std::string& value, const std::string& type,
                        const std::string& help) {
  return Option{*app_->add_option(name, value, help)->type_name(type)};
}

Option OptionList::path(const std::string& name, std::filesystem::path& value,
                        const std::string& type, const std::string& help) {
  return Option{*app_->add_option(name, value, help)->type_name(type)};
}

Option OptionList::choice(const std::string& name, std::string& value,
                          const std::vector<std::string>& words, const std::string& help,
                          const std::string& type) {
  const std::string called = type.empty() ? fmt::format("{}", fmt::join(words, "|")) : type;
  return Option{
      *app_->add_option(name, value, help)->type_name(called)->check(CLI::IsMember(words))};
}

Option OptionList::integer(const std::string& name, int& value, int least, int most,
                           const std::string& help) {
  return Option{
      *app_->add_option(name, value, help)->type_name("N")->check(CLI::Range(least, most))};
}

Option OptionList::number(const std::string& name, double& value, const std::string& type,
                          const std::string& help) {
  return Option{*app_->add_option(name, value, help)->type_name(type)};
}

Option OptionList::number(const std::string& name, double& value, double least, double most,
                          const std::string& help) {
  return Option{
      *app_->add_option(name, value, help)->type_name("X")->check(CLI::Range(least, most))};
}

Option OptionList::flag(const std::string& name, bool& value, const std::string& help) {
  return Option{*app_->add_flag(name, value, help)};
}

Option OptionList::texts(const std::string& name, std::vector<std::string>& values,
                         const std::string& type, const std::string& help) {
  return Option{*app_->add_option(name, values, help)->type_name(type)->allow_extra_args(false)};
}

Option OptionList::positionals(const std::string& name, std::vector<std::string>& values,
                               const std::string& type, const std::string& help) {
  return Option{*app_->add_option(name, values, help)->type_name(type)};
}

Option OptionList::integers(const std::string& name, std::vector<int>& values,
                            const std::string& help) {
  return Option{*app_->add_option(name, values, help)
                     ->type_name("N,N,…")
                     ->delimiter(',')
                     ->allow_extra_args(false)};
}

Option OptionList::integers(const std::string& name, std::vector<int>& values, int least, int most,
                            const std::string& help) {
  return Option{*app_->add_option(name, values, help)
                     ->type_name("N,N,…")
                     ->delimiter(',')
                     ->allow_extra_args(false)
                     ->check(CLI::Range(least, most))};
}

void OptionList::footer(const std::string& text) {
  app_->footer(text);
}

}  // namespace burin::host
