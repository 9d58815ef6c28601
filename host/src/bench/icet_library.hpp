#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <string>

namespace burin::host::bench {

/// What IceT hands around. Its headers are not needed: these are our own declarations, after the
/// manual pages of IceT 2.2 (Debian's package paraview has them in section 3).
namespace icet {

using Enum = std::uint32_t;
using Boolean = std::uint8_t;
/// Passed and returned by value.
struct Image {
  void* internals;
};

// Formats, strategies and state variables, by the names of the manual without their ICET_.
inline constexpr Enum kColorRgbaFloat = 0xC002;
inline constexpr Enum kDepthNone = 0xD000;
inline constexpr Enum kCompositeModeBlend = 0x0302;
inline constexpr Enum kStrategyDirect = 0x6001;
inline constexpr Enum kStrategySequential = 0x6002;
inline constexpr Enum kStrategyReduce = 0x6004;
inline constexpr Enum kSingleAutomatic = 0x7001;
inline constexpr Enum kSingleBinarySwap = 0x7002;
inline constexpr Enum kSingleTree = 0x7003;
inline constexpr Enum kSingleRadixK = 0x7004;
inline constexpr Enum kSingleRadixKr = 0x7005;
inline constexpr Enum kSingleBinarySwapFolding = 0x7006;
inline constexpr Enum kDiagnosticsOff = 0;
inline constexpr Enum kNoError = 0;
inline constexpr Enum kOrderedComposite = 0x0142;
inline constexpr Enum kInterlaceImages = 0x0145;
inline constexpr Enum kCollectImages = 0x0146;
inline constexpr Enum kValidPixelsTile = 0x0098;
inline constexpr Enum kValidPixelsOffset = 0x0099;
inline constexpr Enum kValidPixelsNumber = 0x009A;
inline constexpr Enum kBytesSent = 0x00CA;

}  // namespace icet

/// The functions of IceT's C interface that the benchmark calls; loaded at run time, so that burin
/// neither needs IceT to be built nor to run. The function pointers are never null. Copies share
/// the library, which stays loaded as long as one of them lives.
struct IceTLibrary {
  std::shared_ptr<void> core, mpi;  ///< in this order: closed last to first
  std::string file;                 ///< the library that was found, for messages

  void* (*createMpiCommunicator)(MPI_Comm);
  void (*destroyMpiCommunicator)(void*);
  void* (*createContext)(void*);
  void (*destroyContext)(void*);
  void (*setContext)(void*);
  void (*diagnostics)(icet::Enum);
  icet::Enum (*getError)();
  void (*resetTiles)();
  int (*addTile)(std::int32_t x, std::int32_t y, std::int32_t width, std::int32_t height,
                 int displayRank);
  void (*setColorFormat)(icet::Enum);
  void (*setDepthFormat)(icet::Enum);
  void (*compositeMode)(icet::Enum);
  void (*compositeOrder)(const std::int32_t* ranks);
  void (*strategy)(icet::Enum);
  void (*singleImageStrategy)(icet::Enum);
  void (*enable)(icet::Enum);
  void (*disable)(icet::Enum);
  icet::Boolean (*isEnabled)(icet::Enum);
  void (*getIntegers)(icet::Enum, std::int32_t*);
  icet::Image (*compositeImage)(const void* color, const void* depth,
                                const std::int32_t* validViewport, const double* projection,
                                const double* modelview, const float* background);
  std::int32_t (*imagePixels)(icet::Image);
  const float* (*imageColour)(icet::Image);
};

/// Local. Loads the first IceT for MPI found in: the folder that the environment variable
/// BURIN_ICET_FOLDER names, build/icet of the checkout this program was built in (where
/// scripts/get-icet puts it), the system's library folders. Throws Error{kUsage} that says where it
/// looked if there is none, that it is for another MPI, or what it lacks.
IceTLibrary loadIceT();

}  // namespace burin::host::bench
