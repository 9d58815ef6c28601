#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"
#include "volume_files.hpp"

namespace burin::test {

/// A line of cases.txt; see write_volumes.py.
struct WrittenVolume {
  std::string file;
  std::string option;
  glm::ivec3 dims{0};
  std::string type;
  std::string expected;
  std::string geometry;
};

/// Where the writer was told that its voxels lie.
struct WrittenPlace {
  bool anatomical = false;
  VolumeGrid grid;
};

/// Nothing if the writer has no say in it.
inline std::optional<WrittenPlace> placeOf(const WrittenVolume& one) {
  std::istringstream in{one.geometry};
  const std::vector<double> numbers{std::istream_iterator<double>{in}, {}};
  if (numbers.size() != 16) return std::nullopt;
  WrittenPlace place{numbers[0] != 0, {.dims = one.dims}};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    place.grid.spacing[axis] = numbers[1 + a];
    place.grid.origin[axis] = numbers[4 + a];
    for (int row = 0; row < 3; ++row)
      place.grid.direction[axis][row] = numbers[7 + 3 * a + static_cast<std::size_t>(row)];
  }
  return place;
}

inline std::string contentOf(const std::filesystem::path& file) {
  std::ifstream in{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

/// What the script wrote, once for all tests.
struct WrittenVolumes {
  WrittenVolumes() {
    const std::string command =
        fmt::format("/usr/bin/python3 '{}' '{}' > '{}' 2>&1", BURIN_WRITE_VOLUMES,
                    folder.path().string(), folder / "log.txt");
    if (!std::filesystem::exists("/usr/bin/python3")) {
      std::ofstream{folder.path() / "missing.txt"} << "/usr/bin/python3\n";
      isThere = true;
      return;
    }
    isThere = std::system(command.c_str()) == 0;
    std::istringstream lines{contentOf(folder.path() / "cases.txt")};
    for (std::string line; std::getline(lines, line);) {
      std::istringstream fields{line};
      WrittenVolume one;
      std::string dims;
      for (std::string* field :
           {&one.file, &one.option, &dims, &one.type, &one.expected, &one.geometry})
        std::getline(fields, *field, '\t');
      std::istringstream{dims} >> one.dims.x >> one.dims.y >> one.dims.z;
      cases.push_back(one);
    }
  }
  TemporaryFolder folder;
  bool isThere = false;  ///< all that the programs installed here can write
  std::vector<WrittenVolume> cases;
};

inline const WrittenVolumes& written() {
  static const WrittenVolumes all;
  return all;
}

/// What the user says to open it.
inline VolumeChoice choiceOf(const WrittenVolume& one) {
  VolumeChoice choice = fileChoice(written().folder / one.file.c_str());
  const std::string value = one.option.substr(one.option.find('=') + 1);
  if (one.option.starts_with("component=")) choice.component = std::stoi(value);
  if (one.option.starts_with("series=")) choice.series = value;
  return choice;
}

/// A writer that wrote nothing may only be one that is not installed.
inline void skipIfWritersAreMissing() {
  ASSERT_TRUE(written().isThere) << contentOf(written().folder.path() / "log.txt");
  const std::string missing = contentOf(written().folder.path() / "missing.txt");
  ASSERT_NE(missing, "") << "nothing was written though no program is missing";
  GTEST_SKIP() << "not installed: " << missing;
}

}  // namespace burin::test
