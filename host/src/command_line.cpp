#include "burin/host/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <sstream>

#include "burin/common/error.hpp"
#include "burin/common/nearest_name.hpp"
#include "options/describe.hpp"

namespace burin::host {

namespace {

struct CommandEntry {
  const char* name;
  const char* help;
  Finish (*describe)(OptionList&);
};

constexpr const char* kBench = "bench";

/// In the order of --help; `bench` comes after them.
constexpr CommandEntry kCommands[] = {
    {"render", "Draw a scene or a volume", describeRender},
    {"info", "Describe a volume", describeInfo},
    {"make-volume", "Write a procedural volume", describeMakeVolume},
    {"styles", "List the styles and their parameters", describeStyles},
    {"gallery", "Draw a scene in every named style, or several scenes, on one sheet",
     describeGallery},
    {"colormap", "Convert colour maps of other programs", describeColormap}};

constexpr CommandEntry kBenchmarks[] = {
    {"compositing", "Merging subimages, against IceT", describeBenchCompositing},
    {"accuracy", "Error against time and samples", describeBenchAccuracy},
    {"max-error", "Whether quality.max_error is kept, and at what cost", describeBenchMaxError},
    {"skip", "Skipping empty space, on and off", describeBenchSkip},
    {"scaling", "Frames on ever more ranks", describeBenchScaling},
    {"rates", "Samples per second, against the same program with all lanes busy",
     describeBenchRates}};

constexpr const char* kProgramFooter = R"(Examples:
  burin render head.nrrd -o head.png                draw a volume with a scene of burin's own
  mpirun --bind-to none -n 4 burin render scene.json   the same picture, from four ranks
  burin info head.nrrd                              what the file holds
  burin COMMAND --help                              the options of one command

Exit codes: 0 done, 2 bad usage or scene, 3 bad volume, 4 a rank failed.)";

std::vector<std::string_view> commandNames() {
  std::vector<std::string_view> names;
  for (const CommandEntry& entry : kCommands) names.emplace_back(entry.name);
  names.emplace_back(kBench);
  return names;
}

/// CLI11 would only say that a subcommand is missing.
void checkCommandName(std::span<const char* const> arguments) {
  const auto names = commandNames();
  if (arguments.empty())
    fail(ExitCode::kUsage, "expected a command: {} (burin --help tells more)",
         fmt::join(names, ", "));
  const std::string_view name = arguments.front();
  if (name == "-h" || name == "--help" || name == "--version") return;
  if (std::ranges::find(names, name) != names.end()) return;
  fail(ExitCode::kUsage, "unknown command '{}': {}", name, nameSuggestion(name, names));
}

/// "--size is given twice" for an option that takes one value and got more; else "".
std::string givenTwice(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::size_t given = option->results().size();
    if (option->get_items_expected_max() != 1 || given < 2) continue;
    const std::string times = given == 2 ? "twice" : fmt::format("{} times", given);
    return fmt::format("{} is given {}", option->get_name(), times);
  }
  return {};
}

/// CLI11's own words on one line, with where to read more.
[[noreturn]] void failUsage(const CLI::App& app, const CLI::ParseError& error) {
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  const auto chosen = app.get_subcommands();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr && !chosen.empty()) {
    const std::string twice = givenTwice(*chosen.front());
    if (!twice.empty()) message = twice;
  }
  const std::string program = chosen.empty() ? "burin" : "burin " + chosen.front()->get_name();
  fail(ExitCode::kUsage, "{} ({} --help lists the options)", message, program);
}

/// Arguments in the order CLI11 wants: last one first.
std::vector<std::string> reversed(std::span<const char* const> arguments) {
  return {arguments.rbegin(), arguments.rend()};
}

/// A command and how it ends.
struct Described {
  const CLI::App* app;
  Finish finish;
};

void describe(CLI::App& parent, std::span<const CommandEntry> entries,
              std::vector<Described>& commands) {
  for (const CommandEntry& entry : entries) {
    CLI::App& app = *parent.add_subcommand(entry.name, entry.help);
    OptionList list{app};
    commands.push_back({&app, entry.describe(list)});
  }
}

}  // namespace

bool isSceneFile(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".json" || extension == ".jsonc";
}

const char* programVersion() {
  return BURIN_VERSION;
}

Command parseCommandLine(std::span<const char* const> arguments, int ranks) {
  checkCommandName(arguments);
  CLI::App app{"burin draws illustrations of volume data, on any number of MPI ranks.", "burin"};
  app.set_version_flag("--version", std::string{"burin "} + programVersion());
  app.footer(kProgramFooter);
  app.require_subcommand(1);
  std::vector<Described> commands;
  describe(app, kCommands, commands);
  CLI::App& bench = *app.add_subcommand(kBench, "Measure burin");
  bench.require_subcommand(1);
  describe(bench, kBenchmarks, commands);

  try {
    app.parse(reversed(arguments));
  } catch (const CLI::Success& wanted) {  // --help or --version
    std::ostringstream out, unused;
    app.exit(wanted, out, unused);
    return Answer{out.str()};
  } catch (const CLI::ParseError& error) {
    failUsage(app, error);
  }
  const auto chosen = std::ranges::find_if(
      commands, [](const Described& command) { return command.app->parsed(); });
  BURIN_CHECK(chosen != commands.end());
  return chosen->finish(ranks);
}

}  // namespace burin::host
