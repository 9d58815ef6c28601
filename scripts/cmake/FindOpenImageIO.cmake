# Target OpenImageIO::OpenImageIO, through pkg-config: the CMake package of Debian 12's
# libopenimageio-dev refuses to load unless OpenImageIO's command line tools are installed too.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(OpenImageIO_PC QUIET IMPORTED_TARGET OpenImageIO)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenImageIO
  REQUIRED_VARS OpenImageIO_PC_LINK_LIBRARIES VERSION_VAR OpenImageIO_PC_VERSION)
if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
  add_library(OpenImageIO::OpenImageIO INTERFACE IMPORTED)
  target_link_libraries(OpenImageIO::OpenImageIO INTERFACE PkgConfig::OpenImageIO_PC)
endif()
