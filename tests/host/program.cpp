#include "host/program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "support/temporary_folder.hpp"

namespace burin::test {

namespace {

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string{"'\\''"} : std::string{c};
  return text + "'";
}

std::string contents(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream{file, std::ios::binary}.rdbuf();
  return text.str();
}

}  // namespace

ProgramResult runBurin(const std::vector<std::string>& arguments, int ranks,
                       const std::string& prefix) {
  const TemporaryFolder folder;
  std::string command = prefix + " ";
  if (ranks > 0) command += fmt::format("{} -n {} ", BURIN_MPIRUN, ranks);
  command += quoted(BURIN_PROGRAM);
  for (const std::string& argument : arguments) command += fmt::format(" {}", quoted(argument));
  command += fmt::format(" >{} 2>{} </dev/null", quoted(folder / "out"), quoted(folder / "err"));
  const int status = std::system(command.c_str());
  ProgramResult result;
  result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.out = contents(folder / "out");
  result.err = contents(folder / "err");
  return result;
}

std::string onlyLine(const std::string& err) {
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
  EXPECT_TRUE(err.starts_with("burin: ")) << err;
  return err.substr(0, err.find('\n'));
}

}  // namespace burin::test
