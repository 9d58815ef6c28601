#include <cstdio>
#include <string>

#include "burin/common/error.hpp"
#include "burin/common/named_style.hpp"
#include "burin/common/style.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host {

namespace {

std::string namedStylesHelp() {
  std::string text = "Named styles, for \"style\": \"NAME\" in a layer:\n\n";
  for (const NamedStyle& style : findNamedStyles(styleFolders()))
    text += fmt::format("  {:<14} {}\n", style.name, style.description);
  return text;
}

}  // namespace

int runCommand(const Communicator& comm, const StylesOptions&) {
  onRoot(comm, [] {
    const std::string text =
        namedStylesHelp() + "\nEffects, of which styles are made:\n\n" + styleHelp();
    std::fputs(text.c_str(), stdout);
  });
  return 0;
}

}  // namespace burin::host
