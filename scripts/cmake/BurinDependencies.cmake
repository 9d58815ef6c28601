# Every package the project uses, found in one place so that a missing one is named at once;
# scripts/setup installs them. burinConfig.cmake.in repeats those that installed libraries need.
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
find_package(MPI REQUIRED COMPONENTS C)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
find_package(OpenImageIO 2.4 REQUIRED)
find_package(NIFTI REQUIRED)
find_package(Teem REQUIRED)

if(NOT TARGET glm::glm)
  add_library(glm::glm ALIAS glm)
endif()
