#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace burin::host {

/// An option of a command, valid as long as the command line that it belongs to is being read.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_{&option} {}

  /// Once the arguments are read.
  bool isGiven() const;

  Option& required();
  /// Only beside the option of that name, which stands in the list already.
  Option& needs(const std::string& name);
  /// Not beside that one.
  Option& excludes(const Option& other);

 private:
  CLI::Option* option_;
};

/// The options that one command takes, in the order in which --help lists them. Values must outlive
/// the reading; one that is not given stays as it is, so defaults stand in the caller's struct.
/// `type` is what --help calls a value. What breaks a stated range or choice is a usage error that
/// names the option. CLI11 is behind this: files that describe options do not pay for its headers.
class OptionList {
 public:
  explicit OptionList(CLI::App& app) : app_{&app} {}

  Option text(const std::string& name, std::string& value, const std::string& type,
              const std::string& help);
  Option path(const std::string& name, std::filesystem::path& value, const std::string& type,
              const std::string& help);
  /// One of `words`; called by them, A|B|C, if there is no `type`.
  Option choice(const std::string& name, std::string& value, const std::vector<std::string>& words,
                const std::string& help, const std::string& type = {});
  /// In [least, most].
  Option integer(const std::string& name, int& value, int least, int most, const std::string& help);
  Option number(const std::string& name, double& value, const std::string& type,
                const std::string& help);
  /// In [least, most].
  Option number(const std::string& name, double& value, double least, double most,
                const std::string& help);
  Option flag(const std::string& name, bool& value, const std::string& help);

  /// May be repeated, one text each time.
  Option texts(const std::string& name, std::vector<std::string>& values, const std::string& type,
               const std::string& help);
  /// All positional arguments.
  Option positionals(const std::string& name, std::vector<std::string>& values,
                     const std::string& type, const std::string& help);
  /// N,N,…
  Option integers(const std::string& name, std::vector<int>& values, const std::string& help);
  /// N,N,…, each in [least, most].
  Option integers(const std::string& name, std::vector<int>& values, int least, int most,
                  const std::string& help);

  /// What stands below the list.
  void footer(const std::string& text);

 private:
  CLI::App* app_;
};

}  // namespace burin::host
